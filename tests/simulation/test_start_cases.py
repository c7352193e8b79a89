"""Start cases of one machine: which there are, how they are called, and the scenes they make.

Which starts decide, and have to be confirmed by a tighter run.
"""

import math
from dataclasses import replace
from functools import cache

import pytest

from abu_calc.simulation.start_cases import (
    ALIKE,
    OPPOSITE,
    Lost,
    Member,
    StartOutcome,
    Variation,
    deciding,
    idle_speed,
    members,
    scene_of_member,
    turned,
    usual_run_up,
    worse,
)
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.dynamics.scenes import dimensionless
from tests.sizing.machines import PINNED, machine

MOTOR = {"stall_torque_N_m": 3.0, "no_load_speed_rpm": 7000.0, "rotor_inertia_kg_m2": 2e-3}


@cache
def design() -> Design:
    return size(machine(**PINNED))


def test_names_tell_start_speed_and_motor() -> None:
    assert Member("behind", 15.0).name == "behind"
    assert Member("bunched", 15.0, 2.5).name == "run-up in 2.5 s"
    assert Member("spread", 15.0, speed=2300 * math.pi / 30).name == "spread (2300 rpm)"
    assert Member("bunched", 15.0, 0.8, by_motor=True).name == "run-up by the motor"


def test_the_centre_of_the_race_stands_within_one_turn() -> None:
    assert Member("spread", 15.0).race_centre_deg == 180.0
    assert Member("spread", 15.0, eccentricity=ALIKE).race_centre_deg == 0.0
    assert Member("spread", 15.0, eccentricity=-math.pi / 2).race_centre_deg == 270.0


def test_a_race_without_eccentricity_has_one_side() -> None:
    centred = size(machine(**PINNED, autobalancer__race_eccentricity_mm=0.0))
    assert {member.eccentricity for member in members(centred)} == {ALIKE}
    assert {member.eccentricity for member in members(design())} == {ALIKE, OPPOSITE}
    assert len(list(members(design()))) == len(list(members(centred))) + 5  # four starts and the run-up, once more


def test_the_run_up_is_the_files_or_takes_a_second() -> None:
    assert usual_run_up(design()).run_up == 1.0
    assert usual_run_up(size(machine(**PINNED, run_up={"time_s": 0.7}))).run_up == 0.7


def test_a_motor_runs_up_to_its_idle_speed() -> None:
    driven = size(machine(**PINNED, motor=MOTOR))
    usual = usual_run_up(driven)
    assert usual.by_motor and usual.speed == idle_speed(driven.case)
    assert usual.speed is not None and driven.case.speed < usual.speed < 7000 * math.pi / 30
    assert idle_speed(design().case) is None


def test_balls_are_turned_from_their_usual_place() -> None:
    member = Member("bunched", 15.0)
    usual, moved = (scene_of_member(design(), replace(member, turned=angle)).races[0] for angle in (0.0, 4.0))
    turns = [(b - a) % math.tau for a, b in zip(usual.start_angles, moved.start_angles, strict=True)]
    assert turns == pytest.approx([4.0] * 4)


def test_unequal_balls_differ_by_their_share() -> None:
    factors = (1.01, 0.98, 1.0, 1.03)
    varied = Variation(ball_masses=factors)
    equal, unequal = (
        scene_of_member(design(), Member("spread", 15.0, varied=each)).races[0].ball_masses
        for each in (Variation(), varied)
    )
    assert [b / a for a, b in zip(equal, unequal, strict=True)] == pytest.approx(factors)


def test_a_member_has_its_drag_and_speed() -> None:
    scene = scene_of_member(design(), Member("spread", 4.5, speed=400.0))
    assert scene.speed == 400.0 and scene.races[0].drag == 4.5


def test_turning_a_scene_moves_balls_and_thins_oil() -> None:
    scene = dimensionless(3.0, 0.05, 0.05, 0.2, 0.3, (1.0, 2.5), 400.0)
    (race,) = turned(scene, math.pi, 1 / 3).races
    assert race.start_angles == pytest.approx((1.0 - math.pi, 2.5 - math.pi)) and race.drag == pytest.approx(0.1)
    assert turned(scene, 0.0, 1.0) == scene


DRAG = 15.0


def start(level: float, time: float = 0.1, drag: float = DRAG, **changed: float | bool | None) -> StartOutcome:
    """One that balances."""
    one = StartOutcome(Member("bunched", drag), 0.3, time, 0.4, False, 1e-5, level, 0.0, 1e-5, 1e-4)
    return replace(one, **changed)  # type: ignore[arg-type]


def test_the_loudest_and_the_latest_are_confirmed() -> None:
    """The loudest by a run to the end, for what counts is its level there; the latest may end early."""
    found = [start(98.0), start(99.0), start(97.0, 0.9), start(96.0)]
    assert deciding(found, DRAG) == {1: False, 2: True}
    found[1], found[2] = replace(found[1], confirmed=True), replace(found[2], confirmed=True)
    assert deciding(found, DRAG) == {}


def test_the_latest_is_the_last_to_be_quiet() -> None:
    """Neither the old settling time nor the time of rest decides; what is never quiet comes last."""
    found = [start(99.0, confirmed=True), start(97.0, 0.8), start(97.0, settling_time=None, rest_time=None)]
    assert deciding(found, DRAG) == {1: True}
    assert deciding([*found, start(97.0, quiet_time=None)], DRAG) == {3: True}


def test_what_is_as_loud_as_one_confirmed_decides_nothing() -> None:
    """Within what no level is known to."""
    found = [start(99.0, 0.9, confirmed=True), start(99.2), start(99.4)]
    assert deciding(found[:2], DRAG) == {}
    assert deciding(found, DRAG) == {2: False}


def test_what_might_have_become_the_loudest_is_followed_to_the_end() -> None:
    """A run that ended early while its level rose, confirmed for its time or not."""
    found = [start(99.0, 0.9, confirmed=True), start(98.0, rise=3.0), start(98.5, rise=0.5)]
    assert deciding(found, DRAG) == {1: False}
    found[1] = replace(found[1], confirmed=True)
    assert deciding(found, DRAG) == {1: False}
    found[1] = worse(found[1], start(98.2))  # type: ignore[assignment]
    assert found[1].level == 98.2 and found[1].confirmed and deciding(found, DRAG) == {}


def test_what_hangs_decides_before_what_is_loud() -> None:
    """And the worst at the drag given beside the worst of all."""
    hangs = start(90.0, slip=0.9)
    found = [start(99.0, 0.9, confirmed=True), hangs, start(120.0, drag=5.0)]
    assert deciding(found, DRAG) == {1: False, 2: False}


def test_a_tighter_run_that_ends_otherwise_never_makes_it_easier() -> None:
    """The worse of both stands, and a start without an answer stays without."""
    good, bad, lost = start(99.0), start(95.0, imbalance=1.0), Lost(Member("bunched", DRAG), "why", 1)
    assert worse(good, bad).level == worse(bad, good).level == 95.0  # type: ignore[union-attr]
    assert worse(lost, good) is lost and worse(good, lost) is lost
    assert worse(good, start(98.0)) == start(98.0, confirmed=True)
