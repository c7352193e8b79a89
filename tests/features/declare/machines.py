"""Machines of known declared values, as files."""

from pathlib import Path

S150 = """
[machine]
name = "S150"
layout = "straight"
mass_kg = 5.3
speed_rpm = 5800
spindle_axis = "vertical"
transverse_inertia_kg_m2 = 0.10
center_of_mass_to_wheel_mm = 200.0
[[machine.handle]]
name = "front"
from_center_of_mass_mm = 100.0
[[machine.handle]]
name = "rear"
from_center_of_mass_mm = -200.0
[suspension]
model = "springs"
natural_frequencies_hz = [2.5, 2.5]
damping_ratios = [0.5, 0.5]
[wheel]
mass_kg = 0.7
diameter_mm = 150.0
imbalance_g_mm = 120.0
[autobalancer]
max_outer_diameter_mm = 80.0
max_width_mm = 32.0
max_mass_fraction = 0.25
ball_count = 4
ball_diameter_mm = 10.0
race_radius_mm = 31.0
plane_offset_mm = -20.0
race_eccentricity_mm = 0.010
rolling_friction_mm = 0.002
rolling_drag_per_s = 15.0
"""
"""The rigid reference machine: 6 kg without its autobalancer, race 20 mm behind the wheel."""

S100 = """
[machine]
name = "S100"
layout = "straight"
mass_kg = 2.9
speed_rpm = 10000
spindle_axis = "vertical"
[suspension]
model = "springs"
natural_frequencies_hz = [2.5, 2.5]
damping_ratios = [0.5, 0.5]
[wheel]
mass_kg = 0.2
diameter_mm = 100.0
imbalance_g_mm = 40.0
[autobalancer]
max_outer_diameter_mm = 64.0
max_width_mm = 30.0
max_mass_fraction = 0.25
ball_count = 3
ball_diameter_mm = 8.0
race_radius_mm = 24.0
race_eccentricity_mm = 0.005
rolling_friction_mm = 0.001
rolling_drag_per_s = 15.0
"""
"""The point mass: 3.1 kg without its autobalancer, about 3.2 kg with it."""


def written(folder: Path, text: str, name: str = "machine.toml") -> str:
    """Path of a file with this text."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)
