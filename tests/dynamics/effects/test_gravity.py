"""Gravity by hand: a pendulum, a ball that would fall off, and its estimated influence."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.trajectory import Samples
from abu_calc.foundation.units import GRAVITY
from tests.dynamics.scenes import dimensionless, scene_on, with_effects

G = 0.3


def scene(drag: float = 0.05, imbalance: float = 0.001) -> Scene:
    """Two balls of 0.01 kg at R_p = 1 m, J = 1.4, at 3 rad/s."""
    plain = dimensionless(3.0, 0.01, imbalance, 0.3, drag, (0.4, 2.0), 10.0, inertia_factor=1.4)
    return with_effects(plain, GravityEffect(G))


@pytest.mark.parametrize("angle", [0.0, math.pi / 2, -math.pi / 2, 2.0])
def test_a_ball_in_a_race_that_stands_still_is_a_pendulum(angle: float) -> None:
    """J R_p θ'' = −g cos γ; the lowest point, −π/2, is where it rests."""
    heavy = replace(scene(0.0, 0.0), support=planar(1e12, (0.0, 0.0), (0.0, 0.0)))
    equations = assemble(heavy)
    y = np.array([0, 0, 0, 0, angle, angle, 0, 0], dtype=float)
    accelerations = equations.rhs(np, 0.0, y, equations.acting)[-2:]
    np.testing.assert_allclose(accelerations, -G * math.cos(angle) / 1.4, atol=1e-9)


def remarks(speed_of_ball: float) -> tuple[str, ...]:
    """A ball on top of its race at t = 2 s, after a sample at its side."""
    equations = assemble(replace(scene(), races=(replace(scene().races[0], ball_masses=(0.01,), start_angles=(0.0,),
                                                         start_speeds=(0.0,)),)))  # fmt: skip
    y = np.zeros((6, 2))
    y[4] = 0.0, math.pi / 2 - 3.0 * 2.0
    y[5] = speed_of_ball - 3.0
    return GravityEffect(G).remarks(equations, Samples(np.array([0.0, 2.0]), y))


def test_a_ball_too_slow_for_the_top_of_its_race_is_told() -> None:
    """R_p γ'² < g there: below √0.3 rad/s."""
    assert remarks(1.01 * math.sqrt(G)) == ()
    (remark,) = remarks(0.99 * math.sqrt(G))
    assert "ball 1 would fall" in remark and "t = 2 s" in remark


def test_a_ball_from_rest_is_pushed_off_until_drag_stops_it() -> None:
    """By g/(R_p Ω h₀) [rad], where that is more than what its swinging does to the axis."""
    heavy_imbalance = scene(0.05, 0.3)
    assert GravityEffect(G).weight(heavy_imbalance).value == pytest.approx(G / (3.0 * 0.05), rel=1e-12)
    assert GravityEffect(G).weight(scene(0.0)).value is None


def test_without_balls_or_gravity_nothing_changes() -> None:
    assert GravityEffect(G).weight(replace(scene(), races=())).value == 0.0
    assert GravityEffect(0.0).weight(scene()).value == 0.0
    assert GravityEffect(G).weight(scene_on("swing arm")).value is None


def test_balls_fall_as_on_earth_unless_told_otherwise() -> None:
    assert GravityEffect().falling == GRAVITY == 9.80665
