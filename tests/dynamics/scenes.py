"""Scenes the tests share."""

import math
from collections.abc import Sequence
from dataclasses import replace

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.planar import LinearSupport, PlanarSupport, planar
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.supports.tilting import tilting


def dimensionless(
    speed: float,
    ball_mass: float,
    imbalance: float,
    damping_ratio: float,
    drag: float,
    angles: Sequence[float],
    duration: float,
    *,
    stiffness: tuple[float, float] = (1.0, 1.0),
    inertia_factor: float = 1.0,
) -> Scene:
    """Planar rotor of Green, Champneys & Lieven 2006: mass (without balls), pitch radius, natural frequency are 1."""
    balls = len(angles)
    return Scene(
        name="dimensionless",
        support=planar(1.0, stiffness, (2 * damping_ratio, 2 * damping_ratio)),
        speed=speed,
        imbalance=imbalance,
        imbalance_angle=0.0,
        races=(Race(1.0, (ball_mass,) * balls, drag, inertia_factor, tuple(angles), (0.0,) * balls),),
        duration=duration,
        start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
    )


def straight_grinder() -> Scene:
    """6.4 kg with its four 16 mm balls on springs of 2.5 Hz, 5800 rpm, balls bunched 20° ahead of the imbalance."""
    ball, pitch_radius, frequency = 0.016728, 0.023, 2 * math.pi * 2.5
    stiffness, damping = 6.4 * frequency**2, 2 * 0.5 * frequency * 6.4
    step = 2 * math.asin(0.008 / pitch_radius)
    angles = tuple(math.radians(20) + step * (k - 1.5) for k in range(4))
    return Scene(
        name="idle",
        support=planar(6.4 - 4 * ball, (stiffness, stiffness), (damping, damping)),
        speed=5800 * math.pi / 30,
        imbalance=256e-6,
        imbalance_angle=0.0,
        races=(Race(pitch_radius, (ball,) * 4, 15.0, 7 / 5, angles, (0.0,) * 4),),
        duration=2.24,
        start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
    )


def coupled_support() -> LinearSupport:
    """Three coordinates, all coupled, the race centre a mixture of them: nothing of it is diagonal."""
    return PlanarSupport(
        mass=((2.0, 0.3, 0.1), (0.3, 1.5, -0.2), (0.1, -0.2, 0.8)),
        damping=((0.3, 0.1, 0.0), (0.1, 0.4, 0.05), (0.0, 0.05, 0.2)),
        stiffness=((5.0, -1.0, 0.5), (-1.0, 4.0, 0.2), (0.5, 0.2, 3.0)),
        race_map=((1.0, 0.0, 0.4), (0.1, 1.0, -0.3)),
        names=("a", "b", "c"),
    )


def coupled_scene(inertia_factor: float = 1.4, drag: float = 0.7) -> Scene:
    """Four unequal balls on the coupled support, everything switched on."""
    return Scene(
        name="coupled",
        support=coupled_support(),
        speed=1.7,
        imbalance=0.3,
        imbalance_angle=0.4,
        races=(Race(0.8, (0.2, 0.05, 0.1, 0.3), drag, inertia_factor, (0.0, 1.0, 2.0, 4.0), (0.1, 0.0, -0.2, 0.3)),),
        duration=20.0,
        start_position=(0.1, -0.2, 0.05),
        start_velocity=(0.3, 0.1, -0.2),
    )


def hand_support() -> LinearSupport:
    """A mass on springs and dampers on the rotor's mass: four coordinates, two of which the balls do not feel."""

    def both(a: float, b: float, c: float) -> tuple[tuple[float, ...], ...]:
        return ((a, 0.0, c, 0.0), (0.0, a, 0.0, c), (c, 0.0, b, 0.0), (0.0, c, 0.0, b))

    return PlanarSupport(
        mass=both(2.0, 0.5, 0.0),
        damping=both(0.4, 0.3, -0.2),
        stiffness=both(10.0, 3.0, -3.0),
        race_map=((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0)),
        names=("x", "y", "hand_x", "hand_y"),
    )


def bearings(axial_inertia: bool) -> LinearSupport:
    """A rotor with gyroscopic moments on two unlike bearings, not about its middle."""
    stiffness, damping = ((3.0, 4.0), (2.0, 5.0)), ((0.1, 0.2), (0.3, 0.15))
    return tilting(2.0, 0.7, 0.5, (-0.3, 0.5), stiffness, damping, axial_inertia)


SUPPORTS: dict[str, Support] = {
    "planar": planar(2.0, (5.0, 3.0), (0.3, 0.2)),
    "coupled": coupled_support(),
    "hand": hand_support(),
    "tilting": bearings(axial_inertia=False),
    "tilting, axial": bearings(axial_inertia=True),
    "swing arm": SwingArmSupport(length=1.3, inertia=9.0, stiffness=5.0, damping=0.3, torque=0.7),
}
"""Every kind of support, in numbers near 1, with nothing that is symmetric by chance."""

ROTORS: dict[str, tuple[Effect, ...]] = {
    "steady": (),
    "guided": (RunUpEffect(3.0, 2.0),),
    "driven": (MotorEffect(2.0, 3.0, 6.0),),
}
"""Every way in which a rotor turns."""


def scene_on(support: str, *effects: Effect) -> Scene:
    """Unequal balls in two unlike races, an imbalance, and a couple and places along the spindle where it tilts."""
    held = SUPPORTS[support]
    offsets, couple = ((0.4, -0.3), 0.2) if held.couples else ((0.0, 0.0), 0.0)
    rest = (0.0,) * len(held.names)
    return Scene(
        name=support,
        support=held,
        speed=1.7,
        imbalance=0.3,
        imbalance_angle=0.4,
        races=(
            Race(0.8, (0.2, 0.05, 0.1), 0.7, 1.4, (0.0, 1.5, 3.0), (0.1, 0.0, -0.2), offsets[0], 0.15),
            Race(0.6, (0.15, 0.25), 0.5, 1.5, (0.5, 4.0), (0.0, 0.3), offsets[1], 0.1),
        ),
        duration=20.0,
        start_position=rest,
        start_velocity=rest,
        couple=couple,
        couple_angle=1.0 if couple else 0.0,
        effects=effects,
    )


def with_effects(scene: Scene, *effects: Effect) -> Scene:
    """The scene with these effects alone."""
    return replace(scene, effects=effects)
