"""Good files: what is read, the defaults in force, what is warned of.

The table [identified]: intervals that hold the values in force.
"""

import hashlib
from pathlib import Path

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.autobalancer import Autobalancer
from abu_calc.inputs.machine import Identified, MachineFile, identified_note
from abu_calc.inputs.reading.table import Table, all_tables
from abu_calc.inputs.rolling_bearing import Bearing
from abu_calc.inputs.wheel import QUANTITIES
from tests.inputs.samples import BASIC, FULL, full_text, read, refused


def machine(folder: Path, text: str) -> MachineFile:
    loaded = read(folder, text).tables
    assert isinstance(loaded, MachineFile)
    return loaded


def test_a_file_with_every_key_is_read(tmp_path: Path) -> None:
    loaded = read(tmp_path, full_text()[0])
    assert loaded.defaults_used == ()
    assert loaded.warnings == ("autobalancer.ball_sizes plays no part beside the other keys.",)  # the ball is pinned
    assert isinstance(loaded.tables, MachineFile)
    assert loaded.tables.machine.speeds_rpm == (5800, 5800)
    assert loaded.tables.wheel.measured_level_db == (110, 111)
    assert loaded.tables.bearing[0].housing_outer_mm == 60


def test_keys_that_play_no_part_are_told(tmp_path: Path) -> None:
    text = BASIC.replace('shaft_fit = "k6"', "seat_friction = 0.2")
    loaded = read(tmp_path, text + '[grinding]\ncontact = "face"\ncontact_stiffness_N_per_m = 1e5\n')
    assert [warning.split()[0] for warning in loaded.warnings] == [
        "grinding.contact_stiffness_N_per_m", "bearing[0].seat_friction",
    ]  # fmt: skip


PAUSE = {"pause_speed_rpm", "pause_s", "pause_rise_s"}
"""Not beside a motor."""


IN_SPACE = {
    "center_of_mass_from_wheel_mm", "inertia_kg_m2", "inertia_xz_kg_m2", "rotor_polar_inertia_kg_m2", "position_mm",
}  # fmt: skip
"""Keys of a body in space, in place of those of a body along its spindle."""


def test_the_full_sample_names_every_key_of_the_models() -> None:
    """Otherwise the properties over its numbers would pass by a key that was added later."""
    alternatives = {"runout_tir_mm", "imbalance_g_mm", "balance_grade", "designation", "viscosity_mm2_per_s"}
    alternatives |= {"viscosity_index", *PAUSE, *QUANTITIES, *IN_SPACE, "settling_time_s"}
    alternatives |= {"cutting_force_N", "normal_to_cutting_ratio", "bearings_sharing"}
    for path, table in all_tables(MachineFile):
        if path in (("sweep",), ("optimise",)):
            continue  # not the machine but studies of many, which have their own tests
        header = next(header for header in FULL if header.strip("[]") == ".".join(path))
        inner = {key for key in table.model_fields if key == "handle"}
        assert table.model_fields.keys() - inner - alternatives == FULL[header].keys() - alternatives


