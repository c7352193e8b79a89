"""Texts of a page for readers without the program: entries of the file, no commands and no options."""

import re
import shlex
import tomllib
from collections.abc import Iterable, Iterator
from typing import Final

from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.charts.chart import Extras

COMMAND: Final = re.compile(r"`abu |(?<![\w-])--[a-z]|\babu [a-z]+(?:-[a-z]+)? [\w-]|\bPython: ")
"""Beginning of a command, or of an option, in a text."""
ASIDE: Final = re.compile(r"\s*\([^()]*\)")
"""Words in parentheses, with the space before them."""
SENTENCE: Final = re.compile(r"(?<=[.!?])\s+(?=[A-Z`])")
ENTRY: Final = "--set "
"""Beginning of a line of entries to paste behind a command."""
ENTRIES: Final = "entries"
"""Mark of a paragraph that holds one entry of a file."""


def handed_over(blocks: Iterable[Block]) -> list[Block]:
    """Blocks without commands and options; entries to paste become lines of the file."""
    shown: list[Block] = []
    pending = ""
    for block in blocks:
        if isinstance(block, Paragraph) and (pending or block.text.startswith(ENTRY)):
            pending += f" {block.text.removesuffix(chr(92))}"
            if not block.text.endswith(chr(92)):
                shown += entries(pending)
                pending = ""
        else:
            shown += _block(block)
    return shown


def entries(options: str) -> Iterator[Paragraph]:
    """Entries of a file that options of a command line replace, each on a line behind its table.

    >>> [entry.text for entry in entries("--set wheel.mass_kg=0.5 --set machine.name='My grinder'")]
    ['[wheel]  mass_kg = 0.5', '[machine]  name = "My grinder"']
    >>> [entry.text for entry in entries("--set bearing.1.shaft_fit=m6")]
    ['[[bearing]] number 2:  shaft_fit = "m6"']
    """
    for word in shlex.split(options):
        if word != ENTRY.strip():
            key, _, value = word.partition("=")
            yield Paragraph(f"{_table(key)}{key.rpartition('.')[2]} = {_toml(value)}", ENTRIES)


def _table(key: str) -> str:
    """The table that holds a key, as its header in the file; nothing for a key of the file itself."""
    *parts, _ = key.split(".")
    numbers = [int(part) + 1 for part in parts if part.isdecimal()]
    name = ".".join(part for part in parts if not part.isdecimal())
    if numbers:
        return f"[[{name}]] number {numbers[-1]}:  "
    return f"[{name}]  " if name else ""


def _toml(value: str) -> str:
    """The value as a file has it: a text that is no TOML value stands in quotes."""
    try:
        tomllib.loads(f"value = {value}")
    except tomllib.TOMLDecodeError:
        return f'"{value}"'
    return value


def _block(block: Block) -> Iterator[Block]:
    match block:
        case Paragraph(text):
            if kept := without_commands(text):
                yield block._replace(text=kept)
            elif not text:
                yield block
        case Heading(text):
            yield block._replace(text=_without_asides(text) or text)
        case Facts(rows):
            yield Facts(tuple((_cell(label), symbol, _cell(value)) for label, symbol, value in rows))
        case Grid(header, rows):
            yield block._replace(header=tuple(map(_cell, header)), rows=tuple(tuple(map(_cell, row)) for row in rows))
        case Picture(_, caption):
            yield block._replace(caption=without_commands(caption))


def _cell(text: str) -> str:
    """Text of a table's cell, which is never emptied."""
    return without_commands(text) or text


def without_commands(text: str) -> str:
    """A text without the sentences and the words in parentheses that name a command or an option.

    >>> without_commands("Ask for less accuracy (--accuracy). `abu grinding FILE` simulates more.")
    'Ask for less accuracy.'
    """
    if not COMMAND.search(text):
        return text
    sentences = SENTENCE.split(_without_asides(text))
    return " ".join(sentence for sentence in sentences if not COMMAND.search(sentence))


def _without_asides(text: str) -> str:
    return ASIDE.sub(lambda aside: "" if COMMAND.search(aside[0]) else aside[0], text)


def extras_handed_over(extras: Extras) -> Extras:
    """Figures, formulas and summary without commands and options."""
    figures = (figure._replace(caption=without_commands(figure.caption)) for figure in extras.figures)
    note, summary = handed_over(extras.note), handed_over(extras.summary)
    return extras._replace(figures=tuple(figures), note=tuple(note), summary=tuple(summary))
