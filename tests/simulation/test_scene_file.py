"""Scene files: what is read, and every way to get one wrong."""

import re
from pathlib import Path

import pytest

from abu_calc.dynamics.supports.swing_arm import SceneSwingArm
from abu_calc.dynamics.supports.tilting import Tilting
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.errors import SpecErrors
from abu_calc.inputs.reading.table import all_tables
from abu_calc.simulation.scene_file import (
    Effects,
    SceneDescription,
    SceneFile,
    read_any,
    read_scene,
)
from tests.inputs.samples import BASIC
from tests.inputs.scenes import ARM, PLANAR, SCENE, TILTING, read, refused

SUPPORT, MASS, STIFFNESS = 'support = "planar"', "mass_kg = 1.0", "stiffness_N_per_m = [1.0, 1.0]"
DAMPING, SPEED, LONG = "damping_N_s_per_m = [0.02, 0.02]", "speed_rpm = 19.0985931710274", "duration_s = 700.0"
RACE, PITCH, BALLS = "[[scene.race]]", "pitch_radius_mm = 1000.0", "ball_masses_g = [50.0, 50.0]"
DRAG, ANGLES, IMBALANCE = "rolling_drag_per_s = 0.01", "start_angles_deg = [90.0, -90.0]", "imbalance_g_mm = 10000.0"


def effect(text: str) -> str:
    return f"[scene.effects]\n{text}\n{RACE}"


