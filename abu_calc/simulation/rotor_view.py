"""A run as seen in the turning rotor: balls on their way to rest, the axis, and the residual imbalance.

Amplitude against speed of a simulated run-up, with balls and without: data of a figure.
"""

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.rotor import balls_of
from abu_calc.dynamics.scene import Scene, without
from abu_calc.dynamics.trajectory import Trajectory, merged
from abu_calc.foundation import patience
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, in_units, level_from_velocity
from abu_calc.simulation.response import beginning, settling_times
from abu_calc.simulation.simulate import simulate

Array = NDArray[np.float64]
Level = Callable[[float], float]
"""Level [dB] that is looked at, as a function of a velocity of the axis, rms [m/s]."""

MOST: Final = 500
"""Samples that a picture needs."""


@dataclass(frozen=True, eq=False)
class RotorView:
    """Thinned samples of a run that was made, without half a revolution at both ends.

    Angles from the rotor's zero mark in its sense of rotation.
    x, y: how the axis goes round, along axes that turn with the rotor: what it drifts, its mean over a revolution, is
    taken off. `ball_angles_deg`: a row for each ball. `level_db`: by the velocity over a revolution, in the larger of
    x and y. `speed_rpm`: None at a constant speed. `pitch_radii_mm`, `ball_radii_mm`: of each ball; a radius that is
    not known is 0.
    """

    t_s: Array
    x_um: Array
    y_um: Array
    ball_angles_deg: Array
    residual_g_mm: Array
    level_db: Array
    speed_rpm: Array | None
    imbalance_angle_deg: float
    pitch_radii_mm: tuple[float, ...]
    ball_radii_mm: tuple[float, ...]

    @classmethod
    def of(cls, scene: Scene, run: Trajectory, level: Level = level_from_velocity, most: int = MOST) -> Self | None:
        """View of a run, in at most `most` samples.

        If the run is too long, its beginning is shown; None if that is not held.
        """
        held = _held(run, settling_times(scene), beginning(scene))
        if held is None:
            return None
        times, states = held
        turn, speed = scene.rotor.turning(times, states, scene.speed)
        inner = (turn >= turn[0] + np.pi) & (turn <= turn[-1] - np.pi)
        if np.count_nonzero(inner) < 2:
            return None
        place = scene.axis_place(states)
        swinging = (place - _over_a_turn(place, times, turn))[:, inner]
        squares = _over_a_turn(scene.axis_velocity(states) ** 2, times, turn)[:, inner]
        times, turn, states = times[inner], turn[inner], states[:, inner]
        # Denser at the start, where all moves.
        index = merged(((len(times) - 1) * np.linspace(0, 1, most) ** 2).round().astype(np.intp))
        seen = (from_si(1.0, "um") * (swinging[0] + 1j * swinging[1]) * np.exp(-1j * turn))[index]
        angles = _angles(scene, states[:, index])
        changes = bool(scene.rotor.states) or scene.start_speed != scene.speed
        balls = balls_of(scene.races)
        motion = in_units(
            {
                "ball_angles_deg": angles,
                "residual_g_mm": np.abs(scene.total_imbalance(angles)),
                "speed_rpm": np.broadcast_to(speed, inner.shape)[inner][index],
            }
        )
        radii = in_units({"pitch_radii_mm": balls.radii, "ball_radii_mm": balls.sizes})
        pitch, sizes = (tuple(each.tolist()) for each in radii.values())
        return cls(
            t_s=times[index],
            x_um=seen.real,
            y_um=seen.imag,
            ball_angles_deg=motion["ball_angles_deg"],
            residual_g_mm=motion["residual_g_mm"],
            level_db=_levels(squares[:, index], level),
            speed_rpm=motion["speed_rpm"] if changes else None,
            imbalance_angle_deg=from_si(scene.imbalance_angle, "deg"),
            pitch_radii_mm=pitch,
            ball_radii_mm=sizes,
        )


def _held(trajectory: Trajectory, *choices: Array) -> tuple[Array, Array] | None:
    """The first of these times that are all held, and the states then."""
    for times in choices:
        with suppress(ValueError):
            return times, trajectory.at(times)
    return None


def _angles(scene: Scene, states: Array) -> Array:
    """Angles of the balls in the rotor [rad]."""
    first = 2 * len(scene.support.names)
    return np.asarray(states[first : first + len(scene.ball_masses)])


def _levels(squares: Array, level: Level) -> Array:
    """Levels of the mean squares of both velocities; nothing moves at less than a picometre per second."""
    velocities = np.sqrt(np.maximum(squares.max(axis=0), 1e-24))
    return np.array([level(velocity) for velocity in velocities.tolist()])


def _over_a_turn(values: Array, times: Array, turn: Array) -> Array:
    """Means over the revolution about each time, as far as there is one."""
    steps = np.diff(times) * (values[:, 1:] + values[:, :-1]) / 2
    sums = np.concatenate((np.zeros((len(values), 1)), np.cumsum(steps, axis=1)), axis=1)
    first, last = (np.interp(turn + half, turn, times) for half in (-np.pi, np.pi))
    means = [(np.interp(last, times, row) - np.interp(first, times, row)) / (last - first) for row in sums]
    return np.array(means)


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
