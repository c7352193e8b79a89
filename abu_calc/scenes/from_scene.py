"""From a scene file to the scene that is simulated."""

import math
from dataclasses import replace

from abu_calc.dynamics.equations.parameters import rotor_of
from abu_calc.dynamics.scene import Race, Scene, parted_angles
from abu_calc.dynamics.supports.body import with_body
from abu_calc.dynamics.supports.kinds import LinearSupport, Support, SwingArm
from abu_calc.dynamics.supports.linear import Pair, planar
from abu_calc.dynamics.supports.swing_arm import cutting_arm, idle_arm, resting_angle
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.errors import InputError, Place
from abu_calc.formulas.ball_ring import INERTIA_FACTORS, half_angle
from abu_calc.scenes.from_tables import effects_from, placed
from abu_calc.spec.scene import SceneRace, SceneSwingArm, SceneTable, Tilting
from abu_calc.units import from_si, to_si
from abu_calc.validity import Range

POINT_MASS = 1.0
"""J of a ball whose rolling is left out."""

TOUCHING = 1e-12
"""Rounding of an angle [rad]."""

MOST_VALUES = 4e6
"""Revolutions times states: what fits into memory, and some minutes of work."""


def scene_from(table: SceneTable) -> Scene:
    """The scene of a file in SI, with all its effects.

    The axis starts where the file says, a further body at rest at its place, a tilting rotor upright, an arm at rest
    where it stands; a rigid contact places the axis itself. Raises InputError, naming the key, for an arm that does not
    stand or does not reach its work.
    """
    speed, support = to_si(table.speed_rpm, "rpm"), _support(table)
    position, velocity = _start(table, support)
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
        effects=effects_from(table.effects),
    )
    return placed(scene)


def _support(table: SceneTable) -> Support:
    if table.swing_arm is not None:
        return _arm(table.swing_arm)
    mass = table.mass_kg or 0.0  # which no support takes
    if table.tilting is not None:
        return _tilting(mass, table.tilting)
    stiffness, damping = _pair(table.stiffness_N_per_m), _pair(table.damping_N_s_per_m)
    body = table.body
    if body is None:
        return planar(mass, stiffness, damping)
    return with_body(
        mass, stiffness, damping, body.mass_kg, _pair(body.stiffness_N_per_m), _pair(body.damping_N_s_per_m)
    )


def _arm(table: SceneSwingArm) -> SwingArm:
    joint = (
        to_si(table.arm_length_mm, "mm"),
        table.moment_of_inertia_kg_m2,
        table.joint_stiffness_N_per_m,
        table.joint_damping_N_s_per_m,
    )
    if not table.cutting:
        return idle_arm(*joint)
    return cutting_arm(
        *joint,
        table.contact_stiffness_N_per_m,
        table.cutting_coefficient,
        to_si(table.contact_angle_deg, "deg"),
        to_si(table.touch_angle_deg, "deg"),
        table.pressing_moment_N_m,
        to_si(table.wheel_radius_mm or 0.0, "mm"),  # which no arm takes
    )


def _standing(table: SceneSwingArm, arm: SwingArm) -> float:
    """Where the arm rests [rad], refused where it does not stand or the disk does not touch the work."""
    try:
        angle = resting_angle(arm)
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
    return angle


def _tilting(mass: float, table: Tilting) -> LinearSupport:
    return tilting(
        mass,
        table.transverse_inertia_kg_m2,
        table.polar_inertia_kg_m2,
        [to_si(position, "mm") for position in table.bearing_positions_mm],
        [_pair(pair) for pair in table.bearing_stiffness_N_per_m],
        [_pair(pair) for pair in table.bearing_damping_N_s_per_m],
        axial_inertia=table.ball_tilt_inertia,
    )


def _pair(values: tuple[float, ...] | None) -> Pair:
    """What a file gives along x and y; zero where it gives nothing."""
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


def _start(table: SceneTable, support: Support) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Places and velocities of the support's coordinates, of which the first two are those of the axis."""
    if table.swing_arm is not None and isinstance(support, SwingArm):
        return (_standing(table.swing_arm, support),), (0.0,)
    start, rest = table.initial, (0.0,) * (len(support.names) - 2)
    place = to_si(start.x_mm, "mm"), to_si(start.y_mm, "mm")
    velocity = to_si(start.vx_mm_per_s, "mm_per_s"), to_si(start.vy_mm_per_s, "mm_per_s")
    return (*place, *rest), (*velocity, *rest)


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


def lasting(scene: Scene, duration: float | None, key: str) -> Scene:
    """The scene with another duration [s], if one is given, and not longer than can be integrated.

    At least one revolution, and a run-up or run-down to its end; at most 4e6 revolutions times states. Raises
    RangeError, told of `key`.
    """
    wanted = scene.duration if duration is None else duration
    balls, own = len(scene.ball_masses), sum(len(effect.ball_states) for effect in scene.effects)
    turning = 0 if rotor_of(scene) == "steady" else 1
    states = 2 * (len(scene.support.names) + balls + turning) + own * balls
    longest = MOST_VALUES / states * scene.revolution
    run_up = scene.effect("run_up")
    least = max(scene.revolution, getattr(run_up, "up", 0.0) + getattr(run_up, "down", 0.0))
    remedy = "one revolution and the run-up at least; at most what this version can integrate"
    try:
        Range("duration", least, longest, "s", remedy=remedy).check(wanted)
    except InputError as error:
        raise error.at(Place(key=key)) from None
    return replace(scene, duration=wanted)
