"""One start followed to its end: balanced, stuck, limit cycle, resting off balance, or not steady.

The run is looked at after one, two, four and eight times its length. It ends as soon as the two halves of the last
quarter agree.

Starts of a search for attractors: a designed list, and any number drawn by lot.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Race, Scene, parted_angles
from abu_calc.dynamics.stability.stall import natural_frequencies, stuck_speeds
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.dynamics.trajectory import Samples, Sampling, Trajectory, Until, merged
from abu_calc.formulas.balls import half_angle
from abu_calc.foundation import patience
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.simulation.run_checks import SLIPPING, allowed_of_scene

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


Array = NDArray[np.float64]
Kind = Literal["balanced", "stuck", "limit-cycle", "resting", "chaotic", "undecided"]

TOLERANCE: Final = 1e-5
CLOSER: Final = 1e-2
"""Factor on the tolerance of the run that confirms an example."""

WORK: Final = 2_000_000
"""Work of one run."""

LOOKS: Final = (1, 2, 4, 8)
"""Lengths of the run, in multiples of the first, after which the end is judged."""

SHORTEST: Final = 60
"""Least number of revolutions of the first length."""

WINDOW: Final = 0.25
WIDEST: Final = 400
"""Share of the run that is judged, and the most revolutions of it."""

PER_TURN: Final = 24
"""Samples in a revolution of the rotor."""

STILL: Final = 2e-4
"""Share of the rotor's speed: balls rest in the race if none moves faster on the mean."""

SWUNG: Final = 0.1
"""Mean speed of balls that swing over its variation: with more they still settle, or go round too slowly to tell."""

STANDING: Final = 2e-3
"""Share of the rotor's speed: balls stand still in space if they turn no faster."""

SHAKEN: Final = 0.02
"""Share of the rotor's speed: balls rest or stall if the speed of none varies more (rms)."""

STEADY_SPEED, STEADY_VARIATION, STEADY_IMBALANCE, STEADY_LEVEL = 0.005, 0.02, 0.05, 0.12
"""Permitted differences of the two halves: mean ball speeds and their rms variation over the rotor's speed, mean
residual imbalance and velocity over themselves (1 dB)."""

STRICT: Final = 0.1
"""Factor on them for balls that do not go round against the race."""

CREEP: Final = 0.005
"""The same of the residual imbalance of balls at rest: less, as they may creep to balance."""

NEAR: Final = 0.2
"""Relative distance within which a ball's speed belongs to a natural frequency."""

CLOSED: Final = 0.05
"""Relative distance within which a ball's speed belongs to a closed stuck speed."""

DISTURBED: Final = 1e-6
"""Angle [rad] by which the disturbed twin of a run begins apart."""

CHAOTIC: Final = 1e5
"""Growth of that angle beyond which a motion is chaotic."""


@dataclass(frozen=True)
class EndState:
    """The end of one start; `frequency` [rad/s]: the natural frequency at which balls are stuck, None otherwise.

    `ball_speeds` [rad/s] in space, means over the window, ascending in each race; `velocity` [m/s] rms in the larger
    of x and y; `residual` [kg m], mean of the window; `end`: the state at the end, at time `duration` [s]; `reason`: of
    an end that is undecided.
    """

    start: BallStart
    kind: Kind
    ball_speeds: tuple[float, ...] = ()
    velocity: float = 0.0
    residual: float = 0.0
    frequency: float | None = None
    duration: float = 0.0
    end: tuple[float, ...] = ()
    reason: str = ""


