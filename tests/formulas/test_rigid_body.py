"""Inertances and effective masses of bodies in space: reference cases, and the laws that every body keeps.

Estimated bodies: the shares that the source of the estimate gives, and its bands.
"""

import math
import random

import numpy as np
import pytest

from abu_calc.formulas.rigid_body import (
    LENGTHS,
    BodyEstimate,
    Inertia,
    Layout,
    PlacedBody,
    RigidBody,
    Vector,
    estimated_body,
)
from abu_calc.foundation.errors import InputError, RangeError
from tests.formulas.bodies import G125, G230, V305, SpaceCase
from tests.rows import for_each


@pytest.mark.parametrize(
    ("case", "along_x", "along_y", "without_gyro", "felt", "at_race"),
    [
        (G125, 1.88017, 0.760896, 1.08336, 1.08336, 1.08336),
        (G230, 4.76336, 1.97284, 2.79010, 2.74375, 3.47368),
        (V305, 2.86734, 1.05141, 1.53862, 1.50089, 1.50089),
    ],
)
def test_effective_masses_of_reference_cases(
    case: SpaceCase, along_x: float, along_y: float, without_gyro: float, felt: float, at_race: float
) -> None:
    still = RigidBody(case.body.mass, case.body.inertia)
    A = still.inertance(case.wheel, case.wheel)
    six_digits = 1e-5
    assert (1 / A[0][0]).real == pytest.approx(along_x, rel=six_digits)
    assert (1 / A[1][1]).real == pytest.approx(along_y, rel=six_digits)
    assert still.effective_mass(case.wheel) == pytest.approx(without_gyro, rel=six_digits)
    assert case.body.effective_mass(case.wheel) == pytest.approx(felt, rel=six_digits)
    assert case.body.effective_mass(case.race) == pytest.approx(at_race, rel=six_digits)


def random_body(source: random.Random, polar: float = 0.0) -> RigidBody:
    """The inertia of eight random points, turned so that J_xy = J_yz = 0 by a mirror at y = 0."""
    points = [(source.uniform(-1, 1), source.uniform(0.1, 1), source.uniform(-1, 1)) for _ in range(8)]
    both = np.array([*points, *[(x, -y, z) for x, y, z in points]]) * 0.1
    both -= both.mean(axis=0)
    mass = source.uniform(1, 8)
    each = mass / len(both)
    x, y, z = both.T
    xx, yy, zz = (each * float((a**2 + b**2).sum()) for a, b in ((y, z), (x, z), (x, y)))
    return RigidBody(mass, Inertia(xx, yy, zz, -each * float((x * z).sum())), polar)


def random_place(source: random.Random) -> Vector:
    return source.uniform(-0.2, 0.2), source.uniform(-0.2, 0.2), source.uniform(-0.2, 0.2)


@for_each(range(20))
def test_inertance_is_that_of_newton_and_euler(seed: int) -> None:
    source = random.Random(seed)
    body, p, q = random_body(source), random_place(source), random_place(source)
    assert body.inertia is not None
    i = body.inertia
    J = np.array([[i.xx, 0, i.xz], [0, i.yy, 0], [i.xz, 0, i.zz]])
    for axis in range(3):
        force = np.eye(3)[axis]
        turning = np.linalg.solve(J, np.cross(q, force))
        expected = force / body.mass + np.cross(turning, p)
        assert [row[axis] for row in body.inertance(p, q)] == pytest.approx(expected.tolist(), rel=1e-9, abs=1e-12)


