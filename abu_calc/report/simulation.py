"""A simulation as a result: SI in, keys and units of the interface out."""

from collections.abc import Sequence
from typing import Any

from abu_calc.analysis.idle import LeftOut
from abu_calc.analysis.simulate import Simulation
from abu_calc.dynamics.equations import assemble
from abu_calc.dynamics.scene import Scene
from abu_calc.report.outcome import finite
from abu_calc.units import from_si, wrapped_deg


def simulation_result(simulation: Simulation, left_out: Sequence[LeftOut] = ()) -> dict[str, Any]:
    """What `abu simulate` tells of one scene."""
    response, cost = simulation.response, simulation.cost
    final = response.final
    return {
        "scene": response.scene,
        "duration_s": response.duration,
        "settling_time_s": response.settling_time,
        "residual_imbalance_g_mm": from_si(response.residual_imbalance, "g_mm"),
        "axis_amplitude_mm": from_si(response.axis_amplitude, "mm"),
        "velocity_rms_mm_per_s": from_si(response.velocity_rms, "mm_per_s"),
        "level_db": response.level,
        "final": {
            "t_s": final.t,
            "x_mm": from_si(final.x, "mm"),
            "y_mm": from_si(final.y, "mm"),
            "vx_mm_per_s": from_si(final.vx, "mm_per_s"),
            "vy_mm_per_s": from_si(final.vy, "mm_per_s"),
            "ball_angles_deg": [wrapped_deg(angle) for angle in final.ball_angles],
            "ball_speeds_rpm": [from_si(speed, "rpm") for speed in final.ball_speeds],
        },
        "effects": [
            {"name": effect.name, "included": False, "weight": finite(effect.weight), "why": effect.why}
            for effect in left_out
        ],
        "cost": {
            "integrator": cost.integrator,
            "tolerance": cost.tolerance,
            "evaluations": cost.evaluations,
            "steps": cost.steps,
            "wall_s": cost.wall_s,
        },
        "error_estimate": simulation.error_estimate,
    }


def scene_model(scene: Scene) -> dict[str, Any]:
    """The SI numbers and states that were integrated."""
    return {
        "states": list(assemble(scene).states),
        "mass_kg": [list(row) for row in scene.support.mass],
        "damping_N_s_per_m": [list(row) for row in scene.support.damping],
        "stiffness_N_per_m": [list(row) for row in scene.support.stiffness],
        "speed_rad_per_s": scene.speed,
        "imbalance_kg_m": scene.imbalance,
        "imbalance_angle_rad": scene.imbalance_angle,
        "pitch_radius_m": scene.race.pitch_radius,
        "ball_masses_kg": list(scene.race.ball_masses),
        "drag_per_s": scene.race.drag,
        "inertia_factor": scene.race.inertia_factor,
        "start_angles_rad": list(scene.race.start_angles),
        "start_speeds_rad_per_s": list(scene.race.start_speeds),
        "start_position_m": list(scene.start_position),
        "start_velocity_m_per_s": list(scene.start_velocity),
        "duration_s": scene.duration,
    }
