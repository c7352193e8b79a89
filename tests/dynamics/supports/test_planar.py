"""Supports against closed forms: receptances, whirl, and steady motion, which the equations must reproduce as it is."""

import math

import numpy as np
import pytest

from abu_calc.dynamics.supports.planar import in_hands, with_body
from abu_calc.dynamics.supports.steady_motion import receptance
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.formulas.suspension import Hands, dynamic_stiffness
from abu_calc.foundation.errors import InputError, RangeError
from abu_calc.standards.vibration import hand
from tests.dynamics.supports.steady import SPEED, acceleration, assert_steady, scene_on

# Two hands


@pytest.mark.parametrize("speed", [0.0, 3.0, 30.0, 183.0, 607.0, 5000.0])
def test_hands_have_the_receptance_that_sizing_computes(speed):
    axes = (hand("x"), hand("z"))
    h = receptance(in_hands(5.9, axes), speed)
    for axis in (0, 1):
        assert h[axis, axis] * dynamic_stiffness(Hands(axes), axis, speed, 5.9) == pytest.approx(1, rel=1e-11)
        assert h[axis, 1 - axis] == 0


def test_hands_weigh_what_the_table_says():
    axes = (hand("x"), hand("z"))
    matrix = np.array(in_hands(5.0, axes).mass)
    for axis, one in enumerate(axes):
        assert matrix[axis::2, axis::2].sum() == pytest.approx(5.0 + 2 * sum(one.masses), rel=1e-14)
    # moved as one, palm, fingers and machine feel the ground alone
    stiffness = np.array(in_hands(5.0, axes).stiffness)
    assert stiffness @ np.array((1, 0) * 3) == pytest.approx((0, 0, 2 * 400, 0, 0, 0), abs=1e-9)


# A further body


@pytest.mark.parametrize("speed", [0.5, 1.0, 3.0, 40.0])
def test_body_on_the_rotor_has_the_receptance_of_two_masses(speed):
    support = with_body(2.0, (5.0, 7.0), (0.1, 0.2), 0.5, (1.5, 2.5), (0.05, 0.0))
    h = receptance(support, speed)
    for axis, (k, b, kb, bb) in enumerate(((5.0, 0.1, 1.5, 0.05), (7.0, 0.2, 2.5, 0.0))):
        link = kb + 1j * speed * bb
        felt = k + 1j * speed * b - 2.0 * speed**2 - 0.5 * speed**2 * link / (link - 0.5 * speed**2)
        assert h[axis, axis] * felt == pytest.approx(1, rel=1e-11)
    assert h[0, 1] == h[1, 0] == 0


def test_undamped_body_in_tune_holds_the_rotor_still():
    support = with_body(2.0, (5.0, 5.0), (0.0, 0.0), 0.5, (0.5 * SPEED**2,) * 2, (0.0, 0.0))
    scene = scene_on(support, imbalance_angle=0.0)
    assert abs(receptance(support, SPEED)[0, 0]) < 1e-18
    # The body's inertia carries the imbalance alone: m_b x_b = −m₀e.
    opposite = -scene.imbalance / 0.5
    assert_steady(scene, np.array((0, 0, opposite, -1j * opposite)))


def test_supports_refuse_what_is_no_body():
    with pytest.raises(RangeError, match="support mass"):
        with_body(1.0, (1.0, 1.0), (0.0, 0.0), 0.0, (1.0, 1.0), (0.0, 0.0))
    with pytest.raises(RangeError, match="support damping"):
        with_body(1.0, (1.0, 1.0), (0.0, 0.0), 0.1, (1.0, 1.0), (0.0, math.nan))
    with pytest.raises(RangeError, match="support mass"):
        in_hands(-1.0, (hand("x"), hand("z")))


# A swing arm


def test_arm_stands_where_spring_and_moment_are_in_balance():
    assert SwingArmSupport(0.35, 0.62, 2000.0, 40.0, 24.5).resting_position()[0] == pytest.approx(24.5 / 245)
    assert SwingArmSupport(0.35, 0.62, 0.0, 40.0).resting_position()[0] == 0.0
    for arm in (SwingArmSupport(0.35, 0.62, 0.0, 40.0, 1.0), SwingArmSupport(0.35, 0.62, -5.0, 40.0)):
        with pytest.raises(InputError, match="does not stand"):
            arm.resting_position()[0]


def test_arm_without_balls_swings_as_a_pendulum_on_springs():
    arm = SwingArmSupport(0.35, 0.62, 2000.0, 0.0, 24.5)
    scene = scene_on(arm, imbalance=0.0)
    stands = arm.resting_position()[0]
    assert acceleration(scene, np.array([stands]), np.zeros(1)) == pytest.approx([0.0], abs=1e-12)
    found = acceleration(scene, np.array([stands + 0.01]), np.zeros(1))
    assert found == pytest.approx([-2000.0 * 0.35**2 / 0.62 * 0.01], rel=1e-9)
