"""Figures of `abu grinding`: levels, spindle displacement, the force round the wheel, wear.

Displacement and force are also shown over angles and speeds.
"""

from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import Final

from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.features.grinding.study import GrindingResult
from abu_calc.features.grinding.wear import WearCourse
from abu_calc.reporting.blocks import number
from abu_calc.reporting.charts.chart import (
    Axis,
    Bar,
    Bars,
    Curve,
    Extras,
    Figure,
    MarkedPoint,
    Plot,
    alike,
    db,
    micrometres,
)

WITH, WITHOUT, FIXED, MEAN = 1, 2, 3, 4
"""Series of lines."""
SERIES: Final = {"with": WITH, "without": WITHOUT, "balls fixed": FIXED}

Course = list[tuple[float, float | None]]


def grinding_extras(result: GrindingResult) -> Extras:
    """Figures, and the calculation note."""
    figures = (
        *_levels(result), *_wear(result), *_orbits(result), *_hodograph(result), *_response(result), *_force(result),
        *_profile(result),
    )  # fmt: skip
    if result.profile is None:  # a face presses by nothing in the plane: over angles and speeds all is the same
        figures = tuple(figure for figure in figures if figure.name in ("levels", "orbit-simulated"))
    return Extras(figures, tuple(step_blocks(STEPS["grinding"], _numbers(result))))


def _levels(result: GrindingResult) -> Iterator[Figure]:
    rows = [
        Bar(name, value, db(value), series)
        for name, value, series in (
            ("without autobalancer", result.level_before_db, WITHOUT), ("with it", result.level_after_db, WITH),
            ("with it, pressed before the balls have settled", result.level_at_once_db, FIXED),
        ) if value is not None
    ]  # fmt: skip
    if not rows:
        return
    axis = Axis.around("velocity level at work [dB]", (bar.value for bar in rows))
    chart = Bars("Levels at work", "; ".join(f"{bar.name} {bar.text}" for bar in rows), axis, rows)
    caption = "Velocity level at work, 0 dB = 5e-8 m/s rms: the autobalancer helps where round stands left of square."
    yield Figure("levels", "title", chart, caption)


def _orbits(result: GrindingResult) -> Iterator[Figure]:
    """Closed forms and what was simulated each by itself: they may be of other sizes."""
    for simulated, name, word in (
        (False, "orbit", "as if wheel and work never parted"),
        (True, "orbit-simulated", "simulated"),
    ):
        paths = [orbit for orbit in result.orbits if orbit.simulated is simulated]
        if not paths:
            continue
        across, up = alike("along the work [µm]", "away from it [µm]", [p for orbit in paths for p in orbit.points_um])
        lines = [Curve(orbit.points_um, orbit.name, SERIES[orbit.name]) for orbit in paths]
        text = "; ".join(f"{orbit.name}: {_reach(orbit.points_um)}" for orbit in paths)
        chart = Plot(f"Motion of the axis, {word}", text, across, up, lines)
        which = f"{paths[0].name} autobalancer, " if len(paths) == 1 else ""
        caption = f"How the axis goes round once at the rated speed, {which}{word}: smaller is better."
        yield Figure(name, "angles", chart, caption)


def _reach(points: Iterable[tuple[float, float]]) -> str:
    x, y = (max(map(abs, each)) for each in zip(*points, strict=True))
    return f"{micrometres(x)} along the work, {micrometres(y)} away from it"


def _hodograph(result: GrindingResult) -> Iterator[Figure]:
    rows = result.hodograph
    courses: list[tuple[str, int, Course]] = [
        ("along, without", WITHOUT, [(row.runout_angle_deg, _um(row.without.x_amplitude)) for row in rows]),
        ("away, without", MEAN, [(row.runout_angle_deg, _um(row.without.y_amplitude)) for row in rows]),
        ("along, with", WITH, [(row.runout_angle_deg, _um(row.fitted.x_amplitude)) for row in rows]),
        ("away, with", FIXED, [(row.runout_angle_deg, _um(row.fitted.y_amplitude)) for row in rows]),
    ]
    caption = (
        "Amplitude of the axis along the work and away from it against the angle from imbalance to runout: how much "
        "depends on where the high spot is."
    )
    chart = _lines("Axis against the angle of the runout", "runout from the imbalance [°]", "amplitude [µm]", courses)
    yield from _figure("hodograph", "angles", chart, caption)


