"""Figures of a machine with two races: section of both, displacement against speed in closed form and in a run-up."""

from collections.abc import Iterator

from abu_calc.features.two_races.drawing import both_sections
from abu_calc.features.two_races.records import TwoRaceSizeResult
from abu_calc.reporting.charts.chart import Axis, Curve, Plot
from abu_calc.reporting.charts.figure import Extras, Figure
from abu_calc.reporting.charts.run_up_chart import run_up_chart

SECTION = "vibration"


def two_race_extras(result: TwoRaceSizeResult) -> Extras:
    """Figures of the page."""
    return Extras((*_section(result), *_over_speed(result), *_run_up(result)))


def _section(result: TwoRaceSizeResult) -> Iterator[Figure]:
    drawing = both_sections(result)
    drawn = f"{drawing.scale:g}:1" if drawing.scale >= 1 else f"1:{1 / drawing.scale:g}"
    yield Figure("section", "make", drawing, f"Sections through the axis, drawn to scale {drawn}, sizes in mm.")


def _run_up(result: TwoRaceSizeResult) -> Iterator[Figure]:
    """Amplitude against speed of the simulated run-up."""
    points = result.run_up
    if not points:
        return
    without = [(point.speed_rpm, point.without_um) for point in points]
    balls = [(point.speed_rpm, point.with_um) for point in points if point.with_um is not None]
    caption = (
        "Simulated run-up: largest displacement of any place in each revolution against speed, imbalances of unknown "
        "phase in phase, balls together at the start. Balls do not help below the critical speeds. At full speed they "
        "settle: the curve falls there."
    )
    yield Figure("run-up", SECTION, run_up_chart(balls, without), caption)


def _over_speed(result: TwoRaceSizeResult) -> Iterator[Figure]:
    response = result.response
    without = [(point.speed_rpm, point.without_um) for point in response]
    balanced = [(point.speed_rpm, point.balanced_um) for point in response if point.balanced_um is not None]
    lines = [Curve(without, "without autobalancers")]
    lines += [Curve(balanced, "balanced, closed form", 2)] if balanced else []
    across = Axis.around("speed [rpm]", (speed for speed, _ in without))
    up = Axis.around("displacement, 0–peak [µm]", [0.0, *(value for _, value in (*without, *balanced))])
    speeds = ", ".join(f"{speed:.0f}" for speed in result.frequency.critical_speeds_rpm)
    text = f"Largest displacement of a place against speed; critical speeds {speeds} rpm."
    caption = (
        "Largest displacement of any place against speed, at the worst phase of the imbalances. Balls in two races "
        "balance above both critical speeds only; race eccentricity is what is left there."
    )
    yield Figure("speeds", SECTION, Plot("Displacement against speed", text, across, up, lines), caption)
