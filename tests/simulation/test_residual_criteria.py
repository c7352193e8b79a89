"""Criteria of balanced and lingering balls: their edges, and what eccentricity and friction add to a tenth."""

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.run_checks import (
    HALF,
    LINGERING,
    MARGIN,
    SLIPPING,
    allowed_imbalance,
    balances,
    kept_quiet,
    linger,
    slip,
)
from abu_calc.simulation.start_cases import Member, scene_of_member
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
    moments = autobalancer.balls_mass * autobalancer.pitch_radius
    for imbalance in (0.0, 0.004 * moments, 0.5 * moments):
        assert allowed_imbalance(plain, imbalance, felt) == pytest.approx(
            0.1 * max(imbalance, 0.01 * moments) + left, rel=1e-9
        )


def test_the_worst_friction_widens_it_to_half_the_imbalance_at_most(design: Design) -> None:
    worst: Any = (SimpleNamespace(upright=SimpleNamespace(rolling_friction=1.0)),)
    imbalance = design.autobalancer.static_moment
    assert allowed_imbalance(replace(design, worst=worst), imbalance) == pytest.approx(HALF * imbalance)


def test_only_balls_that_nothing_holds_linger() -> None:
    """Where they leave what an eccentric race asks for, they do not; in a still race, where they leave nothing."""
    found = size(read_machine("swing-arm-grinder").whole("size"))  # gravity shakes them
    scene = scene_of_member(found, Member("bunched", found.case.drag, 0.0, math.pi))
    balanced = found.autobalancer.requirement.effective_mass * found.case.race_eccentricity
    tenth = LINGERING * scene.imbalance
    assert linger(found, scene, 0.0) and not linger(found, scene, balanced)
    assert linger(found, scene, balanced + 1.01 * tenth) and not linger(found, scene, balanced + 0.99 * tenth)
    true = replace(scene, effects=tuple(each for each in scene.effects if each.name != "race_eccentricity"))
    assert linger(found, true, balanced) and not linger(found, true, 0.0)
    upright = replace(scene, effects=tuple(each for each in scene.effects if each.name != "gravity"))
    assert not linger(found, upright, 0.0), "friction holds them"
    smooth = tuple(each for each in upright.effects if each.name != "dry_rolling_friction")
    assert linger(found, replace(upright, effects=smooth), 0.0)


def test_a_machine_keeps_quiet_with_a_decibel_to_spare(design: Design) -> None:
    scene = scene_of_member(design, Member("bunched", design.case.drag))
    quiet = scene.quiet_velocity
    assert quiet is not None
    for rise in (0.0, 2.5):
        below = quiet * 10 ** (-(MARGIN + rise) / 20)
        assert kept_quiet(scene, below * (1 - 1e-9), rise) and not kept_quiet(scene, below * (1 + 1e-9), rise)
    assert kept_quiet(replace(scene, quiet_velocity=None), 1e3, 0.0)
