"""The scene that is run from a growing arrangement: how it is disturbed, and when there is no run."""

import math

import numpy as np
import pytest

from abu_calc.dynamics.stability.verdict import stability
from abu_calc.features.stability.disturbed import DISTURBANCE, _disturbed, _ranks, consequence
from tests.dynamics.scenes import dimensionless

SCENE = dimensionless(3.0, 0.01, 0.05, 0.3, 0.05, (1.5, -1.7, 3.0), 20.0)


@pytest.mark.parametrize(
    ("angles", "ranks"),
    [((0.0, 0.5, 1.0), (0, 1, 2)), ((1.0, 0.0, 0.5), (2, 0, 1)), ((3.0, -3.0, 0.5), (1, 2, 0)), ((6.2, 0.1), (0, 1))],
)
def test_balls_are_counted_from_behind_the_widest_gap(angles: tuple[float, ...], ranks: tuple[int, ...]) -> None:
    """3 and −3 rad are neighbours across the half turn, 0.5 comes after the widest gap, of 3.5 rad."""
    assert tuple(_ranks(np.array(angles)).tolist()) == ranks


def test_a_disturbance_opens_every_gap_and_keeps_the_first_ball() -> None:
    angles = (2.0, 2.3, 2.9)
    disturbed = _disturbed(SCENE, angles)
    (race,) = disturbed.races
    moved = np.subtract(race.start_angles, angles)
    assert moved[0] == 0.0 and moved[-1] == pytest.approx(DISTURBANCE) == moved.max()
    assert (np.diff(moved) > 0).all() and len(set(np.diff(moved).round(9))) == 2  # no symmetry is kept
    assert race.start_speeds == (0.0, 0.0, 0.0) and disturbed.effects == ()
    assert disturbed.start_velocity == (0.0,) * len(SCENE.support.names)
    assert math.isclose(SCENE.races[0].start_angles[0], 1.5)  # the scene itself stays


def test_a_stable_state_asks_for_no_run() -> None:
    calm = dimensionless(3.0, 0.02, 0.02, 0.1, 0.2, (1.5, -1.7), 20.0)
    judged = stability(calm)
    assert judged.stable and consequence(calm, judged) is None
