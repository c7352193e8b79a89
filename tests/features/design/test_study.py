"""Scenes of a sized machine: which are simulated, and what is said of those that cannot be."""

from abu_calc.features.design.study import merged
from tests.cli.runner import abu, once


def test_all_scenes_a_file_calls_for_are_simulated() -> None:
    document = abu("size", "swing-arm-grinder", "--set", "grinding.press_force_N=45", "--json").document
    scenes = [run["scene"] for run in document["result"]["simulation"]]
    assert scenes == ["idle", "grinding", "swing-arm-idle", "swing-arm-cutting"] == list(document["model"]["scenes"])
    for run in document["result"]["simulation"]:
        assert all(effect["included"] for effect in run["effects"])
        assert run["error_estimate"] <= 0.01
    assert document["model"]["scenes"]["swing-arm-idle"]["states"][:2] == ["arm_angle", "arm_angle'"]


def test_a_scene_that_cannot_be_simulated_is_a_check_not_done() -> None:
    """An arm that does not stand at the work: the design stands, its other scenes too."""
    seen = once("size", "swing-arm-grinder", "--set", "swing_arm.contact_angle_deg=5", "--json")
    document = seen.document
    (check,) = [check for check in document["checks"] if check["code"] == "ABU703"]
    assert seen.status == 1 and check["status"] == "not-done" and "swing-arm-cutting" in check["name"]
    assert [run["scene"] for run in document["result"]["simulation"]] == ["idle", "swing-arm-idle"]


def test_wheel_and_work_that_part_are_a_warning() -> None:
    """c_n E (2MΩ² − …)/… of 90 µm at 0.49 MN/m is 49 N, more than the press of 45; a true wheel does not bounce."""
    warnings = once("size", "avtovaz-707-222", "--json").document["warnings"]
    assert [warning for warning in warnings if warning.startswith("grinding: wheel and workpiece lose contact")]
    warnings = abu("size", "avtovaz-707-222", "--set", "wheel.runout_mm=0.01", "--json").document["warnings"]
    assert not [warning for warning in warnings if "lose contact" in warning]


def test_a_warning_that_begins_a_longer_one_is_merged_with_it() -> None:
    assert merged("a: b", "c.", "a: b. Known to 0.3 dB", "c.", "c") == ("c.", "a: b. Known to 0.3 dB", "c")
