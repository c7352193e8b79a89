"""Plausible machines by seed, as the text of their files: held by springs or hands, rigid, with a motor, with a speed
range, with two speeds, on a swing arm.
"""

import math
from typing import Final

import numpy as np

FAMILIES: Final = ("held", "rigid", "motor", "range", "two speeds", "arm")
"""Kinds of machine; `held` is the plain hand-held machine from which the others are made."""


def family_of(seed: int) -> str:
    """Family of a machine of the sample: of each 25 successive seeds 10 are plainly held, 3 of each other family."""
    place = seed % 25
    return "held" if place < 10 else FAMILIES[1 + (place - 10) % 5]


def machine_text(seed: int, family: str) -> str:
    """The file of a machine of a family; the same seed gives the same hand-held machine in every family."""
    text = held_text(seed)
    if family == "held":
        return text
    rng = np.random.default_rng((seed, FAMILIES.index(family)))
    changed = {"rigid": _rigid, "motor": _motor, "range": _range, "two speeds": _two_speeds, "arm": _arm}
    return changed[family](text, rng)


def held_text(seed: int) -> str:
    """A plausible hand-held machine: 1–10 kg, 3000–20 000 rpm, both axes, four suspensions, drags 3–60 1/s."""
    rng = np.random.default_rng(seed)

    def log(low: float, high: float) -> float:
        return _log(rng, low, high)

    mass, speed = log(1, 10), log(3000, 20000)
    springs = [
        ([rng.uniform(2, 4)], 0.5),
        ([log(5, 12), log(8, 20)], 0.2),
        ([log(10, 30)], log(0.02, 0.2)),
    ]
    hertz, damping = springs[rng.integers(3)]
    frequencies = ", ".join(f"{one:.3g}" for one in hertz)
    held = f'model = "springs"\nnatural_frequencies_hz = [{frequencies}]\ndamping_ratios = [{damping:.2g}]'
    suspension = 'model = "hands"' if rng.random() < 0.25 else held
    wheel = 0.3 * log(100, 230) / 100
    return f"""
[machine]
name = "machine {seed}"
layout = "straight"
mass_kg = {mass:.4g}
speed_rpm = {speed:.5g}
spindle_axis = "{rng.choice(["horizontal", "vertical"])}"
[suspension]
{suspension}
[wheel]
mass_kg = {min(wheel, mass / 4):.3g}
diameter_mm = {min(230, 1.5e6 / speed):.4g}
measured_level_db = {rng.uniform(112, 124):.4g}
[autobalancer]
max_outer_diameter_mm = {rng.uniform(60, 100):.3g}
max_width_mm = {rng.uniform(15, 35):.3g}
max_mass_fraction = 0.08
bore_diameter_mm = 12
rolling_drag_per_s = {log(3, 60):.3g}
rolling_friction_mm = {log(0.0005, 0.004):.2g}
race_eccentricity_mm = {log(0.003, 0.015):.2g}
[run_up]
time_s = {log(0.3, 3):.2g}
[limits]
vibration_level_db = 109.0
settling_time_s = {rng.choice([1.0, 2.0])}
"""


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def _number(text: str, key: str) -> float:
    return float(text.split(f"\n{key} = ")[1].split("\n")[0])


def _inserted(text: str, table: str, lines: str) -> str:
    return text.replace(f"[{table}]\n", f"[{table}]\n{lines}\n")


def _rigid(text: str, rng: np.random.Generator) -> str:
    """A radius of gyration of 50–120 mm, the wheel 0.5–1.6 of it from the centre of mass, half of the races outside
    the wheel plane.
    """
    mass, gyration = _number(text, "mass_kg"), _log(rng, 0.05, 0.12)
    away, offset = gyration * rng.uniform(0.5, 1.6), rng.uniform(-12, 12) if rng.random() < 0.5 else 0.0
    lines = (
        f"transverse_inertia_kg_m2 = {mass * gyration**2:.4g}\ncenter_of_mass_to_wheel_mm = {1e3 * max(away, 0.03):.4g}"
    )
    # Handles behind the centre of mass and before it; without them the level at the wheel counts.
    handles = ""
    if rng.random() < 0.5:
        for name, place in (("rear", -rng.uniform(0.3, 1.0)), ("front", rng.uniform(0.1, 0.8))):
            handles += f'[[machine.handle]]\nname = "{name}"\nfrom_center_of_mass_mm = {1e3 * place * gyration:.4g}\n'
    text = _inserted(text, "machine", lines).replace("[suspension]\n", f"{handles}[suspension]\n")
    return _inserted(text, "autobalancer", f"plane_offset_mm = {offset:.3g}")


def _motor(text: str, rng: np.random.Generator) -> str:
    """A no-load speed up to 12 % above the rated one, up to it in 5 time constants of 0.06–0.5 s."""
    speed = _number(text, "speed_rpm") * rng.uniform(1.0, 1.12)
    wheel, radius = float(text.split("[wheel]\nmass_kg = ")[1].split("\n")[0]), _number(text, "diameter_mm") / 2e3
    inertia = wheel * radius**2 / 2 * rng.uniform(1.2, 2.5)
    torque = inertia * speed * math.tau / 60 / _log(rng, 0.06, 0.5)
    return (
        f"{text}[motor]\nstall_torque_N_m = {torque:.4g}\nno_load_speed_rpm = {speed:.6g}\n"
        f"rotor_inertia_kg_m2 = {inertia:.4g}\n"
    )


def _range(text: str, rng: np.random.Generator) -> str:
    """Speeds from 60–95 % of the rated one up to it."""
    speed = _number(text, "speed_rpm")
    return _inserted(text, "machine", f"speed_range_rpm = [{speed * rng.uniform(0.6, 0.95):.5g}, {speed:.5g}]")


def _two_speeds(text: str, rng: np.random.Generator) -> str:
    """A second gear of 45–70 % of the rated speed."""
    speed = _number(text, "speed_rpm")
    return _inserted(text, "machine", f"speed_range_rpm = [{speed * rng.uniform(0.45, 0.7):.5g}, {speed:.5g}]")


def _arm(text: str, rng: np.random.Generator) -> str:
    """An arm of 250–600 mm whose joint has 1.5–5 Hz and damps 10–50 %, pressed with 50–150 N."""
    mass = _number(text, "mass_kg") + float(text.split("[wheel]\nmass_kg = ")[1].split("\n")[0])
    length, natural = _log(rng, 0.25, 0.6), math.tau * _log(rng, 1.5, 5)
    felt = mass * rng.uniform(1.1, 2.0)
    touch, stiffness = rng.uniform(0.5, 3.0), felt * natural**2
    pressing = stiffness * length**2 * math.radians(touch) + rng.uniform(50, 150) * length
    return f"""{text}[swing_arm]
arm_length_mm = {1e3 * length:.4g}
moment_of_inertia_kg_m2 = {felt * length**2:.4g}
joint_stiffness_N_per_m = {stiffness:.4g}
joint_damping_N_s_per_m = {2 * _log(rng, 0.1, 0.5) * natural * felt:.4g}
contact_stiffness_N_per_m = {_log(rng, 2e4, 4e5):.4g}
cutting_coefficient = {rng.uniform(0.3, 0.5):.3g}
contact_angle_deg = {rng.uniform(75, 105):.4g}
touch_angle_deg = {touch:.3g}
pressing_moment_N_m = {pressing:.4g}
"""
