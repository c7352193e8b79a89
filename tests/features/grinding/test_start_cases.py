"""Start cases of grinding: what each ends with, against own equations of steady contact, and which have no answer."""

import cmath
import math
from typing import Any

import pytest

from abu_calc.features.grinding.start_cases import (
    FEW,
    LONGEST,
    STEADY,
    LoadedOutcome,
    LoadedStart,
    loaded_ensemble,
    loaded_start,
)
from abu_calc.simulation.start_cases import Lost, Member, members
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import machine

SPEED = 5800 * math.pi / 30
PLACE = 4e-5, 0.6
"""Of the runout [m, rad]."""


def _pressed(**changes: Any) -> Design:
    """A machine whose wheel never leaves its workpiece, without dry friction unless it is given."""
    contact = {"contact_stiffness_N_per_m": 3e5, "press_force_N": 200.0, "cutting_coefficient": 0.35}
    usual: dict[str, Any] = {
        "wheel__runout_mm": 1e3 * PLACE[0], "wheel__runout_angle_deg": math.degrees(PLACE[1]),
        "autobalancer__rolling_friction_mm": 0.0, "autobalancer__race_eccentricity_mm": 0.01,
        "autobalancer__ball_count": 4, "autobalancer__ball_diameter_mm": 15.875,
        "autobalancer__race_radius_mm": 31.0, "grinding": contact,
    }  # fmt: skip
    return size(machine(**{**usual, **changes}))


def _own_imbalance(design: Design, centre: complex) -> complex:
    """U with which the race's centre has no forward whirl: two linear equations of the axis, for two values of U.

    D_x·X = Ω²U + s·f·N, D_y·Y = −iΩ²U + N, N = −c(Y − iE); forward whirl of the axis (X + iY)/2, and of the centre with
    Δe^{iβ} added.
    """
    mass, sense, friction, stiffness = design.system_mass, -1, 0.35, 3e5
    held = 5.6 + 0.6
    natural, damping = 2 * math.pi * 2.5, 0.5
    dynamic = held * natural**2 + 2j * damping * held * natural * SPEED - mass * SPEED**2
    runout = cmath.rect(*PLACE)

    def whirl(imbalance: complex) -> complex:
        y = (-1j * SPEED**2 * imbalance + 1j * stiffness * runout) / (dynamic + stiffness)
        normal = -stiffness * (y - 1j * runout)
        x = (SPEED**2 * imbalance + sense * friction * normal) / dynamic
        return (x + 1j * y) / 2 + centre

    at_zero, slope = whirl(0j), whirl(1e-4 + 0j) - whirl(0j)
    return -at_zero / slope * 1e-4


@pytest.mark.slow
def test_without_friction_every_start_case_balances_where_own_equations_say() -> None:
    """0.01 mm of race eccentricity and 0.04 mm of runout: imbalance to 1 % of the wheel's, either side of the race."""
    design = _pressed()
    ensemble = loaded_ensemble(design, 0.01)
    assert ensemble is not None and ensemble.count == len(ensemble.outcomes) == 18
    for outcome in ensemble.outcomes:
        own = _own_imbalance(design, cmath.rect(1e-5, outcome.start.member.eccentricity))
        assert abs(outcome.imbalance - own) < 0.01 * 250e-6, outcome.start.name
        assert not outcome.parts and not outcome.stalls and not outcome.swings and outcome.drift < STEADY


@pytest.mark.slow
def test_friction_leaves_each_start_case_another_level() -> None:
    """A friction arm of 5 µm holds balls where they come to rest: levels differ by far more than without friction."""
    levels = []
    for friction in (0.0, 0.005):
        vertical = _pressed(machine__spindle_axis="vertical", autobalancer__rolling_friction_mm=friction,
                            wheel__runout_mm=0.0, autobalancer__race_eccentricity_mm=0.0)  # fmt: skip
        ensemble = loaded_ensemble(vertical, 0.01)
        assert ensemble is not None
        levels.append([outcome.level for outcome in ensemble.pressed("settled")])
    moved = [10 ** (level / 20) for level in levels[1]]
    assert max(moved) > 1.5 * min(moved)
    assert max(levels[0]) < min(levels[1])


@pytest.mark.slow
def test_few_start_cases_are_each_kind_once_with_the_race_off_to_either_side() -> None:
    ensemble = loaded_ensemble(_pressed(), 0.01, most=FEW)
    assert ensemble is not None
    for when, first in (("settled", 0), ("at once", 180)):
        found = [outcome.start.member for outcome in ensemble.outcomes if outcome.start.pressed == when]
        assert [member.name for member in found] == ["bunched", "behind", "spread", "standstill"]
        assert [member.race_centre_deg for member in found] == [first, 180 - first, first, 180 - first]


def test_idle_outcomes_that_are_known_are_not_simulated_again() -> None:
    """An idle start case without an answer has no end to start from: told, never left out."""
    design = _pressed()
    idle = [Lost(member, "no answer", 0) for member in members(design, shares=(1.0,))]
    ensemble = loaded_ensemble(design, 0.01, idle=idle)
    assert ensemble is not None and ensemble.pressed("settled") == ()
    assert [lost.reason for lost in ensemble.without_answer("settled")] == ["idle: no answer"] * 10
    assert len(ensemble.pressed("at once")) == 8


@pytest.mark.slow
def test_a_rigid_contact_that_would_pull_gives_no_answer() -> None:
    contact = {"contact": "rigid", "press_force_N": 10.0}
    ensemble = loaded_ensemble(_pressed(grinding=contact), 0.01, most=FEW)
    assert ensemble is not None and ensemble.outcomes == () and ensemble.count == 8
    assert all("rigid" in lost.reason for lost in ensemble.lost)


def test_a_face_contact_has_no_start_cases() -> None:
    assert loaded_ensemble(_pressed(grinding={"contact": "face"}), 0.01) is None


@pytest.mark.slow
def test_bouncing_that_does_not_settle_is_followed_for_longer() -> None:
    """One start case alone lasts as long as its scene; among others the loud one is run again."""
    design = _pressed(wheel__runout_mm=0.09, wheel__runout_angle_deg=0.0, wheel__imbalance_g_mm=256.0,
                      autobalancer__rolling_friction_mm=0.002,
                      grinding={"contact_stiffness_N_per_m": 4.9e5, "press_force_N": 45.0})  # fmt: skip
    alone = loaded_start(design, LoadedStart(Member("bunched", design.case.drag), "at once"), 0.01)
    assert isinstance(alone, LoadedOutcome) and alone.duration < LONGEST and alone.apart > 0.5
    ensemble = loaded_ensemble(design, 0.01)
    assert ensemble is not None
    loud = max(ensemble.outcomes, key=lambda outcome: outcome.level)
    assert loud.duration == LONGEST and loud.level == pytest.approx(119.6, abs=0.3) and loud.start.pressed == "at once"
