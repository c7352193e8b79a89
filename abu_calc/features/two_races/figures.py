"""Figures of a machine with two races: displacement against speed, without autobalancers and balanced."""

from collections.abc import Iterator

from abu_calc.features.two_races.records import TwoRaceSizeResult
from abu_calc.reporting.charts.chart import Axis, Curve, Plot
from abu_calc.reporting.charts.figure import Extras, Figure

SECTION = "vibration"


def two_race_extras(result: TwoRaceSizeResult) -> Extras:
    """Figures of the page."""
    return Extras(tuple(_over_speed(result)))


def _over_speed(result: TwoRaceSizeResult) -> Iterator[Figure]:
    response = result.response
    without = [(point.speed_rpm, point.without_um) for point in response]
    balanced = [(point.speed_rpm, point.balanced_um) for point in response if point.balanced_um is not None]
    lines = [Curve(without, "without autobalancers")]
    lines += [Curve(balanced, "balanced, closed form")] if balanced else []
    across = Axis.around("speed [rpm]", (speed for speed, _ in without))
    up = Axis.around("displacement, 0–peak [µm]", [0.0, *(value for _, value in (*without, *balanced))])
    speeds = ", ".join(f"{speed:.0f}" for speed in result.frequency.critical_speeds_rpm)
    text = f"Largest displacement of a place against speed; critical speeds {speeds} rpm."
    caption = (
        "Largest displacement of any place against speed, at the worst phase of the imbalances. Balls in two races "
        "balance above both critical speeds only; race eccentricity is what is left there."
    )
    yield Figure("speeds", SECTION, Plot("Displacement against speed", text, across, up, lines), caption)
