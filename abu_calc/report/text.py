"""Blocks as text in a terminal or a file."""

import io
import os
import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator

from rich.console import Console
from rich.table import Table
from rich.text import Text

from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph

STYLES = {
    "pass": "bold green",
    "warn": "bold yellow",
    "fail": "bold red",
    "not-done": "bold yellow",
    "warning": "yellow",
}
WIDEST = 100
MARGIN = 2
"""Blanks before each column of a table, and before running text."""
FACT_WIDTHS = (35, 17)
"""Label and symbol: the same in every block, so that values stand in one column; they take the rest of the line."""

NARROW = 72
"""On lines shorter than this the symbols are left out."""


def show(blocks: Iterable[Block], *, color: bool = True) -> None:
    """Print blocks one after another, as wide as the terminal is but never wider than reads well."""
    width = min(shutil.get_terminal_size().columns, WIDEST)
    if not (color and (sys.stdout.isatty() or os.environ.get("FORCE_COLOR"))):
        print(as_text(blocks, width), end="")
        return
    out = Console(width=width, markup=False, highlight=False, emoji=False)
    for part in _parts(blocks, width):
        out.print(Text(*part) if isinstance(part, tuple) else part)


def as_text(blocks: Iterable[Block], width: int = 80) -> str:
    """Blocks as plain text for a file or a pipe, no blanks at the ends of lines."""
    buffer = io.StringIO()
    out = Console(file=buffer, width=width, markup=False, highlight=False, emoji=False, color_system=None)
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
                yield text, "bold"
            case Paragraph(text, mark, indent):
                yield fill(text, width, indent), STYLES.get(mark or "", "")
            case Facts(rows):
                yield _facts(rows, width)
            case Grid():
                yield _grid(block)


def fill(text: str, width: int, indent: int) -> str:
    """Text wrapped to a width, every line indented; long words keep whole."""
    margin = " " * indent
    return textwrap.fill(
        text, width, initial_indent=margin, subsequent_indent=margin, break_long_words=False, break_on_hyphens=False
    )


def _facts(rows: tuple[tuple[str, str, str], ...], width: int) -> Table:
    table = Table(box=None, show_header=False, padding=(0, 0, 0, MARGIN))
    label, symbol = FACT_WIDTHS
    rest = width - label - 2 * MARGIN
    for column in (label, rest) if width < NARROW else (label, symbol, rest - symbol - MARGIN):
        table.add_column(width=column, overflow="fold")
    for name, sign, value in rows:
        table.add_row(*((name, value) if width < NARROW else (name, sign, value)))
    return table


def _grid(grid: Grid) -> Table:
    table = Table(box=None, padding=(0, 0, 0, MARGIN), header_style="dim", show_header=any(grid.header))
    for index, title in enumerate(grid.header):
        table.add_column(title, justify="right" if index in grid.right else "left", overflow="fold")
    for row in grid.rows:
        table.add_row(*(Text(cell, style=STYLES.get(cell, "")) for cell in row))
    return table