# What is replaced in the basic scene, by what, the line and key that must be named, words that must be told.
CASES: list[tuple[str, str, int | None, str, tuple[str, ...]]] = [
    # not TOML, unknown names
    (MASS, "mass_kg = 1,0", 4, "scene.mass_kg", ("a comma in a number", "write 1.0")),
    (MASS, "mass_g = 1000", 4, "scene.mass_g", ("unknown key", "mass_kg")),
    (MASS, "mas_kg = 1", 4, "scene.mas_kg", ("nearest known key is mass_kg",)),
    (SPEED, SPEED + "\npitch_radius_mm = 3", 8, "scene.pitch_radius_mm", ("belongs in [[scene.race]]",)),
    (DRAG, DRAG + "\nspeed_rpm = 3", 16, "scene.race[0].speed_rpm", ("belongs in [scene]",)),
    (DRAG, DRAG + "\nqqq = 3", 16, "scene.race[0].qqq", ("known keys of [[scene.race]]", "start_speeds_rpm")),
    ("# two balls", "mass_kg = 3 #", 1, "mass_kg", ("belongs in [scene]",)),
    ("# two balls", "[effects]\n#", 1, "effects", ("unknown table", "scene")),
    (RACE, "[scene.race]", 12, "scene.race", ("two brackets",)),
    (RACE, "[[scene.races]]", 12, "scene.races", ("unknown key", "race")),
    (RACE, effect("gravitation = {}"), 13, "scene.effects.gravitation", ("gravity",)),
    (RACE, effect("gravity = { g = 9.81 }"), 13, "scene.effects.gravity.g", ("unknown key",)),
    (RACE, effect("gravity = true"), 13, "scene.effects.gravity", ("a table is expected",)),
    # wrong kinds and lengths
    (MASS, 'mass_kg = "1.0"', 4, "scene.mass_kg", ("without quotes",)),
    (MASS, "mass_kg = nan", 4, "scene.mass_kg", ("finite",)),
    (STIFFNESS, "stiffness_N_per_m = 1.0", 5, "scene.stiffness_N_per_m", ("list", "[1530.0, 1530.0]")),
    (STIFFNESS, "stiffness_N_per_m = [1.0]", 5, "scene.stiffness_N_per_m", ("too few", "at least 2")),
    (STIFFNESS, "stiffness_N_per_m = [1.0, inf]", 5, "scene.stiffness_N_per_m[1]", ("finite",)),
    (STIFFNESS, "stiffness_N_per_m = [1.0, -1.0]", 5, "scene.stiffness_N_per_m[1]", ("at least 0 N/m",)),
    ("rolling_inertia = false", "rolling_inertia = 0", 10, "scene.rolling_inertia", ("true or false",)),
    (SUPPORT, 'support = "plane"', 3, "scene.support", ('nearest is "planar"',)),
    (LONG, LONG + "\ninitial = 5", 10, "scene.initial", ("a table is expected",)),
    (LONG, LONG + "\ninitial = { x = 1 }", 10, "scene.initial.x", ("x_mm",)),
    # out of bounds
    (MASS, "mass_kg = 0", 4, "scene.mass_kg", ("above 0 kg",)),
    (SPEED, "speed_rpm = 0", 7, "scene.speed_rpm", ("above 0 rpm",)),
    (SPEED, "speed_rpm = -100", 7, "scene.speed_rpm", ("above 0 rpm",)),
    (LONG, "duration_s = 3.0", 9, "scene.duration_s", ("one revolution", "3.14159")),
    (IMBALANCE, "imbalance_g_mm = -1", 8, "scene.imbalance_g_mm", ("at least 0",)),
    (PITCH, "pitch_radius_mm = 0", 13, "scene.race[0].pitch_radius_mm", ("above 0 mm",)),
    (DRAG, "rolling_drag_per_s = -0.01", 15, "scene.race[0].rolling_drag_per_s", ("at least 0",)),
    (BALLS, "ball_masses_g = [50.0, 0.0]", 14, "scene.race[0].ball_masses_g[1]", ("above 0 g",)),
    (BALLS, "ball_masses_g = []", 16, "scene.race[0].start_angles_deg", ("one value for each ball", "allowed: 0")),
    (BALLS, f"ball_masses_g = {[1.0] * 101}", 14, "scene.race[0].ball_masses_g", ("too many", "at most 100")),
    # missing
    (SPEED + "\n", "", 2, "scene.speed_rpm", ("missing", "add speed_rpm")),
    (IMBALANCE + "\n", "", 2, "scene.imbalance_g_mm", ("missing",)),
    (DRAG + "\n", "", 12, "scene.race[0].rolling_drag_per_s", ("missing",)),
    (f"{RACE}\n{PITCH}\n{BALLS}\n{DRAG}\n{ANGLES}\n", "", 2, "scene.race", ("missing", "add [[scene.race]]")),
    # rules between keys
    (MASS + "\n", "", 2, "scene.mass_kg", ('"planar" needs mass_kg', "add mass_kg = …, such as 1.0")),
    (STIFFNESS + "\n", "", 2, "scene.stiffness_N_per_m", ("needs stiffness_N_per_m",)),
    (DAMPING + "\n", "", 2, "scene.damping_N_s_per_m", ("needs damping_N_s_per_m",)),
    (SUPPORT, 'support = "tilting"', 2, "scene.tilting", ("needs tilting", "[scene.tilting]")),
    (SUPPORT, 'support = "swing-arm"', 2, "scene.swing_arm", ("needs swing_arm", "[scene.swing_arm]")),
    (RACE, f"[scene.swing_arm]\n{RACE}", 12, "scene.swing_arm", ("takes no swing_arm",)),
    (ANGLES, "start_angles_deg = [90.0]", 16, "scene.race[0].start_angles_deg", ("each ball", "found 1; allowed: 2")),
    (ANGLES, ANGLES + "\nstart_speeds_rpm = [1]", 17, "scene.race[0].start_speeds_rpm", ("found 1; allowed: 2",)),
    (ANGLES, ANGLES + "\nplane_offset_mm = 5", 17, "scene.race[0].plane_offset_mm", ("tilting",)),
    (RACE, effect("ball_contact = { ball_radius_mm = 1000 }"), 13, "scene.effects.ball_contact.ball_radius_mm",
     ("larger than race[0]", "below pitch_radius_mm")),
    (ANGLES, "start_angles_deg = [90.0, 90.5]\n[scene.effects]\nball_contact = { ball_radius_mm = 8 }", 16,
     "scene.race[0].start_angles_deg", ("balls 1 and 2 overlap", "0.5° apart", "at least 0.916742°")),
    (RACE, effect("ball_contact = { ball_radius_mm = 8, restitution = 1.1 }"), 13,
     "scene.effects.ball_contact.restitution", ("at most 1",)),
    (RACE, effect("dry_rolling_friction = { lever_arm_mm = 1, ball_radius_mm = 7 }\nball_contact = "
                  "{ ball_radius_mm = 8 }"), 14, "scene.effects.ball_contact.ball_radius_mm", ("one radius",)),
    (RACE, effect("transverse_motion = { groove_radius_mm = 8, ball_radius_mm = 8 }"), 13,
     "scene.effects.transverse_motion.groove_radius_mm", ("does not fit",)),
    (RACE, effect("run_up = {}"), 13, "scene.effects.run_up.time_s", ("no time",)),
    (RACE, effect("motor = { no_load_speed_rpm = 10 }"), 13, "scene.effects.motor.no_load_speed_rpm",
     ("cannot reach", "19.0986")),
    (RACE, effect("grinding_contact = { plane_offset_mm = 5 }"), 13, "scene.effects.grinding_contact.plane_offset_mm",
     ("places along the spindle",)),
    (RACE, effect("grinding_contact = { wheel_radius_mm = 0 }"), 13, "scene.effects.grinding_contact.wheel_radius_mm",
     ("above 0 mm",)),
    (RACE, effect("run_up = { time_s = 400, run_down_s = 301 }"), 9, "scene.duration_s", ("at least 701 s",)),
    (ANGLES, ANGLES + "\ncorrector = 'rollers'", 17, "scene.race[0].corrector", ('nearest is "roller"',)),
    (ANGLES, ANGLES + "\nball_radius_mm = 1000", 17, "scene.race[0].ball_radius_mm", ("larger than their race",)),
    (ANGLES, ANGLES + "\nball_radius_mm = 0", 17, "scene.race[0].ball_radius_mm", ("above 0 mm",)),
    (ANGLES, ANGLES + "\nball_radius_mm = 7\n[scene.effects]\nball_contact = { ball_radius_mm = 8 }", 17,
     "scene.race[0].ball_radius_mm", ("one radius", "8 mm in ball_contact")),
    (RACE, "[scene.body]\nmass_kg = 0.5\n" + RACE, 12, "scene.body.stiffness_N_per_m", ("missing",)),
    (RACE, "[scene.body]\nmass_kg = 0\nstiffness_N_per_m = [1, 1]\ndamping_N_s_per_m = [0, 0]\n" + RACE, 13,
     "scene.body.mass_kg", ("above 0 kg",)),
    (ANGLES, "start_angles_deg = [0, 180]\n[scene.effects]\nball_contact = { ball_radius_mm = 999.9999999999999 }",
     14, "scene.race[0].ball_masses_g", ("fill their race", "at most 1")),
]  # fmt: skip

