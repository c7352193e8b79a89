"""Figures of a sized machine: bars and points with the numbers of the result, forbidden speeds."""

import math
from dataclasses import replace
from types import SimpleNamespace

import pytest

from abu_calc.features.design.figures import _forbidden, _ratio, size_charts, size_extras
from abu_calc.features.design.records import SpeedLevel
from abu_calc.reporting.charts.chart import Bars, Plot
from abu_calc.simulation.records import StabilityBoundary
from tests.reporting.drawings.samples import whole


@pytest.fixture(scope="module")
def shown() -> dict[str, object]:
    return {figure.name: figure.shown for figure in size_extras(whole()).figures}


def test_bars_of_levels_are_those_of_the_places(shown: dict[str, object]) -> None:
    result, bars = whole(), shown["levels"]
    assert isinstance(bars, Bars) and bars.limit is not None and bars.limit[0] == 109
    values = {bar.name: bar.value for bar in bars.rows}
    for place in result.vibration.handles:
        assert values[f"{place.name}, before"] == place.level_before_db
        assert values[f"{place.name}, after"] == place.level_after_db


def test_bars_of_the_budget_make_its_sum(shown: dict[str, object]) -> None:
    """The expected residual is the root of the squares of the parts before it, the worst friction left out."""
    bars, budget = shown["budget"], whole().accuracy_budget
    assert isinstance(bars, Bars)
    squares = [bar.value for bar in bars.rows if bar.series == 1 and bar.value != budget.rolling_friction_worst_um]
    assert budget.residual_um == pytest.approx(math.hypot(*squares), rel=1e-6)
    assert bars.axis.high >= max(bar.value for bar in bars.rows)


def test_the_chosen_candidate_is_filled(shown: dict[str, object]) -> None:
    result, plot = whole(), shown["candidates"]
    assert isinstance(plot, Plot)
    (filled,) = [point for point in plot.points if point.series == 1]
    assert (filled.x, filled.y) == (result.autobalancer.mass_g, result.autobalancer.residual_um)
    assert len(plot.points) <= 1 + len(result.alternatives)


def test_costs_fall_from_the_first_bar(shown: dict[str, object]) -> None:
    bars = shown["costs"]
    assert isinstance(bars, Bars)
    values = [bar.value for bar in bars.rows]
    assert values == sorted(values, reverse=True) and values[0] > 0
    assert {figure.name for figure in size_charts(whole())} <= shown.keys()


def test_speeds_between_boundaries_are_forbidden() -> None:
    """Unstable below 900, between 2000 and 2500, and above 5000 rpm; levels from 500 to 6000."""
    edges = [(900.0, True), (2000.0, False), (2500.0, True), (5000.0, False)]
    boundaries = tuple(StabilityBoundary(speed_rpm=speed, stable_above=above) for speed, above in edges)
    levels = tuple(SpeedLevel(speed_rpm=speed, level_after_db=90.0) for speed in (500.0, 6000.0))
    made = SimpleNamespace(
        frequency=replace(whole().frequency, stability_boundaries_rpm=boundaries),
        vibration=SimpleNamespace(by_speed=levels),
    )
    assert _forbidden(made) == [(0.0, 900.0), (2000.0, 2500.0), (5000.0, 6000.0)]  # type: ignore[arg-type]
    made.frequency = replace(whole().frequency, stability_boundaries_rpm=None)
    assert _forbidden(made) == []  # type: ignore[arg-type]
    assert [_ratio(scale) for scale in (2.0, 0.2)] == ["2:1", "1:5"]
