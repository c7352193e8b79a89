"""Numbers that are read but unusual: what is warned of, where it stands, which unit was meant."""

import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from pydantic.fields import FieldInfo

from abu_calc.foundation.validity import bounded
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import read_file, read_machine
from abu_calc.inputs.reading import sources as presets
from abu_calc.inputs.reading.schema import schema_of, template_of
from abu_calc.inputs.reading.table import Table, Usual, all_tables, usual_of
from abu_calc.inputs.reading.text import unit_suffix
from abu_calc.simulation.scene_file import SceneFile
from tests.inputs import scenes
from tests.inputs.samples import BASIC, read, refused

FREE = {
    "Start.angles_deg", "Start.speeds_rpm",  # wherever they lie
    "Oil.cold_temperature_C",  # above and below zero
    "Identified.rolling_drag_per_s", "Identified.rolling_friction_mm",  # as measured
    "Identified.race_eccentricity_mm",
    "Wheel.runout_angle_deg", "Wheel.measured_axes", "MeasuredAfter.measured_axes",
    "Grinding.rotation_sense", "Tilting.ball_tilt_inertia",
    "Sweep.least_share", "Sweep.runs", "Sweep.seed", "Optimise.seed", "Optimise.share", "Sweep.time_limit_s",
    "TypeTest.orientations", "TypeTest.runs", "TypeTest.operators",
}  # fmt: skip
"""Numbers of which every permitted one is usual."""
RIGID = ("machine.center_of_mass_to_wheel_mm=200", "machine.transverse_inertia_kg_m2=0.1")
ARM = "swing_arm={arm_length_mm=350, moment_of_inertia_kg_m2=0.6, joint_stiffness_N_per_m=2000, joint_damping_N_s_per_m=40, contact_stiffness_N_per_m=1e6, cutting_coefficient=0.4, contact_angle_deg=90, touch_angle_deg=2, pressing_moment_N_m=20}"  # noqa: E501
MOTOR = "motor={stall_torque_N_m=3, no_load_speed_rpm=6000, rotor_inertia_kg_m2=2e-3}"


def lines(folder: Path, *overrides: str, text: str = BASIC) -> list[str]:
    """The warnings of a machine with entries overridden, but for notes on the overrides themselves."""
    return [line for line in read(folder, text, overrides).warnings if not line.startswith("--set")]


