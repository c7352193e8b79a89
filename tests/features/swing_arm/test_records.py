"""The swing arm in user units: angles, speeds and lengths by hand, and what is not known."""

import pytest

from abu_calc.features.swing_arm.view import SwingArmRecord
from tests.features.swing_arm.test_verdict import judged


def test_changes_are_those_of_the_next_step_that_are_of_the_arm() -> None:
    entries = ("autobalancer.ball_count=2", "swing_arm.contact_angle_deg=17", "swing_arm.pressing_moment_N_m=40")
    record = SwingArmRecord.of(judged("flat contact").found, entries)
    assert [(each.key, each.old, each.new) for each in record.changes] == [
        ("swing_arm.contact_angle_deg", 8.0, 17.0), ("swing_arm.pressing_moment_N_m", 20.0, 40.0),
    ]  # fmt: skip
    assert record.advice.startswith("change contact_angle_deg = 17 (from 8), pressing_moment_N_m = 40 (from 20), as")


def test_the_arm_of_the_file_comes_back_in_its_units() -> None:
    case = judged("flat contact")
    table, tables = case.machine.whole().swing_arm, case.machine.whole()
    assert table is not None
    record = SwingArmRecord.of(case.found)
    for key in ("contact_angle_deg", "touch_angle_deg", "arm_length_mm", "joint_damping_N_s_per_m",
                "contact_stiffness_N_per_m", "pressing_moment_N_m"):  # fmt: skip
        assert getattr(record, key) == pytest.approx(getattr(table, key)), key
    assert record.wheel_diameter_mm == pytest.approx(tables.wheel.diameter_mm)
    low, high = record.lifted_contact_angles_deg or (90.0, 90.0)
    assert low < 8.0 < high and record.pressed_angle_deg is None  # at 8° the arm does not stand
    assert record.changes == () and "ABU504" in record.advice
