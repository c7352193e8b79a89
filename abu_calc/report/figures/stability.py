"""Figures of `abu stability`: decay rate of disturbances over the speeds, eigenvalues, the formulas."""

import math
from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.report.explain import step_blocks
from abu_calc.report.figures.chart import Axis, Line, Plot, Point, alike
from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.numbers import number
from abu_calc.report.stability import CHANGES
from abu_calc.report.steps import STEPS, Step
from abu_calc.studies.stability import GrowthAt, StabilityResult

FORMULAS: Final = (
    "formulas.motion:equations", "formulas.hanging:resonance_drag", "formulas.hanging:side_by_side",
    "formulas.hanging:damped_drag", "formulas.hanging:gravity_drag",
)  # fmt: skip
RIM: Final = tuple((math.cos(math.tau * k / 90), math.sin(math.tau * k / 90)) for k in range(91))
"""Points of the circle within which multipliers die out."""


def stability_extras(result: StabilityResult) -> Extras:
    """Figures, and the calculation note."""
    figures = (*_over_speeds(result), *_eigenvalues(result), *_multipliers(result))
    keys = (*FORMULAS, *(STEPS["swing-arm"].keys if result.swing_arm else ()))
    step = Step("Stability of the balanced state", keys)
    return Extras(figures, tuple(step_blocks(step, _numbers(result))))


def _over_speeds(result: StabilityResult) -> Iterator[Figure]:
    """The growth rate, with the speeds shaded at which something grows."""
    course = result.growth_by_speed or ()
    if len(course) < 2:
        return
    points = [(growth.speed_rpm, growth.growth_rate_per_s) for growth in course]
    across = Axis("speed [rpm]", points[0][0], points[-1][0])
    marks = [Point(boundary.speed_rpm, 0.0, "", 2) for boundary in result.boundaries_rpm or ()]
    here = result.growth_rate_per_s
    if here is not None and across.low <= result.speed_rpm <= across.high:
        marks.append(Point(result.speed_rpm, here, "this speed"))
    up = Axis.around("growth rate [1/s]", [0.0, *(rate for _, rate in points), *(point.y for point in marks)])
    bands = _forbidden(course, result)
    changes = ", ".join(f"{boundary.speed_rpm:.0f} rpm" for boundary in result.boundaries_rpm or ()) or "no speed"
    summary = f"From {points[0][1]:.3g} 1/s at {points[0][0]:.0f} rpm to {points[-1][1]:.3g} 1/s at "
    summary += f"{points[-1][0]:.0f} rpm; stability changes at {changes}"
    caption = (
        "Growth rate of the slowest-dying disturbance of the balanced state: below zero the balls come back to it, the "
        "deeper the faster; squares: where stability changes. Stay clear of shaded speeds."
    )
    chart = Plot(
        "Growth rate against speed", summary, across, up, (Line(points),), marks, (0.0, "edge of stability"), bands
    )
    yield Figure("growth", CHANGES, chart, caption)


def _forbidden(course: Sequence[GrowthAt], result: StabilityResult) -> list[tuple[float, float]]:
    """Ranges of speed [rpm] between boundaries that are not stable."""
    low, high = course[0].speed_rpm, course[-1].speed_rpm
    inner = sorted(result.boundaries_rpm or (), key=lambda boundary: boundary.speed_rpm)
    if not inner:
        return [(low, high)] if course[0].growth_rate_per_s >= 0 else []
    ends = [low, *(boundary.speed_rpm for boundary in inner), high]
    stable = [not inner[0].stable_above, *(boundary.stable_above for boundary in inner)]
    return [(a, b) for a, b, safe in zip(ends, ends[1:], stable, strict=False) if not safe]


def _eigenvalues(result: StabilityResult) -> Iterator[Figure]:
    values = result.eigenvalues
    if not values:
        return
    across = Axis.around("real part [1/s]", [0.0, *(re for re, _ in values)])
    up = Axis.around("imaginary part [1/s]", [0.0, *(im for _, im in values)])
    edge = Line(((0.0, up.low), (0.0, up.high)), "edge of stability", 2)
    summary = _in_words(values)
    chart = Plot("Eigenvalues", summary, across, up, (edge,), [Point(*eigenvalue) for eigenvalue in values])
    caption = (
        "Eigenvalues of small motions about the balanced state at the speed judged: left of the dashed line they die "
        "out, the farther left the faster; up and down: how fast they swing."
    )
    yield Figure("eigenvalues", "Eigenvalues", chart, caption)


def _multipliers(result: StabilityResult) -> Iterator[Figure]:
    values = result.floquet_multipliers
    if not values:
        return
    across, up = alike("real part", "imaginary part", [*RIM, *values])
    summary = _in_words(values)
    rim = Line(RIM, "edge of stability", 2)
    chart = Plot("Floquet multipliers", summary, across, up, (rim,), [Point(*multiplier) for multiplier in values])
    caption = (
        "Floquet multipliers of one revolution: inside the dashed circle a disturbance dies out, the nearer to the "
        "middle the faster."
    )
    yield Figure("multipliers", "Floquet multipliers", chart, caption)


def _in_words(values: Sequence[tuple[float, float]]) -> str:
    """One of a number and its conjugate."""
    return "; ".join(
        f"{number(re, 5)}, imaginary part ± {number(im, 5)}" if im else number(re, 5) for re, im in values if im >= 0
    )


def _numbers(result: StabilityResult) -> tuple[str, ...]:
    """The verdict's number, and the bounds of drag."""
    growth = "none" if result.growth_rate_per_s is None else f"{number(result.growth_rate_per_s)} 1/s"
    lines = [f"max Re λ = {growth} at {result.speed_rpm:.6g} rpm; stable below −1e-9·Ω"]
    if result.hanging is not None:
        lines += [
            f"{bound.state}: no balls hang above h₀ = {number(bound.drag_per_s, 3)} 1/s; given "
            f"{number(result.hanging.drag_per_s, 3)} 1/s"
            for bound in result.hanging.bounds
            if bound.drag_per_s is not None
        ]
    if result.critical_damping_N_s_per_m is not None:
        lines.append(f"h_sh > {number(result.critical_damping_N_s_per_m)} N·s/m against parametric resonance")
    return tuple(lines)
