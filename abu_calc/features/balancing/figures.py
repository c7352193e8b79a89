"""Figures of `abu balance`: corrections, before and after, causes of uncertainty, the formulas.

`planes_drawing` shows both planes of a roll as one stands before its ends: zero mark on top, the heavy spot, the
correction.
"""

import math
from collections.abc import Iterator
from typing import Final

from abu_calc.features.balancing.records import PlaneCorrection, Share
from abu_calc.features.balancing.study import BalanceResult
from abu_calc.features.balancing.view import misfit
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.reporting.blocks import number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars
from abu_calc.reporting.charts.figure import Extras, Figure
from abu_calc.reporting.drawings.dimensions import extent
from abu_calc.reporting.drawings.shapes import Arc, Drawing, Line, Point, Shape, Solid, Text, fitted

RADIUS, APART = 20.0, 58.0
LETTERS: Final = 3.0
SIGNS: Final = {"remove": "−", "add": "+"}
DO: Final = {"remove": "remove", "add": "add"}


def planes_drawing(left: PlaneCorrection, right: PlaneCorrection, turns_from_left: str) -> Drawing:
    """Degrees are laid off against rotation, whose sense the arrows show."""
    sense = 1 if turns_from_left == "counterclockwise" else -1
    shapes = (*_plane("left", left, sense, 0.0), *_plane("right", right, -sense, APART))
    low, high = extent(shapes, 1.0)
    description = f"left: {', '.join(_orders(left))}; right: {', '.join(_orders(right))}"
    corners = (low[0] - 2, low[1] - 2), (high[0] + 2, high[1] + 2)
    return Drawing("planes", "What to do in both planes", description, 1.0, *corners, tuple(shapes))


def _plane(side: str, plane: PlaneCorrection, sense: int, middle: float) -> Iterator[Shape]:
    """`sense`: 1 where the roll turns counterclockwise to the one who looks, so that degrees run clockwise."""

    def at(degrees: float, out: float) -> Point:
        angle = math.radians(degrees)
        return middle + out * RADIUS * math.sin(angle) * sense, out * RADIUS * math.cos(angle)

    for row, line in enumerate((f"{side} plane", f"seen from the {side} end")):
        yield Text((middle, 1.55 * RADIUS + 5 * (1 - row)), line, LETTERS, "centre")
    yield Arc("outline", (middle, 0.0), RADIUS)
    for degrees in range(0, 360, 30):
        yield Line("dimension", at(degrees, 0.94), at(degrees, 1.0))
    for quarter in range(0, 360, 90):
        x, y = at(quarter, 0.66)
        yield Text((x, y - LETTERS / 2), f"{quarter}°", LETTERS, "centre")
    yield from _turning(middle, sense)
    if plane.mass_g:
        yield Arc("outline", at(plane.angle_deg, 1.0), 1.6)
        yield Line("hidden", (middle, 0.0), at(plane.angle_deg, 0.9))
    for share in plane.corrections if plane.mass_g else ():
        x, y = at(share.angle_deg, 1.26)
        yield Text((x, y - 2.2), SIGNS[share.action], 1.5 * LETTERS, "centre")
    for row, line in enumerate(_orders(plane, short=True)):
        yield Text((middle, -1.55 * RADIUS - 5 * row), *fitted(line, APART - 2, LETTERS), "centre")


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
    return [_order(SIGNS[share.action] if short else DO[share.action], share) for share in plane.corrections]


def _order(what: str, share: Share) -> str:
    return f"{what} {number(share.mass_g)} g at {round(share.angle_deg, 1) % 360:.1f}°"


NOW, AFTER = 2, 1
"""Series of bars."""
DRAWN: Final = (
    "Both planes as one stands before each end of the roll, the zero mark on top: − remove, + add, small circle the "
    "heavy spot. Degrees count from the mark against rotation, which the arrows show."
)


