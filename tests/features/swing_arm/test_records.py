"""The swing arm in user units: angles, speeds and lengths by hand, and what is not known."""

import math

import pytest

from abu_calc.features.swing_arm.motion import EdgeDamping, ForcedArmMotion, SimulatedArmMotion
from abu_calc.features.swing_arm.records import ArmMotion, SwingArmRecord
from tests.features.swing_arm.test_verdict import judged

RPM = 30 / math.pi


def moved(simulated: SimulatedArmMotion | None) -> ForcedArmMotion:
    return ForcedArmMotion(
        length=0.5, speed=100.0, modulation=0.01, natural_frequency=40.0, decay=2.0, joint_damping=7.0,
        parametric_rates=(-1.8, -2.2),
        perturbation=(3e-3 + 4e-3j, 1e-5 + 0j, 0j), simulated=simulated, tongue=(EdgeDamping(80.0, 1.0, 1.1),),
    )  # fmt: skip


def test_amplitudes_at_the_wheel_are_length_times_angle() -> None:
    """0.5 m · |3 + 4i| mrad = 2500 µm; resonances at ω₀, ω₀/2, ω₀/3; parametric at 2ω₀."""
    record = ArmMotion.of(moved(SimulatedArmMotion((5e-3 + 0j, 2e-5j, 0j), (-1.7, -2.3))))
    assert [each.perturbation_um for each in record.harmonics] == pytest.approx([2500.0, 5.0, 0.0])
    assert [each.simulation_um for each in record.harmonics] == pytest.approx([2500.0, 10.0, 0.0])
    assert [each.resonance_rpm for each in record.harmonics] == pytest.approx([40 * RPM, 20 * RPM, 40 * RPM / 3])
    assert record.parametric_speed_rpm == pytest.approx(80 * RPM) == record.tongue[0].speed_rpm
    assert record.rate_per_s == -2.0 and record.simulated_rates_per_s == (-1.7, -2.3)


def test_without_a_simulation_its_amplitudes_are_not_known() -> None:
    record = ArmMotion.of(moved(None))
    assert record.simulated_rates_per_s is None and [each.simulation_um for each in record.harmonics] == [None] * 3


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
