"""Effects of a scene file, from its tables."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.spec import duty, scene_effects
from abu_calc.units import to_si

Numbers = dict[str, Any]


def effects_from(tables: scene_effects.Effects) -> tuple[Effect, ...]:
    """The effects that are on, in SI, in the order of the registry."""
    return tuple(_built(kind, NUMBERS[name](getattr(tables, name))) for name, kind in REGISTRY if name in tables.names)


def in_order(effects: Iterable[Effect]) -> tuple[Effect, ...]:
    """Effects in the order of the registry."""
    names = [name for name, _ in REGISTRY]
    return tuple(sorted(effects, key=lambda effect: names.index(effect.name)))


def _built(kind: Callable[..., Effect], numbers: Numbers) -> Effect:
    return kind(**numbers)


def _gravity(table: scene_effects.Gravity) -> Numbers:
    return {}


def _dry_rolling_friction(table: scene_effects.DryRollingFriction) -> Numbers:
    return {"lever_arm": to_si(table.lever_arm_mm, "mm"), "ball_radius": to_si(table.ball_radius_mm, "mm")}


def _ball_contact(table: scene_effects.BallContact) -> Numbers:
    return {"ball_radius": to_si(table.ball_radius_mm, "mm"), "restitution": table.restitution}


def _race_eccentricity(table: scene_effects.RaceEccentricity) -> Numbers:
    return {"magnitude": to_si(table.magnitude_mm, "mm"), "angle": to_si(table.angle_deg, "deg")}


def _grinding_contact(table: scene_effects.GrindingContact) -> Numbers:
    return {
        "press_force": table.press_force_N,
        "cutting_coefficient": table.cutting_coefficient,
        "contact": table.contact,
        "contact_stiffness": table.contact_stiffness_N_per_m if table.contact == "compliant" else 0.0,
        "rotation_sense": table.rotation_sense,
        "runout": to_si(table.runout_mm, "mm"),
        "runout_angle": to_si(table.runout_angle_deg, "deg"),
        "wheel_radius": to_si(table.wheel_radius_mm or 0.0, "mm"),
        "plane_offset": to_si(table.plane_offset_mm, "mm"),
    }


def _run_up(table: scene_effects.SceneRunUp) -> Numbers:
    return {"up": table.time_s or 0.0, "down": table.run_down_s or 0.0, "inertia": table.rotor_inertia_kg_m2 or 0.0}


def motor_numbers(table: duty.Motor) -> Numbers:
    """A motor in SI, as the effect `motor` takes it."""
    return {
        "stall_torque": table.stall_torque_N_m,
        "no_load_speed": to_si(table.no_load_speed_rpm, "rpm"),
        "inertia": table.rotor_inertia_kg_m2,
    }


def _transverse_motion(table: scene_effects.TransverseMotion) -> Numbers:
    return {
        "groove_radius": to_si(table.groove_radius_mm, "mm"),
        "ball_radius": to_si(table.ball_radius_mm, "mm"),
        "axial_runout": to_si(table.axial_runout_mm, "mm"),
        "free_spin": table.free_spin,
    }


NUMBERS: Final[Mapping[str, Callable[[Any], Numbers]]] = {
    "gravity": _gravity,
    "dry_rolling_friction": _dry_rolling_friction,
    "ball_contact": _ball_contact,
    "race_eccentricity": _race_eccentricity,
    "grinding_contact": _grinding_contact,
    "run_up": _run_up,
    "motor": motor_numbers,
    "transverse_motion": _transverse_motion,
}
"""Conversion of each effect's table to its numbers in SI."""
