"""The effects of a scene file, and what they must agree on."""

from pathlib import Path

from tests.inputs.scenes import TILTING, read


def test_a_wheel_of_a_tilting_rotor_has_a_place(tmp_path: Path) -> None:
    contact = "[scene.effects]\ngrinding_contact = { plane_offset_mm = 60, contact = 'rigid' }\n[scene.tilting]"
    read_in = read(tmp_path, TILTING.replace("[scene.tilting]", contact)).scene.effects.grinding_contact
    assert read_in is not None and (read_in.plane_offset_mm, read_in.wheel_radius_mm) == (60, None)
