"""A bank of simulated starts whose drag rate, friction and eccentricity fill a box, kept on disk and used again."""

import hashlib
import math
from dataclasses import replace
from io import BytesIO
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.tracks import REVOLUTIONS, Array, Track
from abu_calc.formulas.balls import half_angle
from abu_calc.foundation.disk_cache import Cache
from abu_calc.foundation.errors import AbuError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, counted
from abu_calc.simulation.scene_of_file import in_order
from abu_calc.version import __version__

PER_REVOLUTION: Final = 24
"""Samples of a simulated revolution."""
TOLERANCE: Final = 2e-4
WORK: Final = 4_000_000
"""Evaluations that one start may take."""
LEAST_SHARE: Final = 0.9
"""Share of the starts of a bank that must give an answer."""
PARTS: Final = 4
"""Unknowns: ln h₀ (1/s), ln k_r (µm), and the components of Δ (µm) in the frame of the imbalance."""

Points = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Box:
    """Lowest and highest of each of the unknowns."""

    low: Points
    high: Points

    def scaled(self, points: Points) -> Points:
        """Points in units of the box, from −1 to 1."""
        return 2 * (points - self.low) / (self.high - self.low) - 1

    def place(self, point: Points) -> Points:
        """Place of a point between the bounds, from 0 to 1."""
        return (point - self.low) / (self.high - self.low)


WIDE: Final = Box(
    np.array([math.log(2.0), math.log(0.3), -30.0, -30.0]), np.array([math.log(100.0), math.log(30.0), 30.0, 30.0])
)
"""Drag rates from 2 to 100 1/s, lever arms from 0.3 to 30 µm, eccentricities up to 30 µm a component."""


@dataclass(frozen=True, eq=False)
class Bank:
    """Points of a box, and the track [m] of the start simulated at each, without noise."""

    box: Box
    points: Points
    tracks: NDArray[np.complex128]


def simulated_track(scene: Scene, point: Points, centres: Array, seed: int) -> Track | None:
    """Track of one start from a random place of the balls; None if it cannot be simulated.

    On a horizontal spindle the balls lie side by side at the bottom, and the rotor stands at any angle. On a
    vertical one they lie anywhere.
    """
    rng = np.random.default_rng(seed)
    horizontal = scene.effect("gravity") is not None
    turned = rng.uniform(0, 2 * math.pi) if horizontal else 0.0
    race = scene.races[0]
    count, half = len(race.ball_masses), half_angle(race.ball_radius, race.pitch_radius)
    angles = _bottom(count, half) if horizontal else _spread(count, half, rng)
    race = replace(race, drag=math.exp(point[0]), start_angles=angles)
    offset = complex(point[2], point[3]) * 1e-6
    lever, radius = math.exp(point[1]) * 1e-6, race.ball_radius
    kept = [effect for effect in scene.effects if effect.name not in ("race_eccentricity", "dry_rolling_friction")]
    ours = (
        RaceEccentricityEffect(abs(offset), float(np.angle(offset)) + turned),
        DryRollingFrictionEffect(lever, radius),
    )
    period = 2 * math.pi / scene.speed
    within = (np.arange(REVOLUTIONS * PER_REVOLUTION) / PER_REVOLUTION - REVOLUTIONS / 2) * period
    times = centres[:, None] + within
    ordered, index = np.unique(times, return_inverse=True)
    given = replace(
        scene,
        races=(race,),
        imbalance_angle=turned,
        effects=in_order((*kept, *ours)),
        duration=float(ordered[-1] + period),
    )
    equations = assemble(given)
    choice = choose(equations, "auto", TOLERANCE)
    try:
        run = choice.integrate(equations, TOLERANCE, ordered, choice.evaluations(WORK))
    except AbuError:
        return None
    motion = given.axis_velocity(run.y)[0][index.reshape(times.shape)]
    phase = scene.speed * (times - scene.full_speed / 2)
    track = 2 * np.mean(motion * np.exp(-1j * phase), axis=1) / (1j * scene.speed)
    return np.asarray(track * np.exp(-1j * turned))


def _bottom(count: int, half_angle: float) -> tuple[float, ...]:
    """Places of balls that lie side by side at the bottom."""
    return tuple(-math.pi / 2 + 2.0002 * half_angle * (k - (count - 1) / 2) for k in range(count))


def _spread(count: int, half_angle: float, rng: np.random.Generator) -> tuple[float, ...]:
    """Random places of balls that do not overlap."""
    room = 2 * math.pi - 2 * half_angle * count * 1.0001
    gaps = np.sort(rng.uniform(0, room, count))
    return tuple(float(a) for a in rng.uniform(0, 2 * math.pi) + gaps + 2.0002 * half_angle * np.arange(count))


def bank_of(scene: Scene, box: Box, count: int, centres: Array, progress: Progress) -> Bank:
    """Bank of a box; taken from disk if it was made before by this version for this scene."""
    key = hashlib.sha256(
        repr((__version__, scene, box.low.tolist(), box.high.tolist(), count, centres.tolist())).encode()
    ).hexdigest()
    cache = Cache.own("banks", "simulated starts are", "npz")
    kept = _read(cache.read(key))
    if kept is not None:
        return Bank(box, *kept)
    from scipy.stats import qmc

    shares = qmc.Sobol(PARTS, seed=11).random_base2(math.ceil(math.log2(count)))
    points = box.low + (box.high - box.low) * shares
    report = counted(progress, "bank: {} of {} starts", len(points))
    tracks = list[Track | None]()
    for number, point in enumerate(points):
        tracks.append(simulated_track(scene, point, centres, number))
        report(number + 1)
    good = [number for number, track in enumerate(tracks) if track is not None]
    if len(good) < LEAST_SHARE * len(points):
        raise NotTrustworthyError(
            f"{len(points) - len(good)} of {len(points)} starts cannot be simulated\n"
            "  See `abu simulate FILE` for the reason."
        )
    made = points[good], np.array([tracks[number] for number in good])
    cache.write(key, _written(*made))
    return Bank(box, *made)


def _read(content: bytes | None) -> tuple[Points, NDArray[np.complex128]] | None:
    """Points and tracks of a bank as it was kept; None if there is none."""
    if content is None:
        return None
    with np.load(BytesIO(content), allow_pickle=False) as file:
        return file["points"], file["tracks"]


def _written(points: Points, tracks: NDArray[np.complex128]) -> bytes:
    stream = BytesIO()
    np.savez(stream, points=points, tracks=tracks)
    return stream.getvalue()
