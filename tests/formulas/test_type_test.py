"""Closed forms of the declared value against the two reference machines, whose numbers were derived independently."""

import math

import pytest

from abu_calc.formulas.type_test import (
    HandleMotion,
    Motion,
    TypeTestBody,
    acceleration_per_displacement,
    break_even,
    evenly,
    friction_displacement,
    frictionless_break_even,
    mean_motion,
    mean_over_orientations,
)
from abu_calc.foundation.units import to_si
from abu_calc.standards.vibration import TestWheel
from abu_calc.standards.vibration import test_wheels as wheels

S100 = (3.2, 0.0, 0.0, 0.0)
S150 = (6.0, 1 / 0.10, 0.20, 0.18)


def body(
    mass: float, compliance: float, wheel: float, race: float, handles: dict[str, float] | None = None
) -> TypeTestBody:
    """A free body whose places lie on the spindle: x and y alike."""

    def inertance(p: float, q: float) -> float:
        return 1 / mass + p * q * compliance

    def motion(p: float, q: float) -> Motion:
        return inertance(p, q), -1j * inertance(p, q), 0j

    places = handles or {"wheel plane": wheel}
    return TypeTestBody(
        inertance(race, wheel), inertance(race, race),
        tuple(HandleMotion(name, motion(place, wheel), motion(place, race)) for name, place in places.items()),
    )  # fmt: skip


RIGID = body(*S150, {"front": 0.10, "rear": -0.20})
POINT = body(*S100)


def test_values_without_autobalancer() -> None:
    front, rear = RIGID.gains
    gain = acceleration_per_displacement(to_si(5800, "rpm"))
    assert gain * front.without(65e-6) == pytest.approx(1.45775, rel=1e-5)
    assert gain * rear.without(65e-6) == pytest.approx(0.92766, rel=1e-5)
    (point,) = POINT.gains
    assert acceleration_per_displacement(to_si(1e4, "rpm")) * point.without(29e-6) == pytest.approx(0.95121, rel=1e-5)


def test_values_with_balls_and_no_friction() -> None:
    """Means over all angles between race eccentricity and test wheel."""
    gain = acceleration_per_displacement(to_si(5800, "rpm"))
    front, rear = (gain * mean_over_orientations(each, 65e-6, 10e-6, evenly(72)) for each in RIGID.gains)
    assert (front, rear) == pytest.approx((0.43241, 0.25206), rel=2e-5)
    point = mean_over_orientations(POINT.gains[0], 29e-6, 5e-6, evenly(5))
    assert acceleration_per_displacement(to_si(1e4, "rpm")) * point == pytest.approx(0.52481, rel=1e-5)


def test_transmissions_of_the_rigid_machine() -> None:
    assert RIGID.effective_mass == pytest.approx(2.03804, rel=1e-5)
    for gain, race, rest in zip(RIGID.gains, (0.706522, 0.394022), (0.005435, 0.025815), strict=True):
        assert math.sqrt(gain.race) == pytest.approx(race, rel=2e-6)
        assert math.sqrt(gain.imbalance) == pytest.approx(rest, rel=1e-4)


def test_break_even_without_friction() -> None:
    for machine, imbalance, expected in ((POINT, 29e-6, 6.9712), (RIGID, 65e-6, 25.946)):
        allowed = max(gain.without(imbalance) for gain in machine.gains) / 1.3
        found = frictionless_break_even(machine.gains, imbalance, allowed, evenly(72))
        assert found is not None
        assert 1e6 * found == pytest.approx(expected, rel=2e-5)


PRODUCTS = (2.77, 11.15, 13.85, 22.31, 34.62, 50.00, 88.46)


@pytest.mark.parametrize(
    ("wheel", "product"), list(zip((row for row in wheels() if row.status == "secondary"), PRODUCTS, strict=True))
)
def test_break_even_of_a_point_mass_for_every_test_wheel(wheel: TestWheel, product: float) -> None:
    """Δ₀·m_F [µm·kg] of the table, two decimals."""
    point = body(1.0, 0.0, 0.0, 0.0)
    found = frictionless_break_even(point.gains, wheel.imbalance, wheel.imbalance / 1.3, (0.0,))
    assert found is not None
    assert 1e6 * found == pytest.approx(product, abs=0.006)


def test_friction_lowers_the_break_even_eccentricity() -> None:
    assert break_even(6.9712e-6, 5.22e-6) == pytest.approx(5.796e-6, rel=1e-3)
    assert break_even(6.9712e-6, 0.0) == 6.9712e-6
    assert break_even(6.9712e-6, 7e-6) is None


def test_no_break_even_if_what_the_plane_leaves_is_too_much() -> None:
    far = body(6.0, 10.0, 0.20, -0.10, {"front": 0.30})
    allowed = far.gains[0].without(65e-6) / 1.3
    assert 1.3 * math.sqrt(far.gains[0].imbalance) > math.sqrt(far.gains[0].bare)
    assert frictionless_break_even(far.gains, 65e-6, allowed, evenly(5)) is None


def test_background_above_its_limit_leaves_no_break_even() -> None:
    """a_b > a_without/√(1.3² − 1) = 1.204·a_without."""
    (gain,) = POINT.gains
    bare = gain.without(29e-6)
    for share, possible in ((1.19, True), (1.21, False)):
        noise = share * bare
        allowed = math.hypot(bare, noise) / 1.3
        assert (frictionless_break_even([gain], 29e-6, allowed, (0.0,), noise) is not None) == possible


def test_estimated_mean_is_near_the_simulated_one() -> None:
    """0.83 … 0.92 of the rms in the sources' simulations, 0.88 here: 6 %."""
    gain = acceleration_per_displacement(to_si(5800, "rpm"))
    front = gain * mean_motion(RIGID.gains[0], 65e-6, 10e-6, 10.50e-6)
    assert front == pytest.approx(0.5515, rel=0.06)


@pytest.mark.parametrize(("count", "low", "high"), [(2, 1.3, 3.2), (3, 1.1, 2.0), (4, 1.0, 1.3), (6, 0.8, 1.0)])
def test_friction_displacement_lies_in_the_simulated_range(count: int, low: float, high: float) -> None:
    assert low <= friction_displacement(count, 1.0) <= high
