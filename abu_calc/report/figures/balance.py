"""Figures of `abu balance`: corrections, before and after, causes of uncertainty, the formulas."""

from collections.abc import Iterator
from typing import Final

from abu_calc.report.drawing.planes import planes_drawing
from abu_calc.report.explain import step_blocks
from abu_calc.report.figures.chart import Axis, Bar, Bars
from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.numbers import number
from abu_calc.report.steps import STEPS
from abu_calc.studies.balance import BalanceResult

NOW, AFTER = 2, 1
"""Series of bars."""
DRAWN: Final = (
    "Both planes as one stands before each end of the roll, the zero mark on top: − take off, + put on, small circle "
    "the heavy spot. Degrees are laid off from the mark against rotation, which the arrows show."
)


def balance_extras(result: BalanceResult) -> Extras:
    """Figures, and the calculation note."""
    drawing = planes_drawing(result.left, result.right, result.turns_from_left)
    figures = (
        Figure("planes", "As one stands", drawing, DRAWN), *_imbalance(result), *_vibration(result), *_causes(result),
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
    yield from _bars("residual", "Planes", "Imbalance before and after", "imbalance [g·mm]", rows, caption, limit)


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
        yield from _bars(f"verification-{index}", "Verification run", title, axis, rows, caption)


def _causes(result: BalanceResult) -> Iterator[Figure]:
    rows = [
        Bar(f"{cause.cause}, {side}", value, f"{number(value, 2)} %", series)
        for cause in result.uncertainty_by_cause
        for side, value, series in (("left", cause.left_percent, AFTER), ("right", cause.right_percent, NOW))
    ]
    caption = "What each cause makes of the uncertainty, one standard deviation: begin with the longest."
    yield from _bars("uncertainty", "What makes the uncertainty", "Causes of the uncertainty",
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
    return (*lines, f"put back, the answer gives the readings to {number(result.residual_check.reproduced, 2)}")
