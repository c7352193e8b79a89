"""Files held to the results they expect: expected values against recomputed ones, at the paths of the JSON.

The report of `abu verify`: a line for each file, and a table of differences.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Final

from abu_calc.features.balancing.read import Readings
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress, Stage, silent
from abu_calc.foundation.quantity import Quantity, Record, as_plain, record
from abu_calc.foundation.rows import Rows
from abu_calc.inputs.bearing_file import BearingFile, HasExpectations, expected_tolerances, expected_values
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.document import FileReading
from abu_calc.reporting.blocks import Block, Grid, Paragraph, number
from abu_calc.reporting.parts import WORD, warning_blocks
from abu_calc.reporting.screen import LINES, cut, height, many
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result

DEFAULT_TOLERANCE: Final = 1e-3
"""Relative; tight enough to see a changed formula, loose enough for another platform's rounding."""

SIMULATED_TOLERANCE: Final = 0.02
"""Relative tolerance of simulated values.

It allows the accuracy of 0.01 asked for by default on either side, whatever the integrator.
"""

WORTH_KEEPING: Final = (
    "status",
    "imbalance_g_mm",
    "required_capacity_g_mm",
    "autobalancer.ball_count",
    "autobalancer.ball_diameter_mm",
    "autobalancer.race_radius_mm",
    "autobalancer.capacity_g_mm",
    "autobalancer.mass_g",
    "accuracy_budget.residual_um",
    "vibration.level_before_db",
    "vibration.level_after_db",
    "simulation.0.quiet_time_s",
    "simulation.0.rest_time_s",
    "simulation.0.settling_time_s",
    "swing_arm.contact_stiffness_limit_N_per_m",
    "swing_arm.damping_limit_N_s_per_m",
    "left.mass_g",
    "left.angle_deg",
    "right.mass_g",
    "right.angle_deg",
)
"""Values that `--update` writes into a file without expected values.

Bearing seats have their fits and interferences instead.
"""

SEAT_KEYS: Final = ("fit", "interference_um.0", "interference_um.1", "recommended_fit")


@record
class ComparedValue(Record):
    """One expected value and what came out."""

    path: Annotated[str, Quantity("path in the result")]
    expected: Annotated[Any, Quantity("expected")]
    found: Annotated[Any, Quantity("found")]
    tolerance: Annotated[float, Quantity("allowed deviation", "", 1, "relative")]
    deviation: Annotated[float | None, Quantity("deviation", "", 3, "relative, where both are numbers")]
    passed: Annotated[bool, Quantity("passed")]


def compare(
    expected: Mapping[str, Any], tolerances: Mapping[str, float], entries: Mapping[str, object]
) -> tuple[ComparedValue, ...]:
    """Every expected value against the result at its path; a path that is not there has failed."""
    return tuple(
        _compared(path, value, tolerances.get(path), value_at(entries, path)) for path, value in expected.items()
    )


def _compared(path: str, value: Any, tolerance: float | None, actual: Any) -> ComparedValue:
    usual = SIMULATED_TOLERANCE if path.startswith("simulation.") else DEFAULT_TOLERANCE
    allowed = usual if tolerance is None else tolerance
    if isinstance(value, list) and isinstance(actual, list) and len(value) == len(actual):
        pairs = [_deviation(a, b) for a, b in zip(value, actual, strict=True)]
        deviation = None if None in pairs else max((each for each in pairs if each is not None), default=0.0)
    else:
        deviation = _deviation(value, actual)
    passed = value == actual if deviation is None else deviation <= allowed
    return ComparedValue(path=path, expected=value, found=actual, tolerance=allowed, deviation=deviation, passed=passed)


def current(paths: tuple[str, ...], entries: Mapping[str, object]) -> dict[str, Any]:
    """The values a file should expect: those at its own paths, or a choice when it has none."""
    if not paths:
        seats = range(len(value_at(entries, "fits") or ()))
        paths = (*WORTH_KEEPING, *(f"fits.{index}.{key}" for index in seats for key in SEAT_KEYS))
    values = {path: value_at(entries, path) for path in paths}
    return {path: _rounded(value) for path, value in values.items() if value is not None}


def value_at(entries: Mapping[str, object], path: str) -> Any:
    """Value at a path in entries of a result, as JSON has it; None if there is none.

    Paths are `autobalancer.ball_count` or `fits.0.fit`, for example.
    """
    value: object = entries
    for part in path.split("."):
        if isinstance(value, Record) and part in value.entries():
            value = getattr(value, part)
        elif isinstance(value, (tuple, Rows)) and part.isdigit() and int(part) < len(value):
            value = value[int(part)]
        elif isinstance(value, Mapping) and part in value:
            value = value[part]
        else:
            return None
    return as_plain(value)


