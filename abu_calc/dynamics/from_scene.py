"""From a scene file to the scene that is simulated."""

import math
from dataclasses import replace

from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.linear import planar
from abu_calc.errors import InputError, Place
from abu_calc.sizing.case import INERTIA_FACTORS
from abu_calc.spec.scene import SceneTable
from abu_calc.units import to_si
from abu_calc.validity import Range

POINT_MASS = 1.0
"""J of a ball whose rolling is left out."""

MOST_VALUES = 4e6
"""Revolutions times states: what fits into memory, and some minutes of work."""


def scene_from(table: SceneTable) -> Scene:
    """The scene of a file in SI. Raises InputError, naming the key, for what this version does not simulate.

    Effects are not part of it: `table.effects.names` tells which the file asks for.
    """
    if table.support != "planar" or table.mass_kg is None:
        raise _not_yet("support", f'the support "{table.support}"', 'support = "planar"')
    if len(table.race) != 1:
        raise _not_yet("race", "more than one race", "one [[scene.race]]")
    kx, ky = table.stiffness_N_per_m or (0.0, 0.0)
    bx, by = table.damping_N_s_per_m or (0.0, 0.0)
    start, speed = table.initial, to_si(table.speed_rpm, "rpm")
    return Scene(
        name="scene",
        support=planar(table.mass_kg, (kx, ky), (bx, by)),
        speed=speed,
        imbalance=to_si(table.imbalance_g_mm, "g_mm"),
        imbalance_angle=to_si(table.imbalance_angle_deg, "deg"),
        race=_race(table),
        # One revolution, written with fewer digits, is one revolution.
        duration=max(table.duration_s, 2 * math.pi / speed),
        start_position=(to_si(start.x_mm, "mm"), to_si(start.y_mm, "mm")),
        start_velocity=(to_si(start.vx_mm_per_s, "mm_per_s"), to_si(start.vy_mm_per_s, "mm_per_s")),
    )


def _race(table: SceneTable) -> Race:
    race = table.race[0]
    return Race(
        pitch_radius=to_si(race.pitch_radius_mm, "mm"),
        ball_masses=tuple(to_si(mass, "g") for mass in race.ball_masses_g),
        drag=race.rolling_drag_per_s,
        inertia_factor=INERTIA_FACTORS["ball"] if table.rolling_inertia else POINT_MASS,
        start_angles=tuple(to_si(angle, "deg") for angle in race.start_angles_deg),
        start_speeds=tuple(to_si(speed, "rpm") for speed in race.start_speeds),
    )


def _not_yet(key: str, what: str, allowed: str) -> InputError:
    return InputError(f"{what} is not simulated in this version", place=Place(key=f"scene.{key}"), allowed=allowed)


def lasting(scene: Scene, duration: float | None, key: str) -> Scene:
    """The scene with another duration [s], if one is given, and not longer than can be integrated.

    At least one revolution; at most 4e6 revolutions times states. Raises RangeError, told of `key`.
    """
    wanted = scene.duration if duration is None else duration
    states = 2 * (len(scene.support.names) + len(scene.race.ball_masses))
    longest = MOST_VALUES / states * scene.revolution
    remedy = "one revolution at least; at most what this version can integrate"
    try:
        Range("duration", scene.revolution, longest, "s", remedy=remedy).check(wanted)
    except InputError as error:
        raise error.at(Place(key=key)) from None
    return replace(scene, duration=wanted)