def _response(result: GrindingResult) -> Iterator[Figure]:
    rows = result.response
    courses: list[tuple[str, int, Course]] = [
        ("without", WITHOUT, [(row.speed_rpm, _um(row.without.largest)) for row in rows]),
        ("with", WITH, [(row.speed_rpm, _um(row.fitted.largest)) for row in rows]),
    ]
    resonance = "" if result.resonance_rpm is None else (
        f" Without autobalancer the machine resonates on its work at {number(result.resonance_rpm)} rpm.")  # fmt: skip
    caption = (
        "Amplitude of the axis over the speeds, wheel on the work; a line breaks off where balls come to no rest."
        f"{resonance}"
    )
    chart = _lines("Axis over the speeds", "speed [rpm]", "amplitude [µm]", courses)
    yield from _figure("response", "speeds", chart, caption)


def _force(result: GrindingResult) -> Iterator[Figure]:
    courses: list[tuple[str, int, Course]] = [
        ("without", WITHOUT, [(row.speed_rpm, row.force_without_N) for row in result.response]),
        ("with", WITH, [(row.speed_rpm, row.force_with_N) for row in result.response]),
    ]
    caption = (
        "Variable part of the force of wheel and work over the speeds: above the dashed line, the mean force, they "
        "part."
    )
    mean = result.reaction.mean_N
    limit = (mean, f"mean force {number(mean, 3)} N")
    chart = _lines("Variable force over the speeds", "speed [rpm]", "force [N]", courses, limit)
    yield from _figure("force", "speeds", chart, caption)


def _profile(result: GrindingResult) -> Iterator[Figure]:
    rows = result.profile
    if not rows:
        return
    # Round the wheel it ends where it begins.
    angles = [*((row.wheel_angle_deg, row) for row in rows), (360.0, rows[0])]
    mean = result.reaction.mean_N
    courses: list[tuple[str, int, Course]] = [
        ("without", WITHOUT, [(angle, row.without_N) for angle, row in angles]),
        ("with", WITH, [(angle, row.with_N) for angle, row in angles]),
        ("mean", MEAN, [(angle, mean) for angle, _ in angles]),
    ]
    points = [
        MarkedPoint(angle, force, "", series)
        for series, name in ((WITHOUT, "simulated_without_N"), (WITH, "simulated_N"))
        for angle, row in angles[:-1]
        if (force := getattr(row, name)) is not None
    ]
    as_simulated = " Points: as simulated, round with, square without." if points else ""
    caption = (
        "Force on each point of the wheel, from its imbalance; lines as if wheel and work never parted: at the dashed "
        f"line they do. Where it presses harder, it wears faster.{as_simulated}"
    )
    limit = (0.0, "wheel and work part")
    chart = _lines("Force round the wheel", "point of the wheel [°]", "force [N]", courses, limit, points)
    yield from _figure("reaction", "force", chart, caption)