# What is asked about: the entry, and the units thought of with the value in each, by factors written down here.
MISTAKES = [
    ("machine.speed_rpm=97", ["Hz (5820 rpm)", "rad/s (926.3 rpm)"]),
    ("machine.speed_rpm=607", ["rad/s (5796 rpm)", "Hz (36420 rpm)"]),
    ("machine.speed_rpm=50", ["Hz (3000 rpm)"]),
    ("machine.speed_rpm=200", ["Hz (12000 rpm)", "rad/s (1910 rpm)"]),
    ("machine.mass_kg=5600", ["g (5.6 kg)"]),
    ("machine.mass_kg=0.0056", ["t (5.6 kg)"]),
    ("machine.power_W=1.2", ["kW (1200 W)", "hp (894.8 W)"]),
    ("machine.background_level_db=2.5", ["m/s² (98.31 dB)", "mm/s (93.98 dB)"]),
    ("wheel.mass_kg=600", ["g (0.6 kg)"]),
    ("wheel.runout_mm=4e-5", ["m (0.04 mm)", "inch (0.001016 mm)"]),
    ("wheel.runout_mm=5", ["µm (0.005 mm)"]),
    ("wheel.runout_tir_mm=8", ["µm (0.008 mm)"]),
    ("wheel.imbalance_g_mm=0.15", ["g·m (150 g·mm)", "kg·mm (150 g·mm)"]),
    ("wheel.imbalance_g_mm=1.5", ["g·m (1500 g·mm)", "kg·mm (1500 g·mm)", "g·cm (15 g·mm)"]),
    ("wheel.imbalance_g_mm=1.5e-4", ["kg·m (150 g·mm)"]),
    ("wheel.imbalance_g_mm=150000", ["mg·mm (150 g·mm)"]),
    ("wheel.measured_level_db=6.5", ["m/s² (106.6 dB)", "mm/s (102.3 dB)"]),
    ("wheel.measured_level_db=[6.5, 7.5]", ["m/s² (106.6, 107.9 dB)", "mm/s (102.3, 103.5 dB)"]),
    ("wheel.measured_level_db=145", ["dB re 1e-9 m/s (111 dB)", "dB re 1e-6 m/s² (115.4 dB)", "mm/s (129.2 dB)"]),
    ("wheel.measured_level_db=0", []),
    ("wheel.measured_level_db=[0, 111]", []),
    ("wheel.measured_level_db=1e-9", []),
    ("wheel.measured_velocity_mm_per_s=0.0177", ["m/s (17.7 mm/s)"]),
    ("wheel.measured_displacement_um=0.029", ["mm (29 µm)"]),
    ("measured_after.measured_acceleration_m_per_s2=4000", ["mm/s² (4 m/s²)", "cm/s² (40 m/s²)"]),
    ("wheel.diameter_mm=9", ["cm (90 mm)", "inch (228.6 mm)"]),
    ("wheel.diameter_mm=6", ["cm (60 mm)", "inch (152.4 mm)"]),
    ("autobalancer.max_outer_diameter_mm=800", []),
    ("autobalancer.max_width_mm=3.2", ["cm (32 mm)", "inch (81.28 mm)"]),
    ("autobalancer.bore_diameter_mm=0.02", ["m (20 mm)"]),
    ("autobalancer.max_mass_fraction=0.9", []),
    ("autobalancer.capacity_margin=20", []),
    ("autobalancer.rolling_drag_per_s=900", ["1/min (15 1/s)"]),
    ("autobalancer.rolling_friction_mm=2e-6", ["m (0.002 mm)"]),
    ("autobalancer.rolling_friction_mm=0.5", ["µm (0.0005 mm)"]),
    ("autobalancer.race_eccentricity_mm=10", ["µm (0.01 mm)"]),
    ("autobalancer.race_eccentricity_mm=1e-5", ["m (0.01 mm)"]),
    ("autobalancer.race_hardness_HRC=30", []),
    ("autobalancer.min_wall_mm=0.25", ["cm (2.5 mm)", "inch (6.35 mm)"]),
    ("autobalancer.plane_offset_mm=-0.03", ["m (-30 mm)"]),
    ("autobalancer.ball_count=60", []),
    ("autobalancer.ball_diameter_mm=0.625", ["inch (15.88 mm)", "cm (6.25 mm)"]),
    ("autobalancer.ball_diameter_mm=0.016", ["m (16 mm)"]),
    ("autobalancer.race_radius_mm=3.1", ["inch (78.74 mm)", "cm (31 mm)"]),
    ("grinding={contact_stiffness_N_per_m=200}", ["N/mm (200000 N/m)"]),
    ("grinding={contact_stiffness_N_per_m=0.2}", ["N/µm (200000 N/m)"]),
    ("grinding={contact='face', press_force_N=4.5}", ["kgf (44.13 N)"]),
    ("grinding={contact='face', press_force_N=0.045}", ["kN (45 N)"]),
    ("grinding={contact='face', cutting_coefficient=0.05}", []),
    ("run_up.time_s=1000", ["ms (1 s)"]),
    ("run_up.run_down_s=0.05", ["min (3 s)"]),
    ("run_up={pause_speed_rpm=18}", ["Hz (1080 rpm)", "rad/s (171.9 rpm)"]),
    (MOTOR.replace("=3,", "=3000,"), ["N·mm (3 N·m)", "N·cm (30 N·m)"]),
    (MOTOR.replace("2e-3", "20"), ["kg·cm² (0.002 kg·m²)", "kg·mm² (2e-5 kg·m²)", "g·m² (0.02 kg·m²)"]),
    (ARM.replace("=350", "=35"), ["cm (350 mm)", "inch (889 mm)"]),
    (ARM.replace("=90", "=1.57"), ["rad (89.95 °)"]),
    (ARM.replace("=2,", "=0.035,"), ["rad (2.005 °)"]),
    (ARM.replace("=1e6", "=1000"), ["N/mm (1e6 N/m)"]),
    ("bearing[0].radial_load_kN=800", ["N (0.8 kN)", "kgf (7.845 kN)"]),
    ("bearing[0].shaft_rz_um=0.004", ["mm (4 µm)"]),
    ("bearing[0].asked_interference_um=[0.01, 0.028]", ["mm (10, 28 µm)"]),
    ("limits.vibration_level_db=6.5", ["m/s² (106.6 dB)", "mm/s (102.3 dB)"]),
    ("limits.quiet_time_s=1000", ["ms (1 s)"]),
    ("limits.settling_time_s=1000", ["ms (1 s)"]),
    ("limits.rest_time_s=2000", ["ms (2 s)"]),
    ("suspension.natural_frequencies_hz=[2.5, 1500]", ["rpm (25 Hz)", "rad/s (238.7 Hz)"]),
    ("suspension.damping_ratios=5", ["% (0.05)"]),
    ("machine.handle=[{name='front', from_center_of_mass_mm=0.1}]", ["m (100 mm)"]),
]  # fmt: skip


