"""Two races on one rotor against reference numbers of an own integration, and against matrices built here."""

import cmath
import math
from collections.abc import Iterator

import numpy as np
import pytest

from abu_calc.formulas.tilting_rotor import (
    Bearing,
    PlacedImbalance,
    TiltingRotor,
    balancing_resultants,
    eccentricity_resultants,
    lever_shares,
    mode_margin,
    one_race_limit,
    one_race_resultant,
    resultant_quantile,
    two_races_balance,
    worst_resultants,
)
from abu_calc.foundation.errors import InputError, RangeError

RPM = 2 * math.pi / 60


def polar(size: float, degrees: float) -> complex:
    return cmath.rect(size, math.radians(degrees))


PEDESTAL = TiltingRotor(62.0, 3.1, 0.09, (Bearing(0.2, 2.2e5, 300.0), Bearing(-0.2, 2.2e5, 300.0)))
PEDESTAL_WHEELS = (PlacedImbalance(0.26, polar(2500e-6, 0.0)), PlacedImbalance(-0.26, polar(1800e-6, 130.0)))
BETWEEN = TiltingRotor(40.0, 1.2, 0.06, (Bearing(0.25, 9e4, 120.0), Bearing(-0.25, 9e4, 120.0)))
BETWEEN_WHEELS = (PlacedImbalance(0.2, polar(3000e-6, 0.0)), PlacedImbalance(-0.15, polar(2000e-6, 75.0)))


def in_g_mm_and_degrees(vector: complex) -> tuple[float, float]:
    return 1e6 * abs(vector), math.degrees(np.angle(vector))


def test_the_pedestal_has_its_reference_numbers() -> None:
    speed = 2850 * RPM
    assert [w / RPM for w in PEDESTAL.critical_speeds()] == pytest.approx([730.204, 804.455], abs=5e-4)
    assert lever_shares((0.3, -0.3), 0.26) == pytest.approx((0.93333, 0.06667), abs=5e-6)
    first, second = balancing_resultants((0.3, -0.3), PEDESTAL_WHEELS)
    assert in_g_mm_and_degrees(first) == pytest.approx((2258.071, -177.6669), abs=5e-4)
    assert in_g_mm_and_degrees(second) == pytest.approx((1578.042, -54.6407), abs=5e-4)
    without = [1e6 * abs(PEDESTAL.whirl(place, PEDESTAL_WHEELS, speed)) for place in (0.2, -0.2)]
    assert without == pytest.approx([90.957, 66.597], abs=5e-4)
    worst = worst_resultants(PEDESTAL, (0.3, -0.3), PEDESTAL_WHEELS, (0.0, 0.0), speed)
    assert [1e6 * size for size in worst] == pytest.approx([2453.33, 1846.67], abs=5e-3)
    sizes = ((2500 * 0.56 / 0.6, 1800 * 0.04 / 0.6), (2500 * 0.04 / 0.6, 1800 * 0.56 / 0.6))
    assert [resultant_quantile(pair, 0.95) for pair in sizes] == pytest.approx([2451.93, 1844.80], abs=5e-3)
    free = TiltingRotor(62.0, 3.1, 0.09, ())
    by_one = eccentricity_resultants(free, (0.3, -0.3), (1e-6, 0j), speed)
    assert [1e6 * each.real for each in by_one] == pytest.approx([23.861, 7.139], abs=5e-4)


def test_with_the_balancing_resultants_every_place_is_still() -> None:
    for rotor, wheels, races, rpm in (
        (PEDESTAL, PEDESTAL_WHEELS, (0.3, -0.3), 2850), (BETWEEN, BETWEEN_WHEELS, (0.22, -0.22), 840),
    ):  # fmt: skip
        balls = [PlacedImbalance(z, V) for z, V in zip(races, balancing_resultants(races, wheels), strict=True)]
        for place in (-0.4, 0.0, 0.25):
            assert abs(rotor.whirl(place, [*wheels, *balls], rpm * RPM)) < 1e-15


