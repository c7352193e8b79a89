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
"""Pixels of a screen per millimetre."""
READABLE: Final = 2.1
"""Pixels for a millimetre below which writing is too small."""
NAMESPACE: Final = ' xmlns="http://www.w3.org/2000/svg"'
"""Elements inside a page need none."""


class _Room(NamedTuple):
    """Preferred width of an element, and its least width [px]; if narrower, it scrolls in its place."""

    wide: float
    least: float = 0.0


def figure(figure: Figure) -> str:
    """The element with its caption."""
    room, drawn = _drawn(figure)
    style = f"max-width:{room.wide:.0f}px" + (f";min-width:{room.least:.0f}px" if room.least else "")
    return (
        f'<figure style="max-width:{room.wide:.0f}px"><div class="wide" tabindex="0" role="group" '
        f'aria-label="{text(figure.caption)}"><div style="{style}">{drawn}</div></div>'
        f"<figcaption>{text(figure.caption)}</figcaption></figure>"
    )


def _drawn(figure: Figure) -> tuple[_Room, str]:
    match figure.shown:
        case Plot() as chart:
            return _Room(520.0), plot(figure.name, chart)
        case Bars() as chart:
            return _Room(520.0), bars(figure.name, chart)
        case Cells() as chart:
            return _Room(520.0), cells(figure.name, chart)
        case Motion() as motion:
            return _Room(640.0), player(motion)
        case Drawing() as drawing:
            wide = drawing.size[0]
            return _Room(PIXELS * wide, READABLE * wide), svg_figure(drawing).replace(NAMESPACE, "")