@pytest.mark.parametrize(("override", "meant"), MISTAKES, ids=[one[0][:60] for one in MISTAKES])
def test_an_unusual_number_is_warned_of_with_the_units_in_which_it_would_be_usual(
    tmp_path: Path, override: str, meant: list[str]
) -> None:
    found = [line for line in lines(tmp_path, override) if "larger than the wheel" not in line]
    assert len(found) == 1, found
    (line,) = found
    assert "(--set) is unusual, " in line and " is usual." in line
    guess = line.partition(" Meant in ")[2].rstrip("?")
    assert sorted(guess.split(" or ") if guess else []) == sorted(meant), line


@pytest.mark.parametrize(("override", "first"), [
    ("machine.speed_rpm=97", "Hz"), ("machine.speed_rpm=607", "rad/s"), ("machine.speed_rpm=1.2e5", None),
    ("wheel.measured_level_db=6.5", "m/s²"), ("limits.vibration_level_db=6.5", "m/s²"),
    ("wheel.imbalance_g_mm=0.15", "g·m"),
])  # fmt: skip
def test_the_likeliest_unit_comes_first(tmp_path: Path, override: str, first: str | None) -> None:
    meant = lines(tmp_path, override)[0].partition("Meant in ")[2]
    assert meant.startswith(f"{first} (") if first else not meant


@pytest.mark.parametrize(("override", "remedy"), [
    ("wheel.diameter_mm=0.15", "Meant in m (150 mm)?"),
    ("autobalancer.race_eccentricity_mm=15", "Meant in µm (0.015 mm)?"),
    ("wheel.mass_kg=6000", "Meant in g (6 kg)?"), ("suspension.damping_ratios=[0.5, 50]", "Meant in % (0.5)?"),
    ("wheel.diameter_mm=-15", None), ("machine.mass_kg=0", None), (f"machine.mass_kg=1{'0' * 400}", None),
    ("machine.speed_rpm=400000", None),
])  # fmt: skip
def test_a_number_that_is_refused_is_asked_about_likewise(tmp_path: Path, override: str, remedy: str | None) -> None:
    assert refused(tmp_path, BASIC, [override]).remedy == remedy


def test_the_line_names_key_value_place_and_range(tmp_path: Path) -> None:
    text = BASIC.replace("mass_kg = 5.6", "mass_kg = 5600")
    assert lines(tmp_path, text=text) == [
        "machine.mass_kg = 5600 (line 5) is unusual, 0.3 … 150 kg is usual. Meant in g (5.6 kg)?"
    ]


