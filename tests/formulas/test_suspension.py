"""Worked numbers of engineering practice; tolerances are those of the digits they are given with."""

import math

import pytest

from abu_calc.formulas.suspension import Hands, dynamic_stiffness, natural_frequency
from abu_calc.sizing.housing import groove_radius
from abu_calc.sizing.strength import hertz_ball_in_toroid, hoop_stress, permitted_pressure
from abu_calc.sizing.track import carry_over_speed
from abu_calc.standards.balls import vickers
from abu_calc.standards.vibration import hand

OMEGA = 5800 * math.pi / 30


def test_forces_and_stresses_of_the_straight_grinder() -> None:
    groove = groove_radius(31e-3, 8e-3)
    force = 16.728e-3 * 23e-3 * OMEGA**2
    assert force == pytest.approx(142, abs=0.5)
    assert 1e-6 * hertz_ball_in_toroid(force, 8e-3, 31e-3, groove) == pytest.approx(1410, rel=0.01)
    fast = force * (12000 / 5800) ** 2
    assert 1e-6 * hertz_ball_in_toroid(fast, 8e-3, 31e-3, groove) == pytest.approx(2290, rel=0.01)
    plain = hertz_ball_in_toroid(force, 8e-3, 31e-3, 1e6)  # a cylinder is a groove of infinite radius
    assert 1e-6 * plain == pytest.approx(1610, rel=0.01)
    assert 30 / math.pi * carry_over_speed(23e-3) == pytest.approx(197, abs=0.5)
    assert 1e-6 * hoop_stress(OMEGA, 33e-3, 7800) == pytest.approx(3, abs=0.5)
    assert 1e-6 * permitted_pressure(vickers(60)) == pytest.approx(5.2 * 697)


@pytest.mark.parametrize(("ratio", "tolerance"), [(1.0, 0.003), (2.0, 0.02), (10.0, 0.02), (60.0, 0.02)])
def test_hertz_pressure_against_elliptic_integrals(ratio: float, tolerance: float) -> None:
    special, optimize = pytest.importorskip("scipy.special"), pytest.importorskip("scipy.optimize")
    small, large = 50.0, 50.0 * ratio  # half the curvature sums

    def mismatch(k: float) -> float:
        m = 1 - 1 / k**2
        first, second = special.ellipk(m), special.ellipe(m)
        return float((k * k * second - first) / (first - second) - large / small)

    k = optimize.brentq(mismatch, 1.0001, 100) if ratio > 1.001 else 1.0
    modulus = 208e9 / (1 - 0.3**2) / 2
    b = (3 * 142 * special.ellipe(1 - 1 / k**2) / (2 * math.pi * k * (small + large) * modulus)) ** (1 / 3)
    expected = 1.5 * 142 / (math.pi * k * b * b)
    r = 1e-4
    found = hertz_ball_in_toroid(142, r, 1 / (1 / r - 2 * small), 1 / (1 / r - 2 * large))
    assert found == pytest.approx(expected, rel=tolerance)


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@pytest.mark.parametrize("mass", [5.0, 5.7, 6.4])
def test_hands_hardly_matter_at_97_hz_but_do_at_29(axis: str, mass: float) -> None:
    """They change the amplitude by −7…+0.5 % at 97 Hz and by −28…−6 % at 29 Hz, over axes and masses."""
    hands = Hands((hand(axis), hand(axis)))

    def change(hertz: float) -> float:
        speed = 2 * math.pi * hertz
        return mass * speed**2 / abs(dynamic_stiffness(hands, 0, speed, mass)) - 1

    assert -0.0715 < change(96.7) < 0.0055
    assert -0.285 < change(29.2) < -0.055


def test_hands_move_with_the_machine_at_a_few_hertz() -> None:
    """Modes at 1.6–2.6 Hz for 5–6.4 kg, read to a tenth."""
    found = [
        natural_frequency(Hands((hand(axis), hand(axis))), 0, mass) / (2 * math.pi)
        for axis in "xyz"
        for mass in (5.0, 6.4)
    ]
    assert 1.5 < min(found) < 1.7 and 2.5 < max(found) < 2.7


def test_hand_model_by_its_matrices() -> None:
    """The closed form against the matrix of palm, fingers and handle, solved as a linear system."""
    np = pytest.importorskip("numpy")
    h, w = hand("z"), 2 * math.pi * 29.2
    z1, z2, z3, z4 = (k + 1j * w * c for k, c in zip(h.stiffness, h.damping, strict=True))
    m1, m2, m3, m4 = h.masses
    inner = np.array([[z1 + z2 + z3 - m1 * w**2, -z2], [-z2, z2 + z4 - m2 * w**2]])
    palm, fingers = np.linalg.solve(inner, [z3, z4])
    force = 2 * ((z3 + z4) - z3 * palm - z4 * fingers - (m3 + m4) * w**2)
    assert Hands((h, h)).reaction(1, w) == pytest.approx(complex(force))