@dataclass(frozen=True)
class HalfWindow:
    """Means of a half of the window: ball speeds and their rms variation [rad/s], residual [kg m], velocity [m/s]."""

    speeds: Array
    variation: Array
    residual: float
    velocity: float

    @classmethod
    def of(cls, scene: Scene, states: Array) -> "HalfWindow":
        """Means of some states, equally spaced in time."""
        size, count = len(scene.support.names), len(scene.ball_masses)
        angles, rates = states[2 * size : 2 * size + count], states[2 * size + count : 2 * size + 2 * count]
        means, variation = rates.mean(axis=1), rates.std(axis=1)
        order = _order(scene, means)
        velocity = float(np.sqrt((scene.axis_velocity(states) ** 2).mean(axis=1)).max())
        return cls(means[order], variation[order], float(np.abs(scene.total_imbalance(angles)).mean()), velocity)

    def like(self, other: "HalfWindow", speed: float, reference: float, strict: float) -> bool:
        """True if the motion is steady: two halves of a window differ by no more than allowed, times `strict`."""
        apart = float(np.abs(self.speeds - other.speeds).max(initial=0.0)) / speed
        varied = float(np.abs(self.variation - other.variation).max(initial=0.0)) / speed
        drift = abs(self.residual - other.residual) / max(reference, other.residual)
        louder = abs(self.velocity - other.velocity) / max(other.velocity, 1e-300)
        limits = STEADY_SPEED, STEADY_VARIATION, STEADY_IMBALANCE, STEADY_LEVEL
        differences = apart, varied, drift, louder
        return all(value <= strict * limit for value, limit in zip(differences, limits, strict=True))


def _order(scene: Scene, speeds: Array) -> NDArray[np.intp]:
    """Indices that sort the balls of each race by speed."""
    places = np.arange(len(scene.ball_masses), dtype=np.intp)
    parts = [own[np.argsort(speeds[own], kind="stable")] for _, own in scene.by_race(places)]
    return np.concatenate([places[:0], *parts])


