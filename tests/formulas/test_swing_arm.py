"""Golden numbers of the corrected theory, each derived without the code under test."""

import cmath
import math

import pytest

from abu_calc.formulas.balls import capacity, half_angle
from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.swing_arm import (
    Arm,
    contact_gain,
    damping_limit,
    growth_rate,
    resonance,
    series_gain,
    stiffness_limit,
    worst_contact_angle,
)
from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.sizing.design import finite_mass_gap, zones

OMEGA = 5800 * math.pi / 30
M, WX, WY, EPS = 5.6, 80.0, 120.0, 0.04e-3
D = (complex(M * (WX**2 - OMEGA**2)), complex(M * (WY**2 - OMEGA**2)))
E = EPS * cmath.exp(0.6j)
G_MM = 1e-6


# Ball rings: exact geometry, printed to 0.1 g·mm.
@pytest.mark.parametrize(
    ("race", "count", "expected"),
    [(30e-3, n, value) for n, value in enumerate((368.0, 685.7, 909.4, 1008.7, 969.8, 798.1, 517.2, 165.5), 1)]
    + [(32e-3, n, value) for n, value in enumerate((757.039, 1026.006, 1177.616, 1194.528), 2)],
)
def test_capacity_of_touching_balls(race: float, count: int, expected: float) -> None:
    pitch, mass = race - 8e-3, 4 / 3 * math.pi * 0.8**3 * 7.8e-3
    held = capacity(count, mass, pitch, half_angle(8e-3, pitch))
    assert held / G_MM == pytest.approx(expected, abs=0.06 if race == 30e-3 else 0.001)


# Golden table for M = 5.6 kg, 5800 rpm, ω 80/120 rad/s, m₀e = 100 g·mm, ε = 0.04 mm at 0.6 rad.
@pytest.mark.parametrize(
    ("f", "s", "u", "force", "angle"),
    [
        (0.0, -1, -181.6678 - 124.2857j, 160.6097, -55.623),
        (0.35, -1, -65.8037 - 209.4975j, 151.5928, -36.332),
        (0.35, +1, -219.1043 + 14.5814j, 151.5928, -74.913),
    ],
)
def test_balancing_under_rigid_contact(f: float, s: int, u: complex, force: float, angle: float) -> None:
    contact = SteadyContact(OMEGA, D, 0.0, s * f)
    found = contact.balancing_imbalance(E)
    assert found / G_MM == pytest.approx(u, abs=2e-3)
    normal = contact.normal_force(found, E)
    assert abs(normal) == pytest.approx(force, abs=2e-3)
    assert math.degrees(cmath.phase(normal)) == pytest.approx(angle, abs=2e-3)
    x, y = contact.axis(found, E)
    assert x == pytest.approx(E) and y == pytest.approx(1j * E)  # backward circle of radius ε


# Regions.
def test_finite_mass_gap() -> None:
    gap = finite_mass_gap(16.73e-3, 5.6, 1.0)
    assert gap == pytest.approx(0.1815, abs=5e-5)
    assert OMEGA * (1 - gap) == pytest.approx(497, abs=0.5)


@pytest.mark.parametrize(("speed", "balances"), [(200, False), (460, True), (620, False), (1000, True)])
def test_zones_of_an_anisotropic_support(speed: float, balances: bool) -> None:
    """Simulated at ω = 300 and 700 rad/s: 200 no, 460 yes, 620 no, 1000 yes (small balls)."""
    between, above = zones((300.0, 700.0))
    assert between is not None
    assert (between[0] < speed < between[1] or speed > above) is balances


# Levels: GOST 17770-86 and Kladiev 1996.
def test_levels() -> None:
    assert velocity_from_level(109) == pytest.approx(1.40919e-2, rel=1e-5)
    assert math.sqrt(2) * velocity_from_level(109) / OMEGA == pytest.approx(32.81e-6, abs=5e-9)
    assert level_from_velocity(0.05e-3 * OMEGA / math.sqrt(2)) == pytest.approx(112.66, abs=0.005)


# Swing arm.
ARM = Arm(0.35, 0.62, 2000.0, 40.0, 1e6, 0.45, 0.115, math.pi / 2, 0.03, 20.0)


@pytest.mark.parametrize(
    ("f", "exact", "series", "gain", "printed"),
    [(0.4, 1.75012, 1.74780, 1.168271, 1.169360), (0.8, 1.87707, 1.83963, 1.390789, 1.402880)],
)
def test_worst_contact_angle(f: float, exact: float, series: float, gain: float, printed: float) -> None:
    ratio = 0.33
    assert worst_contact_angle(f, ratio) == pytest.approx(exact, abs=1e-5)
    assert contact_gain(worst_contact_angle(f, ratio), f, ratio) == pytest.approx(gain, abs=1e-6)
    assert series_gain(f, ratio) == pytest.approx(printed, abs=1e-6)
    by_hand = math.pi / 2 + f / 2 - ratio * f**2 / 4 + (3 * ratio**2 - 4) * f**3 / 24
    assert by_hand == pytest.approx(series, abs=1e-5)


