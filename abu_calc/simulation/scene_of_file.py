"""Scene and effects in SI, from the tables of a scene file."""

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final, TypeVar, cast

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.lift_off import LiftOffEffect, lift_off
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.dynamics.race import Race
from abu_calc.dynamics.scene import Scene, parted_angles, placed
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.planar import Pair, planar, with_body
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport, cutting_arm, idle_arm
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.formulas.balls import INERTIA_FACTORS, half_angle
from abu_calc.formulas.swing_arm import Arm
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs import duty, scene_effects
from abu_calc.inputs.scene import SceneRace, SceneSwingArm, SceneTable

Numbers = dict[str, Any]

Table = TypeVar("Table")

POINT_MASS = 1.0
"""J of a ball whose rolling is left out."""

TOUCHING = 1e-12
"""Rounding of an angle [rad]."""


def scene_from(table: SceneTable) -> Scene:
    """The scene of a file in SI, with all its effects.

    The axis starts where the file says, a further body at rest at its place, a tilting rotor upright, an arm at rest
    where it stands; a rigid contact places the axis itself. Raises InputError, naming the key, for an arm that does not
    stand or does not reach its work.
    """
    speed, (support, position, velocity) = to_si(table.speed_rpm, "rpm"), SUPPORTS[table.support](table)
    couple, couple_angle = _couple(table)
    scene = Scene(
        name="scene",
        support=support,
        speed=speed,
        imbalance=to_si(table.imbalance_g_mm, "g_mm"),
        imbalance_angle=to_si(table.imbalance_angle_deg, "deg"),
        races=tuple(_race(table, race) for race in table.race),
        # One revolution, written with fewer digits, is one revolution.
        duration=max(table.duration_s, 2 * math.pi / speed),
        start_position=position,
        start_velocity=velocity,
        couple=couple,
        couple_angle=couple_angle,
        effects=in_order((*effects_from(table.effects), *_lift_off(table, support))),
    )
    return placed(scene)


Held = tuple[Support, tuple[float, ...], tuple[float, ...]]
"""A support, and places and velocities of its coordinates at the start."""


def _planar(table: SceneTable) -> Held:
    """Support on springs, with a further body if the file has one."""
    mass = table.mass_kg or 0.0  # which no support takes
    stiffness, damping = _pair(table.stiffness_N_per_m), _pair(table.damping_N_s_per_m)
    body = table.body
    if body is None:
        return _started(table, planar(mass, stiffness, damping))
    hung = _pair(body.stiffness_N_per_m), _pair(body.damping_N_s_per_m)
    return _started(table, with_body(mass, stiffness, damping, body.mass_kg, *hung))


def _tilting(table: SceneTable) -> Held:
    """Support on bearings."""
    rotor = _given(table.tilting)
    support = tilting(
        table.mass_kg or 0.0,
        rotor.transverse_inertia_kg_m2,
        rotor.polar_inertia_kg_m2,
        [to_si(position, "mm") for position in rotor.bearing_positions_mm],
        [_pair(pair) for pair in rotor.bearing_stiffness_N_per_m],
        [_pair(pair) for pair in rotor.bearing_damping_N_s_per_m],
        axial_inertia=rotor.ball_tilt_inertia,
    )
    return _started(table, support)


def _arm(table: SceneTable) -> Held:
    """Support on a swing arm, at rest where it stands."""
    given = _given(table.swing_arm)
    arm = Arm(
        length=to_si(given.arm_length_mm, "mm"),
        inertia=given.moment_of_inertia_kg_m2,
        joint_stiffness=given.joint_stiffness_N_per_m,
        joint_damping=given.joint_damping_N_s_per_m,
        contact_stiffness=given.contact_stiffness_N_per_m,
        friction=given.cutting_coefficient,
        disk_radius=to_si(given.wheel_radius_mm or 0.0, "mm"),  # which no arm that cuts takes
        contact_angle=to_si(given.contact_angle_deg, "deg"),
        touch_angle=to_si(given.touch_angle_deg, "deg"),
        pressing_moment=given.pressing_moment_N_m,
    )
    return _standing(given, cutting_arm(arm) if given.cutting else idle_arm(arm))


