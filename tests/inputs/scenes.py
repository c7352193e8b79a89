"""Scene files to read, and how one is read and refused."""

from collections.abc import Sequence
from pathlib import Path

from abu_calc.foundation.errors import InputError
from abu_calc.simulation.scene_file import SceneDescription, read_scene

SCENE = """\
# two balls on a planar rotor
[scene]
support = "planar"
mass_kg = 1.0
stiffness_N_per_m = [1.0, 1.0]
damping_N_s_per_m = [0.02, 0.02]
speed_rpm = 19.0985931710274
imbalance_g_mm = 10000.0
duration_s = 700.0
rolling_inertia = false

[[scene.race]]
pitch_radius_mm = 1000.0
ball_masses_g = [50.0, 50.0]
rolling_drag_per_s = 0.01
start_angles_deg = [90.0, -90.0]
"""

LIGHT_BALLS = """
[scene]
mass_kg = 1.0
stiffness_N_per_m = [1.0, 1.0]
damping_N_s_per_m = [0.1, 0.1]
speed_rpm = 24.0
imbalance_g_mm = 10000.0
duration_s = 300.0
[[scene.race]]
pitch_radius_mm = 1000.0
ball_masses_g = [20.0, 20.0]
rolling_drag_per_s = 0.1
start_angles_deg = [90.0, -90.0]
"""

# Every table and key of a scene file, with the values of the published description of the format.
PLANAR = """\
[scene]
support = "planar"
mass_kg = 1.0
stiffness_N_per_m = [1.0, 1.0]
damping_N_s_per_m = [0.02, 0.02]
speed_rpm = 19.0985931710274
imbalance_g_mm = 10000.0
imbalance_angle_deg = 0.0
duration_s = 700.0
initial = { x_mm = 0.0, y_mm = 0.0, vx_mm_per_s = 0.0, vy_mm_per_s = 0.0 }
rolling_inertia = false
[[scene.race]]
pitch_radius_mm = 1000.0
plane_offset_mm = 0.0
ball_radius_mm = 8.0
corrector = "ball"
ball_masses_g = [50.0, 50.0]
rolling_drag_per_s = 0.01
start_angles_deg = [90.0, -90.0]
start_speeds_rpm = [0.0, 0.0]
[scene.body]
mass_kg = 0.5
stiffness_N_per_m = [1.0, 1.0]
damping_N_s_per_m = [0.02, 0.02]
[scene.effects]
gravity = { }
dry_rolling_friction = { lever_arm_mm = 0.002, ball_radius_mm = 8.0 }
ball_contact = { ball_radius_mm = 8.0, restitution = 0.5 }
race_eccentricity = { magnitude_mm = 0.01, angle_deg = 0.0 }
run_up = { time_s = 1.0 }
motor = { stall_torque_N_m = 3.0, no_load_speed_rpm = 6000.0, rotor_inertia_kg_m2 = 2e-3 }
transverse_motion = { groove_radius_mm = 23.7, ball_radius_mm = 8.0, axial_runout_mm = 0.05, free_spin = false }
[scene.effects.grinding_contact]
contact = "compliant"
contact_stiffness_N_per_m = 2e5
press_force_N = 45.0
cutting_coefficient = 0.35
rotation_sense = -1
runout_mm = 0.04
runout_angle_deg = 0.0
wheel_radius_mm = 75.0
plane_offset_mm = 0.0
"""
TILTING = """\
[scene]
support = "tilting"
mass_kg = 0.8
speed_rpm = 3000
imbalance_g_mm = 50
duration_s = 1
[[scene.race]]
pitch_radius_mm = 30
plane_offset_mm = 20.0
ball_masses_g = [2.0, 2.0]
rolling_drag_per_s = 5
start_angles_deg = [10, 60]
[[scene.race]]
pitch_radius_mm = 30
plane_offset_mm = -20.0
ball_masses_g = [2.0, 2.0]
rolling_drag_per_s = 5
start_angles_deg = [10, 60]
[scene.tilting]
transverse_inertia_kg_m2 = 0.0138
polar_inertia_kg_m2 = 0.00124
bearing_positions_mm = [110.0, -150.0]
bearing_stiffness_N_per_m = [[21500.0, 15800.0], [21500.0, 15800.0]]
bearing_damping_N_s_per_m = [[5.375, 3.95], [5.375, 3.95]]
couple_imbalance_angle = { magnitude_rad = 6.8e-5, angle_deg = 0.0 }
ball_tilt_inertia = true
"""
JOINT_AND_CONTACT = """\
joint_stiffness_N_per_m = 2000.0
joint_damping_N_s_per_m = 40.0
contact_stiffness_N_per_m = 1e6
cutting_coefficient = 0.45
contact_angle_deg = 90.0
touch_angle_deg = 2.0
pressing_moment_N_m = 20.0
"""
ARM = f"""\
[scene]
support = "swing-arm"
speed_rpm = 2864.8
imbalance_g_mm = 400
duration_s = 12
[[scene.race]]
pitch_radius_mm = 30
ball_masses_g = [10, 10]
rolling_drag_per_s = 10
start_angles_deg = [114.6, -57.3]
[scene.swing_arm]
arm_length_mm = 300.0
moment_of_inertia_kg_m2 = 0.45
{JOINT_AND_CONTACT}wheel_radius_mm = 115.0
cutting = true
"""


def read(folder: Path, text: str, overrides: Sequence[str] = ()) -> SceneDescription:
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return read_scene(str(file), overrides)


def refused(folder: Path, text: str, overrides: Sequence[str] = ()) -> InputError:
    """The error a text is refused with; an AssertionError if it is read."""
    try:
        read(folder, text, overrides)
    except InputError as error:
        return error
    raise AssertionError(f"read without error:\n{text!r}")
