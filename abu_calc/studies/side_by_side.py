"""Values of several machines side by side: which differ, and which do not."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any, Final, Literal

from abu_calc.checks import Check
from abu_calc.spec.read import Machine
from abu_calc.spec.table import Table
from abu_calc.spec.text import is_number, key_path
from abu_calc.studies.quantity import Quantity, Record, as_plain, flattened, record
from abu_calc.units import unit_of

Part = Literal["file", "design", "check"]
Values = Mapping[str, tuple[Any, str]]
"""Path → value and unit."""

ROUNDING: Final = 1e-9
"""Computed numbers that are closer, relative to the larger, are the same: they differ by rounding alone."""

OF_THE_RUN: Final = frozenset({"cost", "error_estimate"})
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
