"""The same scene seen from elsewhere: turned, in a mirror, with its balls in another order, in other units."""

import math
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.planar import LinearSupport
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.supports.tilting import TiltingSupport
from tests.dynamics.examples import UNITS

Matrix = tuple[tuple[float, ...], ...]


def _rows(matrix: Any) -> Matrix:
    return tuple(tuple(row) for row in np.asarray(matrix).tolist())


def turned(scene: Scene, angle: float, effect: Callable[[Effect, float], Effect]) -> Scene:
    """All but the support's own coordinates turned by an angle, so that the state is the same but for θ + angle."""
    support = scene.support
    assert isinstance(support, LinearSupport)
    c, s = math.cos(angle), math.sin(angle)
    turn = np.kron(np.eye(len(support.race_map) // 2), np.array([[c, -s], [s, c]]))
    return replace(
        scene,
        support=replace(support, race_map=_rows(turn @ np.array(support.race_map))),
        imbalance_angle=scene.imbalance_angle + angle,
        couple_angle=scene.couple_angle + angle,
        effects=tuple(effect(one, angle) for one in scene.effects),
    )


def mirror_angle(scene: Scene) -> float:
    """An angle γ becomes this less γ: x → −x, which leaves gravity and work where they are; on an arm y → −y."""
    return 0.0 if isinstance(scene.support, SwingArmSupport) else math.pi


def mirrored(scene: Scene, effect: Callable[[Effect, float], Effect]) -> Scene:
    """The scene in a mirror, but for the sense of rotation, which a scene cannot tell.

    A linear support keeps its coordinates: what they move is mirrored.
    """
    support, whole = scene.support, mirror_angle(scene)
    if isinstance(support, SwingArmSupport):
        seen: Any = replace(support, torque=-support.torque)
    else:
        flip = np.diag((-1.0, 1.0) * (len(support.race_map) // 2))
        spinning = _rows(-np.array(support.gyroscopic)) if support.gyroscopic else ()
        seen = replace(support, race_map=_rows(flip @ np.array(support.race_map)), gyroscopic=spinning)
    races = [
        replace(
            race,
            start_angles=tuple(whole - angle for angle in race.start_angles),
            start_speeds=tuple(-speed for speed in race.start_speeds),
        )
        for race in scene.races
    ]
    return replace(
        scene,
        support=seen,
        imbalance_angle=whole - scene.imbalance_angle,
        races=tuple(races),
        couple_angle=whole - scene.couple_angle,
        effects=tuple(effect(one, whole) for one in scene.effects),
    )


def mirrored_state(scene: Scene, y: np.ndarray) -> np.ndarray:
    """The state in that mirror; what goes along the spindle, w and a linear support's coordinates stay."""
    seen, on_arm = y.copy(), isinstance(scene.support, SwingArmSupport)
    for k, name in enumerate(assemble(scene).states):
        if name.startswith(("θ", "turn", "spin", *(["arm"] if on_arm else []))):
            seen[k] = -y[k]
        if name.startswith("θ") and not name.endswith("'"):
            seen[k] += mirror_angle(scene)
    return seen


def reordered(scene: Scene, order: Sequence[int]) -> Scene:
    """The balls of the first race in another order."""
    first = scene.races[0]

    def moved(values: tuple[float, ...]) -> tuple[float, ...]:
        return tuple(values[k] for k in order)

    first = replace(
        first,
        ball_masses=moved(first.ball_masses),
        start_angles=moved(first.start_angles),
        start_speeds=moved(first.start_speeds),
    )
    return replace(scene, races=(first, *scene.races[1:]))


def coordinate_units(scene: Scene, length: float) -> np.ndarray:
    """Units of the support's coordinates: lengths, but for tilts and the arm's angle."""
    return np.array([1.0 if name.startswith(("tilt", "arm")) else length for name in scene.support.names])


def in_units(scene: Scene, length: float, mass: float, time: float) -> Scene:
    """The same scene told in other units: a number of it is multiplied by what the new unit is smaller."""
    u = coordinate_units(scene, length)
    support, energy = scene.support, mass * length**2 / time**2
    if isinstance(support, SwingArmSupport):
        told: Any = replace(
            support,
            length=support.length * length,
            inertia=support.inertia * mass * length**2,
            stiffness=support.stiffness * mass / time**2,
            damping=support.damping * mass / time,
            torque=support.torque * energy,
        )
    else:
        of_frame = np.array((length, length, 1.0, 1.0))[: len(support.race_map), None]
        told = replace(
            support,
            mass=_rows(np.array(support.mass) * energy * time**2 / np.outer(u, u)),
            damping=_rows(np.array(support.damping) * energy * time / np.outer(u, u)),
            stiffness=_rows(np.array(support.stiffness) * energy / np.outer(u, u)),
            race_map=_rows(np.array(support.race_map) * of_frame / u),
            gyroscopic=_rows(np.array(support.gyroscopic) * energy * time**2 / np.outer(u, u))
            if support.gyroscopic
            else (),
        )
        if isinstance(told, TiltingSupport):
            told = replace(told, bearings=tuple(z * length for z in told.bearings))
    return replace(
        scene,
        support=told,
        speed=scene.speed / time,
        imbalance=scene.imbalance * mass * length,
        couple=scene.couple * mass * length**2,
        races=tuple(_race_in_units(race, length, mass, time) for race in scene.races),
        duration=scene.duration * time,
        start_position=tuple((np.array(scene.start_position) * u).tolist()),
        start_velocity=tuple((np.array(scene.start_velocity) * u / time).tolist()),
        effects=tuple(_effect_in_units(effect, length, mass, time) for effect in scene.effects),
    )


def _race_in_units(race: Race, length: float, mass: float, time: float) -> Race:
    return replace(
        race,
        pitch_radius=race.pitch_radius * length,
        ball_masses=tuple(m * mass for m in race.ball_masses),
        drag=race.drag / time,
        start_speeds=tuple(v / time for v in race.start_speeds),
        plane_offset=race.plane_offset * length,
        ball_radius=race.ball_radius * length,
    )


def _effect_in_units(effect: Effect, length: float, mass: float, time: float) -> Effect:
    told = {}
    for field in fields(effect):
        if field.name in UNITS:
            a, b, c = UNITS[field.name]
            told[field.name] = getattr(effect, field.name) * length**a * mass**b * time**c
    return replace(effect, **told)