def _deviation(expected: Any, actual: Any) -> float | None:
    if isinstance(expected, bool) or isinstance(actual, bool):
        return None
    if not isinstance(expected, (int, float)) or not isinstance(actual, (int, float)):
        return None
    return math.fabs(actual - expected) / max(math.fabs(expected), 1e-12)


def _rounded(value: Any) -> Any:
    """Six digits: more than any tolerance needs, few enough to read."""
    if isinstance(value, (list, tuple, Rows)):
        return [_rounded(each) for each in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


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
def verify(machines: Sequence[FileReading], progress: Progress = silent) -> VerifyResult:
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


def present_values(machine: FileReading) -> dict[str, Any]:
    """Values that the file should expect now: at its own paths, or a choice if it has none."""
    return current(tuple(expected_values(expectations(machine))), recompute(machine))


def expectations(reading: FileReading) -> HasExpectations:
    """The tables of a file that may expect results. Raises InputError for a scene."""
    if isinstance(reading, (Machine, Readings)):
        return reading.tables
    raise InputError("this file holds a scene, which expects nothing", place=Place(reading.file))


def recompute(machine: FileReading) -> Mapping[str, object]:
    """The entries of a file's result by which the paths in [expected] begin, its status among them."""
    if isinstance(machine, Readings):
        from abu_calc.features.balancing.study import balance

        balancing = balance(machine)
        return {"status": balancing.status, **{name: getattr(balancing, name) for name in balancing.entries()}}
    if not isinstance(machine, Machine):
        return {}
    if isinstance(machine.tables, BearingFile) or machine.tables.autobalancer is None:
        from abu_calc.features.seats.study import check_fit

        seats = check_fit(machine)
        return {"status": seats.status, "fits": seats.seats}
    from abu_calc.features.design.study import size

    result = size(machine)
    return {"status": result.status, **{name: getattr(result, name) for name in result.entries()}}


def _verified(machine: FileReading) -> VerifiedFile:
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
    return replace(coded("ABU901", verdict(not failed), message, float(failed), 0.0, remedy), name=file.file)


MOST_NAMES: Final = 30
"""Files as expected that a screen names."""
LEAST: Final = 1e-6
"""Least relative deviation that is shown with digits."""


def verify_blocks(result: VerifyResult) -> tuple[Block, ...]:
    """The whole report."""
    return (*_blocks(result, {file.file for file in result.files}), *warning_blocks(result.warnings))


def verify_screen(result: VerifyResult) -> tuple[Block, ...]:
    """One screen: differences as far as there is room; files that are as expected take one line."""
    differ = [file.file for file in result.files if file.failed]
    same = [file.file for file in result.files if not file.failed]
    title = f"{len(same)} of {many(len(result.files), 'file')} as expected"
    verdict = Paragraph(f"{'FAIL' if differ else 'PASS'}: {title}", result.status)
    names = [Paragraph(f"As expected: {', '.join(same[:MOST_NAMES])}{', …' if len(same) > MOST_NAMES else ''}.")]
    last: list[Block] = (
        [Paragraph("More: --full, every file. --update writes the computed values into [expected].")] if differ else []
    )
    head: list[Block] = [verdict, *(names if same else [])]
    last = [*warning_blocks(result.warnings), *last]
    return (*head, *cut(_blocks(result, set(differ)), LINES - height([*head, *last])), *last)


def _blocks(result: VerifyResult, shown: set[str]) -> list[Block]:
    """A line and a table a file."""
    blocks: list[Block] = []
    for file, check in zip(result.files, result.checks, strict=True):
        if file.file in shown:
            blocks.append(Paragraph(f"{WORD[check.status]} {file.file}: {check.message}", check.status))
        if file.failed:
            rows = tuple(map(_row, file.failed))
            blocks.append(Grid(("path", "expected", "computed", "deviation", "allowed"), rows))
    return blocks


def _row(entry: ComparedValue) -> tuple[str, ...]:
    deviation = "" if entry.deviation is None else _percent(entry.deviation)
    return entry.path, _value(entry.expected), _value(entry.found), deviation, _percent(entry.tolerance)


def _percent(ratio: float) -> str:
    """A relative deviation; one that shows only rounding has the bound alone."""
    return f"{number(100 * ratio, 3)} %" if ratio == 0 or ratio >= LEAST else f"< {100 * LEAST:g} %"


def _value(value: Any) -> str:
    if isinstance(value, float):
        return number(value, 6)
    return "none" if value is None else str(value)
