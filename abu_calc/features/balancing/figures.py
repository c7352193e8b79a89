"""Figures of `abu balance`: corrections, conventions, before and after, causes of uncertainty, the formulas.

`planes_drawing` shows the planes of a rotor as one stands before its ends: zero mark on top, the heavy spot, the
correction. `convention_drawing` shows rotor, mark and sensors with the phase and the angle of the heavy spot.
"""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Final

from abu_calc.features.balancing.drawn import called, lag_of, sense_of, sketch_words
from abu_calc.features.balancing.solution import PlaneCorrection
from abu_calc.features.balancing.study import BalanceResult
from abu_calc.features.balancing.view import SIGNS, misfit, orders_of
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.reporting.blocks import Block, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Extras, Figure
from abu_calc.reporting.drawings.dimensions import extent
from abu_calc.reporting.drawings.shapes import Arc, Drawing, Line, Point, Shape, Solid, Text, fitted

RADIUS, APART = 20.0, 58.0
LETTERS: Final = 3.0
IN_LINE: Final = 15.0
"""Angle [degrees] below which both sensors share one text."""
AGAINST: Final = "against rotation"


def planes_drawing(
    left: PlaneCorrection, right: PlaneCorrection, turns_from_left: str, angle_marks: str = AGAINST
) -> Drawing:
    """Degrees are laid off against rotation, whose sense the arrows show, or with it."""
    sense = sense_of(turns_from_left)
    shapes = (*_plane("left", left, sense, 0.0, angle_marks), *_plane("right", right, -sense, APART, angle_marks))
    description = f"left: {', '.join(_orders(left))}; right: {', '.join(_orders(right))}"
    return _drawing("planes", "What to do in both planes", description, shapes)


def plane_drawing(plane: PlaneCorrection, turns_from_left: str, angle_marks: str = AGAINST) -> Drawing:
    """The single plane, seen from the left end."""
    shapes = tuple(_plane("", plane, sense_of(turns_from_left), 0.0, angle_marks))
    return _drawing("planes", "What to do in the plane", ", ".join(_orders(plane)), shapes)


def _drawing(name: str, title: str, description: str, shapes: tuple[Shape, ...]) -> Drawing:
    low, high = extent(shapes, 1.0)
    corners = (low[0] - 2, low[1] - 2), (high[0] + 2, high[1] + 2)
    return Drawing(name, title, description, 1.0, *corners, shapes)


def _plane(side: str, plane: PlaneCorrection, sense: int, middle: float, angle_marks: str) -> Iterator[Shape]:
    """`sense`: 1 where the rotor turns counterclockwise to the one who looks, so that degrees against rotation run
    clockwise.
    """
    along = sense if angle_marks == AGAINST else -sense

    def at(degrees: float, out: float) -> Point:
        return _point(degrees, out, along, middle)

    for row, line in enumerate((f"{side} plane", f"seen from the {side} end") if side else ("seen from the left end",)):
        yield Text((middle, 1.55 * RADIUS + 5 * (1 - row)), line, LETTERS, "centre")
    yield from _dial(along, middle)
    yield from _turning(middle, sense)
    if plane.mass_g:
        yield Arc("outline", at(plane.remove_at_deg, 1.0), 1.6)
        yield Line("hidden", (middle, 0.0), at(plane.remove_at_deg, 0.9))
    for share in plane.corrections if plane.mass_g else ():
        x, y = at(share.angle_deg, 1.26)
        yield Text((x, y - 2.2), SIGNS[share.action], 1.5 * LETTERS, "centre")
    for row, line in enumerate(_orders(plane, short=True)):
        yield Text((middle, -1.55 * RADIUS - 5 * row), *fitted(line, APART - 2, LETTERS), "centre")


def _point(degrees: float, out: float, sense: int, middle: float) -> Point:
    angle = math.radians(degrees)
    return middle + out * RADIUS * math.sin(angle) * sense, out * RADIUS * math.cos(angle)


def _dial(sense: int, middle: float) -> Iterator[Shape]:
    yield Arc("outline", (middle, 0.0), RADIUS)
    for degrees in range(0, 360, 30):
        yield Line("dimension", _point(degrees, 0.94, sense, middle), _point(degrees, 1.0, sense, middle))
    for quarter in range(0, 360, 90):
        x, y = _point(quarter, 0.66, sense, middle)
        yield Text((x, y - LETTERS / 2), f"{quarter}°", LETTERS, "centre")