def test_contact_stiffness_limit_of_the_worked_example() -> None:
    ratio = 0.115 / 0.35
    exact = contact_gain(worst_contact_angle(0.45, ratio), 0.45, ratio)
    assert stiffness_limit(ARM, 680, series_gain(0.45, ratio)) == pytest.approx(1.957172e6, rel=1e-6)
    assert stiffness_limit(ARM, 680, exact) == pytest.approx(1.959921e6, rel=1e-6)


def test_series_errs_on_the_safe_side_by_at_most_1_2_percent() -> None:
    for f in (0.1, 0.3, 0.5, 0.8):
        for ratio in (0.2, 0.35, 0.5):
            excess = series_gain(f, ratio) / contact_gain(worst_contact_angle(f, ratio), f, ratio) - 1
            assert -1e-9 <= excess <= 0.012


def test_resonance_at_the_stiffness_limit_is_the_speed() -> None:
    gain = series_gain(0.45, 0.115 / 0.35)
    limit = stiffness_limit(ARM, 680, gain)
    soft = Arm(**{**vars(ARM), "contact_stiffness": limit})
    assert resonance(soft, gain) == pytest.approx(680, rel=1e-9)


def test_parametric_resonance_by_floquet() -> None:
    """At Ω = 2ω₀ the monodromy of ((1+2κcos τ)z')' + 2κ(kσ)z' + k²z = 0 grows at κω₀/2 − h per second."""
    np = pytest.importorskip("numpy")
    integrate = pytest.importorskip("scipy.integrate")
    kappa, natural, h = 0.02, 300.0, 1.0
    speed = 2 * natural

    def rhs(t: float, y: object) -> object:
        z, v = y
        c, s = math.cos(speed * t), math.sin(speed * t)
        return [v, -(2 * v * (h - kappa * speed * s) + natural**2 * z) / (1 + 2 * kappa * c)]

    period = 2 * math.pi / speed
    columns = [
        integrate.solve_ivp(rhs, (0, period), start, method="DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
        for start in ([1.0, 0.0], [0.0, 1.0])
    ]
    rate = math.log(max(abs(np.linalg.eigvals(np.array(columns).T)))) / period
    arm = Arm(0.35, 0.62, 2000.0, h * 2 * 0.62 / 0.35**2, 1e6, 0.45, 0.115, 1.5, 0.03, 20.0)
    assert growth_rate(arm, kappa * 0.62 / 0.35, natural) == pytest.approx(rate, rel=0.02)


@pytest.mark.parametrize(("kappa", "ratio"), [(0.1, 0.495878), (0.2, 0.482731), (0.3, 0.457496)])
def test_the_damping_limit_is_safe_by_floquet(kappa: float, ratio: float) -> None:
    """At the least favourable ω₀/Ω, damping of the limit decays, and 0.03 % less grows: (17) over one turn."""
    np = pytest.importorskip("numpy")
    integrate = pytest.importorskip("scipy.integrate")
    imbalance = kappa * 0.62 / 0.35
    factor = damping_limit(ARM, imbalance, 300.0) / (imbalance / 0.35 * 300.0)

    def multiplier(sigma: float) -> float:
        """Largest modulus of the Floquet multipliers."""

        def rhs(turn: float, state: tuple[float, float]) -> list[float]:
            z, v = state
            force = 2 * kappa * (ratio * sigma - math.sin(turn)) * v + ratio**2 * z
            return [v, -force / (1 + 2 * kappa * math.cos(turn))]

        columns = [
            integrate.solve_ivp(rhs, (0, math.tau), start, method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
            for start in ([1.0, 0.0], [0.0, 1.0])
        ]
        return float(max(abs(np.linalg.eigvals(np.array(columns).T))))

    assert multiplier(factor / 2) < 1 + 1e-8 < multiplier(0.9997 * factor / 2)


# Resting places.


def test_friction_band_is_the_largest_displacement_that_holds_every_ball() -> None:
    """Against a search over all directions of the displacement."""
    for angles in ((-1.2, 1.2), (-0.4, 0.4), (0.1, 1.3, -2.0), (-0.8, -0.2, 0.5, 2.2)):
        band = 2e-6 * 23e-3 / 8e-3
        search = max(
            band / max(abs(math.sin(math.radians(a / 20) - angle)) for angle in angles) for a in range(0, 7200)
        )
        assert friction_band(2e-6, 23e-3, 8e-3, angles) == pytest.approx(search, rel=1e-3)


def test_friction_band_of_two_balls_as_published() -> None:
    angle = math.radians(70)
    expected = 2e-6 * 23e-3 / 8e-3 / min(math.sin(angle), math.cos(angle))
    assert friction_band(2e-6, 23e-3, 8e-3, (-angle, angle)) == pytest.approx(expected)
    assert friction_band(2e-6, 23e-3, 8e-3, (0.0, math.pi)) == math.inf
    assert friction_band(0.0, 23e-3, 8e-3, (0.0, math.pi)) == 0.0
