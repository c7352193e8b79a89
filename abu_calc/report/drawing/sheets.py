"""Drawings for the results of each command: the autobalancer's sheet first, then the sketches."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from abu_calc.report.drawing.shapes import Drawing
from abu_calc.studies.result import Result
from abu_calc.studies.seat_records import SeatResult

if TYPE_CHECKING:
    from abu_calc.studies.check_fit import CheckFitResult
    from abu_calc.studies.size import SizeResult


def size_sheets(result: "SizeResult") -> tuple[Drawing, ...]:
    """The section, and sketches of the swing arm and of bearing seats where the machine has them."""
    from abu_calc.report.drawing.sheet import section_sheet

    return section_sheet(result), *arm_sheets(result), *seats_of(result, result.fits)


def arm_sheets(result: "SizeResult") -> tuple[Drawing, ...]:
    """The sketch of the swing arm, if there is one."""
    if result.swing_arm is None:
        return ()
    from abu_calc.report.drawing.swing_arm import swing_arm_sketch

    return (swing_arm_sketch(result, result.swing_arm),)


def seat_sheets(result: "CheckFitResult") -> tuple[Drawing, ...]:
    """One sketch for each bearing."""
    return seats_of(result, result.seats)


def seats_of(result: Result, seats: Sequence[SeatResult]) -> tuple[Drawing, ...]:
    """Seats come in pairs, the shaft's first."""
    if not seats:
        return ()
    from abu_calc.report.drawing.seats import seats_sketch

    pairs = list(pairwise(seats))[::2]
    return tuple(seats_sketch(f"seats-{number}", result, *pair) for number, pair in enumerate(pairs, 1))
