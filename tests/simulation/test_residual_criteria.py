"""Criteria of balanced balls: their edges, and what eccentricity and friction add to a tenth of the imbalance."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.residual_criteria import HALF, SLIPPING, allowed_imbalance, balanced_well, balances, slip
from abu_calc.sizing import size
from abu_calc.sizing.design import Design


@pytest.fixture(scope="module")
def design() -> Design:
    return size(read_machine("avtovaz-707-222").whole("size"))


def test_balls_balance_up_to_both_limits_and_not_beyond() -> None:
    assert balances(2.0, 2.0, SLIPPING)
    assert not balances(2.0 + 1e-12, 2.0, 0.0)
    assert not balances(0.0, 2.0, SLIPPING * (1 + 1e-12))


def test_the_fastest_ball_tells_the_slip_whichever_way_it_goes() -> None:
    run: Any = SimpleNamespace(final=SimpleNamespace(ball_speeds=(3.0, -8.0, 0.0)))
    assert slip(run, 40.0) == 0.2
    assert slip(SimpleNamespace(final=SimpleNamespace(ball_speeds=())), 40.0) == 0.0  # type: ignore[arg-type]


@pytest.mark.parametrize("felt", [None, 3.0])
def test_a_tenth_and_what_no_ball_removes_is_allowed(design: Design, felt: float | None) -> None:
    """U/10 + M e + M k_r R_p/r, all of it by hand; a tenth counts from 1 % of Σ m R_p on."""
    plain = replace(design, worst=())
    autobalancer, mass = design.autobalancer, felt or design.autobalancer.requirement.effective_mass
    left = mass * (autobalancer.budget.race_eccentricity + autobalancer.budget.rolling_friction)
    moments = autobalancer.ball_count * autobalancer.ball_mass * autobalancer.pitch_radius
    for imbalance in (0.0, 0.004 * moments, 0.5 * moments):
        assert allowed_imbalance(plain, imbalance, felt) == pytest.approx(
            0.1 * max(imbalance, 0.01 * moments) + left, rel=1e-9
        )


def test_the_worst_friction_widens_it_to_half_the_imbalance_at_most(design: Design) -> None:
    worst: Any = (SimpleNamespace(upright=SimpleNamespace(rolling_friction=1.0)),)
    imbalance = design.autobalancer.static_moment
    assert allowed_imbalance(replace(design, worst=worst), imbalance) == pytest.approx(HALF * imbalance)


def test_an_imbalance_that_balls_hardly_feel_is_balanced_well(design: Design) -> None:
    ratio = abs(design.autobalancer.requirement.plane_ratio)
    for share, well in ((0.0099, True), (0.0101, False)):
        imbalance = replace(design.imbalance, value=share * design.autobalancer.static_moment / ratio)
        assert balanced_well(replace(design, imbalance=imbalance)) is well
