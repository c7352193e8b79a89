"""Races, bodies and supports of a scene file."""

from pathlib import Path

from tests.inputs.scenes import SCENE, read, refused


def test_balls_that_touch_or_have_no_size_are_read(tmp_path: Path) -> None:
    """Two balls of radius 707.1 mm on a pitch radius of 1 m span 90° each: at ±45° they touch."""
    near = SCENE.replace("[90.0, -90.0]", "[45.0, -45.0]")
    size = "[scene.effects]\nball_contact = { ball_radius_mm = 707.10678 }\n"
    assert read(tmp_path, near + size).scene.effects.names == ("ball_contact",)
    error = refused(tmp_path, near.replace("-45.0", "-44.99") + size)
    assert error.place.key == "scene.race[0].start_angles_deg"
    assert read(tmp_path, SCENE.replace("-90.0", "90.0")).scene.effects.names == ()
    third = near.replace("[50.0, 50.0]", "[50, 50, 50]").replace("[45.0, -45.0]", "[45.0, -45.0, 359.0]")
    assert "balls 2 and 3 overlap" in str(refused(tmp_path, third + size))
