"""Checks of the chosen autobalancer, and the warnings beside them."""

import math

import pytest

from abu_calc.sizing import size
from tests.sizing.machines import check_of, machine


def test_a_race_off_the_wheels_plane_needs_the_rigid_body() -> None:
    check = next(c for c in size(machine(autobalancer__plane_offset_mm=-30.0)).checks if c.code == "ABU205")
    assert check.status == "not-done" and check.value is None
    rigid = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
    design = size(machine(autobalancer__plane_offset_mm=-30.0, **rigid))
    check = next(c for c in design.checks if c.code == "ABU205")
    assert check.status in ("pass", "fail") and check.value and check.value > 0


def test_what_is_uncertain_is_warned_of() -> None:
    plain = size(machine()).warnings
    assert any("point mass" in warning for warning in plain) and any("no [grinding]" in warning for warning in plain)
    rigid = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
    assert not any("point mass" in warning for warning in size(machine(**rigid)).warnings)


@pytest.mark.parametrize(("power", "status"), [(820.0, "pass"), (818.0, "fail")])
def test_cutting_takes_force_times_rim_speed(power: float, status: str) -> None:
    """0.4 · 45 N · 0.075 m · 5800 rpm = 819.96 W."""
    grinding = {"contact": "rigid", "cutting_coefficient": 0.4, "press_force_N": 45.0}
    check = check_of(size(machine(machine__power_W=power, grinding=grinding)), "ABU403")
    assert check.status == status
    assert check.value == pytest.approx(0.4 * 45 * 0.075 * 5800 * math.pi / 30)


def test_power_is_not_checked_without_a_contact() -> None:
    assert "ABU403" not in {check.code for check in size(machine(machine__power_W=800.0)).checks}


def test_capacity_is_checked_with_its_margin() -> None:
    design = size(machine(autobalancer__capacity_margin=1.5))
    check, best = check_of(design, "ABU201"), design.autobalancer
    assert check.limit == pytest.approx(1.5e6 * best.requirement.required)
    assert check.value == pytest.approx(1e6 * best.capacity) and check.bound == "least"
