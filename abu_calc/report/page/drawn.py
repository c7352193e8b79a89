"""Drawings to scale as figures of a page."""

from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.report.drawing.shapes import Drawing
from abu_calc.report.drawing.sheets import seats_of
from abu_calc.report.drawing.svg import svg_figure
from abu_calc.report.page.figure import Figure
from abu_calc.studies.result import Result
from abu_calc.studies.seat_records import SeatResult

PIXELS: Final = 3.78
"""Of a screen, for a millimetre."""
READABLE: Final = 2.1
"""Pixels for a millimetre below which writing is too small."""
NAMESPACE: Final = ' xmlns="http://www.w3.org/2000/svg"'
"""Elements inside a page need none."""


def drawn(section: str, drawing: Drawing, caption: str) -> Figure:
    """A drawing at the size of its sheet where there is room."""
    wide = drawing.size[0]
    return Figure(section, svg_figure(drawing).replace(NAMESPACE, ""), caption, PIXELS * wide, READABLE * wide)


def seat_figures(result: Result, seats: Sequence[SeatResult]) -> Iterator[Figure]:
    """A sketch of the two seats of each bearing."""
    for index, one in enumerate(seats_of(result, seats), 1):
        yield drawn("", one, f"Seats of bearing {index}: sizes with limits in mm, and what the drawing asks of them.")
