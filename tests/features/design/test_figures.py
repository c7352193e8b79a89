"""Figures of a sized machine: bars and points with the numbers of the result, forbidden speeds."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import pytest

from abu_calc.dynamics.stability.boundaries import StabilityBoundary
from abu_calc.features.design.figures import _forbidden, _ratio, size_charts, size_extras, start_label
from abu_calc.features.design.starts import StartView
from abu_calc.features.design.view import size_blocks
from abu_calc.foundation.units import to_si
from abu_calc.inputs.read_machine import read_machine
from abu_calc.reporting.blocks import Facts
from abu_calc.reporting.charts.chart import Bars, Plot, RotorMotionFigure
from abu_calc.sizing.vibration import SpeedLevel
from tests.remembered import recalled
from tests.reporting.drawings.samples import whole

VIEW = SimpleNamespace()


@pytest.fixture(scope="module")
def shown() -> dict[str, object]:
    return {figure.name: figure.shown for figure in size_extras(whole()).figures}


@pytest.mark.slow
def test_bars_of_levels_are_those_of_the_places(shown: dict[str, object]) -> None:
    result, bars = whole(), shown["levels"]

    def speed(level_db: float) -> float:
        return 5e-5 * 10 ** (level_db / 20)  # mm/s rms

    assert isinstance(bars, Bars) and bars.limit is not None and bars.limit[0] == pytest.approx(speed(109))
    values = {bar.name: bar.value for bar in bars.rows}
    for place in result.vibration.handles:
        assert values[f"{place.name}, without autobalancer"] == pytest.approx(speed(place.level_before_db))
        assert values[f"{place.name}, with: expected"] == pytest.approx(speed(place.level_after_db))


@pytest.mark.slow
def test_bars_of_the_budget_make_its_sum(shown: dict[str, object]) -> None:
    """The expected residual is the root of the squares of the parts before it, the worst friction left out.

    On this horizontal spindle the worst friction is that of evenly spread balls: its bar comes second.
    """
    bars, budget = shown["budget"], whole().accuracy_budget
    assert isinstance(bars, Bars)
    parts = [bar.value for bar in bars.rows if bar.series == 1]
    parts.reverse()
    parts.remove(budget.rolling_friction_worst_um)
    assert budget.residual_um == pytest.approx(math.hypot(*parts), rel=1e-6)
    assert bars.axis.high >= max(bar.value for bar in bars.rows)


@pytest.mark.slow
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


PRESETS = ("avtovaz-707-222", "msh-230", "swing-arm-grinder")


@pytest.mark.slow
@pytest.mark.parametrize("name", PRESETS)
def test_each_run_of_the_animation_has_its_own_label_that_names_the_case(name: str) -> None:
    result = recalled("size", read_machine(name))
    (figure,) = [figure for figure in size_extras(result).figures if figure.name == "motion"]
    motion = figure.shown
    assert isinstance(motion, RotorMotionFigure)
    labels = [motion.name, *(label for label, _ in motion.others)]
    cases = [label.partition(":")[0].partition(", the loudest")[0] for label in labels]
    assert len(labels) == len(set(labels)) and len(set(cases)) == len(cases) > 2
    assert [label for label in labels if not re.search(r", race centre \d+°, drag rate [\d.]+ 1/s", label)] == []


def test_labels_tell_placed_balls_stalled_balls_and_why_a_case_is_shown() -> None:
    start = StartView("worst", "placed", 15.0, 0.0, (352.4, 21.8), 0.25, 98.7, balanced=True, stalled=False, view=VIEW)  # type: ignore[arg-type]
    case = "race centre 0°, drag rate 15 1/s"
    assert start_label(start) == f"Placed (352°, 22°), {case}, the loudest: quiet after 0.25 s, 98.7 dB"
    start = replace(start, why="typical", start="bunched", angles_deg=())
    assert start_label(start) == f"Bunched, {case}, median quiet time: quiet after 0.25 s, 98.7 dB"
    never = replace(start, why="", quiet_time_s=None)
    assert start_label(never) == f"Bunched, {case}: never quiet, 98.7 dB"
    assert start_label(replace(start, why="", balanced=False)).endswith(": does not balance, 98.7 dB")
    assert start_label(replace(start, why="worst", balanced=False, stalled=True)).endswith(": balls stall, 98.7 dB")


@pytest.mark.slow
def test_caption_of_the_early_pressed_run_names_its_case() -> None:
    """The run is pressed before the balls settle; the level of the one pressed after stands beside it."""
    result = whole()
    caption = next(figure.caption for figure in size_extras(result).figures if figure.name == "level-loaded")
    assert "before the balls settle" in caption and "have settled" not in caption
    assert result.vibration_loaded is not None
    assert f"after the balls settle: {result.vibration_loaded.level_after_db:.1f} dB" in caption


@pytest.mark.slow
@pytest.mark.parametrize("name", PRESETS)
def test_each_time_of_the_report_names_start_race_and_drag_rate(name: str) -> None:
    """One drag rate has a quiet and a rest time for each start case; each row and cell names its own."""
    result = recalled("size", read_machine(name))
    rows = [row for block in size_blocks(result) if isinstance(block, Facts) for row in block.rows]
    times = [label for label, _, _ in rows if re.match("(quiet|rest|settling) time", label)]
    assert {"quiet time", "rest time"} <= {label.partition(",")[0] for label in times}
    assert [label for label in times if not re.search("race centre .*drag rate", label)] == []


def test_speeds_between_boundaries_are_forbidden() -> None:
    """Unstable below 900, between 2000 and 2500, and above 5000 rpm; levels from 500 to 6000."""
    edges = [(900.0, True), (2000.0, False), (2500.0, True), (5000.0, False)]
    boundaries = tuple(StabilityBoundary(speed=to_si(speed, "rpm"), stable_above=above) for speed, above in edges)
    levels = tuple(SpeedLevel(speed=to_si(speed, "rpm"), level_after_db=90.0) for speed in (500.0, 6000.0))
    made = SimpleNamespace(
        frequency=replace(whole().frequency, stability_boundaries_rpm=boundaries),
        vibration=SimpleNamespace(by_speed=levels),
    )
    ranges = [speed for each in _forbidden(made) for speed in each]  # type: ignore[arg-type]
    assert ranges == pytest.approx([0.0, 900.0, 2000.0, 2500.0, 5000.0, 6000.0])
    made.frequency = replace(whole().frequency, stability_boundaries_rpm=None)
    assert _forbidden(made) == []  # type: ignore[arg-type]
    assert [_ratio(scale) for scale in (2.0, 0.2)] == ["2:1", "1:5"]
