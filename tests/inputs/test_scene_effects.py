"""The effects of a scene file, and what they must agree on."""

from pathlib import Path

import pytest

from abu_calc.inputs.scene_effects import Effects
from tests.inputs.scenes import TILTING, read


def test_a_wheel_of_a_tilting_rotor_has_a_place(tmp_path: Path) -> None:
    contact = "[scene.effects]\ngrinding_contact = { plane_offset_mm = 60, contact = 'rigid' }\n[scene.tilting]"
    read_in = read(tmp_path, TILTING.replace("[scene.tilting]", contact)).scene.effects.grinding_contact
    assert read_in is not None and (read_in.plane_offset_mm, read_in.wheel_radius_mm) == (60, None)


def test_effects_are_on_by_their_tables() -> None:
    effects = Effects.model_validate({"motor": {}, "gravity": {}, "ball_contact": {"ball_radius_mm": 8.0}})
    assert effects.names == ("gravity", "ball_contact", "motor")
    assert effects.ball_radii_mm == {"ball_contact": 8.0} and set(effects.rotor_inertias) == {"motor"}
    assert Effects().names == ()


@pytest.mark.parametrize(("effects", "words"), [
    ({"ball_contact": {"ball_radius_mm": 8.0}, "dry_rolling_friction": {"lever_arm_mm": 0.002, "ball_radius_mm": 7.9}},
     "one radius"),
    ({"run_up": {"time_s": 1.0, "rotor_inertia_kg_m2": 1e-3}, "motor": {}}, "one moment of inertia"),
    ({"run_up": {}}, "no time"), ({"transverse_motion": {"groove_radius_mm": 8.0, "ball_radius_mm": 8.0}}, "not fit"),
    ({"ball_contact": {"ball_radius_mm": 8.0, "restitution": 1.1}}, "restitution"), ({"wind": {}}, "wind"),
])  # fmt: skip
def test_effects_that_contradict_are_refused(effects: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Effects.model_validate(effects)


def test_one_inertia_told_twice_is_one() -> None:
    run_up = {"run_down_s": 1.0, "rotor_inertia_kg_m2": 2e-3}
    assert Effects.model_validate({"run_up": run_up, "motor": {}}).rotor_inertias == {"run_up": 2e-3, "motor": 2e-3}
