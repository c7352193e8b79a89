"""Filimonikhin, Yatsun and others (EEJET 2018, 128265): speeds at which the loads of an autobalancer get stuck.

Their platform moves along one axis: here the other one is held by a spring ten thousand times as stiff. Published are
the number of speeds in each of four ranges of the rotor's speed, on which side of the resonance they lie, and that the
exact motion deviates from the closed speeds by as much as the ratio of the masses. Their numbers could not be had.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.stall import stuck_speeds
from abu_calc.dynamics.supports.planar import planar

MASS, DAMPING, DRAG = 0.01, 0.05, 0.02
HELD: Final = 1e4
PUBLISHED: Final = ((1, 1), (3, 1), (3, 0), (1, 0))
"""Number of stuck speeds, and how many of them are below the resonance, as the rotor turns faster."""

RATIOS: Final = (0.005, 0.01, 0.02, 0.04)
"""Mass of the balls over the whole."""


class Range(NamedTuple):
    """A range of the rotor's speed with as many stuck speeds, of which so many are below the resonance."""

    low: float
    high: float
    count: int
    below: int


class Deviation(NamedTuple):
    """Speed of stuck balls: closed, simulated, and the difference over the ratio of the masses."""

    ratio: float
    closed: float
    simulated: float
    share: float


def scene(speed: float, ball: float = MASS, drag: float = DRAG, duration: float = 400.0, rate: float = 0.0) -> Scene:
    """Two balls; rotor and balls together have the mass 1."""
    race = Race(1.0, (ball,) * 2, drag, 1.0, (0.1, 0.4), (rate,) * 2)
    return Scene(
        name="stuck", support=planar(1 - 2 * ball, (1.0, HELD), (2 * DAMPING,) * 2), speed=speed,
        imbalance=ball / 4, imbalance_angle=0.0, races=(race,), duration=duration, start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
    )  # fmt: skip


def curve(speeds: list[float]) -> list[list[float]]:
    """Stuck speeds at each speed of the rotor."""
    return [[stuck.speed for stuck in stuck_speeds(scene(speed))] for speed in speeds]


def speeds() -> list[float]:
    """Speeds of the rotor, closer about the narrow third range."""
    even = np.geomspace(0.8, 20.0, 120)
    three = [k for k, found in enumerate(curve(even.tolist())) if len(found) == 3]
    fine = np.linspace(even[three[-1]], even[three[-1] + 1], 60)
    return sorted({*even.tolist(), *fine.tolist()})


def ranges(at: list[float], found: list[list[float]]) -> list[Range]:
    """Ranges in which number and sides are the same."""
    rows: list[Range] = []
    for speed, values in zip(at, found, strict=True):
        kind = len(values), sum(value < 1.0 for value in values)
        if rows and (rows[-1].count, rows[-1].below) == kind:
            rows[-1] = rows[-1]._replace(high=speed)
        else:
            rows.append(Range(speed, speed, *kind))
    return rows


def deviation(ratio: float, speed: float = 2.0, drag: float = 0.03) -> Deviation:
    """Balls that start together near the resonance, followed until they go round evenly."""
    closed = stuck_speeds(scene(speed, ratio / 2, drag * ratio / 0.02))[0].speed
    case = scene(speed, ratio / 2, drag * ratio / 0.02, 600.0, closed - speed)
    equations, turns = assemble(case), 20 * math.tau / closed
    times = np.array([0.0, 600.0 - turns, 600.0])
    run = choose(equations, "auto", 1e-6).integrate(equations, 1e-6, times, 1_000_000_000)
    moved = float((run.y[4:6, 2] - run.y[4:6, 1]).mean()) / (times[2] - times[1]) + speed
    return Deviation(ratio, closed, float(moved), float(abs(moved / closed - 1) / ratio))


def deviations() -> list[Deviation]:
    """Four ratios of the masses."""
    return [deviation(ratio) for ratio in RATIOS]
