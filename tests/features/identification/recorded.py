"""Recordings of a synthetic machine, simulated apart from the bank: another tolerance, all samples, a mark, noise."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene
from abu_calc.simulation.scene_file import read_any
from abu_calc.simulation.scene_of_file import scene_from

SCENE = """[scene]
support = "planar"
mass_kg = 6.3
stiffness_N_per_m = [1570.55, 1570.55]
damping_N_s_per_m = [99.98, 99.98]
speed_rpm = 5800.0
imbalance_g_mm = 256.0
duration_s = {duration}
rolling_inertia = true
[[scene.race]]
pitch_radius_mm = 23.0
ball_masses_g = [16.3, 16.3, 16.3, 16.3]
ball_radius_mm = 7.9375
rolling_drag_per_s = 15
start_angles_deg = [-150.6, -110.2, -69.8, -29.4]
[scene.effects]
gravity = {{}}
ball_contact = {{ ball_radius_mm = 7.9375, restitution = 0.5 }}
run_up = {{ time_s = 0.5 }}
race_eccentricity = {{ magnitude_mm = 0.01, angle_deg = 0.0 }}
dry_rolling_friction = {{ lever_arm_mm = 0.002, ball_radius_mm = 7.9375 }}
"""


def scene_file(folder: Path, duration: float = 2.0) -> Path:
    """The scene as a designer knows it: drag, lever arm and eccentricity are guesses."""
    path = folder / "scene.toml"
    path.write_text(SCENE.format(duration=duration), encoding="utf-8")
    return path


def record(
    path: Path, file: Path, drag: float, lever: float, offset: complex, seed: int, *, mark: bool = True,
    imbalance: float = 1.0, run_up: float = 1.0, background: complex = 0.0, balls: bool = True, stiffness: float = 1.0,
    angles: tuple[float, ...] | None = None, engine: tuple[str, float] = ("compiled", 1e-6),
) -> str:  # fmt: skip
    """Write one start: drag [1/s], lever arm and offset [m] as they are; shares by which the machine differs.

    `angles`: of the balls [rad], instead of the file's; `stiffness`: with the damping ratio kept; `engine`: integrator
    and tolerance.
    """
    known = read_any(str(path)).scene  # type: ignore[union-attr]
    stiffer = {
        "stiffness_N_per_m": tuple(value * stiffness for value in known.stiffness_N_per_m or ()),
        "damping_N_s_per_m": tuple(value * math.sqrt(stiffness) for value in known.damping_N_s_per_m or ()),
    }
    scene = scene_from(known.model_copy(update=stiffer))
    rng = np.random.default_rng(seed)
    turned = float(rng.uniform(0, 2 * math.pi))
    effects = []
    for effect in scene.effects:
        if effect.name == "race_eccentricity":
            effect = replace(effect, magnitude=abs(offset), angle=float(np.angle(offset)) + turned)  # type: ignore[call-arg]
        elif effect.name == "dry_rolling_friction":
            effect = replace(effect, lever_arm=lever)  # type: ignore[call-arg]
        elif effect.name == "run_up":
            effect = replace(effect, up=scene.full_speed * run_up)  # type: ignore[call-arg]
        effects.append(effect)
    race = replace(scene.races[0], drag=drag, start_angles=angles or scene.races[0].start_angles)
    races = (race,) if balls else ()
    kept = [each for each in effects if balls or each.name in ("gravity", "run_up")]
    moved: Scene = replace(
        scene, races=races, effects=tuple(kept), imbalance_angle=turned, imbalance=scene.imbalance * imbalance
    )
    times = np.arange(0, scene.duration - 1e-9, 5e-4)
    equations = assemble(moved)
    choice = choose(equations, engine[0] if balls else "auto", engine[1])
    run = choice.integrate(equations, engine[1], times, 600_000_000)
    up = moved.full_speed
    angle = np.where(times < up, moved.speed * times**2 / 2 / up, moved.speed * (times - up / 2)) + turned
    velocity = moved.axis_velocity(run.y)[0] + 1e-3 * rng.normal(size=len(times))
    velocity += np.where(times > up, np.real(1j * moved.speed * background * np.exp(1j * angle)), 0.0)
    turns = np.floor(angle / 2 / math.pi)
    marks = np.r_[0, (np.diff(turns) > 0).astype(int)]
    rows = [
        f"{t:.4f},{1e3 * v:.2f}" + (f",{m}" if mark else "") for t, v, m in zip(times, velocity, marks, strict=True)
    ]
    file.write_text("\n".join(["t_s,vx_mm_per_s" + (",mark" if mark else ""), *rows]) + "\n", encoding="utf-8")
    return str(file)