def test_a_changed_machine_says_where_the_number_comes_from() -> None:
    changed = read_machine("msh-230").changed({"machine.mass_kg": 5600})
    assert next(line for line in changed.warnings if "unusual" in line).startswith(
        "machine.mass_kg = 5600 (changed) is unusual"
    )


def test_a_level_without_a_known_speed_is_not_taken_for_an_acceleration(tmp_path: Path) -> None:
    text = '[machine]\nname = "roll"\n[[bearing]]\ndesignation = "6203"\n[limits]\nvibration_level_db = 6.5\n'
    assert lines(tmp_path, text=text) == [
        "limits.vibration_level_db = 6.5 (line 6) is unusual, 85 … 130 dB is usual. Meant in mm/s (102.3 dB)?"
    ]


# What must not be asked about.


@pytest.mark.parametrize("name", presets.names())
def test_no_preset_of_a_grinder_is_unusual(name: str) -> None:
    warnings = read_file(name).warnings
    if not name.startswith("washing-machine"):
        assert warnings == ()
    # A drum is larger than grinders are: its imbalance and its ring alone are asked about.
    keys = ("imbalance_g_mm", "bore_diameter_mm", "max_outer_diameter_mm")
    assert all(any(key in text for key in keys) for text in warnings)


def test_neither_template_is_unusual(tmp_path: Path) -> None:
    assert read(tmp_path, template_of("machine")).warnings == ()
    assert scenes.read(tmp_path, template_of("scene")).warnings == ()


@pytest.mark.parametrize("text", [scenes.SCENE, scenes.PLANAR, scenes.TILTING, scenes.ARM])
def test_scenes_of_any_scale_are_usual(tmp_path: Path, text: str) -> None:
    assert scenes.read(tmp_path, text).warnings == ()


@pytest.mark.parametrize("overrides", [
    ("machine.mass_kg=30", "wheel.mass_kg=8", "wheel.diameter_mm=400"),
    ("machine.mass_kg=90", "wheel.diameter_mm=500", "autobalancer.max_outer_diameter_mm=500", "machine.speed_rpm=900",
     "wheel.imbalance_g_mm=20000"),
    ("machine.mass_kg=0.4", "machine.speed_rpm=60000", "wheel.diameter_mm=25", "autobalancer.max_outer_diameter_mm=25",
     "autobalancer.bore_diameter_mm=4", "autobalancer.max_width_mm=8", "wheel.mass_kg=0.01", "wheel.imbalance_g_mm=2"),
    ("machine.speed_range_rpm=[300, 6000]", "wheel.imbalance_g_mm=0", "autobalancer.rolling_friction_mm=0",
     "autobalancer.rolling_drag_per_s=0", "suspension.damping_ratios=0"),
    ("suspension.natural_frequencies_hz=120", "suspension.damping_ratios=0.01"),
    (*RIGID, "machine.handle=[{name='rear', from_center_of_mass_mm=-300}]", "autobalancer.plane_offset_mm=-30"),
    (ARM.replace("touch_angle_deg=2", "touch_angle_deg=-5"), MOTOR),
    ("autobalancer.rolling_drag_per_s=3", "autobalancer.race_eccentricity_mm=0.0005", "machine.power_W=7500"),
])  # fmt: skip
def test_machines_like_hand_grinders_are_usual(tmp_path: Path, overrides: tuple[str, ...]) -> None:
    assert lines(tmp_path, *overrides) == []


def test_a_key_that_plays_no_part_is_not_asked_about(tmp_path: Path) -> None:
    (line,) = lines(tmp_path, "grinding={contact='rigid', contact_stiffness_N_per_m=200}")
    assert line.endswith("contact_stiffness_N_per_m plays no part beside the other keys.")


# Numbers that do not go together.


