"""Machine files to read: one with every key, as rows whose lines and paths are known by construction."""

import copy
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import Machine, read_machine
from abu_calc.inputs.reading.errors import SpecErrors

Row = tuple[str, str, str]
"""Header (as written, "" within a table), key, value as written."""

BASIC = """\
# a straight grinder
[machine]
name = "straight grinder"
layout = "straight"
mass_kg = 5.6
speed_rpm = 5800
spindle_axis = "horizontal"

[suspension]
model = "springs"
natural_frequencies_hz = [2.5, 2.5]
damping_ratios = [0.5, 0.5]

[wheel]
mass_kg = 0.6
diameter_mm = 150.0
imbalance_g_mm = 150.0

[autobalancer]
max_outer_diameter_mm = 68.0
max_width_mm = 32.0

[[bearing]]
designation = "6203"
shaft_fit = "k6"

[limits]
vibration_level_db = 109.0
"""

BEARINGS = """\
[machine]
name = "fleshing roll"
[[bearing]]
name = "left"
bore_mm = 80
outer_mm = 140
width_mm = 33
chamfer_mm = 2
radial_load_kN = 3
shaft_fit = "k6"
housing_fit = "K7"
[[bearing]]
designation = "7516"
"""

# Every key of a machine file, with the values of the published description of the format.
FULL: dict[str, dict[str, str]] = {
    "[machine]": {
        "name": '"everything"',
        "layout": '"straight"',
        "mass_kg": "5.6",
        "speed_rpm": "5800",
        "speed_range_rpm": "[5800, 5800]",
        "spindle_axis": '"horizontal"',
        "held": '"any"',
        "transverse_inertia_kg_m2": "0.10",
        "center_of_mass_to_wheel_mm": "200.0",
        "length_mm": "450.0",
        "height_mm": "120.0",
        "power_W": "1000.0",
        "background_level_db": "98.0",
    },
    "[[machine.handle]]": {"name": '"front"', "from_center_of_mass_mm": "100.0"},
    "[suspension]": {"model": '"springs"', "natural_frequencies_hz": "[2.5, 2.5]", "damping_ratios": "[0.5, 0.5]"},
    "[wheel]": {
        "mass_kg": "0.6",
        "diameter_mm": "150.0",
        "runout_mm": "0.04",
        "runout_angle_deg": "0.0",
        "axial_runout_mm": "0.02",
        "usable_wear_mm": "10.0",
        "life_with_autobalancer_min": "48.0",
        "life_min": "32.0",
        "measured_level_db": "[110.0, 111.0]",
        "measured_weighting": '"none"',
        "measured_axes": "1",
        "measured_at": '"front"',
    },
    "[measured_after]": {
        "measured_acceleration_m_per_s2": "[0.4, 0.5]",
        "measured_weighting": '"Wh"',
        "measured_axes": "3",
        "measured_at": '"front"',
    },
    "[autobalancer]": {
        "max_outer_diameter_mm": "68.0",
        "max_width_mm": "32.0",
        "max_mass_fraction": "0.05",
        "bore_diameter_mm": "20.0",
        "design": '"one-piece"',
        "ball_sizes": '"metric"',
        "ball_material": '"steel"',
        "corrector": '"ball"',
        "capacity_margin": "1.2",
        "rolling_drag_per_s": "15.0",
        "rolling_friction_mm": "0.002",
        "race_eccentricity_mm": "0.010",
        "race_hardness_HRC": "60.0",
        "min_wall_mm": "2.5",
        "eccentricity_sum": '"rss"',
        "closure": '"screwed"',
        "fastening": '"flange"',
        "clamp_force_N": "8000.0",
        "guard_thickness_mm": "2.0",
        "temperature_range_C": "[0.0, 80.0]",
        "plane_offset_mm": "0.0",
        "ball_count": "4",
        "ball_diameter_mm": "16.0",
        "race_radius_mm": "30.0",
    },
    "[grinding]": {
        "press_force_N": "45.0",
        "cutting_coefficient": "0.35",
        "contact": '"compliant"',
        "contact_stiffness_N_per_m": "2e5",
        "rotation_sense": "-1",
    },
    "[run_up]": {"time_s": "1.0", "run_down_s": "3.0"},
    "[start]": {"angles_deg": "[-30.0, 0.0, 30.0, 60.0]", "speeds_rpm": "[0.0, 0.0, 0.0, 0.0]"},
    "[motor]": {"stall_torque_N_m": "3.0", "no_load_speed_rpm": "6000.0", "rotor_inertia_kg_m2": "2e-3"},
    "[swing_arm]": {
        "arm_length_mm": "350.0",
        "moment_of_inertia_kg_m2": "0.62",
        "joint_stiffness_N_per_m": "2000.0",
        "joint_damping_N_s_per_m": "40.0",
        "contact_stiffness_N_per_m": "1e6",
        "cutting_coefficient": "0.45",
        "contact_angle_deg": "90.0",
        "touch_angle_deg": "2.0",
        "pressing_moment_N_m": "20.0",
    },
    "[[bearing]]": {
        "name": '"spindle, drive end"',
        "bore_mm": "17",
        "outer_mm": "40",
        "width_mm": "12",
        "chamfer_mm": "0.6",
        "bearing_type": '"ball"',
        "dynamic_load_rating_kN": "9.95",
        "static_load_rating_kN": "4.75",
        "radial_load_kN": "0.8",
        "load_kind": '"moderate"',
        "series": '"light"',
        "inner_ring_load": '"rotating"',
        "outer_ring_load": '"stationary"',
        "bearing_class": '"0"',
        "shaft_fit": '"k6"',
        "housing_fit": '"H7"',
        "shaft_limits_um": "[1.0, 12.0]",
        "housing_limits_um": "[0.0, 25.0]",
        "ring_bore_limits_um": "[-8.0, -3.0]",
        "ring_outer_limits_um": "[-7.0, -2.0]",
        "mounting_clearance_um": "20.0",
        "shaft_rz_um": "4.0",
        "housing_rz_um": "6.3",
        "ring_temperature_difference_K": "10.0",
        "housing_temperature_difference_K": "-5.0",
        "temperature_rise_K": "40.0",
        "speed_rpm": "5800.0",
        "shaft_bore_mm": "0.0",
        "housing_outer_mm": "60.0",
        "shaft_material": '"steel"',
        "housing_material": '"steel"',
        "shaft_strength_MPa": "300.0",
        "housing_strength_MPa": "200.0",
        "housing_split": "false",
        "internal_clearance": '"CN"',
        "raceway_temperature_difference_K": "5.0",
        "starting_torque_N_m": "2.0",
        "seat_friction": "0.12",
        "asked_interference_um": "[10.0, 28.0]",
        "axial_load_kN": "0.2",
        "position_mm": "40.0",
        "lubricant_viscosity_mm2_per_s": "20.0",
        "contamination_factor": "0.5",
        "required_life_h": "500.0",
        "short_pairs_warn_percent": "1.0",
        "short_pairs_fail_percent": "5.0",
        "temperature_range_K": "[-40.0, 60.0]",
    },
    "[[measured]]": {
        "place": '"front"',
        "axis": '"y"',
        "state": '"idle"',
        "octave_hz": "125.0",
        "level_db": "[102.0, 103.0]",
        "level_without_db": "[108.0, 111.0]",
        "lowered_db": "[6.0, 10.0]",
        "source": '"own measurement"',
        "remark": '"Two sensors."',
    },
    "[oil]": {
        "grade": '"VG 46"',
        "viscosity_100C_mm2_per_s": "6.7",
        "density_g_per_cm3": "0.87",
        "temperature_C": "40.0",
        "cold_temperature_C": "5.0",
        "hot_temperature_C": "80.0",
        "fill_ml": "2.0",
        "slip_m_per_s": "0.5",
    },
    "[identified]": {
        "starts": "10",
        "rolling_drag_per_s": "[11.0, 18.0]",
        "rolling_friction_mm": "[0.001, 0.003]",
        "race_eccentricity_mm": "[0.008, 0.012]",
    },
    "[type_test]": {
        "test_wheel_diameter_mm": "150.0",
        "test_wheel_imbalance_g_mm": "65.0",
        "orientations": "5",
        "runs": "2",
        "operators": "3",
        "background_a_hv_m_per_s2": "0.5",
    },
    "[limits]": {"vibration_level_db": "109.0", "a_hv_m_per_s2": "2.5", "quiet_time_s": "1.0", "rest_time_s": "2.0"},
}