SUPPORTS: Final[Mapping[str, Callable[[SceneTable], Held]]] = {
    "planar": _planar,
    "tilting": _tilting,
    "swing-arm": _arm,
}
"""Conversion of each kind of support from its tables to SI: by the key `support` of a scene."""


def _lift_off(table: SceneTable, support: Support) -> tuple[LiftOffEffect, ...]:
    """The work of a swing arm that cuts does not pull."""
    arm = table.swing_arm
    if arm is None or not arm.cutting:
        return ()
    return lift_off(cast(SwingArmSupport, support), arm.joint_stiffness_N_per_m, to_si(arm.touch_angle_deg, "deg"))


def _given(table: Table | None) -> Table:
    """A table that the kind of support needs, so the file has it."""
    assert table is not None
    return table


def _started(table: SceneTable, support: Support) -> Held:
    """Support with its start: its axis, the first two coordinates, as the file says.

    All else is at rest at its place.
    """
    start, rest = table.initial, (0.0,) * (len(support.names) - 2)
    place = to_si(start.x_mm, "mm"), to_si(start.y_mm, "mm")
    velocity = to_si(start.vx_mm_per_s, "mm_per_s"), to_si(start.vy_mm_per_s, "mm_per_s")
    return support, (*place, *rest), (*velocity, *rest)


def _standing(table: SceneSwingArm, arm: SwingArmSupport) -> Held:
    """Swing arm at rest where it stands.

    Raises InputError if it does not stand, or if the disk does not touch the workpiece.
    """
    try:
        (angle,) = arm.resting_position()
    except InputError as error:
        raise error.at(Place(key="scene.swing_arm.contact_angle_deg")) from None
    touch = to_si(table.touch_angle_deg, "deg")
    if table.cutting and angle < touch - TOUCHING:
        raise InputError(
            "the disk is not pressed to the work",
            place=Place(key="scene.swing_arm.pressing_moment_N_m"),
            found=f"the arm rests at {from_si(angle, 'deg'):.4g}°",
            allowed=f"at least touch_angle_deg, {table.touch_angle_deg:g}°",
            remedy="a larger moment, or cutting = false",
        )
    return arm, (angle,), (0.0,)


def _pair(values: tuple[float, ...] | None) -> Pair:
    """Values that a file gives along x and y; zero if it gives none."""
    x, y = values or (0.0, 0.0)
    return x, y


def _couple(table: SceneTable) -> tuple[float, float]:
    """χ(J_t − J_p) [kg m²] and where it points [rad]."""
    rotor = table.tilting
    if rotor is None or rotor.couple_imbalance_angle is None:
        return 0.0, 0.0
    lean = rotor.couple_imbalance_angle
    return (
        lean.magnitude_rad * (rotor.transverse_inertia_kg_m2 - rotor.polar_inertia_kg_m2),
        to_si(lean.angle_deg, "deg"),
    )


def _race(table: SceneTable, race: SceneRace) -> Race:
    radius = race.ball_radius_mm or next(iter(table.effects.ball_radii_mm.values()), 0.0)
    return Race(
        pitch_radius=to_si(race.pitch_radius_mm, "mm"),
        ball_masses=tuple(to_si(mass, "g") for mass in race.ball_masses_g),
        drag=race.rolling_drag_per_s,
        inertia_factor=INERTIA_FACTORS[race.corrector] if table.rolling_inertia else POINT_MASS,
        start_angles=_angles(table, race),
        start_speeds=tuple(to_si(speed, "rpm") for speed in race.start_speeds),
        plane_offset=to_si(race.plane_offset_mm, "mm"),
        ball_radius=to_si(radius, "mm"),
    )


def _angles(table: SceneTable, race: SceneRace) -> tuple[float, ...]:
    """Start angles [rad]; balls that touch, but for the digits of the file, touch indeed."""
    angles, contact = tuple(to_si(angle, "deg") for angle in race.start_angles_deg), table.effects.ball_contact
    return parted_angles(angles, 2 * half_angle(contact.ball_radius_mm, race.pitch_radius_mm)) if contact else angles


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
