"""Bounds of a swing arm, and the changes of its table that keep them."""

import math
from dataclasses import replace

import pytest

from abu_calc.formulas.swing_arm import Arm, damping_limit, least_pressing_moment, pressed_angle
from abu_calc.foundation.checks import coded
from abu_calc.sizing import size
from abu_calc.sizing.swing_arm import ArmRepair, Way, changes, doubted, up
from tests.sizing.machines import check_of, machine

TABLE = {
    "arm_length_mm": 350.0,
    "moment_of_inertia_kg_m2": 0.62,
    "joint_stiffness_N_per_m": 2000.0,
    "joint_damping_N_s_per_m": 40.0,
    "contact_stiffness_N_per_m": 1e5,
    "cutting_coefficient": 0.45,
    "contact_angle_deg": 90.0,
    "touch_angle_deg": 2.0,
    "pressing_moment_N_m": 40.0,
}
ARM = Arm(0.35, 0.62, 2000.0, 40.0, 1e5, 0.45, 0.075, math.pi / 2, math.radians(2), 40.0)
SPEED, IMBALANCE = 5800 * math.pi / 30, 250e-6


def test_the_autobalancer_adds_its_mass_at_the_end_of_the_arm() -> None:
    design = size(machine(swing_arm=TABLE))
    assert design.swing_arm is not None
    assert design.swing_arm.arm.inertia == pytest.approx(0.62 + design.autobalancer.mass * 0.35**2)


def test_the_contact_is_held_against_the_smaller_of_two_limits() -> None:
    design = size(machine(swing_arm=TABLE))
    bounds, check = design.swing_arm, check_of(design, "ABU501")
    assert bounds is not None and check.status == "pass"
    assert check.limit == pytest.approx(min(bounds.contact_stiffness_limit, bounds.contact_stiffness_limit_exact))
    stiff = size(machine(swing_arm=TABLE | {"contact_stiffness_N_per_m": 1.01 * check.limit}))
    assert check_of(stiff, "ABU501").status == "fail"


def test_an_arm_within_its_bounds_needs_no_change() -> None:
    assert changes(ARM, 0.62, IMBALANCE, SPEED, Way()) == ()


def test_damping_and_moment_are_raised_just_above_their_bounds() -> None:
    weak = replace(ARM, joint_damping=1e-6, pressing_moment=0.0)
    repairs = changes(weak, 0.62, IMBALANCE, SPEED, Way(margin=1.05))
    assert repairs is not None
    new = {repair.key: repair.new for repair in repairs}
    assert set(new) == {"joint_damping_N_s_per_m", "pressing_moment_N_m"}
    mended = replace(weak, joint_damping=new["joint_damping_N_s_per_m"], pressing_moment=new["pressing_moment_N_m"])
    assert 1.05 * least_pressing_moment(weak) <= mended.pressing_moment <= 1.06 * least_pressing_moment(weak)
    angle = pressed_angle(mended)
    assert angle is not None and angle > mended.touch_angle
    # The limit grows with the natural frequency, which is below that of the contact at the worst angle.
    highest = math.sqrt(0.35**2 * (2000.0 + 1.3 * 1e5) / 0.62)
    assert 0 < mended.joint_damping <= 1.06 * damping_limit(weak, IMBALANCE, highest)


def test_a_pivot_that_carries_no_moment_cannot_be_softened() -> None:
    assert changes(replace(ARM, pressing_moment=1e3), 0.62, IMBALANCE, SPEED, Way(joint="softer")) is None


def test_example_data_turn_a_pass_into_a_warning_but_no_failure() -> None:
    checks = coded("ABU501", "pass", "m"), coded("ABU502", "fail", "m")
    assert doubted(checks, ()) == checks
    doubtful = doubted(checks, ("arm_length_mm",))
    assert [check.status for check in doubtful] == ["warn", "fail"]
    assert "example data" in doubtful[0].message and doubtful[1] == checks[1]


@pytest.mark.parametrize(
    ("repair", "step", "reach"),
    [
        (ArmRepair("joint_damping_N_s_per_m", 2.0, 2.5), "+25 %", math.log(1.25)),
        (ArmRepair("joint_damping_N_s_per_m", 0.01, 0.35), "35 times", math.log(35)),
        (ArmRepair("contact_angle_deg", 60.0, 75.0), "+15°", 0.0),
        (ArmRepair("pressing_moment_N_m", 0.0, 20.0), "from 0", 0.0),
    ],
)
def test_a_repair_tells_its_step(repair: ArmRepair, step: str, reach: float) -> None:
    assert f"({step})" in repair.text and repair.reach == pytest.approx(reach)


@pytest.mark.parametrize("value", [1.2341, 0.5, 2046.1, 99.95, 1e-7])
def test_rounding_up_is_never_below_and_never_far_above(value: float) -> None:
    assert value <= up(value) <= 1.01 * value
