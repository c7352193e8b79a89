"""Blocks as text in a terminal or a file."""

import io
import os
import shutil
import sys
import textwrap
from collections.abc import Iterable

from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph

STYLES = {"pass": "bold green", "fail": "bold red", "not-done": "bold yellow", "warning": "yellow"}
WIDEST = 100
MARGIN, GAP = 2, 2
FACT_WIDTHS = (35, 17)
"""Label and symbol: the same in every block, so that values stand in one column; they take the rest of the line."""

NARROW = 72
"""On lines shorter than this the symbols are left out."""


def show(blocks: Iterable[Block], *, color: bool = True) -> None:
    """Print blocks one after another, as wide as the terminal is but never wider than reads well."""
    width = min(shutil.get_terminal_size().columns, WIDEST)
    if color and (sys.stdout.isatty() or os.environ.get("FORCE_COLOR")):
        _print(blocks, Console(width=width, markup=False, highlight=False, emoji=False))
    else:
        print(as_text(blocks, width), end="")


def as_text(blocks: Iterable[Block], width: int = 80) -> str:
    """Blocks as plain text for a file or a pipe, no blanks at the ends of lines."""
    buffer = io.StringIO()
    _print(blocks, Console(file=buffer, width=width, markup=False, highlight=False, emoji=False, color_system=None))
    return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines()) + "\n"


def _print(blocks: Iterable[Block], out: Console) -> None:
    for index, block in enumerate(blocks):
        if index and isinstance(block, Heading):
            out.print()
        out.print(_rendered(block, out.width))


def _rendered(block: Block, width: int) -> Text | Padding:
    match block:
        case Heading(text):
            return Text(text, style="bold")
        case Paragraph(text, mark, indent):
            return Text(fill(text, width, indent), style=STYLES.get(mark or "", ""))
        case Facts(rows):
            return _facts(rows, width)
        case Grid():
            return _grid(block)


def fill(text: str, width: int, indent: int) -> str:
    """Text wrapped to a width, every line indented; long words keep whole."""
    margin = " " * indent
    return textwrap.fill(
        text, width, initial_indent=margin, subsequent_indent=margin, break_long_words=False, break_on_hyphens=False
    )


def _facts(rows: tuple[tuple[str, str, str], ...], width: int) -> Padding:
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, GAP, 0, 0))
    label, symbol = FACT_WIDTHS
    rest = width - MARGIN - label - GAP
    for column in (label, rest) if width < NARROW else (label, symbol, rest - symbol - GAP):
        table.add_column(width=column, overflow="fold")
    for name, sign, value in rows:
        table.add_row(*((name, value) if width < NARROW else (name, sign, value)))
    return Padding(table, (0, 0, 0, MARGIN), expand=False)


def _grid(grid: Grid) -> Padding:
    table = Table(box=None, pad_edge=False, padding=(0, GAP, 0, 0), header_style="dim", show_header=any(grid.header))
    for index, title in enumerate(grid.header):
        table.add_column(title, justify="right" if index in grid.right else "left", overflow="fold")
    for row in grid.rows:
        table.add_row(*(Text(cell, style=STYLES.get(cell, "")) for cell in row))
    return Padding(table, (0, 0, 0, MARGIN), expand=False)
