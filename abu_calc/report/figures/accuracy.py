"""Figures of `abu accuracy`: error against time, a line for each way to compute.

They also define settling and accuracy.
"""

from collections.abc import Iterator
from typing import Final

from abu_calc.report.explain import step_blocks
from abu_calc.report.figures.chart import Axis, Line, Plot, Point
from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.numbers import number
from abu_calc.report.steps import STEPS
from abu_calc.studies.accuracy import AccuracyResult, MeasuredPoint

SERIES: Final = 8
NOTHING: Final = 1e-16
"""An error below the last digit of a number."""


def accuracy_extras(result: AccuracyResult) -> Extras:
    """The figure, and the calculation note."""
    return Extras(tuple(_precision(result)), tuple(step_blocks(STEPS["simulation"], _numbers(result))))


def _precision(result: AccuracyResult) -> Iterator[Figure]:
    groups: dict[str, list[tuple[float, float]]] = {}
    for measurement in result.points:
        if measurement.wall_s and measurement.error is not None:
            groups.setdefault(_name(measurement), []).append((measurement.wall_s, max(measurement.error, NOTHING)))
    known = [point for points in groups.values() for point in points]
    if not known:
        return
    # Lines in the order of what they cost at best; the eighth and further ones share their looks with the first.
    ordered = sorted(groups.items(), key=lambda group: min(group[1]))
    lines = [Line(points, name, k % SERIES + 1) for k, (name, points) in enumerate(ordered)]
    across = Axis.decades("time, warm [s]", (x for x, _ in known))
    up = Axis.decades("error", [result.accuracy, *(y for _, y in known)])
    best, marks = result.chosen, [Point(*point, "", line.series) for line in lines for point in line.points]
    if best is not None and best.wall_s and best.error is not None:
        marks.append(Point(best.wall_s, max(best.error, NOTHING), "chosen"))
    text = "; ".join(f"{line.name}: error {number(y, 2)} in {number(x, 2)} s" for line in lines for x, y in line.points)
    caption = (
        "Work against precision, both axes in decades, a line for each way to compute over its tolerances: nearer to "
        "the lower left is better; what lies below the dashed line is accurate enough."
    )
    limit = (result.accuracy, f"asked for {result.accuracy:g}")
    chart = Plot("Error against time", text, across, up, lines, marks, limit)
    yield Figure("precision", "Error against time", chart, caption)


def _name(point: MeasuredPoint) -> str:
    """Rung and integrator in short."""
    by = (point.integrator or "").removeprefix("scipy-")
    if point.rung == "equations" and by:
        return by
    return f"{by}, {point.rung}" if by else point.rung


def _numbers(result: AccuracyResult) -> tuple[str, ...]:
    reference = result.reference
    both = zip(reference.integrators, reference.tolerances, strict=True)
    methods = " and ".join(f"{name} at {tolerance:g}" for name, tolerance in both)
    return (f"reference: {methods} differ by {number(reference.disagreement, 2)}",)
