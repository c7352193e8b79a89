"""Scenes of a sized machine: which are simulated, and what is said of those that cannot be."""

import pytest

import abu_calc
from abu_calc.features.design.study import merged
from tests.cli.runner import once


@pytest.mark.slow
def test_all_scenes_a_file_calls_for_are_simulated() -> None:
    machine = abu_calc.read("swing-arm-grinder").changed({"grinding.press_force_N": 45.0})
    result = abu_calc.size(machine, starts="none")
    scenes = [run.scene for run in result.simulation]
    model = result.model.to_dict()["scenes"]
    assert scenes == ["idle", "grinding", "swing-arm-idle", "swing-arm-cutting"] == list(model)
    for run in result.simulation:
        assert all(effect.included for effect in run.effects)
        assert run.error_estimate <= 0.01
    assert model["swing-arm-idle"]["states"][:2] == ["arm_angle", "arm_angle'"]


@pytest.mark.hard
def test_a_scene_that_cannot_be_simulated_is_a_check_not_done() -> None:
    """An arm that does not stand at the work: the design stands, its other scenes too."""
    machine = abu_calc.read("swing-arm-grinder").changed({"swing_arm.contact_angle_deg": 5.0})
    result = abu_calc.size(machine, starts="none")
    (check,) = [check for check in result.checks if check.code == "ABU703"]
    assert check.status == "not-done" and "swing-arm-cutting" in check.name and result.status != "pass"
    assert [run.scene for run in result.simulation] == ["idle", "swing-arm-idle"]


@pytest.mark.slow
def test_wheel_and_work_that_part_are_a_warning() -> None:
    """c_n E (2MΩ² − …)/… of 90 µm at 0.49 MN/m is 49 N, more than the press of 45; a true wheel does not bounce."""
    warnings = once("size", "avtovaz-707-222", "--json").document["warnings"]
    assert [warning for warning in warnings if warning.startswith("grinding: wheel and workpiece lose contact")]
    true = abu_calc.read("avtovaz-707-222").changed({"wheel.runout_mm": 0.01})
    warnings = abu_calc.size(true, starts="none").warnings
    assert not [warning for warning in warnings if "lose contact" in warning]


def test_a_warning_that_begins_a_longer_one_is_merged_with_it() -> None:
    assert merged("a: b", "c.", "a: b. Known to 0.3 dB", "c.", "c") == ("c.", "a: b. Known to 0.3 dB", "c")
