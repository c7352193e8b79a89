"""A motor of limited power on a rotor without imbalance and balls: its line of torque alone."""

from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.rotor import DRIVEN
from tests.dynamics.scenes import scene_on

MOTOR = MotorEffect(2.0, 3.0, 6.0)


def bare() -> Equations:
    """The rotor alone."""
    return assemble(replace(scene_on("planar", MOTOR), races=(), imbalance=0.0))


@pytest.mark.parametrize(("speed", "torque"), [(0.0, 2.0), (1.5, 1.0), (3.0, 0.0), (6.0, -2.0)])
def test_torque_falls_linearly_and_turns_the_rotor(speed: float, torque: float) -> None:
    equations = bare()
    y = np.array([0.1, 0.2, 0.0, 0.0, 0.7, speed])
    rates = equations.rhs(np, 0.0, y, equations.acting)
    assert rates[-2] == speed and rates[-1] == pytest.approx(torque / 6.0, rel=1e-12, abs=1e-15)
    motion, _, solved = equations.accelerations(np, 0.0, y, equations.acting)
    assert MOTOR.power(motion, 1.0, None, solved, equations.parameters) == pytest.approx(torque * speed, abs=1e-15)


def test_it_is_switched_off_for_the_run_down() -> None:
    scene = scene_on("planar", RunUpEffect(3.0, 2.0), MOTOR)
    assert [MOTOR.mode_at(scene, t, 1.0) for t in (0.0, scene.duration - 2.001, scene.duration - 2.0)] == [
        1.0,
        1.0,
        0.0,
    ]
    assert MOTOR.mode_at(scene_on("planar", MOTOR), 1e9, 1.0) == 1.0
    equations = bare()
    rates = equations.rhs(np, 0.0, np.array([0, 0, 0, 0, 0, 1.0]), equations.in_mode((0.0,)))
    assert rates[-1] == 0.0


def test_what_a_motor_changes_cannot_be_weighed() -> None:
    weight = MOTOR.weight(scene_on("planar", MOTOR))
    assert weight.value is None and "resonance" in weight.why
    assert MOTOR.rotor_inertia == 6.0 and MOTOR.rotor is DRIVEN
