"""Races, bodies and supports of a scene file."""

from pathlib import Path

import pytest

from abu_calc.inputs.reading.table import Table
from abu_calc.inputs.scene_parts import SceneRace, SceneSwingArm, Tilting, refuse_overlap
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


RACE = {
    "pitch_radius_mm": 30.0,
    "ball_masses_g": [2.0, 2.0],
    "rolling_drag_per_s": 5.0,
    "start_angles_deg": [0.0, 90.0],
}
BEARINGS = {
    "transverse_inertia_kg_m2": 0.01, "polar_inertia_kg_m2": 0.02, "bearing_positions_mm": [100.0, -100.0],
    "bearing_stiffness_N_per_m": [[1.0, 1.0]] * 2, "bearing_damping_N_s_per_m": [[0.0, 0.0]] * 2,
}  # fmt: skip


def test_balls_without_speeds_start_at_rest_in_their_race() -> None:
    race = SceneRace.model_validate(RACE)
    assert race.start_speeds == (0.0, 0.0) == race.own_defaults()["start_speeds_rpm"]
    given = SceneRace.model_validate(RACE | {"start_speeds_rpm": [1.0, 2.0]})
    assert given.start_speeds == (1.0, 2.0) and "start_speeds_rpm" not in given.own_defaults()


@pytest.mark.parametrize(("table", "given", "words"), [
    (SceneRace, RACE | {"start_angles_deg": [0.0]}, "one value for each ball"),
    (SceneRace, RACE | {"start_speeds_rpm": [0.0] * 3}, "one value for each ball"),
    (SceneRace, RACE | {"ball_radius_mm": 30.0}, "larger than their race"),
    (Tilting, BEARINGS | {"bearing_stiffness_N_per_m": [[1.0, 1.0]]}, "for each bearing"),
    (Tilting, BEARINGS | {"polar_inertia_kg_m2": 0.0201}, "no body"),
    (SceneSwingArm, {"cutting": True}, "needs wheel_radius_mm"),
])  # fmt: skip
def test_parts_that_do_not_fit_are_refused(table: type[Table], given: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        table.model_validate(given)


def test_the_inertias_of_a_flat_disc_are_taken() -> None:
    """Its polar moment is twice the transverse one, the most that a body has."""
    assert Tilting.model_validate(BEARINGS).polar_inertia_kg_m2 == 0.02


def test_an_idle_arm_has_no_use_for_its_contact() -> None:
    assert "wheel_radius_mm" in SceneSwingArm().unused()
    assert SceneSwingArm(cutting=True, wheel_radius_mm=100.0).unused() == frozenset()


def test_balls_need_room_to_move() -> None:
    """Six touching balls of r = R/2 fill the race, 2 arcsin(1/2) = 60° each; five have a sixth of it to move in."""
    six, five = (
        SceneRace.model_validate(RACE | {"ball_masses_g": [1.0] * n, "start_angles_deg": [60.0 * k for k in range(n)]})
        for n in (6, 5)
    )
    refuse_overlap(0, five, 15.0)
    with pytest.raises(ValueError, match="fill their race"):
        refuse_overlap(0, six, 15.0)
    with pytest.raises(ValueError, match="balls 1 and 2 overlap"):
        refuse_overlap(0, five, 15.1)