def test_between_the_modes_one_race_stills_its_plane_alone() -> None:
    speed = 840 * RPM
    assert [w / RPM for w in BETWEEN.critical_speeds()] == pytest.approx([640.586, 948.626], abs=5e-4)
    first, second = balancing_resultants((0.22, -0.22), BETWEEN_WHEELS)
    assert in_g_mm_and_degrees(first) == pytest.approx((2961.976, -174.0442), abs=5e-4)
    assert in_g_mm_and_degrees(second) == pytest.approx((1722.156, -109.3865), abs=5e-4)
    without = [1e6 * abs(BETWEEN.whirl(place, BETWEEN_WHEELS, speed)) for place in (0.25, -0.25)]
    assert without == pytest.approx([499.95, 459.97], abs=5e-3)
    for place, resultant, bearings in ((0.0, 4013.207, (418.04, 418.04)), (0.025, 4241.240, (354.97, 433.85))):
        V = one_race_resultant(BETWEEN, place, BETWEEN_WHEELS, speed)
        assert 1e6 * abs(V) == pytest.approx(resultant, abs=5e-4)
        left = [*BETWEEN_WHEELS, PlacedImbalance(place, V)]
        assert [1e6 * abs(BETWEEN.whirl(z, left, speed)) for z in (0.25, -0.25)] == pytest.approx(bearings, abs=6e-3)
    assert 1e3 * (one_race_limit(BETWEEN, speed) or 0) == pytest.approx(137, abs=0.5)
    assert one_race_limit(BETWEEN, 1200 * RPM) is None
    assert not two_races_balance(BETWEEN, speed)
    assert two_races_balance(PEDESTAL, 2850 * RPM)


def random_rotors(count: int) -> Iterator[tuple[TiltingRotor, np.random.Generator]]:
    rng = np.random.default_rng(20)
    for _ in range(count):
        J = rng.uniform(0.1, 5)
        bearings = tuple(
            Bearing(rng.uniform(-0.5, 0.5), 10 ** rng.uniform(3, 6), rng.uniform(0, 500)) for _ in range(3)
        )
        yield TiltingRotor(rng.uniform(1, 100), J, rng.uniform(0, 0.9) * J, bearings), rng


def test_receptance_and_modes_agree_with_matrices_of_four_freedoms() -> None:
    """x, y, θ_y, −θ_x with real matrices: M q'' + (C + ΩG) q' + K q = f; G turns the tilts."""
    for rotor, rng in random_rotors(20):
        speed, at, force_at = rng.uniform(10, 300), rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)
        places = [np.kron([1, b.place], np.eye(2)).reshape(2, 4) for b in rotor.bearings]
        K = sum(b.stiffness * P.T @ P for b, P in zip(rotor.bearings, places, strict=True))
        C = sum(b.damping * P.T @ P for b, P in zip(rotor.bearings, places, strict=True))
        M = np.diag([rotor.mass, rotor.mass, rotor.transverse_inertia, rotor.transverse_inertia])
        G = np.zeros((4, 4))
        G[2, 3], G[3, 2] = rotor.polar_inertia, -rotor.polar_inertia
        force = np.array([1, -1j, force_at, -1j * force_at])
        q = np.linalg.solve(K - speed**2 * M + 1j * speed * (C + speed * G), force)
        assert q[0] + at * q[2] == pytest.approx(rotor.receptance(at, force_at, speed), rel=1e-9)
        state = np.block([[np.zeros((4, 4)), np.eye(4)], [-np.linalg.solve(M, K), -np.linalg.solve(M, speed * G)]])
        values, vectors = np.linalg.eig(state)
        forward = sorted(
            value.imag for value, vector in zip(values, vectors.T, strict=True)
            if value.imag > 0 and abs(vector[1] + 1j * vector[0]) + abs(vector[3] + 1j * vector[2])
            < abs(vector[1] - 1j * vector[0]) + abs(vector[3] - 1j * vector[2])
        )  # fmt: skip
        assert [mode.frequency for mode in rotor.forward_modes(speed)] == pytest.approx(forward, rel=1e-7)


