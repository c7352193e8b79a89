"""A figure of a result: its name, what it shows, where it stands in a report."""

from collections.abc import Callable
from typing import NamedTuple

from abu_calc.report.blocks import Block
from abu_calc.report.drawing.shapes import Drawing
from abu_calc.report.figures.chart import Bars, Cells, Plot
from abu_calc.report.figures.motion import Motion

Shown = Plot | Bars | Cells | Drawing | Motion


class Figure(NamedTuple):
    """Figure with a caption that says what to see.

    `name`: unique among a result's figures; `section`: the heading it stands below, as far as it is given.
    """

    name: str
    section: str
    shown: Shown
    caption: str


class Extras(NamedTuple):
    """Parts of a page beyond the blocks of a report: figures, and the formulas with numbers put in."""

    figures: tuple[Figure, ...] = ()
    note: tuple[Block, ...] = ()


MakesExtras = Callable[[], Extras]
