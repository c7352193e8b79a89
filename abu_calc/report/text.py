"""Blocks as text in a terminal or a file."""

import io
import textwrap
from collections.abc import Iterable

from rich.console import Console
from rich.table import Table
from rich.text import Text

from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph

STYLES = {"pass": "bold green", "fail": "bold red", "not-done": "bold yellow", "warning": "yellow"}
WIDEST = 100
FACT_WIDTHS = (36, 16, 12)
"""Label, symbol, value: the same in every block, so that a report has one left edge."""


def console(*, color: bool = True, stderr: bool = False) -> Console:
    """A console that takes text as it is: no markup, no highlighting, no emoji codes."""
    return Console(markup=False, highlight=False, emoji=False, stderr=stderr, no_color=not color or None)


def show(blocks: Iterable[Block], out: Console) -> None:
    """Print blocks one after another, never wider than reads well."""
    width = min(out.width, WIDEST)
    for index, block in enumerate(blocks):
        if index and isinstance(block, Heading):
            out.print()
        out.print(_rendered(block, width), width=width)


def as_text(blocks: Iterable[Block], width: int = 80) -> str:
    """Blocks as plain text for a file."""
    buffer = io.StringIO()
    plain = Console(file=buffer, width=width, markup=False, highlight=False, emoji=False, color_system=None)
    show(blocks, plain)
    return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines()) + "\n"


def _rendered(block: Block, width: int) -> Text | Table:
    match block:
        case Heading(text):
            return Text(text, style="bold")
        case Paragraph(text, mark, indent):
            return Text(fill(text, width, indent), style=STYLES.get(mark or "", ""))
        case Facts(rows):
            return _facts(rows)
        case Grid():
            return _grid(block)


def fill(text: str, width: int, indent: int) -> str:
    """Text wrapped to a width, every line indented; long words keep whole."""
    margin = " " * indent
    return textwrap.fill(
        text, width, initial_indent=margin, subsequent_indent=margin, break_long_words=False, break_on_hyphens=False
    )


def _facts(rows: tuple[tuple[str, str, str], ...]) -> Table:
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(width=0)
    for least in FACT_WIDTHS:
        table.add_column(overflow="fold", min_width=least)
    for label, symbol, value in rows:
        table.add_row("", label, symbol, value)
    return table


def _grid(grid: Grid) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="dim")
    table.add_column(width=0)
    for index, title in enumerate(grid.header):
        table.add_column(title, justify="right" if index in grid.right else "left", overflow="fold")
    for row in grid.rows:
        table.add_row("", *(Text(cell, style=STYLES.get(cell, "")) for cell in row))
    return table
