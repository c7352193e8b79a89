"""One machine built to a design: what is made stays, what is given anew is computed anew.

A machine with a motor idles where torque and losses agree, and is judged there.
"""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.foundation.units import from_si, to_si
from abu_calc.simulation.scene_of_design import TIME_CONSTANTS, running_up, scene_of_design
from abu_calc.simulation.simulate import simulate
from abu_calc.simulation.start_cases import members
from abu_calc.sizing import size
from abu_calc.sizing.case import read_case
from abu_calc.sizing.design import built, motor_checks, with_worst
from abu_calc.sizing.vibration import idle_speed_levels
from tests.remembered import recalled
from tests.sizing.machines import PINNED, machine


def test_the_machine_of_the_design_is_built_as_designed() -> None:
    design = size(machine(**PINNED))
    same = built(design, machine(**PINNED))
    assert same.autobalancer == design.autobalancer and same.imbalance == design.imbalance
    assert same.checks == () and same.worst == () and same.speed_levels is None


def test_another_wheel_keeps_the_chosen_balls() -> None:
    design = size(machine())
    other = built(design, machine(wheel__imbalance_g_mm=100.0))
    assert other.imbalance.value == pytest.approx(100e-6)
    chosen, made = design.autobalancer, other.autobalancer
    assert (made.ball_count, made.ball_diameter, made.race_radius) == (
        chosen.ball_count, chosen.ball_diameter, chosen.race_radius,
    )  # fmt: skip
    assert chosen.requirement.required - made.requirement.required == pytest.approx(150e-6)


def test_a_race_made_otherwise_is_that_of_the_file() -> None:
    design = size(machine(**PINNED))
    larger = built(design, machine(**{**PINNED, "autobalancer__race_radius_mm": 30.4}))
    assert larger.autobalancer.race_radius == pytest.approx(30.4e-3)
    assert larger.autobalancer.capacity > design.autobalancer.capacity


def test_worst_arrangements_come_back_on_demand() -> None:
    design = size(machine(**PINNED))
    assert with_worst(built(design, machine(**PINNED))).worst == design.worst != ()
    assert design.system_mass == pytest.approx(5.6 + 0.6 + design.autobalancer.mass)


MACHINES = Path(__file__).resolve().parents[1] / "machines"


def with_motor(*, stall: float = 3.0, no_load: float = 6200.0, inertia: float = 1e-3, **changes: Any) -> Any:
    motor = {"stall_torque_N_m": stall, "no_load_speed_rpm": no_load, "rotor_inertia_kg_m2": inertia}
    return machine(motor=motor, run_up={"time_s": 1.0}, **changes)


VARIETY = [
    with_motor(),
    with_motor(stall=0.5),
    with_motor(stall=10.0, inertia=3e-3),
    with_motor(no_load=5801.0),
    with_motor(no_load=6600.0, wheel__imbalance_g_mm=400.0),
    with_motor(suspension={"model": "hands"}),
    with_motor(suspension={"model": "springs", "natural_frequencies_hz": [6.0], "damping_ratios": [0.6]}),
    with_motor(autobalancer__race_eccentricity_mm=0.02, stall=0.4),
    with_motor(machine__spindle_axis="vertical", machine__mass_kg=15.0),
    with_motor(machine__speed_rpm=3000.0, no_load=3400.0, autobalancer__rolling_drag_per_s=30.0),
    with_motor(machine__speed_rpm=9000.0, no_load=9700.0, inertia=3e-4),
    with_motor(machine__speed_range_rpm=[5000.0, 6500.0]),
]


@pytest.mark.few(1)
@pytest.mark.parametrize("table", [*VARIETY[:4], *(pytest.param(each, marks=pytest.mark.slow) for each in VARIETY[4:])])
@pytest.mark.slow
def test_a_motor_settles_at_the_idle_speed(table: Any) -> None:
    """The speed against an equation of its own, by the simulated amplitude, and against the simulation itself."""
    design = size(table)
    case, scene = design.case, scene_of_design(design, "run-up")
    assert case.idle_speed is not None
    time_constant = running_up(design) / TIME_CONSTANTS
    run = simulate(replace(scene, duration=max(scene.duration, 16 * time_constant)), 0.1)
    motor, swing, speed = table.motor, run.response.axis_amplitude, case.idle_speed
    damping = sum(case.suspension.reaction(axis, speed).imag / speed for axis in (0, 1))
    no_load = to_si(motor.no_load_speed_rpm, "rpm")
    # Power c·|v|² of both axes over the speed: T (1 − Ω/Ω₀) = ½ c Ω w², here solved for Ω.
    balance = motor.stall_torque_N_m / (motor.stall_torque_N_m / no_load + damping * swing**2 / 2)
    assert run.response.final.rotor_speed == pytest.approx(balance, rel=1e-4)
    assert speed == pytest.approx(balance, rel=5e-4)


@pytest.mark.hard
def test_the_refuted_machine_fails_at_its_idle_speed() -> None:
    """It passed at 13993 rpm; at 15107 rpm the level is 109.2 dB and the race goes oval."""
    result = recalled("size", abu_calc.read(MACHINES / "motor-no-load-speed.toml"))
    checks = {check.code: check for check in result.checks}
    assert result.idle_speed_rpm == pytest.approx(15107, abs=1)
    assert {check.code for check in result.checks if check.status == "fail"} == {"ABU304", "ABU401", "ABU702"}
    assert checks["ABU401"].value == pytest.approx(109.2, abs=0.05)
    assert checks["ABU104"].status == "warn"
    assert checks["ABU104"].value == result.idle_speed_rpm
    assert checks["ABU104"].limit == pytest.approx(13993)


