"""Figures of `abu check-fit` for each bearing: sketch, tolerance zones, interference, clearance left.

seats_sketch     shaft, rings and housing in section, tolerance classes with limits, and the drawing requirements;
                 rings and rolling elements are schematic; bore, outside and width are to scale
zones_drawing    tolerance zones of both seats about the zero line, to scale in µm, as textbooks draw fits
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Final, NamedTuple

from abu_calc.features.seats.clearance import Clearance
from abu_calc.features.seats.interference import Pair
from abu_calc.features.seats.seats import SeatResult
from abu_calc.features.seats.study import CheckFitResult
from abu_calc.features.seats.view import Seats, by_bearing, section_of
from abu_calc.reporting.blocks import Block
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Extras, Figure
from abu_calc.reporting.drawings.dimensions import extent, leader, roughness, scale_for, sketch
from abu_calc.reporting.drawings.shapes import (
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
    fitted,
)
from abu_calc.simulation.result import Result


def seat_sheets(result: CheckFitResult) -> tuple[Drawing, ...]:
    """One sketch for each bearing."""
    return seats_of(result, result.seats)


def seats_of(result: Result, seats: Sequence[SeatResult]) -> tuple[Drawing, ...]:
    """Sketches of the seats of each bearing; seats come in pairs, the shaft's first."""
    pairs = list(pairwise(seats))[::2]
    return tuple(seats_sketch(f"seats-{number}", result, *pair) for number, pair in enumerate(pairs, 1))


def seat_figures(result: Result, seats: Sequence[SeatResult]) -> Iterator[Figure]:
    """A sketch of the two seats of each bearing: `seats-1` and on."""
    for index, drawing in enumerate(seats_of(result, seats), 1):
        caption = f"Seats of bearing {index}: sizes and form in mm, Ra in µm (form by SKF's General Catalogue, 2006)."
        yield Figure(f"seats-{index}", "", drawing, caption)


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
    if shaft.bearing_verdict == "fail":
        title = f"NOT FOR MANUFACTURE. {title}"
    return sketch(name, title, f"{title}. {_seat_note(shaft)} {_seat_note(housing)}", result, shapes, scale)


def _seat_note(seat: SeatResult) -> str:
    size = f"{seat.seat} {digits(seat.diameter_mm)} mm {seat.fit or ''}".strip()
    other = seat.recommended_fit if seat.recommended_fit not in (None, seat.fit) else None
    advice = f"; {other} is recommended" if other else ""
    return f"{size}, limits {_limits(seat.part_limits_um)}{advice}."


def _limits(pair: Pair) -> str:
    """Upper and lower deviation [mm], as drawings state them."""
    decimals = 3 if all(float(limit).is_integer() for limit in pair) else 4
    return " / ".join(f"{limit / 1000:+.{decimals}f}" if limit else "0" for limit in reversed(pair))


def _parts(shaft: SeatResult, housing: SeatResult, beyond: float) -> Iterator[Shape]:
    """Both halves; the shaft, as solid parts are, not hatched."""
    bore, outside = shaft.diameter_mm / 2, housing.diameter_mm / 2
    wide, ring = shaft.ring_width_mm, RING * (outside - bore)
    left, right = -0.4 * wide, 1.4 * wide
    for side in (1, -1):
        inner = _ring(0, wide, side * bore, side * (bore + ring), shaft.chamfer_mm or 0.0)
        outer = _ring(0, wide, side * outside, side * (outside - ring), housing.chamfer_mm or 0.0)
        if shaft.bearing_kind != "drawn-cup":
            yield Region(inner, "inner ring", 135.0, 1.8)
        yield Region(outer, "outer ring", 45.0, 1.8)
        yield Region(_ring(left, right, side * outside, side * (outside + beyond), 0.0), "housing", 135.0, 3.0)
        yield Line("outline", (left, side * bore), (right, side * bore))
        yield from _element(shaft.bearing_kind, (wide, side * (bore + ring), side * (outside - ring)))
    for x in (left, right):
        yield Line("outline", (x, -bore), (x, bore))
    yield Line("centre", (left - 0.05 * wide, 0), (right + 0.2 * wide, 0))


TILT: Final = 10.0
"""Angle [deg] of tapered and spherical rollers to the axis as they are drawn."""


def _element(kind: str | None, place: tuple[float, float, float]) -> Iterator[Shape]:
    """The rolling element between the raceways: a ball, or a roller as long as its type has it; schematic."""
    wide, inner, outer = place
    height, middle = abs(outer - inner), (wide / 2, (inner + outer) / 2)
    if kind in (None, "ball", "angular-contact"):
        radius = min(height / 2, 0.45 * wide)
        yield Arc("outline", middle, radius)
        if kind == "angular-contact":
            rise = radius * 1.3 * (1 if outer > inner else -1)
            yield Line(
                "centre", (middle[0] - 0.7 * radius, middle[1] - rise), (middle[0] + 0.7 * radius, middle[1] + rise)
            )
        return
    if kind == "spherical":
        for way in (-1, 1):
            centre = middle[0] + way * 0.23 * wide, middle[1]
            yield from _roller(centre, 0.34 * wide, 0.8 * height, -way * TILT * (1 if outer > inner else -1))
        return
    long, tilt = (0.7 * wide, TILT) if kind == "tapered" else (0.6 * wide, 0.0)
    if kind in ("needle", "drawn-cup"):
        long = 0.8 * wide
    yield from _roller(middle, long, (0.65 if tilt else 1.0) * height, tilt * (1 if outer > inner else -1),
                       0.75 if kind == "tapered" else 1.0)  # fmt: skip