def test_defaults_in_force_are_listed(tmp_path: Path) -> None:
    """The defaults of the published description of the format, written down a second time."""
    used = dict(read(tmp_path, BASIC + "[grinding]\n[run_up]\n[motor]\n[swing_arm]\n").defaults_used)
    assert used.pop("machine.speed_range_rpm") == (5800, 5800)
    assert used == {
        "wheel.runout_mm": 0,
        "wheel.runout_angle_deg": 0,
        "wheel.axial_runout_mm": 0,
        "autobalancer.max_mass_fraction": 0.05,
        "autobalancer.bore_diameter_mm": 20,
        "autobalancer.design": "one-piece",
        "autobalancer.ball_sizes": "all",
        "autobalancer.ball_material": "steel",
        "autobalancer.corrector": "ball",
        "autobalancer.capacity_margin": 1.2,
        "autobalancer.rolling_drag_per_s": 15,
        "autobalancer.rolling_friction_mm": 0.002,
        "autobalancer.race_eccentricity_mm": 0.010,
        "autobalancer.race_hardness_HRC": 60,
        "autobalancer.min_wall_mm": 2.5,
        "autobalancer.eccentricity_sum": "worst-case",
        "autobalancer.closure": "pressed",
        "autobalancer.fastening": "clamped",
        "autobalancer.temperature_range_C": (0, 60),
        "autobalancer.plane_offset_mm": 0,
        "grinding.press_force_N": 45,
        "grinding.cutting_coefficient": 0.35,
        "grinding.contact": "compliant",
        "grinding.contact_stiffness_N_per_m": 2e5,
        "grinding.rotation_sense": -1,
        "run_up.time_s": 1,
        "run_up.run_down_s": 3,
        "motor.stall_torque_N_m": 3,
        "motor.no_load_speed_rpm": 6000,
        "motor.rotor_inertia_kg_m2": 2e-3,
        "swing_arm.arm_length_mm": 350,
        "swing_arm.moment_of_inertia_kg_m2": 0.62,
        "swing_arm.joint_stiffness_N_per_m": 2000,
        "swing_arm.joint_damping_N_s_per_m": 40,
        "swing_arm.contact_stiffness_N_per_m": 1e6,
        "swing_arm.cutting_coefficient": 0.45,
        "swing_arm.contact_angle_deg": 90,
        "swing_arm.touch_angle_deg": 2,
        "swing_arm.pressing_moment_N_m": 20,
        "bearing[0].name": "bearing",
        "bearing[0].inner_ring_load": "rotating",
        "bearing[0].outer_ring_load": "stationary",
        "bearing[0].shaft_material": "steel",
        "bearing[0].housing_material": "steel",
        "bearing[0].housing_split": False,
        "bearing[0].short_pairs_warn_percent": 1.0,
        "bearing[0].short_pairs_fail_percent": 5.0,
        "bearing[0].bearing_class": "0",
        "limits.quiet_time_s": 1,
    }


def test_defaults_that_play_no_part_are_not_listed(tmp_path: Path) -> None:
    text = BASIC.replace("diameter_mm = 150.0", "diameter_mm = 150.0\nrunout_tir_mm = 0.08")
    loaded = read(tmp_path, text + '[grinding]\ncontact = "face"\n')
    used = dict(loaded.defaults_used)
    assert "wheel.runout_mm" not in used and "grinding.contact_stiffness_N_per_m" not in used
    without = read(tmp_path, text.replace("[limits]\nvibration_level_db = 109.0\n", ""))
    assert dict(without.defaults_used)["limits.vibration_level_db"] == 109


def test_absent_tables_are_none(tmp_path: Path) -> None:
    text = BASIC[: BASIC.index("[autobalancer]")]
    bare = machine(tmp_path, text)
    assert (bare.autobalancer, bare.grinding, bare.run_up, bare.motor, bare.swing_arm) == (None,) * 5
    assert bare.bearing == () and bare.expected == {}
    assert bare.limits.longest_quiet_time == 1 and bare.limits.rest_time_s is None


def test_the_quiet_time_has_two_names_but_one_value(tmp_path: Path) -> None:
    """Files of before give `settling_time_s`; an override by either name takes the place of the other."""
    text = BASIC.replace("vibration_level_db = 109.0", "vibration_level_db = 109.0\nsettling_time_s = 0.4")
    old = read(tmp_path, text)
    assert isinstance(old.tables, MachineFile) and old.tables.limits.longest_quiet_time == 0.4
    assert "limits.quiet_time_s" not in dict(old.defaults_used)
    for given, key in ((text, "quiet_time_s"), (text.replace("settling", "quiet"), "settling_time_s")):
        changed = read(tmp_path, given, [f"limits.{key}=0.7"]).tables
        assert isinstance(changed, MachineFile) and changed.limits.longest_quiet_time == 0.7
    with pytest.raises(InputError, match=r"settling_time_s: two names of one limit (.|\n)*Keep quiet_time_s"):
        read(tmp_path, text.replace("settling_time_s = 0.4", "settling_time_s = 0.4\nquiet_time_s = 0.4"))


