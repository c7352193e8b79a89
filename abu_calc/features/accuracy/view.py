"""The report of `abu accuracy`: the price list as a table and as a picture in plain characters, and its figure.

The figure shows error against time, a line for each way to compute. Its note defines settling and accuracy.
"""

import math
from collections.abc import Iterator
from typing import Final

from abu_calc.features.accuracy.study import AccuracyResult, MeasuredPoint
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture, number
from abu_calc.reporting.charts.chart import Axis, Curve, Extras, Figure, MarkedPoint, Plot
from abu_calc.reporting.parts import notices, of_scene, provenance_blocks
from abu_calc.reporting.screen import shortened

MARKS: Final = {
    "closed-form": "f", "envelope": "v", "scipy-dop853": "D", "scipy-rk45": "R", "scipy-lsoda": "L",
    "scipy-radau": "I", "scipy-bdf": "B", "compiled-dop853": "E", "compiled-rk45": "C",
    "plain-dop853": "P", "plain-rk45": "K",
}  # fmt: skip
WIDTH: Final = 58
HEIGHT: Final = 11

ABOUT: Final = (
    "Errors are against the reference, with every effect that has data. Amplitude: relative to the larger of itself "
    "and 1 % of that without balls. Level: likewise for the velocity (0.01 is 0.09 dB). Quiet, rest and settling time: "
    "relative. Angles: in rad. Times are those of the integration alone on this computer. Warm: the median of repeats. "
    "Cold: the first run with import and compilation."
)


