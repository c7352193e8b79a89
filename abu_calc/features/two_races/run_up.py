"""Amplitude against speed of a simulated run-up of two races, with balls and without autobalancers."""

import math
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene, without
from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.features.two_races.start_cases import StartCase, scene_of
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.simulation.simulate import simulate

PER_TURN: Final = 24
"""Samples of a revolution at full speed."""
AFTER: Final = 0.1
"""Part of the run-up that is simulated after it, at full speed."""
REVOLUTIONS: Final = 30
"""Least number of revolutions at full speed."""
MOST_POINTS: Final = 150
"""Points of a curve; of the revolutions between two of them the largest amplitude counts."""
OF_BALLS: Final = ("dry_rolling_friction", "ball_contact", "race_eccentricity")
"""Effects that a machine without autobalancers does not have."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class RunUpAmplitude:
    """Largest displacement of any place [m] about its mean in a revolution, at a speed [rad/s]; None: not simulated."""

    speed: float
    with_balls: float | None
    without: float


def run_up_amplitudes(design: TwoRaceDesign, accuracy: float) -> tuple[RunUpAmplitude, ...]:
    """The run-up with the balls together, imbalances of unknown phase in phase; both machines run up alike."""
    start = StartCase("run-up", 1.0, (0.0,) * design.case.unknown_phases)
    scene = scene_of(design, start)
    more = max(AFTER * scene.full_speed, REVOLUTIONS * scene.revolution)
    scene = replace(scene, duration=min(scene.duration, scene.full_speed + more))
    bare = replace(scene_of(replace(design, case=design.bare), start), races=(), duration=scene.duration)
    bare = without(bare, OF_BALLS)
    with_balls, empty = _amplitudes(scene, design, accuracy), _amplitudes(bare, design, accuracy)
    if empty is None:
        return ()
    return tuple(
        RunUpAmplitude(speed, None if with_balls is None else with_balls[index][1], amplitude)
        for index, (speed, amplitude) in enumerate(empty)
    )


def _amplitudes(scene: Scene, design: TwoRaceDesign, accuracy: float) -> list[tuple[float, float]] | None:
    """Speed and largest amplitude of each group of revolutions; None if the run cannot be trusted."""
    times = np.arange(0.0, scene.duration, scene.revolution / PER_TURN)
    try:
        run = simulate(scene, accuracy, times)
    except NotTrustworthyError:
        return None
    states = run.trajectory.at(times)
    turn, speed = scene.rotor.turning(times, states, scene.speed)
    turns = np.floor(turn / (2 * math.pi)).astype(int)
    last = int(turns[-1])
    places = [scene.axis_place(states, held.place) for held in design.case.places]
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