def test_damping_ratio_of_a_mode_is_that_of_the_lightly_damped_rotor() -> None:
    """First order: the real part of the eigenvalue of the complex pencil ν²M − νΩJ_p … is −ζν."""
    for rotor, rng in random_rotors(20):
        light = TiltingRotor(
            rotor.mass, rotor.transverse_inertia, rotor.polar_inertia,
            tuple(Bearing(b.place, b.stiffness, 1e-3 * b.damping) for b in rotor.bearings),
        )  # fmt: skip
        speed = rng.uniform(10, 300)
        (k, kz, kzz), (c, cz, czz) = light.stiffness, light.damping
        M = np.diag([light.mass, light.transverse_inertia])
        K, C = np.array([[k, kz], [kz, kzz]]), np.array([[c, cz], [cz, czz]])
        gyro = -1j * speed * np.diag([0, light.polar_inertia])
        state = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C + gyro)]])
        values = sorted((v for v in np.linalg.eigvals(state) if v.imag > 0), key=lambda v: v.imag)
        for mode, value in zip(light.forward_modes(speed), values, strict=True):
            assert mode.damping_ratio * mode.frequency == pytest.approx(-value.real, rel=2e-3)


def test_quantiles_of_the_phase_agree_with_a_count() -> None:
    rng = np.random.default_rng(3)
    phases = rng.uniform(0, 2 * math.pi, 200_000)
    found = np.abs(3.0 + 1.2 * np.exp(1j * phases))
    for share in (0.05, 0.5, 0.95):
        assert resultant_quantile((3.0, 1.2), share) == pytest.approx(float(np.quantile(found, share)), abs=0.01)


@pytest.mark.slow
def test_worst_resultants_are_reached_and_never_exceeded() -> None:
    for rotor, rng in random_rotors(10):
        races, speed = (rng.uniform(0.1, 0.4), rng.uniform(-0.4, -0.1)), rng.uniform(50, 300)
        wheels = [PlacedImbalance(rng.uniform(-0.5, 0.5), rng.uniform(0, 1e-3)) for _ in range(2)]
        bound = worst_resultants(rotor, races, wheels, (1e-5, 2e-5), speed)
        largest = [0.0, 0.0]
        for _ in range(4000):
            turn = np.exp(2j * math.pi * rng.uniform(size=4))
            turned = [PlacedImbalance(w.place, w.imbalance * t) for w, t in zip(wheels, turn, strict=False)]
            exact = balancing_resultants(races, turned)
            off = eccentricity_resultants(rotor, races, (1e-5 * turn[2], 2e-5 * turn[3]), speed)
            for race in (0, 1):
                largest[race] = max(largest[race], abs(exact[race] + off[race]))
        for reached, limit in zip(largest, bound, strict=True):
            assert 0.9 * limit < reached <= limit * (1 + 1e-12)


def test_margins_ask_for_the_speed_above_the_whirl() -> None:
    balls = [PlacedImbalance(0.3, 0.08), PlacedImbalance(-0.3, 0.08)]
    for mode in PEDESTAL.forward_modes(2850 * RPM):
        assert mode_margin(mode, balls, 2850 * RPM, 12.0, 1.4).holds
    for mode in PEDESTAL.forward_modes(780 * RPM):
        assert not mode_margin(mode, balls, 780 * RPM, 12.0, 1.4).holds


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(InputError, match="one plane"):
        lever_shares((0.1, 0.1), 0.2)
    with pytest.raises(RangeError):
        resultant_quantile((1.0, 1.0), 1.1)
    for bad in ((0.0, 1.0, 0.1), (1.0, -1.0, 0.1), (1.0, 1.0, 2.1), (math.nan, 1.0, 0.1)):
        with pytest.raises(RangeError):
            TiltingRotor(*bad, ())
