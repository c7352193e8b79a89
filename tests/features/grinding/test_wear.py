"""Wear of a wheel, against one that is worn point by point: its outline, the force on each point, the mass left."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from abu_calc.features.grinding.steady_contact import RestingBalls, SteadyWork
from abu_calc.features.grinding.wear import needed_exponent, worn
from abu_calc.formulas.tilting_contact import SteadyContact

W = 5800 * math.pi / 30
M, PRESS, WHEEL, RADIUS = 5.6, 200.0, 0.6, 75e-3
D = complex(M * (80.0**2 - W**2), 3e4), complex(M * (120.0**2 - W**2), 3e4)
E, OWN = cmath.rect(2e-5, 0.6), 60e-6 + 0j
POINTS = np.arange(720) * 2 * math.pi / 720


def contact(stiffness: float | None) -> SteadyContact:
    return SteadyContact(W, D, 0.0 if stiffness is None else 1 / stiffness, -0.35)


def alone(stiffness: float | None) -> SteadyWork:
    return SteadyWork(contact(stiffness), E, OWN, OWN)


def fitted(stiffness: float | None) -> SteadyWork:
    one = contact(stiffness)
    U = one.balancing_imbalance(E)
    return SteadyWork(one, E, OWN, U, RestingBalls("balanced", U - OWN, U - OWN, (), (1, 1), (1, 1)))


def ground(stiffness: float | None, depth: float, steps: int, *, balls: bool) -> tuple[complex, complex]:
    """Runout and own imbalance of an outline worn by N(ψ), step by step; N from the equations of motion themselves."""
    outline = RADIUS + (E * np.exp(-1j * POINTS)).real
    density = WHEEL / (math.pi * RADIUS**2)

    def moment() -> complex:
        return complex(density * (outline**3 / 3 * np.exp(1j * POINTS)).mean() * 2 * math.pi)

    first = moment()
    for _ in range(steps):
        runout = complex(2 * (outline * np.exp(1j * POINTS)).mean())
        own = OWN + moment() - first
        cn, sf = stiffness or 1e14, -0.35
        rows = np.array([[D[0], 0, -sf, -(W**2)], [0, D[1], -1, 1j * W**2], [0, cn, 1, 0], [1, 1j, 0, 0]])
        right = np.array([0, 0, 1j * cn * runout, 0])
        if not balls:  # the imbalance is the wheel's, instead of what stills the forward whirl
            rows[3], right[3] = [0, 0, 0, 1], own
        N = complex(np.linalg.solve(rows, right)[2])
        # The point ψ touches when Ωt = −π/2 − ψ.
        force = PRESS + (N * np.exp(1j * (-math.pi / 2 - POINTS))).real
        outline = outline - depth / steps * force / PRESS
    return complex(2 * (outline * np.exp(1j * POINTS)).mean()), OWN + moment() - first


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stiffness", "balls"),
    [
        (4.9e5, True),
        (None, True),
        *(pytest.param(one, False, marks=pytest.mark.slow) for one in (4.9e5, None)),  # a part of the same
    ],
)
def test_wear_is_that_of_a_wheel_worn_point_by_point(stiffness: float | None, balls: bool) -> None:
    """To the depth of the first event; the outline loses mass by its radius, 0.1 % of it here."""
    wear = worn((fitted if balls else alone)(stiffness), PRESS, WHEEL, 1e-3)
    assert wear.depth
    for stage in (wear.stages[3], wear.stages[-1]):
        runout, own = ground(stiffness, stage.depth, 2000, balls=balls)
        assert stage.runout == pytest.approx(runout, rel=5e-3, abs=1e-3 * abs(E))
        assert stage.imbalance == pytest.approx(own, rel=5e-3)


def test_what_comes_first() -> None:
    """Softly centred with balls; driven off at a rigid contact until wheel and work part."""
    soft, stiff = worn(fitted(4.9e5), PRESS, WHEEL, 10e-3), worn(fitted(None), PRESS, WHEEL, 10e-3)
    assert (soft.centres, soft.event) == (True, "halved")
    assert soft.rate < 0 < stiff.rate
    assert (stiff.centres, stiff.event) == (False, "parted")
    assert abs(soft.stages[-1].runout) == pytest.approx(abs(E) / 2, rel=1e-6)
    assert abs(stiff.stages[-1].pressure) == pytest.approx(PRESS, rel=1e-6)
    assert worn(fitted(4.9e5), PRESS, WHEEL, 1e-6).event == "worn out"


def test_a_wheel_that_wears_itself_into_balance_settles() -> None:
    """Without balls the pressure dies where D_y E + Ω²U₀ does: 1 % of the first is left."""
    wear = worn(alone(4.9e5), PRESS, WHEEL, 50e-3)
    last = wear.stages[-1]
    assert wear.event == "settled"
    assert abs(last.pressure) == pytest.approx(0.01 * abs(wear.pressure), rel=1e-6)
    assert D[1] * last.runout + W**2 * last.imbalance == pytest.approx(0, abs=0.02 * abs(wear.pressure) * 5)


def test_the_limit_is_met_before_wheel_and_work_part() -> None:
    """At a rigid contact free balls let the axis move by ε: it is above 25 µm when the runout is."""
    wear = worn(fitted(None), 1000.0, WHEEL, 1e-2, 25e-6)
    assert wear.event == "limit"
    assert abs(wear.stages[-1].runout) == pytest.approx(25e-6, rel=1e-9)
    assert worn(fitted(None), 1000.0, WHEEL, 1e-2, 15e-6).event == "parted"  # above it from the beginning


def test_a_wheel_that_parts_already_is_told() -> None:
    wear = worn(fitted(None), 20.0, WHEEL, 1e-2)
    assert (wear.event, wear.depth) == ("parted", 0.0)


def test_a_true_wheel() -> None:
    """Balls leave it alone; without them its imbalance alone drives it off."""
    one = contact(4.9e5)
    free = worn(
        SteadyWork(one, 0j, OWN, 0j, RestingBalls("balanced", -OWN, -OWN, (), (1, 1), (1, 1))), PRESS, WHEEL, 1e-3
    )
    assert (free.rate, free.centres, free.pressure) == (0, True, 0)
    assert worn(SteadyWork(one, 0j, OWN, OWN), PRESS, WHEEL, 1e-3).rate > 0


@pytest.mark.slow
@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_needed_exponent_is_the_one(without: float, fitted_part: float) -> None:
    """Forces 1 + a cos: at the exponent the means are 1.5 apart; without more variation there is none."""
    turn = np.cos(POINTS)
    forces = [1 + part * turn for part in (without, fitted_part)]
    found = needed_exponent(forces[0], forces[1], 1.5)
    if found is None:
        at = [np.mean(force**50.0) for force in forces]
        assert at[0] < 1.5 * at[1] * (1 + 1e-9)
        return
    means = [np.mean(force**found) for force in forces]
    assert means[0] / means[1] == pytest.approx(1.5, rel=1e-6)


def test_archard_needs_more_than_squares() -> None:
    """Without separation and with the force squared, at most 1 + 1/2: the source's 48 to 32 takes it all."""
    turn = np.cos(POINTS)
    assert needed_exponent(1 + turn, np.ones(720), 1.5) == pytest.approx(2.0, abs=1e-6)
    assert needed_exponent(1 + 0.3 * turn, np.ones(720), 1.5) > 5  # type: ignore[operator]


def test_a_force_that_would_pull_wears_nothing() -> None:
    """A rigid contact that never parts pulls for a part of the turn: there wheel and work are apart."""
    force = 1 + 2 * np.sin(np.arange(720) * (2 * math.pi / 720))
    pushed = needed_exponent(np.maximum(force, 0.0), np.ones(720), 1.5)
    assert needed_exponent(force, np.ones(720), 1.5) == pushed is not None
