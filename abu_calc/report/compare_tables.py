"""Entries of several machines as tables: one column for each machine, one row for each entry."""

import math
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

from abu_calc.checks import Grade
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.numbers import number
from abu_calc.report.parts import RANK, WORD
from abu_calc.spec.text import is_number
from abu_calc.spec.text import shown as exact
from abu_calc.studies.compare import CompareResult
from abu_calc.studies.side_by_side import ROUNDING, Difference, Part

SECTIONS: Final[dict[Part, str]] = {
    "file": "Files",
    "check": "Checks: grade, value (limit where it differs)",
    "design": "Designs",
}
LONGEST_CELL: Final = 20
DIGITS: Final = 4
MOST_DIGITS: Final = 15


class Table(NamedTuple):
    """A heading, and lines: what an entry is called, and the cell of each machine."""

    heading: str
    lines: tuple[tuple[str, ...], ...]


def tables_of(result: CompareResult, rows: Sequence[Difference], *, marked: bool = False) -> list[Table]:
    """Each part that has rows under its heading, the checks with value beside grade."""
    tables = []
    for part, heading in SECTIONS.items():
        own = [row for row in rows if row.part == part]
        lines = _checks(result, own, marked) if part == "check" else [_cells(row, marked) for row in own]
        if lines:
            tables.append(Table(heading, tuple(lines)))
    return tables


def table_blocks(letters: Sequence[str], table: Table, count: int | None = None) -> list[Block]:
    """Blocks of the first `count` lines of a table; None: all lines.

    Lines with long cells stand below the table, one machine after another.
    """
    lines = table.lines[:count]
    short = [line for line in lines if max(map(len, line[1:])) <= LONGEST_CELL]
    blocks: list[Block] = [Heading(table.heading), *_grid(letters, short)]
    for label, *cells in (line for line in lines if line not in short):
        blocks.append(Paragraph(label))
        blocks += [Paragraph(f"{k}  {cell}", indent=4, hang=3) for k, cell in zip(letters, cells, strict=True)]
    return blocks


def _grid(letters: Sequence[str], lines: Sequence[tuple[str, ...]]) -> list[Grid]:
    """A table; where the machines do not stand side by side each begins with the first of them."""
    return [Grid(("", *letters), tuple(lines), frozenset(range(1, len(letters) + 1)), kept=2)] if lines else []


def _mark(row_alike: bool, marked: bool) -> str:
    return "" if not marked else "  " if row_alike else "≠ "


def _cells(row: Difference, marked: bool) -> tuple[str, ...]:
    return f"{_mark(row.alike, marked)}{row.path}", *_written(row.values)


def _checks(result: CompareResult, rows: Sequence[Difference], marked: bool) -> list[tuple[str, ...]]:
    """One line for each check of these rows, the worst first: grade and value of each machine."""
    known = {row.path: row for row in (*result.differences, *result.alike) if row.part == "check"}
    names = {check.code: check.name for check in reversed(result.checks)}
    lines = []
    for head in dict.fromkeys(row.path.rpartition(".")[0] for row in rows):
        status, value, limit = (known[f"{head}.{key}"] for key in ("status", "value", "limit"))
        name = head.removeprefix("checks.").strip('"')
        label = name if " " in name else f"{name} {names[name].rpartition(', ')[0]}"
        limits = [""] * len(limit.values) if limit.alike else [f" ({text})" for text in _written(limit.values)]
        cells = (
            "–" if grade is None else f"{WORD[grade]} {value_text}{bound}".replace(" –", "").rstrip()
            for grade, value_text, bound in zip(status.values, _written(value.values), limits, strict=True)
        )  # fmt: skip
        same = status.alike and value.alike and limit.alike
        line = f"{_mark(same, marked)}{label}{f', {value.unit}' if value.unit else ''}", *cells
        lines.append((min(map(_rank, status.values)), line))
    return [line for _, line in sorted(lines, key=lambda pair: pair[0])]


def _rank(grade: Grade | None) -> int:
    return RANK.index(grade) if grade in RANK else len(RANK)


def _written(values: Sequence[Any]) -> list[str]:
    """Values as text; numbers to as many digits as tell apart those that differ."""
    apart = len({value for value in values if is_number(value)})
    for digits in range(DIGITS, MOST_DIGITS + 1):
        texts = [_text(value, digits) for value in values]
        if len({text for text, value in zip(texts, values, strict=True) if is_number(value)}) >= apart:
            break
    return texts


def _text(value: Any, digits: int) -> str:
    if value is None:
        return "–"
    if isinstance(value, float):
        short = f"{value:g}"
        return (
            short if math.isclose(float(short), value, rel_tol=ROUNDING) and "e" not in short else number(value, digits)
        )
    return value if isinstance(value, str) else exact(value)
