"""Machines, or variants of one, side by side: differences in their files, designs and checks.

The numbers that decide a comparison: levels and quiet times, case by case, one column for each machine.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from string import ascii_uppercase
from typing import Annotated, Any, ClassVar, Final, Literal, NamedTuple

from abu_calc.features.design.study import SizeResult, size
from abu_calc.features.seats.study import CheckFitResult, check_fit
from abu_calc.foundation.checks import Check, Status
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.foundation.quantity import Quantity, Record, as_plain, flattened, record
from abu_calc.foundation.units import unit_of
from abu_calc.inputs.bearing_file import BearingFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.table import Table
from abu_calc.inputs.reading.text import is_number, key_path
from abu_calc.reporting.blocks import Block, Grid, level_text, number
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result

Part = Literal["file", "design", "check"]
Values = Mapping[str, tuple[Any, str]]
"""Path → value and unit."""

ROUNDING: Final = 1e-9
"""Computed numbers that are closer, relative to the larger, are the same: they differ by rounding alone."""

OF_THE_RUN: Final = frozenset({"cost", "error_estimate", "outline_mm"})
"""Entries of a result that say how it was computed, and nothing of the machine."""


@record
class Difference(Record):
    """One entry of a file, a design or a check, in the order of the files; null: there is none in force."""

    part: Annotated[Part, Quantity("part", "", 4, "file: the key in the machine file; design: the path in the result")]
    path: Annotated[str, Quantity("path")]
    unit: Annotated[str, Quantity("unit")]
    values: Annotated[tuple[Any, ...], Quantity("values", "", 4, "in the order of the files")]

    @property
    def alike(self) -> bool:
        """True if all machines have the same value."""
        return all(_alike(self.values[0], other, exact=self.part == "file") for other in self.values[1:])


def of_files(machines: Sequence[Machine]) -> Iterator[Difference]:
    """Entries of the files, with the defaults in force for missing ones; expected values are left out."""
    return _rows("file", [_in_force(machine.tables) for machine in machines])


def of_designs(entries: Sequence[Mapping[str, Any]]) -> Iterator[Difference]:
    """Results of the designs, at the paths of their results."""
    return _rows("design", [{path: (value, _unit(path)) for path, value in _leaves(design)} for design in entries])


def of_checks(checks: Sequence[Sequence[Check]]) -> Iterator[Difference]:
    """Status, value and limit of every check, by its code; where there are several of one code, by its name too."""
    repeated = {code for column in checks for code in _repeated(check.code for check in column)}
    return _rows("check", [_graded(column, repeated) for column in checks])


def _rows(part: Part, columns: Sequence[Values]) -> Iterator[Difference]:
    paths = dict.fromkeys(path for column in columns for path in column)
    for path in paths:
        cells = [column.get(path, (None, "")) for column in columns]
        unit = next((unit for _, unit in cells if unit), "")
        yield Difference(part=part, path=path, unit=unit, values=tuple(as_plain(value) for value, _ in cells))


def _in_force(tables: Table) -> Values:
    entries = {}
    for path, table in tables.tables():
        silent = table.unused() - table.model_fields_set
        for key in type(table).model_fields:
            value = getattr(table, key)
            if key not in silent and _is_entry(value) and "expected" not in (*path[:1], key):
                entries[key_path((*path, key))] = value, unit_of(key)
    return entries


def _is_entry(value: object) -> bool:
    """True if there is a value, and no further table."""
    inner = value if isinstance(value, tuple) else (value,)
    return value is not None and value != () and not any(isinstance(element, Table) for element in inner)


def _leaves(entries: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    return ((path, value) for path, value in flattened(dict(entries)) if not OF_THE_RUN & {*path.split(".")})


def _unit(path: str) -> str:
    """Unit of the last step which names one: `interference_um.0` is in µm."""
    return next((unit for unit in map(unit_of, reversed(path.split("."))) if unit), "")


def _repeated(codes: Iterable[str]) -> set[str]:
    seen, twice = set[str](), set[str]()
    for code in codes:
        (twice if code in seen else seen).add(code)
    return twice


def _graded(checks: Sequence[Check], repeated: set[str]) -> Values:
    grades: dict[str, tuple[Any, str]] = {}
    for check in checks:
        name = f"{check.code} {check.name}" if check.code in repeated else check.code
        for key in ("status", "value", "limit"):
            grades[key_path(("checks", name, key))] = getattr(check, key), "" if key == "status" else check.unit or ""
    return grades


def _alike(first: Any, other: Any, *, exact: bool) -> bool:
    """The same; a number alone is a list of it, as files may say either."""
    if isinstance(first, list) != isinstance(other, list):
        first, other = (first, [other] * len(first)) if isinstance(first, list) else ([first] * len(other), other)
    if isinstance(first, list):
        same = (_alike(a, b, exact=exact) for a, b in zip(first, other, strict=False))
        return len(first) == len(other) and all(same)
    if exact or not (is_number(first) and is_number(other)):
        return isinstance(first, bool) is isinstance(other, bool) and bool(first == other)
    return bool(abs(first - other) <= ROUNDING * max(abs(first), abs(other)))


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


def checks_named(result: CompareResult, name: str) -> list[Check | None]:
    """The check of each machine with this code or key, or with this code and name; None: it is not asked there."""
    by_letter: dict[str, Check] = {}
    for check in result.checks:
        own, _, letter = check.name.rpartition(", ")
        if name in (check.code, check.key, f"{check.code} {own}"):
            by_letter.setdefault(letter, check)
    return [by_letter.get(file.letter) for file in result.files]


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
        checks=tuple(
            replace(check, name=f"{check.name}, {letter}") for letter, _, result in named for check in result.checks
        ),
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
        file=machine.file or "text",
        title=machine.title,
        sha256=machine.sha256,
        overrides=as_plain({override.key: override.value for override in machine.overrides}),
        status=result.status,
    )


def _warnings(of: Mapping[str, Sequence[str]]) -> tuple[str, ...]:
    """Each once, with the letters of the machines that it is about."""
    letters: dict[str, list[str]] = {}
    for letter, warnings in of.items():
        for warning in dict.fromkeys(warnings):
            letters.setdefault(warning, []).append(letter)
    return tuple(f"{', '.join(about)}: {warning}" for warning, about in letters.items())


DECIBELS: Final = (
    ("vibration.level_before_db", "Idle, without autobalancer"),
    ("ensemble.predicted_level_db", "Idle, with: median of the start cases"),
    ("vibration.level_after_db", "  expected, manufacture and friction"),
    ("ensemble.level_db.worst", "  loudest listed start case"),
    ("vibration.worst_arrangement.level_after_db", "  bound of friction"),
    ("measured_after.measured_level_db", "  measured"),
)
"""Levels of the idle machine, by their paths in the results; labels as on the screen of `abu size`."""
LOADED: Final = (
    ("vibration_loaded.level_before_db", "Grinding, without autobalancer"),
    ("vibration_loaded.level_after_db", "Grinding, with: pressed after settling"),
    ("vibration_loaded.level_at_once_db", "  pressed earlier"),
    ("vibration_loaded.starts.worst_db", "  loudest start case"),
)
"""Levels at the workpiece."""
STARTS: Final = "ensemble.settling_by_start"
MEDIAN: Final = "ensemble.quiet_time_s.typical"
SLOWEST: Final = "ensemble.quiet_time_s.worst"
DRAG: Final = "autobalancer.rolling_drag_per_s"
"""Key of the files: the drag rate in force: as given, or its default."""
COUNT: Final = "ensemble.members"
BOUND: Final = "vibration_loaded.bound.lower_bound"

Designs = Mapping[str, Sequence[Any]]
"""Path → the values of all machines."""


class _NumbersLine(NamedTuple):
    """A case and its cell for each machine."""

    label: str
    cells: tuple[str, ...]


def main_blocks(result: CompareResult) -> list[Block]:
    """Levels and quiet times, those that are equal too; nothing if no machine has an autobalancer."""
    rows = (*result.differences, *result.alike)
    designs = {row.path: row.values for row in rows if row.part == "design" or row.path == DRAG}
    titles = (
        (f"Vibration, dB re 5e-8 m/s{_one_limit(result, 'idle_level')}", _levels(result, designs)),
        (f"Quiet time, s{_one_limit(result, 'quiet_time')}", _settling(result, designs)),
    )
    letters = tuple(file.letter for file in result.files)
    right = frozenset(range(1, len(letters) + 1))
    return [
        Grid((title, *letters), tuple((line.label, *line.cells) for line in lines), right, kept=2)
        for title, lines in titles
        if lines
    ]


def _levels(result: CompareResult, designs: Designs) -> list[_NumbersLine]:
    lines = [
        _NumbersLine(label, tuple(map(_level, designs[path]))) for path, label in DECIBELS if _known(designs, path)
    ]
    if lines:
        lines += _limit(result, "idle_level")
    bounds = designs.get(BOUND, [None] * len(result.files))
    for path, label in LOADED:
        if _known(designs, path):
            values = zip(designs[path], bounds, strict=True)
            at_least = path == "vibration_loaded.level_after_db"
            lines.append(
                _NumbersLine(label, tuple(f"≥ {_level(v)}" if at_least and low and v is not None else _level(v)
                                   for v, low in values))
            )  # fmt: skip
    return lines


def _settling(result: CompareResult, designs: Designs) -> list[_NumbersLine]:
    machines = range(len(result.files))
    simulated = [designs.get(COUNT, [None] * len(result.files))[k] is not None for k in machines]
    if not any(simulated):
        return []

    def line(label: str, values: Sequence[float | None]) -> _NumbersLine:
        """A line of times [s]; “–” for a design without simulated start cases."""
        return _NumbersLine(label, tuple(_time(value) if simulated[k] else "–" for k, value in enumerate(values)))

    given = [_slowest_as_given(designs, k) for k in machines]
    return [
        line("Median of the start cases", designs[MEDIAN]),
        line("Slowest start case, drag rate in force", given),
        line("Slowest listed start case, any oil", designs[SLOWEST]),
        *_limit(result, "quiet_time"),
    ]


def _slowest_as_given(designs: Designs, machine: int) -> float | None:
    """Longest quiet time [s] of one machine at its own drag rate; None: a start case is never quiet."""
    times = list[float]()
    drags = {path: values[machine] for path, values in designs.items()
             if path.startswith(STARTS) and path.endswith(".drag_per_s")}  # fmt: skip
    for path, drag in drags.items():
        if drag is not None and drag == designs[DRAG][machine]:
            time = designs[path.replace(".drag_per_s", ".quiet_time_s")][machine]
            times.append(math.inf if time is None else time)
    longest = max(times, default=math.inf)
    return None if math.isinf(longest) else longest


def _limits(result: CompareResult, key: str) -> list[float | None]:
    return [None if check is None else check.limit for check in checks_named(result, key)]


def _one_limit(result: CompareResult, key: str) -> str:
    """Limit that all machines have, for the head of a table."""
    limits = set(_limits(result, key)) - {None}
    return f" (limit {number(limit, 3)})" if len(limits) == 1 and (limit := limits.pop()) is not None else ""


def _limit(result: CompareResult, key: str) -> list[_NumbersLine]:
    """Limits that differ, as a line of the table."""
    limits = _limits(result, key)
    if len(set(limits) - {None}) <= 1:
        return []
    return [_NumbersLine("  limit", tuple("–" if limit is None else number(limit, 3) for limit in limits))]


def _known(designs: Designs, path: str) -> bool:
    return any(is_number(value) for value in designs.get(path, ()))


def _level(value: float | None) -> str:
    return "–" if value is None else level_text(value, 4 if value >= 100 else 3).removesuffix(" dB")


def _time(value: float | None) -> str:
    return "never" if value is None else number(value, 3 if value >= 1 else 2)
