"""Blocks as text in a terminal or a file."""

import io
import os
import re
import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from abu_calc.foundation.escaping import escaped
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture

STYLES = {
    "pass": "bold green",
    "warn": "bold yellow",
    "fail": "bold red",
    "not-done": "bold magenta",
    "warning": "yellow",
}
WORDS = {"WARN": "warn", "FAIL": "fail", "NOT EVALUATED": "not-done", "LOUDER THAN WITHOUT": "warn"}
"""Cells of tables that are styled as these marks are."""
WIDEST = 100
MARGIN = 2
"""Blanks before each column of a table, and before running text."""
HEADING_HANG = 6
"""Blanks before further lines of a heading, so that no word of a long name stands where verdicts do."""
FACT_WIDTHS = (35, 17)
"""Label and symbol: the same in every block, so that values stand in one column; they take the rest of the line."""

BEFORE_UNIT = re.compile(r"(?<=[±≤≥]) |(?<=\bR) (?=\d)|(?<=\d) (?=±|(?:g·mm|1/s|mm|Hz|rpm|dB|µm|MPa|kg|[sNgW%])(?!\w))")
"""Blanks at which no line is broken."""
TIE = "\u00a0"

NARROW = 72
"""Line width below which the symbols are left out."""


def show(blocks: Iterable[Block], *, color: bool = True) -> None:
    """Print blocks one after another, as wide as the terminal is but never wider than reads well."""
    width = min(shutil.get_terminal_size().columns, WIDEST)
    if not (color and (sys.stdout.isatty() or os.environ.get("FORCE_COLOR"))):
        print(as_text(blocks, width), end="")
        return
    out = console(width)
    for part in _parts(blocks, width):
        out.print(Text(*part) if isinstance(part, tuple) else part, soft_wrap=isinstance(part, tuple))


def console(width: int, **how: Any) -> Console:
    """A console of so many columns: Rich does not bear everything that COLUMNS and LINES may be."""
    plain = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "LINES")}
    return Console(width=width, markup=False, highlight=False, emoji=False, _environ=plain, **how)


def as_text(blocks: Iterable[Block], width: int = 80) -> str:
    """Blocks as plain text for a file or a pipe, no blanks at the ends of lines."""
    buffer = io.StringIO()
    out = console(width, file=buffer, color_system=None)
    for part in _parts(blocks, width):
        if isinstance(part, tuple):
            buffer.write(part[0] + "\n")
        else:
            out.print(part)
    return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines()) + "\n"


def _parts(blocks: Iterable[Block], width: int) -> Iterator[tuple[str, str] | Table]:
    """Lines that are wrapped already, each with its style, and tables."""
    for index, block in enumerate(blocks):
        if index and isinstance(block, Heading):
            yield "", ""
        match block:
            case Heading(text):
                yield fill(escaped(text), width, 0, HEADING_HANG), "bold"
            case Paragraph(text, whole=True):
                yield " " * block.indent + escaped(text), ""
            case Paragraph(text, mark, indent, hang):
                style = STYLES.get(mark or "", "")
                yield fill(escaped(text), width, indent, hang), style.removeprefix("bold ") if hang else style
            case Facts(rows):
                yield _facts(rows, width)
            case Grid():
                yield from map(_grid, block.within(width, MARGIN))
            case Picture(lines, caption, indent):
                shown = [" " * indent + escaped(line) for line in lines]
                if max(map(len, shown)) <= width:
                    yield "\n".join(shown), ""
                    yield fill(escaped(caption), width, MARGIN), ""


def height(blocks: Sequence[Block], width: int = 80) -> int:
    """Number of lines that blocks take."""
    return len(as_text(blocks, width).splitlines()) if blocks else 0


def fill(text: str, width: int, indent: int, hang: int = 0) -> str:
    """Text wrapped to a width, every line indented, those but the first by `hang` more; long words keep whole."""
    together = BEFORE_UNIT.sub(TIE, text)
    return textwrap.fill(
        together, width, initial_indent=" " * indent, subsequent_indent=" " * (indent + hang), break_long_words=False,
        break_on_hyphens=False,
    ).replace(TIE, " ")  # fmt: skip


def _facts(rows: tuple[tuple[str, str, str], ...], width: int) -> Table:
    table = Table(box=None, show_header=False, padding=(0, 0, 0, MARGIN))
    label, symbol = FACT_WIDTHS
    rest = width - label - 2 * MARGIN
    for column in (label, rest) if width < NARROW else (label, symbol, rest - symbol - MARGIN):
        table.add_column(width=column, overflow="fold")
    for name, sign, value in rows:
        table.add_row(*map(escaped, (name, value) if width < NARROW else (name, sign, value)))
    return table


def grade_of(cell: str) -> str:
    """Grade that a cell of a table shows, with or without the number of its action.

    >>> grade_of("WARN 2"), grade_of("pass, tightest")
    ('warn', 'pass')
    """
    word = cell.rstrip("0123456789 ").removesuffix(", tightest")
    return WORDS.get(word, word)


def _grid(grid: Grid) -> Table:
    table = Table(box=None, padding=(0, 0, 0, MARGIN), header_style="dim", show_header=any(grid.header))
    for index, title in enumerate(grid.header):
        table.add_column(escaped(title), justify="right" if index in grid.right else "left", overflow="fold")
    for row in grid.rows:
        table.add_row(*(Text(escaped(cell), style=STYLES.get(grade_of(cell), "")) for cell in row))
    return table