@pytest.mark.parametrize(("wheel", "meant"), [(60, None), (25, None), (67.9, None), (11, "cm (110 mm) or inch")])
def test_an_autobalancer_larger_than_its_wheel_is_warned_of(tmp_path: Path, wheel: float, meant: str | None) -> None:
    line = lines(tmp_path, f"wheel.diameter_mm={wheel}")[-1]
    head = "autobalancer.max_outer_diameter_mm = 68 (line 20) is unusual, larger than the wheel: wheel.diameter_mm = "
    assert line.startswith(f"{head}{wheel}.")
    assert (f"The wheel's meant in {meant}" in line) if meant else ("meant" not in line)


def test_an_autobalancer_as_large_as_its_wheel_is_not(tmp_path: Path) -> None:
    assert lines(tmp_path, "wheel.diameter_mm=68") == []


@pytest.mark.parametrize(("overrides", "key"), [
    (("machine.speed_rpm=20400",), "machine.speed_rpm = 20400"),
    (("machine.speed_range_rpm=[5800, 20400]",), "machine.speed_range_rpm = [5800, 20400]"),
])  # fmt: skip
def test_a_rim_faster_than_wheels_bear_is_warned_of(tmp_path: Path, overrides: tuple[str, ...], key: str) -> None:
    """At 0.15 m and 160 m/s: 160/(0.075)·30/π = 20 372 rpm."""
    (line,) = lines(tmp_path, *overrides)
    assert line.startswith(key) and "160 m/s" in line
    assert lines(tmp_path, *(one.replace("20400", "20300") for one in overrides)) == []


# Defaults that are another machine's.


@pytest.mark.parametrize(("table", "keys"), [
    ("[swing_arm]", ["arm_length_mm = 350", "moment_of_inertia_kg_m2 = 0.62", "joint_stiffness_N_per_m = 2000",
                     "joint_damping_N_s_per_m = 40", "contact_stiffness_N_per_m = 1e6", "cutting_coefficient = 0.45",
                     "contact_angle_deg = 90", "touch_angle_deg = 2", "pressing_moment_N_m = 20"]),
    ("[swing_arm]\narm_length_mm = 300", ["moment_of_inertia_kg_m2 = 0.62"]),
    ("[motor]", ["stall_torque_N_m = 3", "no_load_speed_rpm = 6000", "rotor_inertia_kg_m2 = 0.002"]),
    ("[grinding]", ["contact_stiffness_N_per_m = 200000"]),
])  # fmt: skip
def test_example_data_in_force_is_warned_of(tmp_path: Path, table: str, keys: list[str]) -> None:
    (line,) = lines(tmp_path, text=BASIC + table)
    assert line.startswith(f"{table.split()[0]} (line 29) takes example data, not your machine's: ")
    assert all(key in line for key in keys) and "give your own" in line
    assert "arm_length_mm" not in line or "arm_length_mm = 300" not in table


@pytest.mark.parametrize("table", [
    '[grinding]\ncontact = "face"', "[grinding]\ncontact_stiffness_N_per_m = 1e5", "[run_up]",
    f"[motor]\n{MOTOR[7:-1].replace(', ', chr(10))}", f"[swing_arm]\n{ARM[11:-1].replace(', ', chr(10))}",
])  # fmt: skip
def test_data_that_is_given_or_plays_no_part_is_not(tmp_path: Path, table: str) -> None:
    assert lines(tmp_path, text=BASIC + table) == []


def test_the_example_of_a_scene_is_told_by_what_it_uses(tmp_path: Path) -> None:
    """An idle arm is not pressed to the work."""
    head, _, _ = scenes.ARM.partition("arm_length_mm")
    (line,) = scenes.read(tmp_path, head).warnings
    assert line.startswith("[scene.swing_arm] (line ") and "arm_length_mm = 350" in line and "touch" not in line
    (line,) = scenes.read(tmp_path, head + "cutting = true\nwheel_radius_mm = 115").warnings
    assert "arm_length_mm = 350" in line and "touch_angle_deg = 2" in line
    effects = "[scene.effects.grinding_contact]\n"
    (line,) = scenes.read(tmp_path, scenes.SCENE + effects).warnings
    assert line.startswith("[scene.effects.grinding_contact]") and "contact_stiffness_N_per_m = 200000" in line


