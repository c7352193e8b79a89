"""A wheel pressed to its workpiece: limits of its action on the axis, and remarks on a run."""

import numpy as np
import pytest

from abu_calc.dynamics.effects.grinding_contact import moved, pulls, stopped
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.supports.steady_motion import receptance
from abu_calc.dynamics.trajectory import Samples
from tests.dynamics.scenes import dimensionless, scene_on

SCENE = dimensionless(3.0, 0.01, 0.02, 0.3, 0.05, (0.4, 1.0), 10.0)


def test_a_rigid_contact_holds_the_wheel_to_its_runout() -> None:
    """The axis then moves by −E along y, so what changes is E and all of the free motion there."""
    free = -1j * 0.02 * 9 * receptance(SCENE.support, 3.0)[1, 1]
    for surface in (0j, 0.01 + 0.02j):
        assert moved(SCENE, 0.0, 0.0, surface, 0.0, 1.0) == pytest.approx(abs(free + surface), rel=1e-12)


def test_a_contact_that_gives_way_changes_nothing_but_the_place() -> None:
    """With drag the press still swings the axis at first, by what is left of it near the end."""
    assert moved(SCENE, 0.0, 0.0, 0.01, 1e12, 1.0) < 1e-11
    dragged = moved(SCENE, 0.0, -0.4, 0.01, 1e12, 2.0)
    assert dragged == pytest.approx(SCENE.small_motion.swinging(np.array((-0.8, 0.0)), 9.5), rel=1e-6)


def test_a_contact_that_pulls_is_told_with_its_share_of_the_time() -> None:
    """Samples at 0, 1, 2 and 6 s stand for 0.5, 1, 2.5 and 2 s: the third for 42 % of 6."""
    t = np.array([0.0, 1.0, 2.0, 6.0])
    (remark,) = pulls(t, np.array([3.0, 1.0, -2.5, 0.0]))
    assert "42 % of the time" in remark and "-2.5 N" in remark
    assert pulls(t, np.array([3.0, 1.0, 0.0, 2.0])) == pulls(np.zeros(0), np.zeros(0)) == ()


def test_a_rotor_that_the_work_stops_is_told_from_one_that_is_switched_off() -> None:
    scene = scene_on("planar", MotorEffect(2.0, 3.0, 6.0))
    t, y = np.array([0.0, 1.0, 2.0, 3.0]), np.zeros((16, 4))
    y[-1] = [1.7, 0.5, 0.001, 0.0]
    (remark,) = stopped(scene, Samples(t, y), 0.8)
    assert "from t = 2 s on" in remark and "0.8 N·m" in remark
    assert stopped(scene_on("planar", RunUpEffect(3.0, 2.0), *scene.effects), Samples(t, y), 0.8) == ()
    y[-1, -1] = 0.5
    assert stopped(scene, Samples(t, y), 0.8) == ()