@dataclass(frozen=True)
class Follower:
    """Follows starts of one scene at constant speed; `length` [s]: the first length of a run, whole revolutions."""

    scene: Scene
    length: float
    frequencies: tuple[float, ...]
    stuck: tuple[float, ...]

    @classmethod
    def of(cls, scene: Scene) -> "Follower":
        """Follower of a scene without run-up."""
        turns = max(math.ceil(scene.duration / scene.revolution - 1e-9), SHORTEST)
        stuck = tuple(each.speed for each in stuck_speeds(scene, touching(scene)) if each.holds)
        below = tuple(each for each in stuck if each < (1 - SLIPPING) * scene.speed)
        return cls(scene, turns * scene.revolution, natural_frequencies(scene), below)

    def end_of(self, start: BallStart, closeness: float = 1.0) -> EndState:
        """End state of a start; `closeness`: factor on the tolerance. A run that fails is undecided, with a reason."""
        scene = started(self.scene, start)
        try:
            run = self._run(scene, TOLERANCE * closeness)
        except NotTrustworthyError as error:
            reason = "time was up" if patience.over() else str(error).splitlines()[0]
            return EndState(start, "undecided", reason=reason)
        return self._judged(start, scene, run)

    def grows(self, state: EndState) -> float:
        """Growth of a disturbance of one ball's angle over one further length of run; 0 if that cannot be run."""
        if self.scene.ball_states:
            return 0.0
        size, count = len(self.scene.support.names), len(self.scene.ball_masses)
        ends = []
        for moved in (0.0, DISTURBED):
            angles = np.array(state.end[2 * size : 2 * size + count])
            angles[0] += moved
            scene = self._from_end(state, angles)
            try:
                run = _integrated(scene, TOLERANCE * CLOSER, Sampling(np.array([self.length])))
            except NotTrustworthyError:
                return 0.0
            ends.append(run.y[2 * size : 2 * size + count, -1])
        apart = np.angle(np.exp(1j * (ends[1] - ends[0])))
        return float(np.abs(apart).max()) / DISTURBED

    def _from_end(self, state: EndState, angles: Array) -> Scene:
        """The scene started from an end state, which is a whole number of revolutions after its start."""
        size, count = len(self.scene.support.names), len(self.scene.ball_masses)
        # Balls that touch are parted a little, as a disturbance may push one into its neighbour.
        room, places = 2 * touching(self.scene) + 2 * DISTURBED, list[float]()
        for _, own in self.scene.by_race(tuple(angles.tolist())):
            places += parted_angles(own, min(room, math.tau / max(len(own), 1)))
        return replace(
            self.scene.started(places, state.end[2 * size + count : 2 * (size + count)]),
            start_position=state.end[:size], start_velocity=state.end[size : 2 * size], duration=self.length,
        )  # fmt: skip

    def _run(self, scene: Scene, tolerance: float) -> Trajectory:
        looks = [look * self.length for look in LOOKS]
        times = merged(*(self._window(look) for look in looks))

        def enough(samples: Samples) -> bool:
            """True if the end is decided at this look."""
            return self._kind(scene, samples)[0] != "undecided"

        return _integrated(scene, tolerance, Sampling(times, until=Until(tuple(looks), enough)))

    def _window(self, end: float) -> Array:
        """Times [s] of the window before the end of a run."""
        turns = min(round(WINDOW * end / self.scene.revolution), WIDEST)
        times = end - self.scene.revolution / PER_TURN * np.arange(2 * (turns * PER_TURN // 2), -1.0, -1.0)
        times[-1] = end
        return times

    def _kind(self, scene: Scene, samples: Samples) -> tuple[Kind, HalfWindow, float | None]:
        """Kind of the end, means of its second half, and the natural frequency of stuck balls [rad/s]."""
        end = float(samples.t[-1])
        turns = min(round(WINDOW * end / scene.revolution), WIDEST)
        half = turns * PER_TURN // 2
        states = samples.y[:, -2 * half :]
        first, last = HalfWindow.of(scene, states[:, :half]), HalfWindow.of(scene, states[:, half:])
        speed, reference = scene.speed, reference_imbalance(scene)
        slip = float(np.abs(last.speeds).max(initial=0.0)) / speed
        size, count = len(scene.support.names), len(scene.ball_masses)
        allowed = allowed_of_scene(scene, tuple(states[2 * size : 2 * size + count, -1].tolist()))
        if slip <= SLIPPING and last.residual <= allowed:
            return "balanced", last, None
        drift = abs(last.residual - first.residual) / reference
        varied = float(last.variation.max(initial=0.0)) / speed
        if slip <= STILL and varied <= SHAKEN:
            return ("resting" if drift <= CREEP else "undecided"), last, None
        if STILL + SWUNG * varied < slip <= SLIPPING:
            return "undecided", last, None
        # Balls that do not go round may settle slowly: they are looked at more strictly.
        if not first.like(last, speed, reference, 1.0 if slip > SLIPPING else STRICT):
            return "undecided", last, None
        frequency = self.stuck_at(last.speeds)
        return ("limit-cycle" if frequency is None else "stuck"), last, frequency

    def stuck_at(self, against_race: Array) -> float | None:
        """Natural frequency [rad/s] at which the slowest balls are stuck, 0 if they stand still; None: at none."""
        speed = self.scene.speed
        slipping = [value + speed for value in against_race.tolist() if abs(value) > SLIPPING * speed]
        if not slipping:
            return None
        slowest = min(slipping)
        if abs(slowest) <= STANDING * speed:
            return 0.0
        closed = any(abs(slowest - each) <= CLOSED * each for each in self.stuck)
        nearest = min(self.frequencies, key=lambda each: abs(slowest - each), default=None)
        if nearest is None or not (closed or abs(slowest - nearest) <= NEAR * nearest):
            return None
        return nearest

    def _judged(self, start: BallStart, scene: Scene, run: Trajectory) -> EndState:
        kind, window, frequency = self._kind(scene, run)
        reason = "" if kind != "undecided" else "still changing at the end of the run"
        return EndState(
            start, kind, tuple((window.speeds + scene.speed).tolist()), window.velocity, window.residual, frequency,
            float(run.t[-1]), tuple(run.y[:, -1].tolist()), reason,
        )  # fmt: skip


def _integrated(scene: Scene, tolerance: float, times: Sampling) -> Trajectory:
    scene = replace(scene, duration=float(times.times[-1]))
    equations = assemble(scene)
    choice = choose(equations, "auto", tolerance)
    return choice.integrate(equations, tolerance, times, choice.evaluations(WORK))
