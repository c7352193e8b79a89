"""What `abu accuracy` shows: error against time, a line for each way to compute, and what settling and accuracy are."""

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
    for one in result.points:
        if one.wall_s and one.error is not None:
            groups.setdefault(_name(one), []).append((one.wall_s, max(one.error, NOTHING)))
    known = [point for points in groups.values() for point in points]
    if not known:
        return
    # Lines in the order of what they cost at best; the eighth and further ones share their looks with the first.
    ordered = sorted(groups.items(), key=lambda one: min(one[1]))
    lines = [Line(points, name, k % SERIES + 1) for k, (name, points) in enumerate(ordered)]
    across = Axis.decades("time, warm [s]", (x for x, _ in known))
    up = Axis.decades("error", [result.accuracy, *(y for _, y in known)])
    best, marks = result.chosen, [Point(*point, "", line.series) for line in lines for point in line.points]
    if best is not None and best.wall_s and best.error is not None:
        marks.append(Point(best.wall_s, max(best.error, NOTHING), "chosen"))
    told = "; ".join(f"{line.name}: error {number(y, 2)} in {number(x, 2)} s" for line in lines for x, y in line.points)
    caption = (
        "Work against precision, both axes in decades, a line for each way to compute over its tolerances: nearer to "
        "the lower left is better; what lies below the dashed line is accurate enough."
    )
    limit = (result.accuracy, f"asked for {result.accuracy:g}")
    chart = Plot("Error against time", told, across, up, lines, marks, limit)
    yield Figure("precision", "Error against time", chart, caption)


def _name(one: MeasuredPoint) -> str:
    """Rung and integrator in short."""
    by = (one.integrator or "").removeprefix("scipy-")
    if one.rung == "equations" and by:
        return by
    return f"{by}, {one.rung}" if by else one.rung


def _numbers(result: AccuracyResult) -> tuple[str, ...]:
    one = result.reference
    both = zip(one.integrators, one.tolerances, strict=True)
    told = " and ".join(f"{name} at {tolerance:g}" for name, tolerance in both)
    return (f"reference: {told} differ by {number(one.disagreement, 2)}",)
