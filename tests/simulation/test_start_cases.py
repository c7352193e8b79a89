"""Start cases of one machine: which there are, how they are called, and the scenes they make."""

import math
from dataclasses import replace
from functools import cache

import pytest

from abu_calc.simulation.start_cases import (
    ALIKE,
    OPPOSITE,
    Member,
    Variation,
    idle_speed,
    members,
    scene_of_member,
    turned,
    usual_run_up,
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
