"""Amplitude against speed of a simulated run-up, with balls and without: data of a figure."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene, without
from abu_calc.foundation import patience
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.simulation.simulate import simulate

PER_TURN: Final = 24
"""Samples of a revolution at full speed."""
AFTER: Final = 0.1
"""Part of the run-up that is simulated after it, at full speed."""
REVOLUTIONS: Final = 30
"""Least number of revolutions at full speed."""
MOST_POINTS: Final = 150
"""Points of a curve; of the revolutions between two of them the largest amplitude counts."""
MOST_SAMPLES: Final = 400_000
"""Samples of a run: 16 000 revolutions. Longer run-ups have no such figure."""
OF_BALLS: Final = ("dry_rolling_friction", "ball_contact", "race_eccentricity", "transverse_motion")
"""Effects that a machine without balls does not have."""

Array = NDArray[np.float64]
Course = list[tuple[float, float]]
"""Speed [rad/s] and largest displacement of any place about its mean in a revolution [m], one pair a point."""


def until_shortly_after(scene: Scene) -> Scene:
    """The scene of a run-up, ended soon after full speed."""
    more = max(AFTER * scene.full_speed, REVOLUTIONS * scene.revolution)
    return replace(scene, duration=min(scene.duration, scene.full_speed + more))


def without_balls(scene: Scene) -> Scene:
    """The scene without its balls, and without what acts on them."""
    return without(replace(scene, races=()), OF_BALLS)


def both_courses(scene: Scene, accuracy: float) -> tuple[Course, Course]:
    """Courses of a run-up with balls and without them, at the planes of its races.

    Empty where a run cannot be trusted, is too long for a figure, or the time of --patience is over.
    """
    planes = tuple(dict.fromkeys(race.plane_offset for race in scene.races)) or (0.0,)
    scene = until_shortly_after(scene)
    if patience.over() or scene.duration / scene.revolution * PER_TURN > MOST_SAMPLES:
        return [], []
    with_balls = course(scene, planes, accuracy) if scene.races else None
    return with_balls or [], course(without_balls(scene), planes, accuracy) or []


MOST_WORK: Final = 1_000_000
"""Work of a run-up that is only drawn: five seconds of compiled code, more with many balls."""


def course(scene: Scene, planes: Sequence[float], accuracy: float) -> Course | None:
    """Speed and largest amplitude of each group of revolutions; None if the run cannot be trusted."""
    times = np.arange(0.0, scene.duration, scene.revolution / PER_TURN)
    try:
        run = simulate(scene, accuracy, times, MOST_WORK)
    except NotTrustworthyError:
        return None
    states = run.trajectory.at(times)
    turn, speed = scene.rotor.turning(times, states, scene.speed)
    turns = np.floor(turn / (2 * math.pi)).astype(int)
    last = int(turns[-1])
    places = [scene.axis_place(states, plane) for plane in planes]
    points = [_revolution(places, np.asarray(speed), turns == revolution) for revolution in range(last)]
    step = max(1, math.ceil(len(points) / MOST_POINTS))
    groups = [points[first : first + step] for first in range(0, len(points), step)]
    return [(group[len(group) // 2][0], max(amplitude for _, amplitude in group)) for group in groups]


def _revolution(places: list[Array], speed: Array, inside: NDArray[np.bool_]) -> tuple[float, float]:
    """Mean speed of a revolution, and the largest displacement of any place from its mean."""
    amplitude = 0.0
    for place in places:
        path = place[:, inside]
        off = path - path.mean(axis=1, keepdims=True)
        amplitude = max(amplitude, float(np.sqrt((off**2).sum(axis=0)).max()))
    return float(np.broadcast_to(speed, inside.shape)[inside].mean()), amplitude
