"""Scene and effects in SI, from the tables of a scene file."""

import math
from collections.abc import Iterable
from typing import cast

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.lift_off import lift_off
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene, parted_angles, placed
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.formulas.balls import INERTIA_FACTORS, half_angle
from abu_calc.simulation.scene_file import KINDS, SceneRace, SceneTable

POINT_MASS = 1.0
"""J of a ball whose rolling is left out."""


def scene_from(table: SceneTable) -> Scene:
    """The scene of a file in SI, with all its effects.

    The axis starts where the file says, a further body at rest at its place, a tilting rotor upright, an arm at rest
    where it stands; a rigid contact places the axis itself. Raises InputError, naming the key, for an arm that does not
    stand or does not reach its work.
    """
    support = KINDS[table.support].of(table)
    position, velocity = support.started(table)
    effects = [kind.of(getattr(table.effects, name)) for name, kind in REGISTRY if name in table.effects.names]
    couple, couple_angle = table.tilting.couple if table.tilting else (0.0, 0.0)
    if (arm := table.swing_arm) and arm.cutting:  # the work does not pull
        effects += lift_off(cast("SwingArmSupport", support), arm.joint_stiffness, arm.touch_angle)
    scene = Scene(
        name="scene",
        support=support,
        speed=table.speed,
        imbalance=table.imbalance,
        imbalance_angle=table.imbalance_angle,
        races=tuple(_race(table, race) for race in table.race),
        # One revolution, written with fewer digits, is one revolution.
        duration=max(table.duration, 2 * math.pi / table.speed),
        start_position=position,
        start_velocity=velocity,
        couple=couple,
        couple_angle=couple_angle,
        effects=in_order(effects),
    )
    return placed(scene)


def _race(table: SceneTable, race: SceneRace) -> Race:
    return Race(
        pitch_radius=race.pitch_radius,
        ball_masses=race.ball_masses,
        drag=race.rolling_drag,
        inertia_factor=INERTIA_FACTORS[race.corrector] if table.rolling_inertia else POINT_MASS,
        start_angles=_angles(table, race),
        start_speeds=race.start_speeds or (0.0,) * len(race.ball_masses),
        plane_offset=race.plane_offset,
        ball_radius=race.ball_radius or next(iter(table.effects.ball_radii.values()), 0.0),
    )


def _angles(table: SceneTable, race: SceneRace) -> tuple[float, ...]:
    """Start angles [rad]; balls that touch, but for the digits of the file, touch indeed."""
    angles, contact = race.start_angles, table.effects.ball_contact
    return parted_angles(angles, 2 * half_angle(contact.ball_radius, race.pitch_radius)) if contact else angles


def in_order(effects: Iterable[Effect]) -> tuple[Effect, ...]:
    """Effects in the order of the registry."""
    names = [name for name, _ in REGISTRY]
    return tuple(sorted(effects, key=lambda effect: names.index(effect.name)))
