"""Starts of a search for attractors: a designed list, and any number drawn by lot."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np

from abu_calc.dynamics.scene import Race, Scene, parted_angles
from abu_calc.dynamics.stability.stuck_speeds import natural_frequencies
from abu_calc.formulas.balls import half_angle
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si

SIDES: Final = (math.radians(20), math.radians(160))
"""Middle of the balls from the imbalance [rad]: beside the heavy side, and beside the light one."""

SHARES: Final = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Speeds of the balls in space, as shares of the rotor's; 0: not turning, 1: at rest in the race."""

BACKWARD: Final = -0.25
"""Speed of balls that start against the sense of rotation, as a share of the rotor's."""

MARGIN: Final = 1e-3
"""Room [rad] left between balls of some size at the start, so that rounded angles do not overlap."""


@dataclass(frozen=True)
class BallStart:
    """Places and speeds of all balls at the start, race by race, as a file writes them.

    `angles_deg` from the zero mark, `speeds_rpm` against the race; `drawn`: True if drawn by lot; `name`: drawn-N or
    designed-N, by which the same search finds it again.
    """

    angles_deg: tuple[float, ...]
    speeds_rpm: tuple[float, ...]
    drawn: bool
    name: str


def touching(scene: Scene) -> float:
    """Half the angle [rad] between touching balls, the largest of all races; 0 for balls without contact."""
    radius = getattr(scene.effect("ball_contact"), "ball_radius", 0.0)
    if not radius:
        return 0.0
    return max((half_angle(radius, race.pitch_radius) for race in scene.races if race.ball_masses), default=0.0)


def designed_starts(scene: Scene) -> tuple[BallStart, ...]:
    """Balls together and evenly spread, beside the heavy and the light side, at each of several speeds.

    The speeds: `SHARES` and `BACKWARD` of the rotor's, and just below each natural frequency under it.
    """
    speed = scene.speed
    shares = {*SHARES, BACKWARD, *(0.97 * each / speed for each in natural_frequencies(scene) if each < speed)}
    plan = [(share, spread, middle) for share in sorted(shares) for spread in (False, True) for middle in SIDES]
    return tuple(
        _start(scene, _arranged(scene, middle, spread=spread), [share] * _balls(scene), f"designed-{number}")
        for number, (share, spread, middle) in enumerate(plan)
    )


def drawn_starts(scene: Scene, count: int, seed: int) -> Iterator[BallStart]:
    """Balls anywhere round the race, each at any speed between standstill and the rotor's; both uniform."""
    for index in range(count):
        lot = np.random.default_rng((seed, index))
        places = lot.uniform(-math.pi, math.pi, _balls(scene))
        shares = lot.uniform(0.0, 1.0, _balls(scene))
        yield _start(scene, places.tolist(), shares.tolist(), f"drawn-{index}")


def started(scene: Scene, start: BallStart) -> Scene:
    """The scene with its balls started so."""
    speeds = [to_si(speed, "rpm") for speed in start.speeds_rpm]
    return scene.started([to_si(angle, "deg") for angle in start.angles_deg], speeds)


def _balls(scene: Scene) -> int:
    return len(scene.ball_masses)


def _arranged(scene: Scene, middle: float, *, spread: bool) -> list[float]:
    """Angles of all balls [rad], each race alike, their middle so far from the imbalance."""
    angles: list[float] = []
    beta = touching(scene)
    for race in scene.races:
        count = len(race.ball_masses)
        step = math.tau / max(count, 1) if spread else _room(race, beta)
        angles += [scene.imbalance_angle + middle + (k - (count - 1) / 2) * step for k in range(count)]
    return angles


def _room(race: Race, beta: float) -> float:
    """Angle [rad] between neighbours that are together; balls without size keep some, or none could part them."""
    return min(2 * beta + 10 * MARGIN, math.tau / max(len(race.ball_masses), 1))


def _start(scene: Scene, angles: list[float], shares: list[float], name: str) -> BallStart:
    """A start whose numbers are rounded as they are written; balls that would overlap are moved apart."""
    placed, beta = list[float](), touching(scene)
    for _, own in scene.by_race(tuple(angles)):
        least = min(2 * beta + MARGIN, math.tau / max(len(own), 1)) if beta else MARGIN
        placed += parted_angles(own, least)
    degrees = tuple(round(math.degrees(math.remainder(angle, math.tau)), 3) for angle in placed)
    speeds = tuple(round(from_si((share - 1) * scene.speed, "rpm"), 6) for share in shares)
    return BallStart(degrees, speeds, name.startswith("drawn"), name)
