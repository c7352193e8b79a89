"""Files held to the results they expect."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar

from abu_calc.checks import Check, verdict
from abu_calc.errors import InputError, Place
from abu_calc.progress import Progress, Stage, silent
from abu_calc.spec.bearing_file import BearingFile, HasExpectations, expected_tolerances, expected_values
from abu_calc.spec.document import Reading
from abu_calc.spec.read import Machine
from abu_calc.spec.read_readings import Readings
from abu_calc.studies.arguments import checked
from abu_calc.studies.expected import ComparedValue, compare, current
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.studies.result import Provenance, Result


@record
class VerifiedFile(Record):
    """One file and its values."""

    file: Annotated[str, Quantity("file")]
    values: tuple[ComparedValue, ...]

    @property
    def failed(self) -> tuple[ComparedValue, ...]:
        """Values that differ."""
        return tuple(each for each in self.values if not each.passed)


@record
class VerifyResult(Result):
    """Every file with its values, a check each."""

    command: ClassVar[str] = "verify"

    files: tuple[VerifiedFile, ...]


@checked
def verify(machines: Sequence[Reading], progress: Progress = silent) -> VerifyResult:
    """Recompute files of machines and readings and compare with what they expect.

    Raises InputError for a file that expects nothing.
    """
    files = []
    for index, machine in enumerate(machines, 1):
        progress(Stage(f"{index} of {len(machines)} files, {machine.file}", (index - 1) / len(machines)))
        files.append(_verified(machine))
    checks = tuple(map(_check, files))
    warnings = tuple(f"{machine.file}: {warning}" for machine in machines for warning in machine.warnings)
    return VerifyResult(
        title="verify", checks=checks, warnings=warnings, provenance=Provenance.today(), files=tuple(files)
    )


def present_values(machine: Reading) -> dict[str, Any]:
    """Values that the file should expect now: at its own paths, or a choice if it has none."""
    return current(tuple(expected_values(expectations(machine))), recompute(machine))


def expectations(reading: Reading) -> HasExpectations:
    """The tables of a file that may expect results. Raises InputError for a scene."""
    if isinstance(reading, (Machine, Readings)):
        return reading.tables
    raise InputError("this file holds a scene, which expects nothing", place=Place(reading.file))


def recompute(machine: Reading) -> Mapping[str, object]:
    """The entries of a file's result by which the paths in [expected] begin, its status among them."""
    if isinstance(machine, Readings):
        from abu_calc.studies.balance import balance

        balancing = balance(machine)
        return {"status": balancing.status, **{name: getattr(balancing, name) for name in balancing.entries()}}
    if not isinstance(machine, Machine):
        return {}
    if isinstance(machine.tables, BearingFile) or machine.tables.autobalancer is None:
        from abu_calc.studies.check_fit import check_fit

        seats = check_fit(machine)
        return {"status": seats.status, "fits": seats.seats}
    from abu_calc.studies.size import size

    result = size(machine)
    return {"status": result.status, **{name: getattr(result, name) for name in result.entries()}}


def _verified(machine: Reading) -> VerifiedFile:
    expected = expected_values(expectations(machine))
    if not expected:
        raise InputError(
            "nothing is expected of this file",
            place=Place(machine.file, key="expected"),
            remedy=f"`abu verify --update {machine.file}` writes its present results.",
        )
    values = compare(expected, expected_tolerances(expectations(machine)), recompute(machine))
    return VerifiedFile(file=machine.file, values=values)


def _check(file: VerifiedFile) -> Check:
    failed = len(file.failed)
    remedy = "If the change is meant, write it with --update." if failed else None
    message = f"{len(file.values)} values, {failed} differ"
    return Check("ABU901", file.file, verdict(not failed), message, float(failed), 0.0, None, remedy)
