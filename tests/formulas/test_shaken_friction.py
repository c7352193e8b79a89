"""Friction that gravity shakes on a horizontal spindle: a single ball integrated over revolutions, and by hand."""

import math

import numpy as np
import pytest

from abu_calc.formulas.friction_band import COUNTED, equivalent_drag, friction_number, remaining_band
from abu_calc.foundation.units import GRAVITY

SPEED, PITCH, INERTIA = 607.37, 23e-3, 1.4


def _crept(pull: float, band: float, revolutions: int = 60, steps: int = 4000) -> float:
    """Angle [rad] by which a ball creeps that a displacement `pull` [m] pulls along the race, from rest.

    J θ'' = Ω²/R_p·(pull ± band) − g/R_p·cos Ωt; friction is set-valued: it stops a ball or opposes it.
    """
    step = 2 * math.pi / SPEED / steps
    friction = step * band * SPEED**2 / (PITCH * INERTIA)
    angle = speed = 0.0
    for turn in range(revolutions * steps):
        gravity = GRAVITY * math.cos(2 * math.pi * (turn + 0.5) / steps)
        speed += step * (pull * SPEED**2 - gravity) / (PITCH * INERTIA)
        speed = math.copysign(max(abs(speed) - friction, 0.0), speed)
        angle += speed * step
    return angle


SHAKE = GRAVITY / SPEED**2
"""Displacement that pulls a ball like its weight [m]."""


@pytest.mark.parametrize("number", [1.3, 2.0, 4.0])
def test_a_ball_stays_just_within_the_band_that_a_level_spindle_leaves(number: float) -> None:
    """The product counts half of gravity: never less friction than here."""
    band = number * SHAKE
    assert _crept(0.99 * (band - SHAKE), band, 5) == 0
    assert _crept(band - 0.95 * SHAKE, band) > 1e-6
    assert band - SHAKE < remaining_band(band, SPEED) < band


@pytest.mark.few(1)
@pytest.mark.parametrize("number", [0.2, 0.6, 0.9])
@pytest.mark.slow
def test_below_one_any_pull_moves_a_ball(number: float) -> None:
    band = number * SHAKE
    steady = _crept(0.0, band)
    assert _crept(0.05 * band, band) > abs(steady) + 1e-6
    assert _crept(-0.05 * band, band) < -abs(steady) - 1e-6


@pytest.mark.slow
def test_creeping_close_to_the_band_is_as_slow_as_told() -> None:
    """Slips from −φ₁ to 2φ₁ about the pull of gravity, φ₁² = 2δ/g: 4.5·δ²/(J·R_p·g·Ω²) in a revolution."""
    band, beyond = 2 * SHAKE, 0.02 * SHAKE
    excess = beyond * SPEED**2
    slip = 4.5 * excess**2 / (INERTIA * PITCH * GRAVITY * SPEED**2)
    assert _crept(band - SHAKE + beyond, band, 20, 20000) / 20 == pytest.approx(slip, rel=0.02)


def test_band_by_hand_and_its_ends() -> None:
    assert remaining_band(30e-6, SPEED) == pytest.approx(30e-6 - COUNTED * GRAVITY / SPEED**2)
    number = friction_number(1e-6, 24e-3, 8e-3, SPEED)
    assert number == pytest.approx(1e-6 * 24e-3 * SPEED**2 / (8e-3 * 9.80665))
    assert remaining_band(1e-6 * 24e-3 / 8e-3, SPEED) == 0 and number < 1
    bands = np.geomspace(1e-7, 1e-3, 50)
    left = [remaining_band(band, SPEED) for band in bands]
    assert all(0 <= each <= band for each, band in zip(left, bands, strict=True)) and left == sorted(left)
    assert left[-1] == pytest.approx(1e-3, rel=0.03)  # a slow weight matters little beside much friction


def test_friction_number_and_equivalent_drag_by_hand() -> None:
    speed = 5800 * 2 * math.pi / 60
    # h_eq = (2/π)·J·Λ·Ω: the friction number times the speed.
    number = friction_number(1e-6, 24e-3, 8e-3, speed)
    assert equivalent_drag(1e-6, 24e-3, 8e-3, speed, 1.4) == pytest.approx(2 / math.pi * 1.4 * number * speed)