TILTING_CASES: list[tuple[str, str, str, tuple[str, ...]]] = [
    ("polar_inertia_kg_m2 = 0.00124", "polar_inertia_kg_m2 = 0.03", "polar_inertia_kg_m2", ("at most twice", "0.0276")),
    ("[110.0, -150.0]", "[110.0]", "bearing_stiffness_N_per_m", ("each bearing", "allowed: 1")),
    ("[110.0, -150.0]", "[]", "bearing_positions_mm", ("too few",)),
    ("[[5.375, 3.95], [5.375, 3.95]]", "[[5.375, 3.95]]", "bearing_damping_N_s_per_m", ("found 1 of them",)),
    ("[[5.375, 3.95], [5.375, 3.95]]", "[5.375, 3.95]", "bearing_damping_N_s_per_m[0]", ("a list is expected",)),
    ("[[5.375, 3.95], [5.375, 3.95]]", "[[5.375, 3.95], [5.375]]", "bearing_damping_N_s_per_m[1]", ("too few",)),
    (
        "[[5.375, 3.95], [5.375, 3.95]]",
        "[[5.375, 3.95], [5.375, -1]]",
        "bearing_damping_N_s_per_m[1][1]",
        ("at least",),
    ),
    ("{ magnitude_rad = 6.8e-5, angle_deg = 0.0 }", "{}", "couple_imbalance_angle.magnitude_rad", ("missing",)),
    ("ball_tilt_inertia = true", 'ball_tilt_inertia = "yes"', "ball_tilt_inertia", ("true or false",)),
]


