"""Tolerance zones of both seats of a bearing about the zero line, to scale in µm, as textbooks draw fits."""

from collections.abc import Iterator
from typing import Final, NamedTuple

from abu_calc.report.drawing.extent import extent
from abu_calc.report.drawing.shapes import Drawing, Line, Region, Shape, Text, digits, fitted
from abu_calc.studies.seat_parts import Pair
from abu_calc.studies.seat_records import SeatResult

HIGH: Final = 60.0
"""Height of the tolerance zones on paper [mm]."""
BOX, PITCH, SEAT = 12.0, 25.0, 54.0
"""Width of a zone, from one to the next, from one seat to the next [mm on paper]."""
LETTERS: Final = 3.0


class _Zone(NamedTuple):
    """Limits [µm], what it is of, angle of its hatching, and where it begins on paper [mm]."""

    limits: Pair
    name: str
    angle: float
    left: float


def zones_drawing(name: str, shaft: SeatResult, housing: SeatResult) -> Drawing:
    """A unit of the drawing is a µm: zones of the inner ring and the shaft, of the outer ring and the housing."""
    seats = (shaft, housing)
    zones = [zone for index, seat in enumerate(seats) for zone in _zones(seat, index * SEAT)]
    deviations = [0.0, *(limit for zone in zones for limit in zone.limits)]
    low, high = min(deviations), max(deviations)
    scale = HIGH / max(high - low, 1e-3)
    shapes: list[Shape] = [shape for zone in zones for shape in _drawn(zone, low, scale)]
    for index, seat in enumerate(seats):
        middle = (index * SEAT + (PITCH + BOX) / 2) / scale
        for row, line in enumerate((seat.seat, _fit(seat)), 1):
            shapes.append(Text((middle, low - (9 + 5 * row) / scale), *fitted(line, SEAT - 3, LETTERS), "centre"))
    shapes.append(Text((-4 / scale, -LETTERS / 2 / scale), "0", LETTERS, "right"))
    corners = extent(shapes, scale)
    margin = 2 / scale
    description = "; ".join(_told(seat) for seat in seats)
    title = f"Tolerance zones of {shaft.name}"
    return Drawing(
        name, title, f"{title}, deviations from the nominal size in µm. {description}.", scale,
        (corners[0][0] - margin, corners[0][1] - margin), (corners[1][0] + margin, corners[1][1] + margin),
        tuple(shapes),
    )  # fmt: skip


def _zones(seat: SeatResult, left: float) -> tuple[_Zone, _Zone]:
    ring = "inner ring" if seat.seat == "shaft" else "outer ring"
    return _Zone(seat.ring_limits_um, ring, 45.0, left), _Zone(seat.part_limits_um, seat.fit, 135.0, left + PITCH)


def _drawn(zone: _Zone, bottom: float, scale: float) -> Iterator[Shape]:
    """The zone with its limits at its right, its name below all, and its part of the zero line."""
    (lower, upper), unit = zone.limits, 1 / scale
    left, right = zone.left * unit, (zone.left + BOX) * unit
    corners = (left, lower, 0.0), (right, lower, 0.0), (right, upper, 0.0), (left, upper, 0.0)
    yield Region(corners, zone.name, zone.angle, 1.6)
    beside = right + 1.2 * unit
    yield Text((beside, upper + 0.3 * unit), _signed(upper), LETTERS)
    yield Text((beside, lower - (LETTERS + 0.3) * unit), _signed(lower), LETTERS)
    yield Text(((left + right) / 2, bottom - 8 * unit), *fitted(zone.name, PITCH - 2, LETTERS), "centre")
    written = lower - (LETTERS + 1) * unit < 0 < lower or upper < 0 < upper + (LETTERS + 1) * unit
    end = right + 0.6 * unit if written else (zone.left + PITCH) * unit
    yield Line("frame", (left - 2 * unit, 0.0), (end, 0.0))


def _signed(limit: float) -> str:
    return f"+{digits(limit)}" if limit > 0 else digits(limit)


def _fit(seat: SeatResult) -> str:
    """Interference or clearance, as it comes out."""
    least, most = seat.interference_um
    if most <= 0:
        return f"clearance {digits(-most)} … {digits(-least)} µm"
    return f"interference {digits(least)} … {digits(most)} µm"


def _told(seat: SeatResult) -> str:
    ring, part = (" … ".join(map(digits, pair)) for pair in (seat.ring_limits_um, seat.part_limits_um))
    return f"{seat.seat}: ring {ring}, {seat.fit} {part}, {_fit(seat)}"