def test_no_load_is_assumed_of_a_bearing(tmp_path: Path) -> None:
    assert "bearing[0].radial_load_kN" not in dict(read(tmp_path, BASIC).defaults_used)


# The data itself.


def fields(root: type[Table]) -> Iterator[tuple[str, str, FieldInfo]]:
    for _, table in all_tables(root):
        for key, field in table.model_fields.items():
            yield table.__name__, key, field


def numbers(value: object) -> list[float]:
    if isinstance(value, (list, tuple)):
        return [inner for each in value for inner in numbers(each)]
    return [value] if isinstance(value, (int, float)) and not isinstance(value, bool) else []


def test_every_number_of_a_machine_file_has_a_usual_range() -> None:
    without = {
        f"{table}.{key}"
        for table, key, field in fields(MachineFile)
        if numbers([*(field.examples or ()), field.default]) and usual_of(field) is None
    }
    assert without <= FREE, without - FREE


def test_every_default_and_every_example_is_usual() -> None:
    seen = 0
    for root in (MachineFile, SceneFile):
        for table, key, field in fields(root):
            if usual := usual_of(field):
                for value in numbers([*(field.examples or ()), field.default]):
                    assert usual.holds(value), (table, key, value)
                    seen += 1
    assert seen > 60


def test_every_usual_range_is_narrower_than_what_is_allowed_and_stands_in_the_description_and_the_schema() -> None:
    definitions = schema_of("machine")["definitions"]
    for table, key, field in fields(MachineFile):
        if usual := usual_of(field):
            assert 0 < usual.low < usual.high, (table, key)
            allowed = {name: getattr(one, name) for one in field.metadata for name in ("ge", "gt", "le")
                       if hasattr(one, name)}  # fmt: skip
            assert usual.high <= allowed.get("le", math.inf) and usual.low >= allowed.get("ge", -math.inf), (table, key)
            assert f"usually {bounded(usual.low)} … {bounded(usual.high)}" in (field.description or ""), (table, key)
            assert definitions[table]["properties"][key]["x-usual"] == [usual.low, usual.high]


def test_the_template_shows_them() -> None:
    text = " ".join(template_of("machine").replace("\n#", "").split())
    assert "0.001 … 20000, usually 0.3 … 150, hand grinders 1 … 8." in text
    assert "-2000 … 2000, usually 5 … 1000 either way, at a grinder" in text


@pytest.mark.parametrize(("value", "holds"), [
    (0, True), (1, True), (-1, True), (1000, True), (0.999, False), (-0.999, False), (1001, False), (-1001, False),
])  # fmt: skip
def test_zero_says_none_and_the_size_counts(value: float, holds: bool) -> None:
    assert Usual(1, 1000).holds(value) is holds


def test_units_are_guessed_for_every_unit_of_the_keys() -> None:
    from abu_calc.inputs.reading.suggestions import MISTAKEN

    units = {unit_suffix(key) for _, key, field in fields(MachineFile) if usual_of(field)}
    assert units - {"db", "HRC", "K"} <= MISTAKEN.keys()


def test_a_pasted_action_leaves_no_key_in_vain(tmp_path: Path) -> None:
    """Balls that an option pins make the file's ball_sizes idle: the file is not to blame, an option would be."""
    assert lines(tmp_path, "autobalancer.ball_diameter_mm=9") == []
    (line,) = lines(tmp_path, "autobalancer.ball_diameter_mm=9", "autobalancer.ball_sizes='all'")
    assert line.endswith("ball_sizes plays no part beside the other keys.")
