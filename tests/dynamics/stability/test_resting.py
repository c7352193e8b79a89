"""Where balls that balance come to rest: sums of vectors, and cases without an answer."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.resting import narrowest_gap, needed_gap, needed_resultants, resting_angles, still_axis
from tests.dynamics.closed_forms import two_ball_angles
from tests.dynamics.scenes import dimensionless, scene_on, with_effects


def scene(imbalance: float, *masses: float, angle: float = 0.4) -> Scene:
    """Balls on a race of 1 m."""
    plain = dimensionless(3.0, 1.0, imbalance, 0.1, 0.1, (0.0,) * len(masses), 10.0)
    return replace(plain, imbalance_angle=angle, races=(replace(plain.races[0], ball_masses=masses),))


@pytest.mark.parametrize("imbalance", [0.01, 0.3, 1.99])
def test_two_balls_have_one_arrangement(imbalance: float) -> None:
    angles = resting_angles(scene(imbalance, 1.0, 1.0))
    expected = two_ball_angles(imbalance, 1.0, 0.4)
    assert angles is not None
    turns = np.exp(1j * np.array(angles))
    assert sorted(turns, key=np.imag) == pytest.approx(sorted(np.exp(1j * np.array(expected)), key=np.imag), abs=1e-7)


def test_gaps_go_round_the_circle() -> None:
    assert narrowest_gap((0.1, 2 * math.pi - 0.1, 3.0)) == pytest.approx(0.2)
    assert narrowest_gap((1.0,)) == pytest.approx(2 * math.pi) and narrowest_gap(()) == math.inf


def test_size_counts_where_balls_meet() -> None:
    plain = scene_on("planar")
    meeting = with_effects(plain, BallContactEffect(0.1, 0.5))
    race = replace(plain.races[0], ball_radius=0.4)  # arcsin(0.4/0.8) = 30°
    assert needed_gap(plain, race, 0.0) == 0.0
    assert needed_gap(meeting, race, 0.0) == pytest.approx(math.pi / 3)
    assert needed_gap(meeting, race, 1.0) == 2.0


def test_two_planes_take_force_and_couple_alike() -> None:
    """Σ V = −U and Σ zV = −W for an imbalance and a couple at angles of their own."""
    tilting = scene_on("tilting")
    needed = needed_resultants(tilting)
    assert set(needed) == {0.4, -0.3} and still_axis(tilting)
    assert sum(needed.values()) == pytest.approx(-0.3 * np.exp(0.4j), abs=1e-12)
    assert sum(place * V for place, V in needed.items()) == pytest.approx(-0.2 * np.exp(1j), abs=1e-12)
