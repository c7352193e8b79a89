"""A race and its balls: what it refuses, and what the balls weigh."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.rotor import Race, balls_of
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import dimensionless

SCENE = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, -1.0])
@pytest.mark.parametrize("name", ["pitch_radius", "drag", "inertia_factor"])
def test_race_refuses_what_is_no_quantity(name, value):
    with pytest.raises(InputError):
        replace(SCENE.races[0], **{name: value})


@pytest.mark.parametrize(
    "change",
    [
        {"ball_masses": (0.05,)},
        {"ball_masses": (0.05, 0.0)},
        {"start_angles": (0.0, math.nan)},
        {"start_speeds": (0.0, math.inf)},
        {"start_speeds": (0.0,)},
    ],
)
def test_race_refuses_wrong_balls(change):
    with pytest.raises(InputError):
        replace(SCENE.races[0], **change)


def test_all_balls_stand_race_by_race() -> None:
    races = (
        Race(0.8, (0.2, 0.1), 0.7, 1.4, (0.0, 1.0), (0.0, 0.0), 0.4, 0.15),
        Race(0.6, (0.3,), 0.5, 1.5, (2.0,), (0.0,)),
    )
    balls = balls_of(races)
    assert balls.race.tolist() == [0, 0, 1] and balls.radii.tolist() == [0.8, 0.8, 0.6]
    assert balls.factors.tolist() == [1.4, 1.4, 1.5] and balls.places.tolist() == [0.4, 0.4, 0.0]
    assert balls.static_moments.tolist() == pytest.approx([0.16, 0.08, 0.18])
    assert races[0].static_moment == pytest.approx(0.24)
    assert len(balls_of(()).masses) == 0


def test_what_balls_weigh_gives_their_kinetic_energy_in_a_frame_that_moves() -> None:
    """½ vᵀ M v = Σ ½ m |r' + z Θ'|² for balls at the centres of their races."""
    races = (replace(SCENE.races[0], plane_offset=0.4), replace(SCENE.races[0], plane_offset=-0.3))
    balls, v = balls_of(races), np.array((0.3, -0.7, 1.1, 0.2))
    energy = sum(m / 2 * ((v[:2] + z * v[2:]) ** 2).sum() for m, z in zip(balls.masses, balls.places, strict=True))
    assert v @ balls.mass(4) @ v / 2 == pytest.approx(energy, rel=1e-14)
    np.testing.assert_array_equal(balls.mass(2), balls.mass(4)[:2, :2])
