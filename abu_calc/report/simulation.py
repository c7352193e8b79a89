"""A simulation as a result: SI in, keys and units of the interface out."""

from typing import Any

from abu_calc.analysis.audit import Audit
from abu_calc.analysis.ledger import Ledger
from abu_calc.analysis.response import FinalState
from abu_calc.analysis.simulate import Cost, Simulation
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Scene
from abu_calc.report.effects import ledger_result
from abu_calc.report.outcome import finite
from abu_calc.units import from_si, wrapped_deg


def simulation_result(simulation: Simulation, ledger: Ledger) -> dict[str, Any]:
    """What `abu simulate` tells of one scene."""
    response = simulation.response
    result: dict[str, Any] = {
        "scene": response.scene,
        "duration_s": response.duration,
        "settling_time_s": response.settling_time,
        "residual_imbalance_g_mm": from_si(response.residual_imbalance, "g_mm"),
        "axis_amplitude_mm": from_si(response.axis_amplitude, "mm"),
        "velocity_rms_mm_per_s": from_si(response.velocity_rms, "mm_per_s"),
        "level_db": response.level,
        "unbalanced_amplitude_mm": from_si(response.unbalanced_amplitude, "mm"),
        "largest_amplitude_mm": from_si(response.largest_amplitude, "mm"),
        "final": _final(response.final),
        "effects": ledger_result(ledger.entries),
        "cost": _cost(simulation.cost),
        "error_estimate": simulation.error_estimate + ledger.spared,
        "rung": simulation.rung,
        "envelope": {"error_estimate": finite(simulation.offered.error), "why": simulation.offered.why},
    }
    if response.bearing_amplitudes:
        amplitudes = [from_si(value, "mm") for value in response.bearing_amplitudes]
        result["bearing_amplitudes_mm"] = result["final"]["bearing_amplitudes_mm"] = amplitudes
    return result


def _final(final: FinalState) -> dict[str, Any]:
    told: dict[str, Any] = {
        "t_s": final.t,
        "x_mm": from_si(final.x, "mm"),
        "y_mm": from_si(final.y, "mm"),
        "vx_mm_per_s": from_si(final.vx, "mm_per_s"),
        "vy_mm_per_s": from_si(final.vy, "mm_per_s"),
        "ball_angles_deg": [wrapped_deg(angle) for angle in final.ball_angles],
        "ball_speeds_rpm": [from_si(speed, "rpm") for speed in final.ball_speeds],
        "rotor_speed_rpm": from_si(final.speed, "rpm"),
    }
    if final.tilt is not None:
        about_y, about_minus_x = final.tilt
        told["tilt_x_mrad"], told["tilt_y_mrad"] = -1000 * about_minus_x, 1000 * about_y
    if final.arm_angle is not None:
        told["arm_angle_mrad"] = 1000 * final.arm_angle
    return told


def _cost(cost: Cost) -> dict[str, Any]:
    return {
        "integrator": cost.integrator,
        "tolerance": cost.tolerance,
        "evaluations": cost.evaluations,
        "steps": cost.steps,
        "events": cost.events,
        "wall_s": cost.wall_s,
        "why": cost.why,
    }


def audit_result(audit: Audit) -> dict[str, Any]:
    """What an audit found beside what was promised."""
    return {
        "difference": audit.difference,
        "promise": audit.promise,
        "effects": list(audit.effects),
        "evaluations": audit.evaluations,
        "wall_s": audit.wall_s,
    }


def scene_model(scene: Scene) -> dict[str, Any]:
    """The SI numbers and states that are integrated."""
    return {
        "states": list(assemble(scene).states),
        **scene.support.model(),
        "speed_rad_per_s": scene.speed,
        "imbalance_kg_m": scene.imbalance,
        "imbalance_angle_rad": scene.imbalance_angle,
        "couple_kg_m2": scene.couple,
        "couple_angle_rad": scene.couple_angle,
        "races": [
            {
                "pitch_radius_m": race.pitch_radius,
                "plane_offset_m": race.plane_offset,
                "ball_masses_kg": list(race.ball_masses),
                "ball_radius_m": race.ball_radius,
                "drag_per_s": race.drag,
                "inertia_factor": race.inertia_factor,
                "start_angles_rad": list(race.start_angles),
                "start_speeds_rad_per_s": list(race.start_speeds),
            }
            for race in scene.races
        ],
        "effects": [effect.name for effect in scene.effects],
        "start_position": list(scene.start_position),
        "start_velocity": list(scene.start_velocity),
        "duration_s": scene.duration,
    }
