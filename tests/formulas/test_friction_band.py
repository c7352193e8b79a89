"""Dry friction at its worst: published numbers, and by the balance of forces at the arrangement it names.

Friction that gravity shakes on a horizontal spindle: a single ball integrated over revolutions, and by hand.
"""

import cmath
import math

import numpy as np
import pytest

from abu_calc.formulas.friction_band import COUNTED, equivalent_drag, friction_number, remaining_band, worst_friction
from abu_calc.foundation.units import GRAVITY

SPEED, NATURAL, ZETA, ARM = 5800 * math.pi / 30, 5 * math.pi, 0.5, 2e-6

# n, m [g], R_p [mm], r [mm], U [g mm], M_t [kg]; worst [µm]; angles [deg]
A2 = (2, 16.3393, 23.0625, 7.9375, 256.02, 6.4)
B3 = (3, 7.057, 25.0, 6.0, 300.0, 5.6)
D4 = (4, 4.084, 26.0, 5.0, 300.0, 5.6)
F6 = (6, 2.091, 27.0, 4.0, 200.0, 4.0)
E8 = (8, 2.091, 27.0, 4.0, 200.0, 4.0)
# Wheels balanced so well that the balls have to cancel each other.
D4_STILL, F6_STILL = (*D4[:4], 0.5, 5.6), (*F6[:4], 2.0, 4.0)
Row = tuple[int, float, float, float, float, float]


def _receptance(mass: float) -> complex:
    return SPEED**2 / (mass * (NATURAL**2 - SPEED**2) + 2j * ZETA * mass * NATURAL * SPEED)


def _worst(row: Row, arm: float = ARM) -> tuple[float, tuple[float, ...]]:
    count, mass, pitch, radius, imbalance, total = row
    found = worst_friction(count, mass * pitch * 1e-6, arm * pitch / radius, imbalance * 1e-6, _receptance(total))
    return found.displacement * 1e6, found.angles


@pytest.mark.parametrize(
    ("row", "worst", "angles"),
    [
        (B3, 25.532, (199.49, 161.40, 0.0)),
        (D4, 25.883, (168.145,) * 4),
        (F6, 39.568, (163.198,) * 6),
    ],
)
def test_published_worst(row: Row, worst: float, angles: tuple[float, ...]) -> None:
    found, where = _worst(row)
    assert found == pytest.approx(worst, abs=1e-3)
    mirrored = sorted(math.degrees(-angle) % 360 for angle in where)
    straight = sorted(math.degrees(angle) % 360 for angle in where)
    wanted = pytest.approx(sorted(angles), abs=0.02)
    assert any([a % 359.99 for a in found] == wanted for found in (straight, mirrored))


def test_two_balls_include_the_separate_interval() -> None:
    """Published: 20.072 at the end of the first interval, and a separate one from 34.10 to 40.36."""
    assert _worst(A2)[0] == pytest.approx(40.36, abs=0.01)


@pytest.mark.parametrize("row", [A2, B3, D4, D4_STILL, F6, F6_STILL, E8])
def test_the_arrangement_rests_by_friction_and_not_with_less_of_it(row: Row) -> None:
    """By the balance of forces: w of these balls, and what pulls each of them along the race, |Im(w e^{−iθ})|."""
    count, mass, pitch, radius, imbalance, total = row
    worst, angles = _worst(row)
    balls = mass * pitch * 1e-6 * sum(cmath.exp(1j * angle) for angle in angles)
    w = _receptance(total) * (imbalance * 1e-6 + balls)
    pulled = max(abs((w * cmath.exp(-1j * angle)).imag) for angle in angles)
    band = ARM * pitch / radius
    assert len(angles) == count
    assert abs(w) * 1e6 == pytest.approx(worst, rel=1e-4)
    assert 0.97 * band < pulled <= band * (1 + 1e-4)


@pytest.mark.parametrize("row", [B3, D4, D4_STILL])
def test_no_arrangement_beyond_it_until_a_gap(row: Row) -> None:
    """Of half a million random arrangements those that friction holds reach nearly to the worst, then none follows."""
    count, mass, pitch, radius, imbalance, total = row
    worst, _ = _worst(row)
    rng = np.random.default_rng(11)
    turned = np.exp(1j * rng.uniform(0, 2 * math.pi, (500_000, count)))
    w = _receptance(total) * 1e-6 * (imbalance + mass * pitch * turned.sum(axis=1))
    held = np.abs((w[:, None] * turned.conj()).imag).max(axis=1) <= ARM * pitch / radius
    rests = np.abs(w[held]) * 1e6
    assert 0.8 * worst < rests[rests < 1.001 * worst].max()
    assert not ((rests > 1.001 * worst) & (rests < 1.1 * worst)).any()


