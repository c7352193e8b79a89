"""Inertances and effective masses of bodies in space: reference cases, and the laws that every body keeps."""

import math
import random

import numpy as np
import pytest

from abu_calc.formulas.rigid_body import Inertia, RigidBody, Vector
from abu_calc.foundation.errors import RangeError
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
