"""A figure of a page: where it stands, and what it holds."""

from collections.abc import Callable
from html import escape
from typing import NamedTuple

from abu_calc.escapes import escaped
from abu_calc.report.blocks import Block


class Figure(NamedTuple):
    """An element that draws, with a caption that says what to see.

    `section`: the heading it stands below, as far as it is given; `width`: what it would like to take [px].
    """

    section: str
    drawn: str
    caption: str
    width: float = 520.0
    least: float = 0.0
    """What it is never narrower than [px]: where the page is, it scrolls in its place."""


class Extras(NamedTuple):
    """What a page has beyond the blocks of a report: figures, and the formulas with numbers put in."""

    figures: tuple[Figure, ...] = ()
    note: tuple[Block, ...] = ()


MakesExtras = Callable[[], Extras]


def text(words: str) -> str:
    """Words as a page may hold them: nothing in them is an element, or acts."""
    return escape(escaped(words), quote=True)
