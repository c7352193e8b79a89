"""Speeds of a motor whose torque falls linearly, by the balance of torques."""

import pytest

from abu_calc.formulas.motor import idle_speed, working_speed

STALL, NO_LOAD = 3.0, 628.0


def reaction(speed: float) -> complex:
    """Two dampers of 40 N·s/m, springs that take no torque, and inertia."""
    return complex(2000 - 6 * speed**2, 80 * speed)


def test_with_linear_damping_the_idle_speed_is_a_quotient() -> None:
    """T(1 − Ω/Ω₀) = ½Δ²bΩ gives Ω = T/(T/Ω₀ + ½Δ²b)."""
    expected = STALL / (STALL / NO_LOAD + 0.5 * 1e-6 * 80)
    assert idle_speed(STALL, NO_LOAD, 1e-3, reaction) == pytest.approx(expected, rel=1e-9)


def test_a_rotor_that_keeps_still_runs_at_the_no_load_speed() -> None:
    assert idle_speed(STALL, NO_LOAD, 0.0, reaction) == NO_LOAD


def test_cutting_takes_the_torque_that_the_motor_gives() -> None:
    for torque in (0.0, 0.7, 2.9):
        assert STALL * (1 - working_speed(STALL, NO_LOAD, torque) / NO_LOAD) == pytest.approx(torque, abs=1e-12)
    assert working_speed(STALL, NO_LOAD, STALL) == working_speed(STALL, NO_LOAD, 9 * STALL) == 0.0