@pytest.mark.parametrize(("old", "new", "line", "key", "words"), CASES, ids=[f"{c[3]}: {c[1][:40]}" for c in CASES])
def test_a_wrong_scene_is_told_with_line_key_and_remedy(
    tmp_path: Path, old: str, new: str, line: int | None, key: str, words: tuple[str, ...]
) -> None:
    assert SCENE.count(old) == 1
    error = refused(tmp_path, SCENE.replace(old, new))
    first = error.errors[0] if isinstance(error, SpecErrors) else error
    assert (first.place.line, first.place.key) == (line, key), str(error)
    assert first.place.file == str(tmp_path / "scene.toml")
    assert all(word.casefold() in str(first).casefold() for word in words), str(error)


@pytest.mark.parametrize(("old", "new", "key", "words"), TILTING_CASES, ids=[case[1][:50] for case in TILTING_CASES])
def test_a_wrong_tilting_support(tmp_path: Path, old: str, new: str, key: str, words: tuple[str, ...]) -> None:
    assert TILTING.count(old) == 1
    error = refused(tmp_path, TILTING.replace(old, new))
    assert error.place.key == f"scene.tilting.{key}", str(error)
    assert all(word in str(error) for word in words), str(error)


def test_other_supports_keep_to_their_own_keys(tmp_path: Path) -> None:
    error = refused(tmp_path, TILTING.replace("duration_s", "stiffness_N_per_m = [1.0, 1.0]\nduration_s"))
    assert error.place.key == "scene.stiffness_N_per_m" and "takes no" in str(error)
    error = refused(tmp_path, ARM.replace("wheel_radius_mm = 115.0\n", ""))
    assert error.place.key == "scene.swing_arm.wheel_radius_mm" and "cutting" in str(error)
    assert read(tmp_path, ARM.replace("wheel_radius_mm = 115.0\ncutting = true", "")).scene.swing_arm is not None


BODY = "[scene.body]\nmass_kg = 0.5\nstiffness_N_per_m = [1, 1]\ndamping_N_s_per_m = [0, 0]\n"

FOREIGN: list[tuple[str, str, str, str, str]] = [
    (TILTING, "[scene.tilting]", BODY + "[scene.tilting]", "body", "takes no body"),
    (ARM, "[scene.swing_arm]", BODY + "[scene.swing_arm]", "body", "takes no body"),
    (ARM, "duration_s = 12", "duration_s = 12\ninitial = { vx_mm_per_s = 1 }", "initial.vx_mm_per_s", "at rest"),
    (ARM, "[scene.swing_arm]", "[scene.effects.grinding_contact]\n[scene.swing_arm]", "effects.grinding_contact",
     "contact with the work"),
    (ARM, "[scene.swing_arm]", "[scene.effects.motor]\nrotor_inertia_kg_m2 = 0.45\n[scene.swing_arm]",
     "effects.motor.rotor_inertia_kg_m2", "more inertia than the arm"),
    (ARM, "pitch_radius_mm = 30", "pitch_radius_mm = 30\nplane_offset_mm = 1", "race[0].plane_offset_mm", "no places"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "old", "new", "key", "words"), FOREIGN, ids=[case[3] for case in FOREIGN])
def test_a_support_refuses_what_belongs_to_another(
    tmp_path: Path, text: str, old: str, new: str, key: str, words: str
) -> None:
    assert text.count(old) == 1
    error = refused(tmp_path, text.replace(old, new))
    assert error.place.key == f"scene.{key}" and words in str(error)


def test_every_table_and_key_of_the_published_format_is_known_and_read(tmp_path: Path) -> None:
    """And of the tables that it has it lacks no key but one; other tables have their examples in the template."""
    text = PLANAR + TILTING + ARM
    seen = set(re.findall(r"^ *(\w+) =", text, re.MULTILINE)) | set(re.findall(r"[{,] (\w+) =", text))
    seen |= set(re.findall(r"^\[+(?:\w+\.)*(\w+)\]", text, re.MULTILINE))
    tables = dict(all_tables(SceneFile))
    keys = {key for path, table in tables.items() if path[-1] in seen for key in table.model_fields}
    assert keys - seen - {path[-1] for path in tables} == {"run_down_s"}
    assert seen - keys == {"scene"}
    names = read(tmp_path, PLANAR).scene.effects.names
    assert names == tuple(name for name in Effects.model_fields if name in seen) and len(names) == 8
    assert len(read(tmp_path, TILTING).scene.race) == 2
    assert read(tmp_path, ARM).scene.mass_kg is None