def accuracy_blocks(result: AccuracyResult) -> tuple[Block, ...]:
    """The whole report."""
    reference = result.reference
    sure = (
        f"Reference: {reference.integrators[0]} at {reference.tolerances[0]:g} and {reference.integrators[1]} at "
        f"{reference.tolerances[1]:g} differ by {number(reference.disagreement, 2)}, computed in "
        f"{reference.wall_s:.1f} s."
    )
    skipped = [Paragraph(f"Not measured in the time allowed (--time-budget): {'; '.join(_grouped(result.skipped))}.")]
    return (
        Heading(f"{result.title}: error and computing time, {result.quantity}{of_scene(result.scene)}"),
        Paragraph(_chosen(result), "fail" if result.chosen is None else "pass"),
        Paragraph(sure),
        Heading("Points", "points"),
        _grid(result),
        *(Paragraph(line) for line in _not_computed(result.points)),
        *(skipped if result.skipped else []),
        Heading("Error against time", "error-against-time"),
        Picture(tuple(picture(result.points)), _legend(result.points), indent=0),
        Heading("Conventions", "conventions"),
        Paragraph(ABOUT),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def accuracy_screen(result: AccuracyResult) -> tuple[Block, ...]:
    """The answer and the picture."""
    return shortened(result, accuracy_blocks(result), "points", more=("--time-budget S, more points",))


def _grouped(names: tuple[str, ...]) -> list[str]:
    """Model level and integrator once, with all their tolerances."""
    groups: dict[str, list[str]] = {}
    for name in names:
        method, _, tolerance = name.rpartition(" ") if " " in name else (name, "", "")
        groups.setdefault(_short(method), []).append(tolerance)
    return [f"{method} {'/'.join(tolerances)}".rstrip() for method, tolerances in groups.items()]


def _not_computed(points: tuple[MeasuredPoint, ...]) -> list[str]:
    """Why points have no error, each reason once with those it holds for."""
    groups: dict[str, dict[str, None]] = {}
    for point in points:
        if point.error is None and point.note:
            method = point.rung if point.rung != "equations" else _short(point.integrator or "")
            groups.setdefault(point.note, {})[method] = None
    return [f"Not computed by {', '.join(methods)}: {reason}." for reason, methods in groups.items()]


def _chosen(result: AccuracyResult) -> str:
    point = result.chosen
    if point is None or point.error is None or point.wall_s is None:
        return f"No method that was measured reaches an error of {result.accuracy:g}."
    tolerance = "" if point.tolerance is None else f" at tolerance {point.tolerance:g}"
    method = point.rung if point.integrator is None else f"{point.rung}, {point.integrator}{tolerance}"
    return (
        f"Cheapest method for an error of at most {result.accuracy:g}: {method}. "
        f"Its error is {number(point.error, 2)}, its computing time {_time(point.wall_s)}."
    )


def _short(integrator: str) -> str:
    """Short name of an integrator for a column of a table."""
    return integrator.replace("scipy-", "").replace("compiled-rk45", "compiled").replace("plain-rk45", "plain")


def _grid(result: AccuracyResult) -> Grid:
    rows = tuple(
        (point.rung, _short(point.integrator or ""),
         "" if point.tolerance is None else f"{point.tolerance:.0e}",
         "-" if point.error is None else f"{point.error:.1e}", str(point.evaluations or ""),
         _time(point.wall_s), _time(point.cold_s))
        for point in result.points
    )  # fmt: skip
    return Grid(
        ("model level", "by", "tolerance", "error", "evaluations", "warm", "cold"), rows, frozenset({2, 3, 4, 5, 6})
    )


def _time(seconds: float | None) -> str:
    if seconds is None:
        return ""
    return f"{seconds:.3g} s" if seconds >= 1 else f"{1000 * seconds:.3g} ms"


def picture(points: tuple[MeasuredPoint, ...]) -> list[str]:
    """Error upward, time to the right, both in decades."""
    known = [(math.log10(point.wall_s), math.log10(max(point.error, 1e-16)), _mark(point))
             for point in points if point.wall_s and point.error is not None]  # fmt: skip
    if not known:
        return ["no point has an error"]
    times, errors = [x for x, _, _ in known], [y for _, y, _ in known]
    left, right = math.floor(min(times)), math.ceil(max(times))
    low, high = math.floor(min(errors)), math.ceil(max(errors))
    right, high = max(right, left + 1), max(high, low + 1)
    cells = [[" "] * WIDTH for _ in range(HEIGHT)]
    for x, y, mark in known:
        column = round((x - left) / (right - left) * (WIDTH - 1))
        row = round((high - y) / (high - low) * (HEIGHT - 1))
        cells[row][column] = mark
    labels = {round((high - d) / (high - low) * (HEIGHT - 1)): f"1e{d}" for d in range(low, high + 1)}
    lines = [f"{labels.get(row, ''):>8} |{''.join(content)}".rstrip() for row, content in enumerate(cells)]
    axis = [" "] * (WIDTH + 6)
    for decade in range(left, right + 1):
        column = round((decade - left) / (right - left) * (WIDTH - 1))
        for offset, letter in enumerate(f"1e{decade}"):
            axis[column + offset] = letter
    return [*lines, f"{'error':>8} +{'-' * WIDTH}", f"{'':8}  {''.join(axis).rstrip()} s"]


def _legend(points: tuple[MeasuredPoint, ...]) -> str:
    """The marks that the picture shows."""
    shown = {_mark(point): point for point in points if point.error is not None and point.wall_s is not None}
    marks = "; ".join(f"{mark} {_marked(point)}" for mark, point in shown.items())
    return f"{marks}."


def _marked(point: MeasuredPoint) -> str:
    if point.rung in MARKS:
        return point.rung
    return f"{point.integrator}, every effect" if point.rung == "everything" else f"{point.integrator}"


def _mark(point: MeasuredPoint) -> str:
    mark = MARKS[point.rung if point.rung in MARKS else point.integrator or ""]
    return mark.lower() if point.rung == "everything" else mark


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
    lines = [Curve(points, name, k % SERIES + 1) for k, (name, points) in enumerate(ordered)]
    across = Axis.decades("time, warm [s]", (x for x, _ in known))
    up = Axis.decades("error", [result.accuracy, *(y for _, y in known)])
    best, marks = result.chosen, [MarkedPoint(*point, "", line.series) for line in lines for point in line.points]
    if best is not None and best.wall_s and best.error is not None:
        marks.append(MarkedPoint(best.wall_s, max(best.error, NOTHING), "chosen"))
    text = "; ".join(f"{line.name}: error {number(y, 2)} in {number(x, 2)} s" for line in lines for x, y in line.points)
    caption = (
        "Error against computing time, both axes in decades, a line for each method over its tolerances. Nearer to the "
        "lower left is better; points below the dashed line are accurate enough."
    )
    limit = (result.accuracy, f"asked for {result.accuracy:g}")
    chart = Plot("Error against time", text, across, up, lines, marks, limit)
    yield Figure("precision", "error-against-time", chart, caption)


def _name(point: MeasuredPoint) -> str:
    """Model level and integrator in short."""
    by = (point.integrator or "").removeprefix("scipy-")
    if point.rung == "equations" and by:
        return by
    return f"{by}, {point.rung}" if by else point.rung


def _numbers(result: AccuracyResult) -> tuple[str, ...]:
    reference = result.reference
    both = zip(reference.integrators, reference.tolerances, strict=True)
    methods = " and ".join(f"{name} at {tolerance:g}" for name, tolerance in both)
    return (f"reference: {methods} differ by {number(reference.disagreement, 2)}",)
