"""The report of `abu check-fit` on one screen: what to write first, then each seat in a line."""

from typing import Final

from abu_calc.escapes import shortened
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.fit_advice import NAME, advice_lines, bearing_table, repair_lines, sorting_blocks
from abu_calc.report.fits import by_bearing
from abu_calc.report.numbers import number
from abu_calc.report.screen import BLANK, cut, one_screen, verdict_line
from abu_calc.studies.check_fit import CheckFitResult
from abu_calc.studies.seat_records import SeatResult

SIGN = (
    "Tight by: interference from the loosest to the tightest pair, negative when loose; at least what the ring needs, "
    "at most what is permitted."
)
MOST_LINES: Final = 24
"""Most lines of the table of several bearings; the whole report has the rest."""


def check_fit_screen(result: CheckFitResult) -> tuple[Block, ...]:
    """The one screen: of one bearing the advice and its seats, of several a table of them all."""
    pairs = list(by_bearing(result.seats))
    about: list[Block] = [Heading(f"Bearing seats: {result.title}"), verdict_line(result)]
    if len(pairs) > 1:
        about += [BLANK, *cut([bearing_table(pairs)], MOST_LINES)]
    else:
        about += [line for pair in pairs for line in advice_lines(pair)]
    header = ("bearing", "seat", "field", "tight by, µm", "at least", "at most", "write")
    body: list[Block] = [Grid(header, tuple(map(_row, result.seats)), frozenset({4, 5})), Paragraph(SIGN)]
    for pair in pairs:
        body += [*repair_lines(pair), *sorting_blocks(pair)]
    return one_screen(result, about, body, ("--explain, every formula with its numbers",))


def _row(seat: SeatResult) -> tuple[str, ...]:
    low, high = seat.interference_um
    needed = "no grip" if seat.needs_no_grip else _um(seat.required_interference_um)
    return (
        shortened(seat.name, NAME) if seat.seat == "shaft" else "", seat.seat, seat.fit, f"{low:.4g} … {high:.4g}",
        needed, _um(seat.permitted_interference_um), seat.recommended_fit or "–",
    )  # fmt: skip


def _um(value: float | None) -> str:
    return "–" if value is None else number(value, 3)