def test_more_friction_holds_farther_and_none_holds_nothing() -> None:
    found = [_worst(D4, arm)[0] for arm in (0.0, 1e-6, 2e-6, 5e-6)]
    assert found[0] == 0.0
    assert found == sorted(found) and found[1] < found[2] < found[3]


def test_a_need_beyond_the_balls_leaves_the_band() -> None:
    """What they cannot carry is the budget's shortfall, not friction's."""
    count, mass, pitch, _, imbalance, total = D4
    found = worst_friction(count, mass * pitch * 1e-6, 1e-5, 10 * imbalance * 1e-6, _receptance(total))
    assert found.angles == () and found.displacement == 1e-5


SHAKEN_SPEED, PITCH, INERTIA = 607.37, 23e-3, 1.4


def _crept(pull: float, band: float, revolutions: int = 60, steps: int = 4000) -> float:
    """Angle [rad] by which a ball creeps that a displacement `pull` [m] pulls along the race, from rest.

    J θ'' = Ω²/R_p·(pull ± band) − g/R_p·cos Ωt; friction is set-valued: it stops a ball or opposes it.
    """
    step = 2 * math.pi / SHAKEN_SPEED / steps
    friction = step * band * SHAKEN_SPEED**2 / (PITCH * INERTIA)
    angle = speed = 0.0
    for turn in range(revolutions * steps):
        gravity = GRAVITY * math.cos(2 * math.pi * (turn + 0.5) / steps)
        speed += step * (pull * SHAKEN_SPEED**2 - gravity) / (PITCH * INERTIA)
        speed = math.copysign(max(abs(speed) - friction, 0.0), speed)
        angle += speed * step
    return angle


SHAKE = GRAVITY / SHAKEN_SPEED**2
"""Displacement that pulls a ball like its weight [m]."""


@pytest.mark.parametrize("number", [1.3, 2.0, 4.0])
def test_a_ball_stays_just_within_the_band_that_a_level_spindle_leaves(number: float) -> None:
    """The product counts half of gravity: never less friction than here."""
    band = number * SHAKE
    assert _crept(0.99 * (band - SHAKE), band, 5) == 0
    assert _crept(band - 0.95 * SHAKE, band) > 1e-6
    assert band - SHAKE < remaining_band(band, SHAKEN_SPEED) < band


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
    excess = beyond * SHAKEN_SPEED**2
    slip = 4.5 * excess**2 / (INERTIA * PITCH * GRAVITY * SHAKEN_SPEED**2)
    assert _crept(band - SHAKE + beyond, band, 20, 20000) / 20 == pytest.approx(slip, rel=0.02)


def test_band_by_hand_and_its_ends() -> None:
    assert remaining_band(30e-6, SHAKEN_SPEED) == pytest.approx(30e-6 - COUNTED * GRAVITY / SHAKEN_SPEED**2)
    number = friction_number(1e-6, 24e-3, 8e-3, SHAKEN_SPEED)
    assert number == pytest.approx(1e-6 * 24e-3 * SHAKEN_SPEED**2 / (8e-3 * 9.80665))
    assert remaining_band(1e-6 * 24e-3 / 8e-3, SHAKEN_SPEED) == 0 and number < 1
    bands = np.geomspace(1e-7, 1e-3, 50)
    left = [remaining_band(band, SHAKEN_SPEED) for band in bands]
    assert all(0 <= each <= band for each, band in zip(left, bands, strict=True)) and left == sorted(left)
    assert left[-1] == pytest.approx(1e-3, rel=0.03)  # a slow weight matters little beside much friction


def test_friction_number_and_equivalent_drag_by_hand() -> None:
    speed = 5800 * 2 * math.pi / 60
    # h_eq = (2/π)·J·Λ·Ω: the friction number times the speed.
    number = friction_number(1e-6, 24e-3, 8e-3, speed)
    assert equivalent_drag(1e-6, 24e-3, 8e-3, speed, 1.4) == pytest.approx(2 / math.pi * 1.4 * number * speed)
