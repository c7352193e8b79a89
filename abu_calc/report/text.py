"""Blocks as text in a terminal or a file."""

import os
import re
import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from abu_calc.escapes import escaped
from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.report.columns import Line, Piece, table_lines, widths_within

if TYPE_CHECKING:
    from rich.console import Console

STYLES = {
    "pass": "bold green",
    "warn": "bold yellow",
    "fail": "bold red",
    "not-done": "bold magenta",
    "warning": "yellow",
}
WORDS = {"WARN": "warn", "FAIL": "fail", "NOT DONE": "not-done"}
"""Cells of tables that are styled as these marks are."""
WIDEST = 100
MARGIN = 2
"""Blanks before each column of a table, and before running text."""
HEADING_HANG = 6
"""Before further lines of a heading, so that no word of a long name stands where verdicts do."""
FACT_WIDTHS = (35, 17)
"""Label and symbol: the same in every block, so that values stand in one column; they take the rest of the line."""

BEFORE_UNIT = re.compile(r"(?<=\d) (?=(?:g·mm|1/s|mm|Hz|rpm|dB|µm|MPa|kg|[sNgW%])(?!\w))")
"""Blanks at which no line is broken."""
TIE = "\u00a0"

NARROW = 72
"""On lines shorter than this the symbols are left out."""


def show(blocks: Iterable[Block], *, color: bool = True) -> None:
    """Print blocks one after another, as wide as the terminal is but never wider than reads well."""
    width = min(shutil.get_terminal_size().columns, WIDEST)
    if not (color and (sys.stdout.isatty() or os.environ.get("FORCE_COLOR"))):
        print(as_text(blocks, width), end="")
        return
    from rich.text import Text  # in color alone

    out = console(width)
    for line in _lines(blocks, width):
        out.print(Text.assemble(*line))


def console(width: int, **how: Any) -> "Console":
    """A console of so many columns: Rich does not bear everything that COLUMNS and LINES may be."""
    from rich.console import Console

    plain = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "LINES")}
    return Console(width=width, markup=False, highlight=False, emoji=False, _environ=plain, **how)


def as_text(blocks: Iterable[Block], width: int = 80) -> str:
    """Blocks as plain text for a file or a pipe, no blanks at the ends of lines."""
    text = "".join("".join(piece for piece, _ in line) + "\n" for line in _lines(blocks, width))
    return "\n".join(line.rstrip() for line in text.splitlines()) + "\n"


def _lines(blocks: Iterable[Block], width: int) -> Iterator[Line]:
    """Lines that are wrapped already, several together where they have one style."""
    for index, block in enumerate(blocks):
        if index and isinstance(block, Heading):
            yield (("", ""),)
        match block:
            case Heading(text):
                yield ((fill(escaped(text), width, 0, HEADING_HANG), "bold"),)
            case Paragraph(text, mark, indent, hang):
                style = STYLES.get(mark or "", "")
                yield ((fill(escaped(text), width, indent, hang), style.removeprefix("bold ") if hang else style),)
            case Facts(rows):
                yield from _facts(rows, width)
            case Grid():
                yield from _grid(block, width)
            case Picture(lines, caption, indent):
                if indent + max(map(len, lines)) <= width:
                    yield (("\n".join(" " * indent + line for line in lines), ""),)
                    yield ((fill(caption, width, MARGIN), ""),)


def height(blocks: Sequence[Block], width: int = 80) -> int:
    """How many lines blocks take."""
    return len(as_text(blocks, width).splitlines()) if blocks else 0


def fill(text: str, width: int, indent: int, hang: int = 0) -> str:
    """Text wrapped to a width, every line indented, those but the first by `hang` more; long words keep whole."""
    together = BEFORE_UNIT.sub(TIE, text)
    return textwrap.fill(
        together, width, initial_indent=" " * indent, subsequent_indent=" " * (indent + hang), break_long_words=False,
        break_on_hyphens=False,
    ).replace(TIE, " ")  # fmt: skip


def _facts(rows: tuple[tuple[str, str, str], ...], width: int) -> Iterator[Line]:
    label, symbol = FACT_WIDTHS
    if width < NARROW:
        both = max(width - 2 * MARGIN, 2)
        label = min(label, max(both - symbol, both // 2))
        return table_lines([(_cell(name), _cell(value)) for name, _, value in rows], (label, both - label), MARGIN)
    widths = (label, symbol, width - label - symbol - 3 * MARGIN)
    return table_lines([tuple(map(_cell, row)) for row in rows], widths, MARGIN)


def _cell(text: str) -> Piece:
    return escaped(text), ""


def _grid(grid: Grid, width: int) -> Iterator[Line]:
    header = [[(escaped(title), "dim") for title in grid.header]] if any(grid.header) else []
    rows = [[(escaped(cell), STYLES.get(WORDS.get(cell, cell), "")) for cell in row] for row in grid.rows]
    cells = [*header, *rows]
    return table_lines(cells, widths_within(cells, width - MARGIN * len(grid.header)), MARGIN, grid.right)
