"""A bank of simulated starts whose drag rate, friction and eccentricity fill a box, kept on disk and used again.

Tracks of recorded starts: the place of the axis in the rotor's frame over time, from a sensor and a mark.

Far from standstill the axis runs round once per revolution, so that one sensor tells its place: of a velocity
v = Re(iΩ w e^{iΩt}) least squares over two revolutions give w, the place in the frame of the rotor [m].
"""

import hashlib
import math
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene
from abu_calc.features.balancing.formulas import ORDERS
from abu_calc.features.balancing.recorded_run import passages
from abu_calc.formulas.balls import half_angle
from abu_calc.foundation.disk_cache import Cache
from abu_calc.foundation.errors import AbuError, InputError, NotTrustworthyError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, counted
from abu_calc.foundation.units import shown
from abu_calc.inputs.recording_columns import MotionQuantity
from abu_calc.inputs.recording_files import read_recording
from abu_calc.inputs.recording_table import decoded, table_of
from abu_calc.simulation.scene_of_file import in_order
from abu_calc.version import __version__

Array = NDArray[np.float64]
Track = NDArray[np.complex128]

REVOLUTIONS: Final = 2
"""Revolutions of a window."""
WINDOWS: Final = 60
"""Windows of a start, from the end of the run-up to the end of the record, the closer the earlier."""
CLOSER: Final = 1.7
"""Power by which windows get closer to the end of the run-up: fast decays need a tenth of a second, slow ones all."""
FULL: Final = 0.9
"""Share of the last speed above which the rotor counts as run up."""
OFF_SPEED: Final = 0.03
"""Difference of speeds, as a share, beyond which a recording is of another speed than the file's."""
LEAST_PER_REVOLUTION: Final = 6
"""Samples in a revolution, at least."""
FEWEST_PULSES: Final = 20


@dataclass(frozen=True, eq=False)
class RecordedStart:
    """One start: its track [m] at the windows, the speed [rad/s], run-up time [s] by the mark (None: unknown)."""

    file: str
    track: Track
    speed: float
    run_up: float | None
    phase_error: float
    """Largest error of the phase [rad] that all windows share: the mark is known to a sample."""

    @property
    def noise(self) -> float:
        """Noise of a component [m]: neighbouring windows of the last 39 % of the time differ by it."""
        tail = self.track[int(0.75 * len(self.track)) :]
        return math.sqrt(float(np.mean(np.abs(np.diff(tail)) ** 2)) / 4)


def window_centres(scene: Scene, file: str = "") -> Array:
    """Centres [s] of the windows, from the switching-on; the first begins when the rotor is at full speed.

    `file`: the shortest recording, which sets the duration; else the scene does.
    """
    half = REVOLUTIONS * math.pi / scene.speed
    first, last = scene.full_speed + half, scene.duration - 1.05 * half
    if last < first + 20 * half:
        raise InputError(
            "the starts are too short",
            place=Place(file) if file else Place(key="scene.duration_s"),
            found=f"{scene.duration:.3g} s",
            allowed=f"at least {scene.full_speed + 22 * half:.3g} s",
            remedy="Record until the balls have come to rest.",
        )
    return first + (last - first) * np.linspace(0, 1, WINDOWS) ** CLOSER


@dataclass(frozen=True, eq=False)
class Signal:
    """One recording as it is: motion along x [SI], its column and quantity, rate [1/s], mark (None: no such column)."""

    file: str
    column: str
    quantity: MotionQuantity
    motion: Array
    rate: float
    mark: Array | None
    clipped: bool = False

    @property
    def duration(self) -> float:
        """Duration of the record [s]."""
        return len(self.motion) / self.rate


def recorded(file: str) -> Signal:
    """The signal of a file. Raises InputError for what cannot be read."""
    recording = read_recording(file)
    axis = next((k for k, name in enumerate(recording.names) if "x" in name.lower().split("_")[0]), 0)
    motion = recording.samples[axis]
    return Signal(file, recording.names[axis], recording.quantity, motion, recording.rate, _mark_column(file),
                  recording.names[axis] in recording.clipped)  # fmt: skip


