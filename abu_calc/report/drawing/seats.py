"""The seats of a bearing: shaft, rings and housing in section, fields with limits, and what their drawing must ask for.

Rings and rolling elements are schematic; bore, outside and width are to scale.
"""

from collections.abc import Iterator

from abu_calc.report.drawing.dimensions import leader, roughness
from abu_calc.report.drawing.shapes import (
    HEIGHT,
    SCALES,
    Arc,
    Corner,
    Drawing,
    Length,
    Line,
    Region,
    Shape,
    Text,
    digits,
)
from abu_calc.report.drawing.sketch import scale_for, sketch
from abu_calc.studies.result import Result
from abu_calc.studies.seat_parts import Pair
from abu_calc.studies.seat_records import SeatResult

RING = 0.3
"""Thickness of a ring, as a share of what is between bore and outside."""
COLUMN = 16.0


def seats_sketch(name: str, result: Result, shaft: SeatResult, housing: SeatResult) -> Drawing:
    """Both seats of one bearing."""
    beyond = 0.35 * (housing.diameter_mm - shaft.diameter_mm)
    scale = scale_for(housing.diameter_mm + 2 * beyond, SCALES)
    shapes = (
        *_parts(shaft, housing, beyond),
        *_sizes(shaft, housing, beyond, 1 / scale),
        *_asked(shaft, housing, beyond, scale),
    )
    title = f"Bearing seats: {shaft.name}"
    return sketch(name, title, f"{title}. {_told(shaft)} {_told(housing)}", result, shapes, scale)


def _told(seat: SeatResult) -> str:
    size = f"{seat.seat} {digits(seat.diameter_mm)} mm {seat.fit or ''}".strip()
    return f"{size}, limits {_limits(seat.part_limits_um)}; asked for: {seat.requirements.field}."


def _limits(pair: Pair) -> str:
    return " / ".join(f"{limit:+g}" if limit else "0" for limit in reversed(pair)) + " µm"


def _parts(shaft: SeatResult, housing: SeatResult, beyond: float) -> Iterator[Shape]:
    """Both halves; the shaft, as solid parts are, not hatched."""
    bore, outside = shaft.diameter_mm / 2, housing.diameter_mm / 2
    wide, ring = shaft.ring_width_mm, RING * (outside - bore)
    left, right = -0.4 * wide, 1.4 * wide
    for side in (1, -1):
        inner = _ring(0, wide, side * bore, side * (bore + ring), shaft.chamfer_mm or 0.0)
        outer = _ring(0, wide, side * outside, side * (outside - ring), housing.chamfer_mm or 0.0)
        yield Region(inner, "inner ring", 135.0, 1.8)
        yield Region(outer, "outer ring", 45.0, 1.8)
        yield Region(_ring(left, right, side * outside, side * (outside + beyond), 0.0), "housing", 135.0, 3.0)
        yield Line("outline", (left, side * bore), (right, side * bore))
        yield Arc("outline", (wide / 2, side * (bore + outside) / 2), min((outside - bore) / 2 - ring, 0.45 * wide))
    for x in (left, right):
        yield Line("outline", (x, -bore), (x, bore))
    yield Line("centre", (left - 0.05 * wide, 0), (right + 0.2 * wide, 0))


def _ring(left: float, right: float, seat: float, free: float, chamfer: float) -> tuple[Corner, ...]:
    """A rectangle whose corners at the seat are cut by the chamfer."""
    cut = min(chamfer, abs(free - seat) / 2, (right - left) / 4)
    inward = seat + (cut if free > seat else -cut)
    if not cut:
        return (left, seat, 0.0), (right, seat, 0.0), (right, free, 0.0), (left, free, 0.0)
    return ((left + cut, seat, 0.0), (right - cut, seat, 0.0), (right, inward, 0.0), (right, free, 0.0),
            (left, free, 0.0), (left, inward, 0.0))  # fmt: skip


def _sizes(shaft: SeatResult, housing: SeatResult, beyond: float, unit: float) -> Iterator[Length]:
    """Diameters with field and limits left, the width above."""
    wide, left = shaft.ring_width_mm, -0.4 * shaft.ring_width_mm
    for index, seat in enumerate((shaft, housing)):
        half, text = seat.diameter_mm / 2, f"Ø{digits(seat.diameter_mm)} {seat.fit or ''}".strip()
        yield Length((left, -half), (left, half), left - (10 + 14 * index) * unit, text, True,
                     below=f"({_limits(seat.part_limits_um)})")  # fmt: skip
    outer = housing.diameter_mm / 2
    yield Length((0, outer), (wide, outer), outer + beyond + 8 * unit, digits(wide))


def _asked(shaft: SeatResult, housing: SeatResult, beyond: float, scale: float) -> Iterator[Shape]:
    """Requirements that the drawing of each seat must state, beside that seat."""
    unit, x = 1 / scale, 1.4 * shaft.ring_width_mm
    tops = (housing.diameter_mm / 2 + beyond, housing), (-4 * unit, shaft)
    for top, seat in tops:
        asked = seat.requirements
        tip = 1.2 * shaft.ring_width_mm, seat.diameter_mm / 2
        shelf = x + COLUMN * unit, top
        head = f"Ø{digits(seat.diameter_mm)} {asked.field} ({_limits(asked.limits_um)})"
        yield from leader(tip, shelf, head, scale, more=6)
        end = shelf[0] + (0.62 * 1.35 * HEIGHT * len(head) + 5) * unit
        yield from roughness((end, top), f"Ra {digits(asked.roughness_Ra_um)}", scale)
        runout = "" if asked.shoulder_runout_um is None else f" = {digits(asked.shoulder_runout_um)} µm"
        lines = (
            f"roundness, profile {digits(asked.roundness_um, 2)} µm on the radius",
            f"shoulder runout {asked.shoulder_runout_grade}{runout}",
            f"{asked.hardness}; {asked.source}",
        )
        for index, line in enumerate(lines, 1):
            yield Text((shelf[0], top - 1.7 * HEIGHT * index * unit), line)
