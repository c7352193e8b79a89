"""What the machine does: grinding, run-up, motor and swing arm; keys that play no part are told."""

import pytest

from abu_calc.inputs.duty import STIFFNESS, Grinding, Motor, RunUp, Start, SwingArm


def test_only_a_compliant_contact_has_a_stiffness() -> None:
    """To set another contact takes the stiffness away with it."""
    assert Grinding().unused() == frozenset()
    for contact in ("rigid", "face"):
        assert Grinding.model_validate({"contact": contact}).unused() == {STIFFNESS}
        assert Grinding.displaced_by("contact", contact) == (STIFFNESS,)
    assert Grinding.displaced_by("contact", "compliant") == Grinding.displaced_by("press_force_N", 1.0) == ()


def test_times_of_a_pause_count_only_with_its_speed() -> None:
    assert RunUp().unused() == {"pause_s", "pause_rise_s"}
    assert RunUp(pause_speed_rpm=1100.0).unused() == frozenset()


@pytest.mark.parametrize("table", [Grinding, Motor, SwingArm])
def test_example_defaults_are_keys_with_defaults(table: type[Grinding | Motor | SwingArm]) -> None:
    assert table.example_defaults and table.example_defaults <= table.model_fields.keys()
    assert all(not table.model_fields[key].is_required() for key in table.example_defaults)


@pytest.mark.parametrize(("table", "given"), [
    (Grinding, {"rotation_sense": 0}), (Grinding, {"cutting_coefficient": 1.6}), (Grinding, {"press_force_N": 0.0}),
    (RunUp, {"time_s": 0.0}), (Start, {"angles_deg": []}), (Start, {"angles_deg": [361.0]}),
    (Start, {"angles_deg": [1.0], "speeds_rpm": [0.0, 0.0]}), (Start, {"speeds_rpm": [2e6], "angles_deg": [1.0]}),
    (Motor, {"stall_torque_N_m": -1.0}), (SwingArm, {"contact_angle_deg": 181.0}),
])  # fmt: skip
def test_what_no_machine_does_is_refused(table: type[Grinding], given: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=next(iter(given))):
        table.model_validate(given)


@pytest.mark.parametrize("written", [-1, -1.0, 1, 1.0])
def test_a_sense_may_be_written_with_a_point(written: float) -> None:
    assert Grinding.model_validate({"rotation_sense": written}).rotation_sense == written
