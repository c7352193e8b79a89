"""Velocity levels over the speed range, at handles, and under load."""

import math
import re

import pytest

from abu_calc.foundation.units import from_si
from abu_calc.sizing import size
from abu_calc.sizing.actions import pins
from tests.sizing.machines import PINNED, check_of, machine, ranged


def test_the_level_is_judged_at_the_worst_speed() -> None:
    """What stays does not depend on the speed: the level rises by 20 lg(12000/5000) = 7.6 dB above that of 5000 rpm."""
    design = ranged(105.0)
    assert design.idle.worst.after is not None and design.idle.worst.after < 105.0
    level = check_of(design, "ABU401")
    assert level.status == "fail" and level.value == pytest.approx(design.idle.worst.after + 7.604, abs=0.03)
    assert "12000 rpm" in level.message
    assert "12000 rpm" in check_of(design, "ABU202").message and check_of(design, "ABU202").status == "fail"


def test_the_curve_of_level_against_speed_is_that_of_the_displacement() -> None:
    """L = 20 lg(wΩ/√2/5e-8), by hand; ends and rated speed among its speeds, which ascend."""
    design = ranged(120.0)
    levels = design.speed_levels
    assert levels is not None
    speeds = [from_si(each.speed, "rpm") for each in levels.by_speed]
    assert speeds == sorted(speeds) and {2500, 5000, 12000} <= {round(speed) for speed in speeds}
    residual = design.autobalancer.budget.residual
    for each in levels.by_speed:
        assert each.level_after_db == pytest.approx(
            20 * math.log10(residual * each.speed / math.sqrt(2) / 5e-8), abs=0.02
        )


def test_the_bound_of_friction_is_told_and_decides_nothing() -> None:
    typical = ranged(130.0)
    assert typical.speed_levels is not None
    expected, worst = typical.speed_levels.highest.level_after_db, typical.speed_levels.arranged.level_after_db
    assert worst > expected + 3
    checks = [check_of(ranged(limit), "ABU401") for limit in (worst + 0.1, worst - 0.1, expected + 0.1, expected - 0.1)]
    assert [check.status for check in checks] == ["pass", "pass", "pass", "fail"]
    assert all(f"Bound of friction: {worst:.1f} dB" in check.message for check in checks)


def test_without_friction_and_eccentricity_the_worst_is_the_oval_race() -> None:
    changes = {"autobalancer__rolling_friction_mm": 0.0, "autobalancer__race_eccentricity_mm": 0.0}
    design = size(machine(**changes, **PINNED, wheel__imbalance_g_mm=100.0))
    (worst,) = design.worst
    assert worst.rolling_friction == 0.0
    assert worst.residual == pytest.approx(design.autobalancer.ball_count * design.autobalancer.roundness.lobes)


def test_the_level_names_each_case_with_its_number_and_its_limit() -> None:
    """No handle is named if the file defines none. The bound held vertical is that of a vertical file."""
    chosen = size(machine())
    message = check_of(chosen, "ABU401").message
    assert re.match(r"Wheel plane, 5800 rpm: expected [\d.]+ dB \(limit 109 dB\). Bound of friction: ", message)
    assert "handle" not in message
    same = {key.replace(".", "__"): value for key, value in pins(chosen.autobalancer).items()}
    upright = check_of(size(machine(machine__spindle_axis="vertical", **same)), "ABU401")
    assert upright.status == "pass" and "held vertical" not in upright.message
    level = re.search(r"Bound of friction: ([\d.]+ dB)", upright.message)
    assert level and message.endswith(f"With the spindle held vertical: {level[1]}")
    body = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
    held = size(machine(**body, machine__handle=[{"name": "front", "from_center_of_mass_mm": 100.0}]))
    assert check_of(held, "ABU401").message.startswith('Handle "front", 5800 rpm: expected ')


def test_handles_of_a_rigid_body() -> None:
    """265, 116 and 169 g·mm make 111 dB at the wheel of a point mass, at a front and a rear handle: masses as these."""
    handles = [{"name": "front", "from_center_of_mass_mm": 100.0}, {"name": "rear", "from_center_of_mass_mm": -200.0}]
    design = size(
        machine(
            machine__transverse_inertia_kg_m2=0.1, machine__center_of_mass_to_wheel_mm=200.0, machine__handle=handles
        )
    )
    front, rear = design.idle.places
    mass = 6.2 + design.autobalancer.mass
    assert front.effective_mass == pytest.approx(1 / (1 / mass + 0.2))
    assert rear.effective_mass == pytest.approx(1 / (0.4 - 1 / mass))
    assert front.levels.before > rear.levels.before
    assert design.idle.worst.before == front.levels.before