def balance_extras(result: BalanceResult) -> Extras:
    """Figures, and the calculation note."""
    drawing = planes_drawing(result.left, result.right, result.turns_from_left)
    figures = (
        Figure("planes", "before-the-roll", drawing, DRAWN), *_imbalance(result), *_vibration(result), *_causes(result),
    )  # fmt: skip
    return Extras(figures, tuple(step_blocks(STEPS["balance"], _numbers(result))))


def _imbalance(result: BalanceResult) -> Iterator[Figure]:
    """Figure of the imbalance in both planes, now and expected; with the limit if both have the same."""
    sides = ("left", result.left), ("right", result.right)
    rows = [
        Bar(f"{side} plane, {when}", value, f"{number(value, 3)} g·mm", series)
        for side, plane in sides
        for when, value, series in (("now", plane.imbalance_g_mm, NOW), ("expected after it", plane.rest_g_mm, AFTER))
    ]
    permitted = {plane.permitted_g_mm for _, plane in sides}
    most = next(iter(permitted)) if len(permitted) == 1 else None
    limit = None if most is None else (most, f"permitted {number(most, 3)} g·mm")
    caption = "Imbalance of each plane now, and as expected after the correction, rms over the errors."
    yield from _bars("residual", "planes", "Imbalance before and after", "imbalance [g·mm]", rows, caption, limit)


def _vibration(result: BalanceResult) -> Iterator[Figure]:
    """Figures of the vibration for each speed and quantity that was read."""
    for index, run in enumerate(result.residual_check.verification, 1):
        rows = [
            Bar(f"{side} sensor, {when}", value, f"{number(value, 3)} {run.unit}", series)
            for side, values in (
                ("left", (run.left_before, run.left_expected, run.left_at_most)),
                ("right", (run.right_before, run.right_expected, run.right_at_most)),
            )
            for when, value, series in zip(("now", "expected", "at most"), values, (NOW, AFTER, 3), strict=True)
        ]
        caption = (
            f"Readings of the sensors at {run.speed_rpm:.0f} rpm now, and what the verification run should show: above "
            '"at most" something is wrong.'
        )
        title, axis = f"Vibration at {run.speed_rpm:.0f} rpm, before and after", f"{run.quantity} [{run.unit}], 0–peak"
        yield from _bars(f"verification-{index}", "verification-run", title, axis, rows, caption)


def _causes(result: BalanceResult) -> Iterator[Figure]:
    rows = [
        Bar(f"{cause.cause}, {side}", value, f"{number(value, 2)} %", series)
        for cause in result.uncertainty_by_cause
        for side, value, series in (("left", cause.left_percent, AFTER), ("right", cause.right_percent, NOW))
    ]
    caption = "What each cause makes of the uncertainty, one standard deviation: begin with the longest."
    yield from _bars("uncertainty", "uncertainty", "Causes of the uncertainty",
                     "share of the plane's imbalance [%]", rows, caption)  # fmt: skip


def _bars(
    name: str, section: str, title: str, axis: str, rows: list[Bar], caption: str,
    limit: tuple[float, str] | None = None,
) -> Iterator[Figure]:  # fmt: skip
    most = max([*(bar.value for bar in rows), *([limit[0]] if limit else [])], default=0.0)
    if most > 0:
        text = "; ".join(f"{bar.name} {bar.told}" for bar in rows) + (f"; {limit[1]}" if limit else "")
        yield Figure(name, section, Bars(title, text, Axis(axis, 0.0, most), rows, limit), caption)


def _numbers(result: BalanceResult) -> tuple[str, ...]:
    """Values of the formulas for this result."""
    lines = [
        f"{side}: q = {number(plane.mass_g)} g at {plane.angle_deg:.1f}°, q·R = {number(plane.imbalance_g_mm)} g·mm"
        for side, plane in (("left plane", result.left), ("right plane", result.right))
    ]
    if result.natural_frequencies_hz is not None:
        lines.append("natural frequencies: " + ", ".join(f"{freq:.2f} Hz" for freq in result.natural_frequencies_hz))
    return (*lines, f"readings recalculated from these: {misfit(result.residual_check)} of the largest off")
