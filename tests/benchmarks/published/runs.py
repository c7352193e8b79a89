"""Ends of many starts of a dimensionless rotor."""

import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import planar

WORK = 1_000_000_000


def rotor(
    speed: float, mass: float, imbalance: float, damping_ratio: float, drag: float, angles: Sequence[float],
    duration: float, effects: tuple[Effect, ...] = (), ball_radius: float = 0.0,
) -> Scene:  # fmt: skip
    """Rotor of Green, Champneys and Lieven 2006: its mass, pitch radius and natural frequency are 1."""
    race = Race(1.0, (mass,) * len(angles), drag, 1.0, tuple(angles), (0.0,) * len(angles), ball_radius=ball_radius)
    return Scene(
        name="published", support=planar(1.0, (1.0, 1.0), (2 * damping_ratio,) * 2), speed=speed, imbalance=imbalance,
        imbalance_angle=0.0, races=(race,), duration=duration, start_position=(0.0, 0.0), start_velocity=(0.0, 0.0),
        effects=effects,
    )  # fmt: skip


def end(scene: Scene, tolerance: float = 1e-6) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Angles and rates of the balls at the end."""
    equations, balls = assemble(scene), len(scene.start_angles)
    times = np.array([0.0, scene.duration])
    last = choose(equations, "auto", tolerance).integrate(equations, tolerance, times, WORK).y[:, -1]
    return last[4 : 4 + balls], last[4 + balls : 4 + 2 * balls]


def left_over(scene: Scene, tolerance: float = 1e-6) -> tuple[float, float]:
    """Imbalance that is left at the end, over that of the rotor, and the largest rate of a ball over its speed."""
    angles, rates = end(scene, tolerance)
    moment = scene.races[0].ball_masses[0]
    left = abs(scene.imbalance + moment * np.exp(1j * angles).sum()) / scene.imbalance
    return float(left), float(np.abs(rates).max() / scene.speed)


def pairs(count: int) -> Iterator[tuple[float, float]]:
    """Start angles of two equal balls on a grid, each pair once, none of them in one place.

    >>> len(list(pairs(8)))
    36
    """
    grid = [math.tau * (k + 0.5) / count for k in range(count)]
    for first in range(count):
        for second in range(first, count):
            yield grid[first] + 1e-3, grid[second]
