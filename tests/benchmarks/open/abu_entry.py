"""A case by abu-calc: python -m tests.benchmarks.open.abu_entry CASE.json [TOLERANCE]."""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.planar import planar
from tests.benchmarks.open.files import case_of

WORK = 100_000_000


def scene_of(case: dict[str, Any]) -> Scene:
    """Scene of a case: a race for each ball that differs in radius, factor or drag from the one before."""
    races: list[Race] = []
    keys = ("pitch_radii_m", "viscous_drag_rates_per_s", "ball_inertia_factors")
    columns = zip(
        *(case[key] for key in (*keys, "ball_masses_kg", "start_angles_rad", "start_rates_rad_per_s")), strict=True
    )
    for radius, drag, factor, mass, angle, rate in columns:
        last = races[-1] if races else None
        if last and (last.pitch_radius, last.drag, last.inertia_factor) == (radius, drag, factor):
            own = (*last.ball_masses, mass), (*last.start_angles, angle), (*last.start_speeds, rate)
            races[-1] = Race(radius, own[0], drag, factor, own[1], own[2])
        else:
            races.append(Race(radius, (mass,), drag, factor, (angle,), (rate,)))
    return Scene(
        name=case["name"],
        support=planar(case["mass_kg"], tuple(case["stiffness_N_per_m"]), tuple(case["damping_N_s_per_m"])),
        speed=case["speed_rad_per_s"],
        imbalance=case["imbalance_kg_m"],
        imbalance_angle=case["imbalance_angle_rad"],
        races=tuple(races),
        duration=case["times_s"][-1],
        start_position=tuple(case["start_place_m"]),
        start_velocity=tuple(case["start_velocity_m_per_s"]),
        effects=effects_of(case),
    )


def effects_of(case: dict[str, Any]) -> tuple[Effect, ...]:
    """Effects of a case that switches, in the order of the registry."""
    gravity, friction = case.get("gravity_m_per_s2", 0.0), case.get("rolling_friction", 0.0)
    effects: list[Effect] = [GravityEffect(gravity)] if gravity else []
    if friction:
        effects.append(DryRollingFrictionEffect(friction * case["ball_radius_m"], case["ball_radius_m"]))
    if "restitution" in case:
        effects.append(BallContactEffect(case["ball_radius_m"], case["restitution"]))
    return tuple(effects)


def solved(case: dict[str, Any], tolerance: float) -> list[list[float]]:
    """States [x, y, θ₁ …, x', y', θ₁' …] at the case's times."""
    equations = assemble(scene_of(case))
    run = choose(equations, "auto", tolerance).integrate(equations, tolerance, np.array(case["times_s"]), WORK)
    count = len(case["ball_masses_kg"])
    order = [0, 1, *range(4, 4 + count), 2, 3, *range(4 + count, 4 + 2 * count)]
    states: list[list[float]] = run.y[order].T.tolist()
    return states


if __name__ == "__main__":
    print(json.dumps({"states": solved(case_of(Path(sys.argv[1])), float(sys.argv[2]) if len(sys.argv) > 2 else 1e-8)}))