def _turning(middle: float, sense: int) -> Iterator[Shape]:
    """An arc with an arrow: the sense in which the roll turns."""
    out = 0.36 * RADIUS
    yield Arc("dimension", (middle, 0.0), out, 30.0, 150.0)
    end = math.radians(150.0 if sense > 0 else 30.0)
    x, y = middle + out * math.cos(end), out * math.sin(end)
    along, across = (-sense * math.sin(end), sense * math.cos(end)), (math.cos(end), math.sin(end))
    tip = x + 2.5 * along[0], y + 2.5 * along[1]
    yield Solid((tip, (x + 0.8 * across[0], y + 0.8 * across[1]), (x - 0.8 * across[0], y - 0.8 * across[1])))


def _orders(plane: PlaneCorrection, *, short: bool = False) -> list[str]:
    """`short`: by signs."""
    if not plane.mass_g or not plane.corrections:
        return ["leave it as it is"]
    return orders_of(plane, short)


def convention_drawing(result: BalanceResult) -> Drawing:
    """Rotor at the moment when the mark passes its sensor, seen from the left end."""
    sense, run = sense_of(result.turns_from_left), result.runs[0]
    sensor, plane = run.sensors[0], result.planes[0][1]

    def at(degrees: float, out: float) -> Point:
        return _point(degrees, out, sense, 0.0)

    shapes: list[Shape] = [*_dial(sense, 0.0), *_turning(0.0, sense)]
    vibration = result.sensor_to_mark_deg
    in_line = abs((vibration + 180) % 360 - 180) < IN_LINE
    letters = [("mark, its sensor, vibration sensor" if in_line else "mark and its sensor", 0.0, 1.42)]
    if not in_line:
        letters.append(("vibration sensor", vibration, 1.25))
    shapes += [Solid((at(-4, 1.02), at(4, 1.02), at(0, 0.9))), Line("outline", at(0, 1.08), at(0, 1.3))]
    shapes.append(Line("outline", at(vibration, 1.04), at(vibration, 1.16)))
    if sensor.phase_deg is not None:
        high = vibration + lag_of(run, sensor.phase_deg)
        shapes += [Line("hidden", (0.0, 0.0), at(high, 1.0)), Arc("outline", at(high, 1.0), 1.0)]
        shapes += _span(vibration, high, 0.8, sense)
        letters.append((f"phase {sensor.phase_deg:.1f}° ({run.phase})", high, 1.2))
    shapes += [Line("hidden", (0.0, 0.0), at(plane.angle_deg, 1.0)), Arc("outline", at(plane.angle_deg, 1.0), 1.6)]
    shapes += _span(0.0, plane.angle_deg, 0.5, sense)
    letters.append((f"heavy spot {plane.angle_deg:.1f}°", plane.angle_deg, 1.2))
    shapes += _letters(letters, sense)
    return _drawing("convention", "Mark, sensors and angles", " ".join(sketch_words(result)), tuple(shapes))


def _letters(letters: list[tuple[str, float, float]], sense: int) -> Iterator[Shape]:
    """Texts at their angles, moved out where they would cover another."""
    taken: list[Point] = []
    for text, degrees, out in letters:
        while True:
            x, y = _point(degrees, out, sense, 0.0)
            x += math.copysign(0.5 * LETTERS * 0.6 * len(text), x) if abs(x) > 2 else 0.0
            if all(abs(y - other[1]) > 1.4 * LETTERS or abs(x - other[0]) > 22 for other in taken):
                break
            out += 0.12
        taken.append((x, y))
        yield Text((x, y - LETTERS / 2), text, LETTERS, "centre")


def _span(first: float, last: float, out: float, sense: int) -> list[Shape]:
    """An arc from one angle to another, both against rotation from the mark, as short lines."""
    steps = max(2, math.ceil(abs(last - first) / 5))
    points = [_point(first + (last - first) * k / steps, out, sense, 0.0) for k in range(steps + 1)]
    return [Line("dimension", start, end) for start, end in pairwise(points)]


NOW, AFTER = 2, 1
"""Series of bars."""
DRAWN: Final = (
    "Each plane as one stands before the end of the rotor, the zero mark on top: − remove, + add, small circle the "
    "heavy spot. Arrows show the rotation. Degrees count from the mark {marks}."
)
CONVENTIONS: Final = "The rotor from its left end at the moment when the zero mark passes its sensor. {words}"