def test_a_motor_may_reach_the_rated_speed_just(tmp_path: Path) -> None:
    motor = machine(tmp_path, BASIC + "[motor]\nno_load_speed_rpm = 5800\n").motor
    assert motor is not None and motor.no_load_speed_rpm == 5800


def test_what_is_told_of_the_file(tmp_path: Path) -> None:
    loaded = read(tmp_path, "\ufeff" + BASIC.replace("\n", "\r\n"))
    raw = (tmp_path / "m.toml").read_bytes()
    assert loaded.sha256 == hashlib.sha256(raw).hexdigest()
    assert loaded.file == str(tmp_path / "m.toml")
    assert loaded.text.startswith("# a straight grinder")
    assert loaded.lines["wheel.mass_kg"] == 15 and loaded.lines["bearing[0].shaft_fit"] == 25


def test_models_are_frozen() -> None:
    bearing = Bearing(designation="6203")
    with pytest.raises(Exception, match="frozen"):
        bearing.shaft_fit = "m6"


def test_every_key_is_described_with_an_example_where_it_has_no_default() -> None:
    for path, table in all_tables(MachineFile):
        assert issubclass(table, Table) and table.__doc__
        for key, field in table.model_fields.items():
            assert field.description and len(field.description) > 20, (path, key)
            if field.is_required() or field.default is None:
                assert field.examples, (path, key)


BAD = [
    ("rolling_drag_per_s = 15.0", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [15.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [12.0, 15.0, 18.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [18.0, 12.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [0.0, 18.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [nan, 18.0]", "rolling_drag_per_s"),
    ("drag_per_s = [12.0, 18.0]", "drag_per_s"),
    ("starts = 0", "starts"),
    ("starts = 2.5", "starts"),
]


@pytest.mark.parametrize(("entry", "key"), BAD)
def test_bad_intervals_are_refused_with_their_key(tmp_path: Path, entry: str, key: str) -> None:
    assert f"identified.{key}" in str(refused(tmp_path, f"{BASIC}\n[identified]\n{entry}\n"))


def test_intervals_without_an_autobalancer_are_refused(tmp_path: Path) -> None:
    text = BASIC.replace("[autobalancer]\nmax_outer_diameter_mm = 68.0\nmax_width_mm = 32.0\n", "")
    assert "no autobalancer" in str(refused(tmp_path, f"{text}\n[identified]\nstarts = 8\n"))


@pytest.mark.parametrize(
    ("key", "interval", "value"),
    [
        ("rolling_drag_per_s", "[16.0, 18.0]", "15"),
        ("rolling_friction_mm", "[0.003, 0.004]", "0.002"),
        ("race_eccentricity_mm", "[0.001, 0.004]", "0.01"),
    ],
)
def test_an_interval_that_does_not_hold_the_value_is_not_used(
    tmp_path: Path, key: str, interval: str, value: str
) -> None:
    machine = read(tmp_path, f"{BASIC}\n[identified]\n{key} = {interval}\n", ())
    tables = machine.whole("size")
    assert list(identified_note(tables.identified, tables.autobalancer)) == []
    assert any(f"does not hold autobalancer.{key} = {value}" in warning for warning in machine.warnings)


def test_the_note_names_every_identified_value(tmp_path: Path) -> None:
    text = f"{BASIC}\n[identified]\nstarts = 9\nrolling_drag_per_s = [12.0, 18.0]\n"
    tables = read(tmp_path, text, ()).whole("size")
    (note,) = identified_note(tables.identified, tables.autobalancer)
    assert "9 recorded starts" in note and "15 1/s (12 … 18)" in note
    abu = Autobalancer(max_outer_diameter_mm=68.0, max_width_mm=32.0)
    assert list(identified_note(None, abu)) == list(identified_note(Identified(starts=8), abu)) == []