def full_text(changed: tuple[str, str] | None = None, value: str = "") -> tuple[str, int]:
    """The full file, one value replaced, and the line it stands on (0 for none)."""
    rows, line = [], 0
    for header, keys in FULL.items():
        rows.append(header)
        for key, given in keys.items():
            if (header, key) == changed:
                line = len(rows) + 1
            rows.append(f"{key} = {value if (header, key) == changed else given}")
    return "\n".join(rows) + "\n", line


def path_of(header: str, key: str) -> str:
    """The key path by the rules of TOML, for the full file: each of its arrays has one element."""
    name = header.strip("[]")
    return f"{name}[0].{key}" if header.startswith("[[") else f"{name}.{key}"


def document(text: str) -> dict[str, object]:
    return tomllib.loads(text)


def read(folder: Path, text: str | bytes, overrides: Sequence[str] = ()) -> Machine:
    file = folder / "m.toml"
    file.write_bytes(text.encode("utf-8") if isinstance(text, str) else text)
    return read_machine(str(file), overrides)


def refused(folder: Path, text: str | bytes, overrides: Sequence[str] = ()) -> InputError:
    """The error a text is refused with; an AssertionError if it is read."""
    try:
        read(folder, text, overrides)
    except InputError as error:
        return error
    raise AssertionError(f"read without error:\n{text!r}")


def all_of(error: InputError) -> tuple[InputError, ...]:
    return error.errors if isinstance(error, SpecErrors) else (error,)


def mutated(sample: dict[str, Any], path: tuple[Any, ...], how: str, value: Any) -> dict[str, Any]:
    """A copy of a document with the entry at a path replaced, removed, or given a strange neighbour."""
    data = copy.deepcopy(sample)
    held: Any = data
    for step in path[:-1]:
        held = held[step]
    if how == "replace":
        held[path[-1]] = value
    elif how == "remove":
        del held[path[-1]]
    elif isinstance(held, dict):
        held["strange"] = value
    return data