def balance_extras(result: BalanceResult) -> Extras:
    """Figures, and the calculation note."""
    if result.left is not None and result.right is not None:
        drawing = planes_drawing(result.left, result.right, result.turns_from_left, result.angle_marks)
    else:
        drawing = plane_drawing(result.planes[0][1], result.turns_from_left, result.angle_marks)
    words = CONVENTIONS.format(words=" ".join(sketch_words(result)))
    figures = (
        Figure("planes", "before-the-roll", drawing, DRAWN.format(marks=result.angle_marks)), *_imbalance(result),
        *_vibration(result), *_causes(result), Figure("convention", "conventions", convention_drawing(result), words),
    )  # fmt: skip
    return Extras(figures, balance_note(result))


def balance_note(result: BalanceResult) -> tuple[Block, ...]:
    """Every formula, with the numbers of this result."""
    return tuple(step_blocks(STEPS["balance"], _numbers(result)))


def _imbalance(result: BalanceResult) -> Iterator[Figure]:
    """Figure of the imbalance of the correction planes, now and expected; with the limit if these are judged."""
    rows = [
        Bar(f"{called(name)}, {when}", value, f"{number(value, 3)} g·mm", series)
        for name, plane in result.planes
        for when, value, series in (("now", plane.imbalance_g_mm, NOW), ("expected after it", plane.rest_g_mm, AFTER))
    ]
    permitted = {plane.permitted_g_mm for _, plane in result.planes}
    judged = result.tolerance is not None and result.tolerance.planes == "correction planes"
    most = next(iter(permitted)) if len(permitted) == 1 and judged else None
    limit = None if most is None else (most, f"permitted {number(most, 3)} g·mm")
    caption = "Imbalance of each plane now, and as expected after the correction, rms over the errors."
    yield from _bars("residual", "planes", "Imbalance before and after", "imbalance [g·mm]", rows, caption, limit)


def _vibration(result: BalanceResult) -> Iterator[Figure]:
    """Figures of the vibration for each speed and unit that was read."""
    for index, run in enumerate(result.residual_check.verification, 1):
        rows = [
            Bar(f"{sensor.name} sensor, {when}", value, f"{number(value, 3)} {run.unit}", series)
            for sensor in run.sensors
            for when, value, series in (
                ("now", sensor.before, NOW), ("expected", sensor.expected, AFTER), ("at most", sensor.at_most, 3),
            )
        ]  # fmt: skip
        caption = (
            f"Readings of the sensors at {run.speed_rpm:.0f} rpm now, and what the verification run should show: above "
            '"at most" something is wrong.'
        )
        kind = "" if " " in run.unit else ", 0–peak"
        title, axis = f"Vibration at {run.speed_rpm:.0f} rpm, before and after", f"{run.quantity} [{run.unit}]{kind}"
        yield from _bars(f"verification-{index}", "verification-run", title, axis, rows, caption)


def _causes(result: BalanceResult) -> Iterator[Figure]:
    rows = [
        Bar(f"{cause.cause}, {called(name)}" if name == "single" else f"{cause.cause}, {name}", value,
            f"{number(value, 2)} %", (AFTER, NOW)[k])
        for cause in result.uncertainty_by_cause
        for k, (name, _) in enumerate(result.planes)
        if (value := getattr(cause, "single_plane_percent" if name == "single" else f"{name}_percent")) is not None
    ]  # fmt: skip
    caption = "What each cause makes of the uncertainty, one standard deviation: begin with the longest."
    yield from _bars("uncertainty", "uncertainty", "Causes of the uncertainty",
                     "share of the plane's imbalance [%]", rows, caption)  # fmt: skip


def _bars(
    name: str, section: str, title: str, axis: str, rows: list[Bar], caption: str,
    limit: tuple[float, str] | None = None,
) -> Iterator[Figure]:  # fmt: skip
    most = max([*(bar.value for bar in rows), *([limit[0]] if limit else [])], default=0.0)
    if most > 0:
        text = "; ".join(f"{bar.name} {bar.text}" for bar in rows) + (f"; {limit[1]}" if limit else "")
        yield Figure(name, section, Bars(title, text, Axis(axis, 0.0, most), rows, limit), caption)


def _numbers(result: BalanceResult) -> tuple[str, ...]:
    lines = [
        f"{called(name)}: q = {number(plane.mass_g)} g at {plane.angle_deg:.1f}°, "
        f"q·R = {number(plane.imbalance_g_mm)} g·mm"
        for name, plane in result.planes
    ]
    if result.natural_frequencies_hz is not None:
        lines.append("natural frequencies: " + ", ".join(f"{freq:.2f} Hz" for freq in result.natural_frequencies_hz))
    return (*lines, f"readings recalculated from these: {misfit(result.residual_check)} of the largest off")
