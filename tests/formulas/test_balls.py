"""Balls side by side by sums of vectors, and the steady contact of wheel and work by its equilibrium."""

import cmath
import math

import pytest

from abu_calc.formulas.balls import (
    INERTIA_FACTORS,
    best_count,
    capacity,
    corrector_mass,
    half_angle,
    most_balls,
)
from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.foundation.errors import RangeError

COMPLIANT = SteadyContact(600.0, (-2e6 + 5e4j, -1.7e6 + 4e4j), 1 / 2e5, -0.35)
RIGID = SteadyContact(600.0, (-2e6 + 5e4j, -1.7e6 + 4e4j), 0.0, 0.35)
FACE = SteadyContact(600.0, (-2e6 + 5e4j, -1.7e6 + 4e4j), 1.0, -0.35, pressing=0.0)


@pytest.mark.parametrize("count", range(2, 12))
def test_balls_that_touch_all_round_are_a_polygon(count: int) -> None:
    """Centres of n touching balls are corners of a polygon of side 2r in a circle of R_p: r = R_p·sin(π/n)."""
    beta = half_angle(24e-3 * math.sin(math.pi / count), 24e-3)
    assert beta == pytest.approx(math.pi / count, rel=1e-12)
    assert most_balls(beta) == count and most_balls(1.001 * beta) == count - 1


@pytest.mark.parametrize("count", [1, 2, 5, 9])
def test_capacity_is_the_sum_of_the_balls_moments(count: int) -> None:
    beta, mass, radius = 0.3, 0.0167, 0.024
    total = sum(mass * radius * cmath.exp(2j * beta * k) for k in range(count))
    assert capacity(count, mass, radius, beta) == pytest.approx(abs(total), rel=1e-12)


@pytest.mark.parametrize("beta", [0.11, 0.26, 0.4, 0.7])
def test_the_best_count_has_the_largest_capacity(beta: float) -> None:
    counts = range(1, most_balls(beta) + 1)
    assert best_count(beta) == max(counts, key=lambda count: capacity(count, 1.0, 1.0, beta))


def test_more_balls_than_the_race_holds_are_refused() -> None:
    with pytest.raises(RangeError, match="number of balls"):
        capacity(most_balls(0.3) + 1, 0.01, 0.02, 0.3)
    with pytest.raises(RangeError, match="pitch radius"):
        half_angle(0.03, 0.02)


def test_a_roller_weighs_three_halves_of_a_ball() -> None:
    """A cylinder as long as it is thick about its inscribed ball; J = 1 + 2/5 and 1 + 1/2."""
    assert corrector_mass("roller", 0.01, 7800) / corrector_mass("ball", 0.01, 7800) == pytest.approx(1.5)
    assert corrector_mass("ball", 0.01, 7800) == pytest.approx(7800 * 4 / 3 * math.pi * 0.005**3)
    assert INERTIA_FACTORS == {"ball": 1.4, "roller": 1.5}


@pytest.mark.parametrize("contact", [COMPLIANT, RIGID, FACE])
def test_forces_are_in_balance_and_the_contact_obeys_its_law(contact: SteadyContact) -> None:
    """D_x X = Ω²U + s·f·N, D_y Y = N − iΩ²U, and q·N = p(iE − Y): the spring gives way by what the surface comes."""
    U, E = 2e-4 + 1e-4j, 3e-5 * cmath.exp(0.7j)
    X, Y = contact.axis(U, E)
    N, pull = contact.normal_force(U, E), contact.speed**2 * U
    (dx, dy), p = contact.dynamic_stiffness, contact.pressing
    assert dx * X == pytest.approx(pull + contact.friction * N, rel=1e-12)
    assert dy * Y == pytest.approx(N - 1j * pull, rel=1e-12)
    if p:
        assert contact.compliance * N == pytest.approx(1j * E - Y, rel=1e-9, abs=1e-18)
    else:
        assert N == 0


@pytest.mark.parametrize("contact", [COMPLIANT, RIGID])
def test_balls_settle_where_the_axis_has_no_forward_whirl(contact: SteadyContact) -> None:
    E = 3e-5 * cmath.exp(0.7j)
    X, Y = contact.axis(contact.balancing_imbalance(E), E)
    assert abs(X + 1j * Y) < 1e-12 * abs(X)


@pytest.mark.parametrize("contact", [COMPLIANT, RIGID, FACE])
def test_whirl_per_imbalance_is_that_of_a_unit_imbalance(contact: SteadyContact) -> None:
    X, Y = contact.axis(1.0, 0.0)
    assert contact.whirl_per_imbalance == pytest.approx((X + 1j * Y) / 2, rel=1e-12)


def test_balls_increase_the_imbalance_in_a_band_of_contact_stiffness() -> None:
    """Without friction and damping M Ω² − c_y < c_n < 2 M Ω² − c_x − c_y: 1.7e6 … 3.7e6 N/m here."""
    for stiffness, bad in ((1.6e6, False), (1.8e6, True), (3.6e6, True), (3.8e6, False), (math.inf, False)):
        contact = SteadyContact(600.0, (-2e6, -1.7e6), 1 / stiffness, 0.0)
        assert contact.balls_increase_imbalance is bad
        assert (contact.whirl_per_imbalance.real > 0) is bad