def _wear(result: GrindingResult) -> Iterator[Figure]:
    """Runout and imbalance of the wheel as it wears, by time where that is known."""
    wears = [
        (name, wear) for name, wear in (("without", result.wear_without), ("with", result.wear)) if wear is not None
    ]
    timed = all(stage.time_min is not None for _, wear in wears for stage in wear.stages)

    def against(wear: WearCourse, name: str, scale: float) -> Course:
        """One quantity of the wear over time, or over depth where time is not known."""
        return [(stage.time_min if timed and stage.time_min is not None else stage.depth_um,
                 scale * getattr(stage, name)) for stage in wear.stages]  # fmt: skip

    across = "time at work [min]" if timed else "depth worn off [µm]"
    for name, key, unit, scale, title in (
        ("wear", "runout_mm", "runout [µm]", 1e3, "Runout as the wheel wears"),
        ("wear-imbalance", "imbalance_g_mm", "imbalance [g·mm]", 1.0, "Imbalance as the wheel wears"),
    ):
        courses = [(side, SERIES[side], against(wear, key, scale)) for side, wear in wears if wear.depth_um]
        caption = (
            f"{title}, {' and '.join(side for side, *_ in courses)} autobalancer (Archard): where it falls, wear "
            "centres the wheel. Lines end where what the table names comes first."
        )
        yield from _figure(name, "wear", _lines(title, across, unit, courses), caption)


def _figure(name: str, section: str, chart: Plot | None, caption: str) -> Iterator[Figure]:
    """The figure of a chart; none without one."""
    if chart is not None:
        yield Figure(name, section, chart, caption)


def _lines(
    title: str, across: str, up: str, courses: Iterable[tuple[str, int, Course]],
    limit: tuple[float, str] | None = None, points: Iterable[MarkedPoint] = (),
) -> Plot | None:  # fmt: skip
    """Lines over one another, broken where a value is not known; None where none is."""
    lines = [line for course in courses for line in _unbroken(*course)]
    data, marks = [point for line in lines for point in line.points], list(points)
    if not data:
        return None
    xs, ys = [x for x, _ in data], [*(y for _, y in data), *(mark.y for mark in marks), *([limit[0]] if limit else [])]
    horizontal = Axis(across, min(xs), max(xs)) if max(xs) > min(xs) else Axis.around(across, xs)
    text = "; ".join(f"{line.name}: {_extremes(line)}" for line in lines)
    vertical = Axis.around(up, [0.0, *ys], zero=min(ys) >= 0)
    return Plot(title, text, horizontal, vertical, lines, marks, limit)


def _unbroken(name: str, series: int, course: Course) -> Iterator[Curve]:
    for known, part in groupby(course, key=lambda point: point[1] is not None):
        if known:
            yield Curve([(x, y) for x, y in part if y is not None], name, series)


def _extremes(line: Curve) -> str:
    least, most = (chosen(line.points, key=lambda point: point[1]) for chosen in (min, max))
    return ", ".join(f"{word} {number(y, 3)} at {number(x)}" for word, (x, y) in (("least", least), ("most", most)))


def _um(length: float | None) -> float | None:
    return None if length is None else 1e6 * length


def _numbers(result: GrindingResult) -> tuple[str, ...]:
    """Values of the formulas for this result."""
    reaction, friction = result.reaction, result.friction
    lines = [
        f"asked of the balls: {number(result.needed_resultant_g_mm)} g·mm",
        f"variable force {_n(reaction.amplitude_N)} N of {_n(reaction.mean_N)} N with the autobalancer, "
        f"{_n(result.reaction_without.amplitude_N)} N without",
    ]
    if result.printed is not None:
        lines.append(f"|V| as printed = {number(result.printed.resultant_g_mm)} g·mm")
    if result.contact_stiffness_regions_N_per_m is not None:
        first, second = result.contact_stiffness_regions_N_per_m
        lines.append(f"regions of stiffness: up to {first:.4g} N/m, and above {second:.4g} N/m")
    if result.flutter_drag_limit_per_s is not None:
        lines.append(
            f"no flutter above h₀ = {_n(result.flutter_drag_limit_per_s)} 1/s as the balls stand, "
            f"{_n(result.flutter_drag_worst_per_s)} 1/s at the worst"
        )
    if result.wear is not None:
        lines.append(f"dε/ds = {result.wear.runout_rate:+.4g} with the autobalancer")
    lines.append(f"k_r·R_p/r = {number(friction.threshold_um)} µm shakes dry friction out")
    return tuple(lines)


def _n(value: float | None) -> str:
    return "not known" if value is None else number(value)
