"""Housing of the race: mass, groove and room for the balls."""

import cmath
import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.sizing.housing import (
    dimensions,
    greatest_race_radius,
    groove_radius,
    housing,
    last_ball_passes,
    least_race_radius,
)


def test_housing_of_the_straight_grinder() -> None:
    """231 g with 2 mm wall, 1.5 mm webs; our hub and groove rules may differ by a few grams."""
    body = housing("one-piece", 31e-3, 16e-3, 20e-3, 2e-3)
    assert body.mass + 4 * 16.728e-3 == pytest.approx(0.231, abs=0.012)


RANDOM = settings(max_examples=60, deadline=None, derandomize=True)


@given(st.floats(20e-3, 60e-3), st.floats(1e-4, 5e-3), st.sampled_from(["one-piece", "bearing-ring", "light"]))
@RANDOM
def test_a_larger_race_is_never_lighter(race: float, step: float, design: Any) -> None:
    assert housing(design, race + step, 8e-3, 20e-3, 2.5e-3).mass > housing(design, race, 8e-3, 20e-3, 2.5e-3).mass


def test_a_straight_race_weighs_less_by_the_fill_of_the_groove() -> None:
    """Volume between cylinder and groove by the midpoint rule over the 16.6 mm between the webs."""
    race, ball, steps = 31e-3, 16e-3, 20000
    groove = groove_radius(race, ball / 2)
    half = ball / 2 + 0.3e-3
    across = [half * (2 * (k + 0.5) / steps - 1) for k in range(steps)]
    surfaces = [race - groove + math.sqrt(groove**2 - x**2) for x in across]
    volume = sum(math.pi * (race**2 - surface**2) for surface in surfaces) * 2 * half / steps
    grooved, straight = (housing("one-piece", race, ball, 20e-3, 2e-3, grooved=each).mass for each in (True, False))
    assert grooved - straight == pytest.approx(7800 * volume, rel=1e-6)


def test_the_largest_race_fills_the_outer_diameter() -> None:
    for design in ("one-piece", "bearing-ring", "light"):
        race = greatest_race_radius(design, 68e-3, 2.5e-3)
        assert housing(design, race, 8e-3, 20e-3, 2.5e-3).outer_diameter == pytest.approx(68e-3)


def test_the_smallest_race_leaves_half_a_millimetre_between_ball_and_hub() -> None:
    """10 mm of bore, 2.5 mm of hub, 0.5 mm of clearance, 8 mm of ball."""
    assert least_race_radius("one-piece", 20e-3, 8e-3) == pytest.approx(21e-3)


@pytest.mark.parametrize("ball", [8e-3, 10e-3, 12e-3])
@pytest.mark.parametrize("grooved", [True, False])
def test_the_last_ball_passes_where_it_overlaps_no_other(ball: float, grooved: bool) -> None:
    """The others touch in a row in the race; the last one stands opposite their middle, at the race's edge."""
    size = dimensions("one-piece", 30e-3, ball, 20e-3, 2e-3, grooved)
    pitch, edge = 30e-3 - ball / 2, size.shoulder_radius - ball / 2
    step = 2 * math.asin(ball / (2 * pitch))
    most = math.floor(2 * math.pi / step)
    passes = []
    for count in range(2, most + 1):
        others = [cmath.rect(pitch, step * (k - (count - 2) / 2)) for k in range(count - 1)]
        passes.append(min(abs(each - cmath.rect(edge, math.pi)) for each in others) > ball)
    assert [last_ball_passes(size, count, ball) for count in range(2, most + 1)] == passes
    assert passes[0]
    assert not last_ball_passes(size, most + 2, ball)