def test_the_speeds_judged_hold_the_idle_speed() -> None:
    low, high = read_case(with_motor(no_load=6200.0)).speed_range
    assert (from_si(low, "rpm"), from_si(high, "rpm")) == pytest.approx((5800, 6200), rel=1e-5)
    assert read_case(with_motor(no_load=5801.0)).speed_range == read_case(machine()).speed_range
    within = read_case(with_motor(machine__speed_range_rpm=[5000.0, 6500.0]))
    assert within.speed_range == read_case(machine(machine__speed_range_rpm=[5000.0, 6500.0])).speed_range


def test_losses_pull_the_idle_speed_below_the_rated_one() -> None:
    """A weak motor, a damped suspension and an eccentric race: the file's speed is not reached."""
    table = with_motor(
        stall=0.1, no_load=5800.0, autobalancer__race_eccentricity_mm=0.5,
        suspension={"model": "springs", "natural_frequencies_hz": [20.0], "damping_ratios": [0.5]},
    )  # fmt: skip
    case = read_case(table)
    assert case.idle_speed is not None
    assert case.idle_speed < 0.9 * case.speed
    # T (1 − Ω/Ω₀) = c·Ω·Δ²: both axes move by Δ on dampers c = 2·ζ·ω·M.
    torque, no_load, damping = 0.1, 5800 * math.pi / 30, 2 * 0.5 * 2 * math.pi * 20.0 * (5.6 + 0.6)
    assert case.idle_speed == pytest.approx(torque / (torque / no_load + damping * 0.5e-3**2), rel=1e-9)
    assert case.speed_range == (case.idle_speed, case.speed)
    (check,) = motor_checks(case)
    assert (check.code, check.status, check.bound) == ("ABU104", "warn", "least")
    assert check.limit == pytest.approx(5800)


@pytest.mark.slow
def test_a_motor_runs_up_to_one_speed_in_its_own_time() -> None:
    design = size(with_motor())
    by_motor = [member for member in members(design) if member.by_motor]
    assert by_motor
    assert {member.speed for member in by_motor} == {design.case.idle_speed}
    assert {member.run_up for member in by_motor} == {running_up(design)}
    assert not [member for member in members(design) if member.run_up and not member.by_motor]
    slow = size(with_motor().model_copy(update={"run_up": with_motor().run_up.model_copy(update={"time_s": 10.0})}))
    assert running_up(slow) == running_up(design) == pytest.approx(5e-3 * math.pi / 30 * 6200 / 3)


def test_cutting_slows_a_motor_or_stops_it() -> None:
    grinding = {"press_force_N": 45.0, "cutting_coefficient": 0.35, "contact": "face"}
    torque = 45 * 0.35 * 0.075
    (slowed,) = (one for one in size(with_motor(grinding=grinding)).checks if one.code == "ABU104")
    assert f"slows it to {6200 * (1 - torque / 3):.0f} rpm" in slowed.message
    (stopped,) = (one for one in size(with_motor(stall=1.0, no_load=5800.0, grinding=grinding)).checks
                  if one.code == "ABU104")  # fmt: skip
    assert stopped.status == "warn"
    assert "The cutting torque stops it" in stopped.message


def test_a_rim_too_fast_at_the_no_load_speed_is_told() -> None:
    table = with_motor(machine__speed_rpm=9000.0, no_load=22000.0)
    ((path, text),) = table.contradictions()
    assert path == ("motor", "no_load_speed_rpm")
    assert "173 m/s" in text


@pytest.mark.slow
def test_levels_are_told_at_the_idle_speed_too() -> None:
    """The keys at the rated speed keep their meaning; those at the idle speed are those of a file rated at it."""
    there = abu_calc.read(MACHINES / "motor-no-load-speed.toml")
    result = recalled("size", there)
    idle = result.vibration.at_idle_speed
    assert idle is not None and idle.speed_rpm == result.idle_speed_rpm
    last = (result.vibration.by_speed or ())[-1]
    assert (last.speed_rpm, last.level_after_db) == pytest.approx((idle.speed_rpm, idle.level_after_db), rel=1e-12)
    assert idle.level_after_db > result.vibration.level_after_db
    # Far above resonance the displacement without autobalancer is U/M whatever the speed.
    before = idle.level_before_db - result.vibration.level_before_db
    assert before == pytest.approx(20 * math.log10(idle.speed_rpm / 13993), abs=0.01)
    assert idle.reduction_db == pytest.approx(idle.level_before_db - idle.level_after_db)


@pytest.mark.parametrize("no_load", [None, 5801.0])
def test_no_second_level_where_the_machine_idles_at_its_rated_speed(no_load: float | None) -> None:
    table = machine() if no_load is None else with_motor(no_load=no_load)
    design = size(table)
    assert idle_speed_levels(design.case, design.imbalance.value, design.autobalancer, possible=True) is None


@pytest.mark.slow
def test_the_idle_scene_says_that_it_turns_at_the_rated_speed() -> None:
    there = abu_calc.read(MACHINES / "motor-no-load-speed.toml")
    told = [text for text in abu_calc.simulate(there, duration_s=0.1).warnings if "machine.speed_rpm = 13993" in text]
    assert len(told) == 1 and "15107 rpm" in told[0] and "--scene run-up" in told[0]
    assert not any(
        "The motor idles" in text
        for text in abu_calc.simulate(abu_calc.read("avtovaz-707-222"), duration_s=0.1).warnings
    )