@for_each(range(20))
def test_inertances_are_reciprocal_and_masses_positive(seed: int) -> None:
    source = random.Random(seed)
    body, p, q = random_body(source, polar=1e-4), random_place(source), random_place(source)
    there, back = np.array(body.inertance(p, q)), np.array(body.inertance(q, p))
    assert there == pytest.approx(back.conj().T, rel=1e-9, abs=1e-12)  # Hermitian with a spinning rotor
    assert body.forward(p, p).imag == pytest.approx(0, abs=1e-9)
    assert 0 < body.effective_mass(p) <= body.mass * (1 + 1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_gyroscopic_moments_of_a_body_on_its_axes(seed: int) -> None:
    """2/m_F = 2/M + a²(J_x + J_y + 2J_p)/(J_xJ_y − J_p²) + b²/J_z, derived by hand for places in the plane y = 0."""
    source = random.Random(seed)
    M, Jx, Jy, Jz, Jp = 5.0, 0.03, source.uniform(0.05, 0.06), 0.055, source.uniform(0, 0.01)
    a, b = source.uniform(0.05, 0.2), source.uniform(0, 0.2)
    expected = 2 / (2 / M + a**2 * (Jx + Jy + 2 * Jp) / (Jx * Jy - Jp**2) + b**2 / Jz)
    assert RigidBody(M, Inertia(Jx, Jy, Jz), Jp).effective_mass((b, 0, a)) == pytest.approx(expected, rel=1e-12)


def test_point_mass_moves_alike_everywhere() -> None:
    point = RigidBody(5.6)
    assert point.effective_mass((0.1, -0.2, 0.3)) == pytest.approx(5.6)
    assert point.acceleration((1, 2, 3), (-1, 0, 2)) == pytest.approx((1 / 5.6, -1j / 5.6, 0))


def test_body_along_the_spindle_is_the_plane_formula() -> None:
    body = RigidBody(6.4, Inertia(0.10, 0.10, 0.002))
    at, wheel = (0.0, 0.0, -0.2), (0.0, 0.0, 0.2)
    assert body.acceleration(at, wheel)[0] == pytest.approx(1 / 6.4 - 0.4)
    assert body.effective_mass(wheel) == pytest.approx(1 / (1 / 6.4 + 0.4))


@pytest.mark.parametrize(
    "moments",
    [
        (0.0, 0.1, 0.1, 0.0),
        (-0.1, 0.1, 0.1, 0.0),
        (0.1, 0.1, math.nan, 0.0),
        (math.inf, 0.1, 0.1, 0.0),
        (0.1, 0.1, 0.1, 0.1),
        (0.1, 0.1, 0.1, -0.2),
    ],
)
def test_moments_of_no_body_are_refused(moments: tuple[float, float, float, float]) -> None:
    with pytest.raises(RangeError):
        Inertia(*moments)


def test_moment_above_the_sum_of_the_others_is_refused_beyond_errors_of_measurement() -> None:
    assert Inertia(0.05, 0.05, 0.104).checked().zz == 0.104
    with pytest.raises(RangeError, match="exceeds the sum"):
        Inertia(0.05, 0.05, 0.106).checked()


@pytest.mark.parametrize(("mass", "polar"), [(0.0, 0.0), (-1.0, 0.0), (math.nan, 0.0), (1.0, -0.1), (1.0, 0.2)])
def test_odd_masses_and_rotors_are_refused(mass: float, polar: float) -> None:
    with pytest.raises(RangeError):
        RigidBody(mass, Inertia(0.1, 0.1, 0.1), polar)


LENGTH: dict[Layout, dict[str, float]] = {
    "straight": {"L": 0.45},
    "angle": {"L": 0.30, "H": 0.06},
    "face": {"H": 0.30},
}


def effective_share(placed: PlacedBody) -> float:
    return placed.body.effective_mass(placed.wheel) / placed.body.mass


@pytest.mark.parametrize(
    ("layout", "share", "low", "high"),
    [("straight", 0.29, 0.235, 0.35), ("angle", 0.495, 0.42, 0.57), ("face", 0.35, 0.29, 0.42)],
)
def test_effective_share_of_the_mass(layout: Layout, share: float, low: float, high: float) -> None:
    """Against 4000 random assemblies; those of angle grinders have other heights too, so 0.05 of the mass is left."""
    estimate = estimated_body(layout, 5.0, LENGTH[layout])
    assert effective_share(estimate.nominal) == pytest.approx(share, abs=0.025)
    found = estimate.band(effective_share)
    assert found[0] == pytest.approx(low, abs=0.01)
    assert found[1] == pytest.approx(high, abs=0.05)


@pytest.mark.parametrize(("layout", "width"), [("straight", 0.13), ("angle", 0.08), ("face", 0.12)])
def test_known_centre_of_mass_narrows_the_band(layout: Layout, width: float) -> None:
    guessed = estimated_body(layout, 5.0, LENGTH[layout])
    known = estimated_body(layout, 5.0, LENGTH[layout], center_of_mass_to_wheel=guessed.nominal.wheel)
    assert known.nominal == guessed.nominal
    low, high = known.band(effective_share)
    nominal = effective_share(known.nominal)
    assert (high - low) / 2 / nominal == pytest.approx(width, abs=0.02)
    assert all(placed.wheel == known.nominal.wheel for pair in known.ends for placed in pair)


def test_straight_machine_by_hand() -> None:
    placed = estimated_body("straight", 6.0, {"L": 0.5}).nominal
    assert placed.wheel == pytest.approx((0.0, 0.0, 0.22))
    assert placed.body.inertia is not None
    assert placed.body.inertia.xx == pytest.approx(6.0 * (0.284 * 0.5) ** 2)
    assert placed.body.inertia.yy == placed.body.inertia.xx


def test_angle_machine_by_hand() -> None:
    placed = estimated_body("angle", 2.4, {"L": 0.3, "H": 0.06}, polar=1e-4).nominal
    assert placed.wheel == pytest.approx((0.087, 0.0, 0.048))
    assert placed.body.inertia is not None
    assert placed.body.inertia.xz == pytest.approx(-0.2 * 2.4 * 0.087 * 0.048)
    assert placed.body.rotor_polar_inertia == 1e-4


def test_angle_machine_of_unknown_height() -> None:
    """0.8 · 0.22 L to the wheel plane; the height of usual machines widens the band, and lies within it."""
    alone = estimated_body("angle", 2.4, {"L": 0.3})
    assert alone.nominal.wheel == pytest.approx((0.087, 0.0, 0.0528))

    def mass(placed: PlacedBody) -> float:
        return placed.body.effective_mass(placed.wheel)

    low, high = alone.band(mass)
    for height in (0.054, 0.06, 0.084):
        known = estimated_body("angle", 2.4, {"L": 0.3, "H": height})
        assert low < mass(known.nominal) < high
        assert high - low > known.band(mass)[1] - known.band(mass)[0]


@pytest.mark.parametrize("layout", list(LENGTHS))
def test_missing_length_is_refused_by_its_key(layout: Layout) -> None:
    for missing in LENGTHS[layout]:
        if (layout, missing) == ("angle", "H"):
            continue  # assumed by the length
        lengths = {name: length for name, length in LENGTH[layout].items() if name != missing}
        with pytest.raises(InputError, match=r"machine\.length_mm|machine\.height_mm"):
            estimated_body(layout, 5.0, lengths)


@pytest.mark.parametrize("height", [0.001, 0.16])
def test_odd_proportions_of_an_angle_grinder_are_refused(height: float) -> None:
    with pytest.raises(RangeError):
        estimated_body("angle", 2.4, {"L": 0.3, "H": height})


def test_band_of_a_sure_quantity_has_no_width() -> None:
    estimate = estimated_body("face", 5.0, LENGTH["face"])
    assert estimate.band(lambda placed: placed.body.mass) == (5.0, 5.0)
    assert isinstance(estimate, BodyEstimate)