def recorded_start(signal: Signal, scene: Scene, centres: Array) -> RecordedStart:
    """The start of a recording that begins when the machine is switched on. Raises InputError for what it cannot be."""
    motion, times = signal.motion, np.arange(len(signal.motion)) / signal.rate
    place = Place(signal.file, key=signal.column)
    if signal.rate * 2 * math.pi / scene.speed < LEAST_PER_REVOLUTION:
        raise InputError(
            "sampled too slowly",
            place=place,
            found=f"{signal.rate:g} samples/s",
            allowed=f"at least {LEAST_PER_REVOLUTION * scene.speed / 2 / math.pi:.0f} samples/s",
            remedy="Record with a higher rate.",
        )
    if signal.duration < centres[-1] + REVOLUTIONS * math.pi / scene.speed:
        raise InputError(
            "the recording is too short",
            place=place,
            found=f"{signal.duration:.3g} s",
            allowed=f"at least {centres[-1] + REVOLUTIONS * math.pi / scene.speed:.3g} s",
            remedy="Record from the switching-on until the balls have come to rest.",
        )
    phase, speed, run_up, late = (
        (*_by_motion(motion, times, scene), None, 0.0)
        if signal.mark is None
        else _by_mark(signal.file, times, signal.mark)
    )
    if abs(speed / scene.speed - 1) > OFF_SPEED:
        raise InputError(
            "another speed than the file's",
            place=place,
            found=shown(speed, "rpm", ".0f"),
            allowed=f"{shown(scene.speed, 'rpm', '.0f')} within {OFF_SPEED:.0%}",
            remedy="Correct the speed of the file, or record at its speed.",
        )
    order = ORDERS[signal.quantity]
    track = np.array([_harmonic(times, motion, phase, speed, centre) for centre in centres]) / (1j * speed) ** order
    return RecordedStart(signal.file, track, speed, run_up, late)


def _mark_column(file: str) -> Array | None:
    path = Path(file)
    if path.suffix.lower() == ".wav":
        return None
    table = table_of(file, decoded(file, path.read_bytes()), [])
    names = [name.lower().partition("_")[0] for name in table.names]
    index = next((k for k, name in enumerate(names) if name in ("mark", "tacho", "key")), None)
    return None if index is None else np.asarray(table.values[:, index])


def _by_mark(file: str, times: Array, mark: Array) -> tuple[Array, float, float | None, float]:
    """Angle of the rotor [rad] at full speed, the speed [rad/s], the run-up time [s], the largest error [rad]."""
    late = times >= times[-1] * 0.4
    try:
        passed = passages(times[late], mark[late])
    except InputError as error:
        raise InputError(str(error).splitlines()[0], place=Place(file, key="mark"), remedy=error.remedy) from None
    pulses = passed.times
    if len(pulses) < FEWEST_PULSES:
        raise InputError(
            "the mark has too few pulses",
            place=Place(file, key="mark"),
            found=f"{len(pulses)}",
            allowed=f"at least {FEWEST_PULSES} in the last 60 % of the record",
            remedy="One pulse a revolution.",
        )
    counts = np.round((pulses - pulses[0]) / np.median(np.diff(pulses)))
    period, first = np.polyfit(counts, pulses, 1)
    speed = 2 * math.pi / period
    return speed * (times - first), speed, _run_up(times, mark, float(period)), passed.unsure * speed


def _run_up(times: Array, mark: Array, period: float) -> float | None:
    """Time [s] of an even run-up, from the intervals of the mark before full speed; None with fewer than three."""
    high = mark > (mark.max() + mark.min()) / 2
    rises = times[1:][high[1:] & ~high[:-1]]
    steps, middles = np.diff(rises), (rises[1:] + rises[:-1]) / 2
    slow = (steps > period / FULL) & (steps < 8 * period)
    if np.count_nonzero(slow) < 3:
        return None
    speeds = period / steps[slow]
    return float(np.sum(middles[slow] ** 2) / np.sum(middles[slow] * speeds))


def _by_motion(motion: Array, times: Array, scene: Scene) -> tuple[Array, float]:
    """Angle without a mark, from an arbitrary zero, and the speed whose tone is the largest near the scene's."""
    late = times >= times[-1] * 0.3
    t, values = times[late], motion[late] - motion[late].mean()
    trial = scene.speed * np.linspace(1 - OFF_SPEED, 1 + OFF_SPEED, 1201)
    power = np.abs(np.exp(-1j * np.outer(trial, t)) @ (values * np.hanning(len(values))))
    speed = float(trial[int(np.argmax(power))])
    return speed * times, speed


def _harmonic(times: Array, motion: Array, phase: Array, speed: float, centre: float) -> complex:
    """Complex amplitude of the motion once per revolution in one window, a constant left out."""
    half = REVOLUTIONS * math.pi / speed
    inside = (times >= centre - half) & (times < centre + half)
    terms = np.stack([np.cos(phase[inside]), np.sin(phase[inside]), np.ones(int(inside.sum()))], axis=1)
    cosine, sine, _ = np.linalg.lstsq(terms, motion[inside], rcond=None)[0]
    return complex(cosine, -sine)


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