def test_defaults_in_force_are_told(tmp_path: Path) -> None:
    told = dict(read(tmp_path, SCENE).defaults_used)
    assert told["scene.race[0].start_speeds_rpm"] == (0.0, 0.0)
    assert told["scene.imbalance_angle_deg"] == 0.0 and told["scene.initial.vy_mm_per_s"] == 0.0
    assert dict(read(tmp_path, PLANAR).defaults_used) == {}


def test_a_key_that_plays_no_part_is_told(tmp_path: Path) -> None:
    """The stiffness of a contact that is none; the file is right otherwise."""
    rigid = effect('grinding_contact = { contact = "rigid", contact_stiffness_N_per_m = 1e5 }')
    loaded = read(tmp_path, SCENE.replace(RACE, rigid))
    assert loaded.warnings == ("scene.effects.grinding_contact.contact_stiffness_N_per_m plays no part beside the "
                               "other keys.",)  # fmt: skip
    assert read(tmp_path, SCENE.replace(RACE, rigid.replace("rigid", "compliant"))).warnings == ()


def test_overrides_are_told_by_their_option(tmp_path: Path) -> None:
    changed = read(tmp_path, SCENE, ["scene.race[0].start_angles_deg=[10, 20]", "scene.support=planar"])
    assert changed.scene.race[0].start_angles_deg == (10, 20)
    error = refused(tmp_path, SCENE, ["scene.race.0.start_angles_deg=[10]"])
    assert error.place.key == "--set scene.race[0].start_angles_deg"
    assert refused(tmp_path, SCENE, ["scene.speed=3"]).place.key == "--set scene.speed"


def test_either_kind_of_file_is_read_by_its_tables(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / "machine.toml").write_text(BASIC, encoding="utf-8")
    assert isinstance(read_any(str(tmp_path / "scene.toml")), SceneDescription)
    assert isinstance(read_any(str(tmp_path / "machine.toml")), Machine)
    assert isinstance(read_any("msh-230"), Machine)
    with pytest.raises(InputError, match="a machine, not a scene"):
        read_scene("msh-230")
    with pytest.raises(InputError, match="table \\[scene\\] is missing"):
        read(tmp_path, "[other]\n")


# Races and supports


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


BEARINGS = {
    "transverse_inertia_kg_m2": 0.01, "polar_inertia_kg_m2": 0.02, "bearing_positions_mm": [100.0, -100.0],
    "bearing_stiffness_N_per_m": [[1.0, 1.0]] * 2, "bearing_damping_N_s_per_m": [[0.0, 0.0]] * 2,
}  # fmt: skip


def test_the_inertias_of_a_flat_disc_are_taken() -> None:
    """Its polar moment is twice the transverse one, the most that a body has."""
    assert Tilting.model_validate(BEARINGS).polar_inertia_kg_m2 == 0.02


def test_an_idle_arm_has_no_use_for_its_contact() -> None:
    assert "wheel_radius_mm" in SceneSwingArm().unused()
    assert SceneSwingArm(cutting=True, wheel_radius_mm=100.0).unused() == frozenset()


# Effects, and what they must agree on


def test_a_wheel_of_a_tilting_rotor_has_a_place(tmp_path: Path) -> None:
    contact = "[scene.effects]\ngrinding_contact = { plane_offset_mm = 60, contact = 'rigid' }\n[scene.tilting]"
    read_in = read(tmp_path, TILTING.replace("[scene.tilting]", contact)).scene.effects.grinding_contact
    assert read_in is not None and (read_in.plane_offset_mm, read_in.wheel_radius_mm) == (60, None)


def test_effects_are_on_by_their_tables() -> None:
    effects = Effects.model_validate({"motor": {}, "gravity": {}, "ball_contact": {"ball_radius_mm": 8.0}})
    assert effects.names == ("gravity", "ball_contact", "motor")
    assert effects.ball_radii == {"ball_contact": 0.008} and set(effects.rotor_inertias) == {"motor"}
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
    with pytest.raises(ValueError, match="one moment of inertia"):
        Effects.model_validate({"run_up": run_up | {"rotor_inertia_kg_m2": 1e-3}, "motor": {}})
