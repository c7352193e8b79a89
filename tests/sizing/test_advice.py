"""Checks of the chosen autobalancer, and the warnings beside them."""

import math
import re

import pytest

from abu_calc.inputs.read_machine import read
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


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("preset", "keys"), [("avtovaz-707-222", 1), ("avtovaz-707-370", 1), ("avtovaz-707-305", 2), ("msh-230", 2)]
)
def test_the_line_for_a_point_mass_holds_when_followed(preset: str, keys: int) -> None:
    """The lengths of the note make a rigid body with the effective mass and the imbalance that the note gives."""
    point = read(preset)
    design = size(point.whole())
    note = next(warning for warning in design.warnings if "point mass" in warning)
    entries = re.findall(r"--set (machine\.\w+)=(\d+)", note)
    assert len(entries) == keys
    rigid = size(point.changed({key: float(value) for key, value in entries}).whole())
    assert rigid.case.body.estimate is not None
    masses = re.search(r"from ([\d.]+) to ([\d.]+) kg", note)
    assert masses is not None
    told = [sized.case.body.effective_mass() for sized in (design, rigid)]
    assert [float(each) for each in masses.groups()] == pytest.approx(told, rel=5e-3)
    imbalances = re.search(r"imbalance falls from ([\d.]+) to ([\d.]+) g·mm", note)
    assert (imbalances is None) == (preset == "msh-230")
    if imbalances is not None:
        assert float(imbalances[2]) == pytest.approx(1e6 * rigid.imbalance.value, rel=5e-3)
    assert not any("point mass" in warning for warning in rigid.warnings)


@pytest.mark.parametrize(("layout", "key"), [("face", "length_mm"), ("angle", "height_mm")])
def test_a_length_that_gives_no_estimate_is_told(layout: str, key: str) -> None:
    design = size(machine(machine__layout=layout, **{f"machine__{key}": 80.0}))
    assert design.case.body.estimate is None
    assert any(f"Alone machine.{key} gives no estimate" in warning for warning in design.warnings)


def test_a_machine_that_is_no_hand_grinder_gets_no_usual_length() -> None:
    note = next(warning for warning in size(machine(machine__mass_kg=60.0)).warnings if "point mass" in warning)
    assert "Specify machine.length_mm" in note and "--set" not in note


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
