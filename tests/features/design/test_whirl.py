"""Stability of balls in a body in space, against boundaries by Floquet multipliers of six degrees of freedom."""

import math

import pytest

from abu_calc.features.design.region import growing_whirls, true_region, unstable_speed
from abu_calc.formulas.body_motion import BodyMotion, BodySprings
from abu_calc.formulas.rigid_body import RigidBody
from abu_calc.sizing import size
from tests.formulas.bodies import G125, G230, V305, SpaceCase
from tests.sizing.test_places import angle_grinder


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "frequency", "damping", "gyro", "boundary"),
    [
        (G125, 20.0, 0.05, False, 1359.5),
        pytest.param(G230, 20.0, 0.05, False, 1408.8, marks=pytest.mark.slow),
        (G230, 20.0, 0.05, True, 1425.0),
        (V305, 12.0, 0.10, True, 988.6),
    ],
)
def test_balls_are_stable_above_the_boundary_alone(
    case: SpaceCase, frequency: float, damping: float, gyro: bool, boundary: float
) -> None:
    """Half a per cent below and above it; the equation differs from the multipliers by 0.04 %."""
    body = case.body if gyro else RigidBody(case.body.mass, case.body.inertia)
    n_m = case.count * case.ball_mass
    spread = abs(2 * (case.imbalance / (n_m * case.pitch_radius)) ** 2 - 1)
    springs = BodySprings((2 * math.pi * frequency,) * 2, (damping,) * 2)
    counts = [
        growing_whirls(BodyMotion(body, share * boundary * math.pi / 30, springs), case.wheel, n_m, spread, 15.0, 7 / 5)
        for share in (0.995, 1.005)
    ]
    assert counts[0] > 0 and counts[1] == 0


def test_planar_model_is_enough_without_gyroscopic_moments() -> None:
    assert unstable_speed(size(angle_grinder())) is None


BALLS = "ball_count", "ball_diameter_mm", "race_radius_mm"
"""Chosen for the speed, not those that the reference has at its own."""


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("polar", "rpm", "status"),
    [
        (0.0, 1450.0, "pass"),
        (0.002, 1450.0, "fail"),
        pytest.param(0.002, 1700.0, "pass", marks=pytest.mark.slow),
    ],
)
def test_gyroscopic_moments_raise_the_boundary(polar: float, rpm: float, status: str) -> None:
    """Above the boundary in the plane of the race, a rotor with polar inertia still makes the balls unstable."""
    springs = {"model": "springs", "natural_frequencies_hz": [20.0, 20.0], "damping_ratios": [0.05, 0.05]}
    others = {"machine__rotor_polar_inertia_kg_m2": polar, **{f"autobalancer__{key}": None for key in BALLS}}
    design = size(angle_grinder(suspension=springs, machine__speed_rpm=rpm, **others))
    assert (unstable_speed(design) is not None) == (status == "fail")
    region = true_region(design)
    assert region.check.status == status and region.stable == (status == "pass")
    if status == "fail":
        assert "the whole body in space" in region.check.message
