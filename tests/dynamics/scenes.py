"""Scenes the tests share."""

import math
from collections.abc import Sequence

from abu_calc.dynamics.scene import LinearSupport, Race, Scene
from abu_calc.dynamics.supports.linear import planar


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
        race=Race(1.0, (ball_mass,) * balls, drag, inertia_factor, tuple(angles), (0.0,) * balls),
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
        race=Race(pitch_radius, (ball,) * 4, 15.0, 7 / 5, angles, (0.0,) * 4),
        duration=2.24,
        start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
    )


def coupled_support() -> LinearSupport:
    """Three coordinates, all coupled, the race centre a mixture of them: nothing of it is diagonal."""
    return LinearSupport(
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
        race=Race(0.8, (0.2, 0.05, 0.1, 0.3), drag, inertia_factor, (0.0, 1.0, 2.0, 4.0), (0.1, 0.0, -0.2, 0.3)),
        duration=20.0,
        start_position=(0.1, -0.2, 0.05),
        start_velocity=(0.3, 0.1, -0.2),
    )
