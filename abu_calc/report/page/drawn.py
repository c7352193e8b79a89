"""A figure as elements of a page."""

from typing import Final, NamedTuple

from abu_calc.report.drawing.shapes import Drawing
from abu_calc.report.drawing.svg import svg_figure
from abu_calc.report.figures.chart import Bars, Cells, Plot
from abu_calc.report.figures.figure import Figure
from abu_calc.report.figures.motion import Motion
from abu_calc.report.page.cells_svg import cells
from abu_calc.report.page.chart_svg import bars, plot
from abu_calc.report.page.player import player
from abu_calc.report.page.words import text

PIXELS: Final = 3.78
"""Of a screen, for a millimetre."""
READABLE: Final = 2.1
"""Pixels for a millimetre below which writing is too small."""
NAMESPACE: Final = ' xmlns="http://www.w3.org/2000/svg"'
"""Elements inside a page need none."""


class _Room(NamedTuple):
    """What an element would like to take, and what it is never narrower than: it then scrolls in its place [px]."""

    wide: float
    least: float = 0.0


def figure(one: Figure) -> str:
    """The element with its caption."""
    room, drawn = _drawn(one)
    style = f"max-width:{room.wide:.0f}px" + (f";min-width:{room.least:.0f}px" if room.least else "")
    return (
        f'<figure style="max-width:{room.wide:.0f}px"><div class="wide" tabindex="0" role="group" '
        f'aria-label="{text(one.caption)}"><div style="{style}">{drawn}</div></div>'
        f"<figcaption>{text(one.caption)}</figcaption></figure>"
    )


def _drawn(one: Figure) -> tuple[_Room, str]:
    match one.shown:
        case Plot() as chart:
            return _Room(520.0), plot(one.name, chart)
        case Bars() as chart:
            return _Room(520.0), bars(one.name, chart)
        case Cells() as chart:
            return _Room(520.0), cells(one.name, chart)
        case Motion() as motion:
            return _Room(640.0), player(motion)
        case Drawing() as drawing:
            wide = drawing.size[0]
            return _Room(PIXELS * wide, READABLE * wide), svg_figure(drawing).replace(NAMESPACE, "")
