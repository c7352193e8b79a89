"""Drawings to scale as figures."""

from collections.abc import Iterator, Sequence

from abu_calc.report.drawing.sheets import seats_of
from abu_calc.report.figures.figure import Figure
from abu_calc.studies.result import Result
from abu_calc.studies.seat_records import SeatResult


def seat_figures(result: Result, seats: Sequence[SeatResult]) -> Iterator[Figure]:
    """A sketch of the two seats of each bearing: `seats-1` and on."""
    for index, drawing in enumerate(seats_of(result, seats), 1):
        caption = f"Seats of bearing {index}: sizes with limits in mm, and what the drawing asks of them."
        yield Figure(f"seats-{index}", "", drawing, caption)
