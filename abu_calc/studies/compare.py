"""Machines, or variants of one, side by side: what differs in their files, designs and checks."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from string import ascii_uppercase
from typing import Annotated, Any, ClassVar, Final

from abu_calc.checks import Check, Status
from abu_calc.errors import InputError, Place
from abu_calc.progress import Progress, silent, within
from abu_calc.spec.bearing_file import BearingFile
from abu_calc.spec.read import Machine
from abu_calc.studies.arguments import checked
from abu_calc.studies.check_fit import CheckFitResult, check_fit
from abu_calc.studies.quantity import Quantity, Record, as_plain, record
from abu_calc.studies.result import Provenance, Result
from abu_calc.studies.side_by_side import Difference, of_checks, of_designs, of_files
from abu_calc.studies.size import SizeResult, size

LETTERS: Final = ascii_uppercase


@record
class ComparedFile(Record):
    """One of the machines: where it comes from, and its verdict."""

    letter: Annotated[str, Quantity("letter", "", 4, "by which reports, checks and warnings name it")]
    file: Annotated[str, Quantity("file")]
    title: Annotated[str, Quantity("machine")]
    sha256: Annotated[str, Quantity("SHA-256")]
    overrides: Annotated[Mapping[str, Any], Quantity("entries replaced")]
    status: Annotated[Status, Quantity("status")]


@record
class CompareResult(Result):
    """Differences, entry by entry; the checks are those of all, each with the letter of its machine."""

    command: ClassVar[str] = "compare"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"alike"}

    files: tuple[ComparedFile, ...]
    differences: tuple[Difference, ...]
    alike: tuple[Difference, ...]
    """Entries that all have alike: whole reports show them, JSON does not."""


@checked
def compare(
    machines: Sequence[Machine], accuracy: float = 0.01, progress: Progress = silent, workers: int | None = None
) -> CompareResult:
    """Size every machine as `size` does, and set files, designs and checks side by side, the first one first.

    Of files without an autobalancer the bearing seats are judged, as `check_fit` does. A variant is
    `machine.changed({…})`. Values of files are those given, or else the defaults in force; computed numbers that differ
    by less than 1e-9 of the larger are alike. Raises InputError for less than two machines, and what sizing raises.
    """
    if not 2 <= len(machines) <= len(LETTERS):
        raise InputError(
            "at least two are compared",
            place=Place(key="machines"),
            found=f"{len(machines)} of them" if len(machines) != 1 else "one",
            allowed=f"2 to {len(LETTERS)}",
            remedy='Name another one, or a variant: --variant "wheel.mass_kg=0.5".',
        )
    results = []
    for letter, machine in zip(LETTERS, machines, strict=False):
        what = f"{letter} of {LETTERS[len(machines) - 1]}, {machine.title}"
        progress(what)
        results.append(_judged(machine, accuracy, within(progress, what), workers))
    named = list(zip(LETTERS, machines, results, strict=False))
    designs = of_designs([_entries(result) for result in results])
    rows = (*of_files(machines), *designs, *of_checks([result.checks for result in results]))
    return CompareResult(
        title=f"Comparison of {len(machines)} machines",
        checks=tuple(_of(letter, check) for letter, _, result in named for check in result.checks),
        warnings=_warnings({letter: result.warnings for letter, _, result in named}),
        provenance=Provenance.today(),
        files=tuple(_file(*entry) for entry in named),
        differences=tuple(row for row in rows if not row.alike),
        alike=tuple(row for row in rows if row.alike),
    )


def _judged(machine: Machine, accuracy: float, progress: Progress, workers: int | None) -> SizeResult | CheckFitResult:
    tables = machine.tables
    if isinstance(tables, BearingFile) or (tables.autobalancer is None and tables.bearing):
        return check_fit(machine)
    return size(machine, accuracy, progress, workers)


def _entries(result: SizeResult | CheckFitResult) -> Mapping[str, Any]:
    """Entries of a design's result; for bearing seats alone, the seats stand in their place."""
    return {"fits": result.to_dict()} if isinstance(result, CheckFitResult) else result.to_dict()


def _file(letter: str, machine: Machine, result: Result) -> ComparedFile:
    return ComparedFile(
        letter=letter,
        file=machine.file,
        title=machine.title,
        sha256=machine.sha256,
        overrides=as_plain({override.key: override.value for override in machine.overrides}),
        status=result.status,
    )


def _of(letter: str, check: Check) -> Check:
    return replace(check, name=f"{check.name}, {letter}")


def _warnings(of: Mapping[str, Sequence[str]]) -> tuple[str, ...]:
    """Each once, with the letters of the machines that it is about."""
    letters: dict[str, list[str]] = {}
    for letter, warnings in of.items():
        for warning in dict.fromkeys(warnings):
            letters.setdefault(warning, []).append(letter)
    return tuple(f"{', '.join(about)}: {warning}" for warning, about in letters.items())