def _roller(
    centre: tuple[float, float], long: float, high: float, angle: float, narrow: float = 1.0
) -> Iterator[Shape]:
    """A roller about its centre, turned by an angle [deg]; `narrow`: its small end over its large one."""
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    ends = (
        (-long / 2, narrow * high / 2),
        (long / 2, high / 2),
        (long / 2, -high / 2),
        (-long / 2, -narrow * high / 2),
    )
    corners = [(centre[0] + x * cos - y * sin, centre[1] + x * sin + y * cos) for x, y in ends]
    for start, end in pairwise((*corners, corners[0])):
        yield Line("outline", start, end)


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
        form = seat.form
        tip = 1.2 * shaft.ring_width_mm, seat.diameter_mm / 2
        shelf = x + COLUMN * unit, top
        head = f"{'shaft' if seat.seat == 'shaft' else 'housing'} seat, ground"
        yield from leader(tip, shelf, head, scale, more=6)
        end = shelf[0] + (0.62 * 1.35 * HEIGHT * len(head) + 5) * unit
        yield from roughness((end, top), f"Ra {digits(form.roughness_Ra_um)}", scale)
        lines = (
            f"cylindricity {digits(form.cylindricity_um / 1000, 5)}",
            f"total axial runout of the shoulder {digits(form.shoulder_runout_um / 1000, 5)}",
        )
        for index, line in enumerate(lines, 1):
            yield Text((shelf[0], top - 1.7 * HEIGHT * index * unit), line)


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
    description = "; ".join(_zone_note(seat) for seat in seats)
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


def _zone_note(seat: SeatResult) -> str:
    ring, part = (" … ".join(map(digits, pair)) for pair in (seat.ring_limits_um, seat.part_limits_um))
    return f"{seat.seat}: ring {ring}, {seat.fit} {part}, {_fit(seat)}"


def check_fit_extras(result: CheckFitResult) -> Extras:
    """Figures of each bearing, and every formula with its numbers."""
    return Extras(tuple(check_fit_figures(result)), seat_note(result))


def seat_note(result: CheckFitResult) -> tuple[Block, ...]:
    """Every formula with the numbers of each bearing."""
    from abu_calc.features.explain.steps import STEPS, step_blocks
    from abu_calc.features.seats.formula_view import seat_numbers

    return tuple(step_blocks(STEPS["seats"], seat_numbers(result.judged)))


def check_fit_figures(result: CheckFitResult) -> Iterator[Figure]:
    """Figures of each bearing, below its heading."""
    sketches = list(seat_figures(result, result.seats))
    for index, pair in enumerate(by_bearing(result.seats), 1):
        section = section_of(index)
        yield sketches[index - 1]._replace(section=section)
        caption = (
            f"Zones of bearing {index} to scale in µm about the zero line, the nominal size: a shaft is tight where it "
            "stands above its ring, a housing where it stands below."
        )
        yield Figure(f"zones-{index}", section, zones_drawing(f"zones-{index}", *pair), caption)
        yield _interference(index, section, pair)
        if pair[0].internal_clearance is not None:
            yield _clearance(index, section, pair[0].internal_clearance)


def _interference(index: int, section: str, pair: Seats) -> Figure:
    """Figure of the interference from the tolerance classes, above the permitted interference."""
    values = [value for seat in pair for value in (*seat.interference_um, seat.permitted_interference_um)]
    low = 1.05 * min(0.0, *values)
    rows = []
    for seat in pair:
        rows += [
            _span(f"{seat.seat}: extreme", seat.interference_um, 1),
            _span(f"{seat.seat}: probable", seat.probable_interference_um, 1),
        ]
        needed, most = seat.needed_um, seat.permitted_interference_um
        text = f"≤ {most:g} µm" if needed is None else _chart_note((needed, most))
        rows.append(Bar(f"{seat.seat}: permitted", most, text, 2, low if needed is None else needed))
    axis = Axis("interference [µm], below zero clearance", low, 1.05 * max(values))
    text = "; ".join(f"{bar.name} {bar.text}" for bar in rows)
    caption = (
        f"Interference in the seats of bearing {index}: what comes out should lie within what is permitted, from the "
        "least that the ring needs to the most that it bears."
    )
    return Figure(f"interference-{index}", section, Bars("Interference", text, axis, rows, (0.0, "neither")), caption)


def _clearance(index: int, section: str, left: Clearance) -> Figure:
    rows = [
        _span(f"group {left.group}, before mounting", left.initial_um, 2),
        _span("after mounting, extreme", left.mounted_um, 1),
        _span("after mounting, probable", left.probable_um, 1),
    ]
    ends = [0.0, *(end for bar in rows for end in (bar.start, bar.value))]
    axis = Axis("radial clearance [µm]", 1.05 * min(ends), 1.05 * max(ends))
    text = "; ".join(f"{bar.name} {bar.text}" for bar in rows)
    caption = f"Clearance left in bearing {index} after mounting and warming: it should stay right of the dashed line."
    chart = Bars("Clearance left in the bearing", text, axis, rows, (0.0, "none left"))
    return Figure(f"clearance-{index}", section, chart, caption)


def _span(name: str, ends: Pair, series: int) -> Bar:
    return Bar(name, ends[1], _chart_note(ends), series, ends[0])


def _chart_note(ends: Pair) -> str:
    return "{:.4g} … {:.4g}".format(*ends)
