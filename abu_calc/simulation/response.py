"""Results of one run: amplitude, velocity, level, settling time, residual imbalance and final state.

The residual history is read while the run goes on: three numbers of each sample, all that the settling time and the
largest amplitude need.
"""

import math
from copy import copy
from dataclasses import replace
from typing import Annotated, ClassVar

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import reference_imbalance, unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.trajectory import Array, Samples, Sampling, merged
from abu_calc.formulas.motion import SETTLED
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import level_from_velocity, to_si, wrapped_deg
from abu_calc.simulation.quiet import PER_TURN, TimeRange, last_crossing, range_of, turn_velocities

ABOVE_END = 10 ** (1 / 20)
"""Without a limit a machine is quiet 1 dB above the level of its end."""

NEVER = TimeRange(None, None, None)


class Course:
    """Imbalance in the rotor [kg m], the axis's place x, y [m] and its velocity where it counts, at the settling times.

    A reader of its samples.

    `lost`: what to raise for a motion that left what its support stands for.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene, self.count = scene, settling_count(scene)
        # What was not read is no number: see `evaluate`.
        self.imbalances = np.full(self.count + 1, np.nan, dtype=complex)
        self.places = np.full((2, self.count + 1), np.nan)
        self.velocities = np.full((2 * len(scene.quiet_places or (0,)), self.count + 1), np.nan)
        self.lost: NotTrustworthyError | None = None

    @property
    def times(self) -> Array:
        """Settling times [s] that have been read or will be read."""
        return settling_times(self.scene)[: self.count + 1]

    @property
    def residuals(self) -> Array:
        """Residual imbalance [kg m]."""
        return np.asarray(np.abs(self.imbalances))

    def until(self, t: float) -> "Course":
        """The same up to one of its times."""
        short = copy(self)
        short.count = round(t / (self.scene.duration / self.count))
        known = slice(short.count + 1)
        short.imbalances, short.places = self.imbalances[known], self.places[:, known]
        short.velocities = self.velocities[:, known]
        return short

    def __call__(self, samples: Samples) -> None:
        """Read these."""
        scene, size = self.scene, len(self.scene.support.names)
        self.lost = self.lost or scene.support.lost(samples.t, samples.y[:size])
        step = scene.duration / self.count
        index = np.rint(samples.t / step).astype(np.intp)
        here = (index * step == samples.t) | (samples.t == scene.duration)
        index, states = index[here], samples.y[:, here]
        self.imbalances[index] = scene.total_imbalance(states[2 * size : 2 * size + len(scene.ball_masses)])
        self.places[:, index] = scene.axis_place(states)
        # The axis of a spindle that tilts is linear in its coordinates.
        there = [scene.support.axis(states[size : 2 * size], place) for place in scene.quiet_places]
        self.velocities[:, index] = np.concatenate(there) if there else scene.axis_velocity(states)


def settling_count(scene: Scene) -> int:
    """Number of intervals between settling times."""
    return math.ceil(scene.duration / scene.revolution * PER_TURN)


def settling_times(scene: Scene) -> Array:
    """Equally spaced times [s] from 0 to the end, 16 per revolution, at which settling is judged."""
    count = settling_count(scene)
    times = np.arange(count + 1.0)
    times *= scene.duration / count
    times[-1] = scene.duration
    return times


SAMPLES_PER_REVOLUTION = 64
"""Samples per revolution in the amplitude window."""

BLOCK = 2**16
"""Samples of which distances are taken at once."""

HELD = 2**22
"""Numbers in a trajectory that holds every sample."""

QUARTIC = np.array(
    ((1, -4, 6, -4, 1), (-2, 4, 0, -4, 2), (-1, 16, -30, 16, -1), (2, -16, 0, 16, -2), (0, 0, 24, 0, 0))
) / 24  # fmt: skip
"""Coefficients, the highest first, of the quartic through five values at −2 … 2."""

BEGINNING = 20_000
"""Samples of the beginning of a longer run that stay."""


@dataclass(frozen=True)
class Window:
    """The amplitude window: times [s], equally spaced up to the end but for the first, which is where the window
    begins, and how many of the last steps make whole turns.
    """

    times: Array
    whole: int


@record
class End(Record):
    """Final state of a run; ball angles in (−180, 180], in the order of the file."""

    optional: ClassVar[frozenset[str]] = frozenset(
        {"tilt_x_mrad", "tilt_y_mrad", "arm_angle_mrad", "bearing_amplitudes_mm"}
    )

    t: Annotated[float, Quantity("time", "t", unit="s")]
    x: Annotated[float, Quantity("axis, along the work", "x", 3, unit="mm")]
    y: Annotated[float, Quantity("axis, away from the work", "y", 3, unit="mm")]
    vx: Annotated[float, Quantity("velocity along the work", "x'", 3, unit="mm_per_s")]
    vy: Annotated[float, Quantity("velocity away from the work", "y'", 3, unit="mm_per_s")]
    ball_angles: Annotated[
        tuple[float, ...], Quantity("ball angles", "θ", 5, "in the rotor, from its zero mark", unit="deg")
    ]
    ball_speeds: Annotated[
        tuple[float, ...],
        Quantity("ball speeds", "θ'", 3, "relative to the race, mean over the amplitude window", unit="rpm"),
    ]
    ball_rates: Annotated[
        tuple[float, ...],
        Quantity("ball speeds at the end", "θ'", 6, "relative to the race, at that very moment", unit="rpm"),
    ]
    rotor_speed: Annotated[float, Quantity("speed of the rotor", "", 6, unit="rpm")]
    tilt_x: Annotated[float | None, Quantity("tilt about x", "θ_x", 3, unit="mrad")] = None
    tilt_y: Annotated[float | None, Quantity("tilt about y", "θ_y", 3, unit="mrad")] = None
    arm_angle: Annotated[float | None, Quantity("angle of the arm", "φ", unit="mrad")] = None
    bearing_amplitudes: Annotated[
        tuple[float, ...] | None, Quantity("amplitudes at the bearings", "", 3, unit="mm")
    ] = None


@dataclass(frozen=True)
class Response:
    """Results of one scene in SI; level [dB] None without any velocity.

    `settling_time` [s] counts from `full_speed` [s], see `Scene.full_speed`: 0 if the balls settled before, None if not
    settled in time.
    """

    scene: str
    duration: float
    settling_time: float | None
    settled_imbalance: float
    """Mean imbalance left in the amplitude window [kg m], from which settling counts."""
    end_imbalance: complex
    """Mean of the imbalance there, in the rotor [kg m], from which rest counts."""
    residual_imbalance: float
    axis_amplitude: float
    velocity_rms: float
    level: float | None
    unbalanced_amplitude: float
    largest_amplitude: float
    """Largest amplitude of the axis over the whole run, about its mean place in the window [m]."""
    bearing_amplitudes: tuple[float, ...]
    """Amplitudes, defined like `axis_amplitude`, at each bearing of a support that tilts."""
    ball_angles: tuple[float, ...]
    """At the end [rad], unwrapped."""
    final: End
    quiet: TimeRange
    """From when the level stays at or below the one that is asked for, see `Scene.quiet_velocity`."""
    rest: TimeRange
    """From when the imbalance in the rotor stays near that of the end."""
    creeping: bool = False
    """True if the balls still drift at the end, so that they have no time of rest."""
    full_speed: float = 0.0

    @property
    def quiet_time(self) -> float | None:
        """Quiet time [s] from full speed; None: never."""
        return self.quiet.time

    @property
    def rest_time(self) -> float | None:
        """Rest time [s] from full speed; None: the balls still creep, or come to rest too late."""
        return self.rest.time


def amplitude_window(scene: Scene) -> Window:
    """The last twentieth of the run, but at least one revolution, sampled 64 times per revolution."""
    length = max(scene.duration / 20, scene.revolution)
    turns = int(length / scene.revolution * (1 + 1e-12))
    step = scene.revolution / SAMPLES_PER_REVOLUTION
    times = scene.duration - step * np.arange(math.ceil(length / step - 1e-9), -1, -1)
    return Window(times=np.maximum(times, scene.duration - length), whole=turns * SAMPLES_PER_REVOLUTION)


def needed_times(scene: Scene) -> Array:
    """All times [s] a trajectory must be sampled at to be evaluated."""
    return merged(settling_times(scene), amplitude_window(scene).times)


def sampling(scene: Scene, wanted: Array | None = None) -> Sampling:
    """Sampling at the needed times and at further ones [s].

    Trajectories of up to 32 MB hold all of them. Longer runs keep their beginning, the wanted times and the
    amplitude window; a course must read their results as they go on.
    """
    wanted = np.empty(0) if wanted is None else wanted
    times = merged(needed_times(scene), wanted)
    whole = len(times) * scene.state_count <= HELD
    return Sampling(times, None if whole else merged(amplitude_window(scene).times, wanted, beginning(scene)))


def beginning(scene: Scene) -> Array:
    """The first times [s] at which settling is judged; even very long runs are held at them."""
    return settling_times(scene)[:BEGINNING]


def evaluate(scene: Scene, trajectory: Samples, course: Course | None = None) -> Response:
    """The results of a run that was sampled at least at `needed_times`.

    Its trajectory holds these, or with a course, which has read them, only those of the amplitude window. Raises
    NotTrustworthyError for an arm that turns right round, InputError at a resonance that nothing damps, ValueError for
    times that are missing.
    """
    if course is None:
        course = Course(scene)
        course(trajectory)
    if course.lost:
        raise course.lost
    if np.isnan(course.imbalances).any():
        raise ValueError("a run was not sampled at all times at which its settling is judged")
    window, first = amplitude_window(scene), 2 * len(scene.support.names)
    balls = slice(first, first + len(scene.ball_masses))
    states = trajectory.at(window.times)
    whole = states[:, -1 - window.whole :]
    place = scene.axis_place(states)
    mean = _mean(scene.axis_place(whole))
    rms = float(np.sqrt(_mean(scene.axis_velocity(whole) ** 2)).max())
    left = scene.total_imbalance(whole[balls])
    settled, end = float(_mean(np.abs(left))[0]), complex(left[:-1].mean())
    steps = (scene.duration - scene.full_speed) * course.count / scene.duration
    creeping = drift(course.imbalances, steps) > SETTLED * reference_imbalance(scene)
    theta = states[balls, :][:, [-1 - window.whole, -1]]
    bearings = tuple(
        _largest_radius(scene.axis_place(states, z), _mean(scene.axis_place(whole, z))) for z in scene.support.bearings
    )
    span = float(window.times[-1] - window.times[-1 - window.whole])
    return Response(
        scene=scene.name,
        duration=scene.duration,
        settling_time=_settled_in(scene, course, settled),
        settled_imbalance=settled,
        end_imbalance=end,
        residual_imbalance=float(course.residuals[-1]),
        axis_amplitude=_largest_radius(place, mean),
        velocity_rms=rms,
        level=level_from_velocity(rms) if rms > 0 else None,
        unbalanced_amplitude=unbalanced_amplitude(scene),
        largest_amplitude=_largest_radius(course.places, mean),
        bearing_amplitudes=bearings,
        ball_angles=tuple(states[balls, -1].tolist()),
        # The mean of a speed is the way made; exact, whatever the samples.
        final=_final(scene, states[:, -1], tuple(((theta[:, 1] - theta[:, 0]) / span).tolist()), bearings),
        # Where nothing says how loud a machine may be, one whose balls still creep is not quiet.
        quiet=NEVER if creeping and scene.quiet_velocity is None else _quiet_in(scene, course),
        rest=NEVER if creeping else _rest_in(scene, course, end, 0.0),
        creeping=creeping,
        full_speed=scene.full_speed,
    )


def with_creep(response: Response, scene: Scene, course: Course, creep: float) -> Response:
    """The response of a course if the imbalance left may yet change by `creep` [kg m], less where that is negative:
    its settling time and its time of rest are others.
    """
    return replace(
        response,
        settling_time=_settled_in(scene, course, response.settled_imbalance - creep),
        rest=NEVER if response.creeping else _rest_in(scene, course, response.end_imbalance, creep),
    )


def _quiet_in(scene: Scene, course: Course) -> TimeRange:
    """Quiet time from full speed on: below the velocity that the scene asks for, else 1 dB above that of the end."""
    velocities, first = turn_velocities(course.velocities), np.searchsorted(course.times, scene.full_speed)
    limit = scene.quiet_velocity
    if limit is None:
        last = max(len(velocities) // 20, PER_TURN)
        limit = max(ABOVE_END * float(np.sqrt((velocities[-last:] ** 2).mean())), least_velocity(scene))
    velocities[:first] = 0.0
    return range_of(course.times, velocities, limit, scene.full_speed)


def least_velocity(scene: Scene) -> float:
    """Velocity [m/s] that counts as quiet without a limit: a hundredth of that without balls."""
    return weighing_amplitude(scene) * scene.speed / math.sqrt(2)


def _rest_in(scene: Scene, course: Course, end: complex, creep: float) -> TimeRange:
    """Time of rest from full speed on, the imbalance left [kg m] ending there or `creep` farther off."""
    band = SETTLED * reference_imbalance(scene) - creep
    away = np.abs(course.imbalances - end)
    away[: np.searchsorted(course.times, scene.full_speed)] = 0.0
    return range_of(course.times, away, band, scene.full_speed)


def drift(imbalances: Array, steps: float) -> float:
    """Change of the imbalance left [kg m] at its pace near the end of these samples, over so many of them.

    The pace is the least of that between the last two windows and that over a quarter of the run: balls that have just
    come to rest have none by the first, balls that swing with a slow support none by the second.
    """
    count = len(imbalances)
    turns = max(count // 20 // PER_TURN, 1) * PER_TURN

    def pace(lag: int) -> float:
        """Change [kg m] a sample of the mean over a window since so many samples before."""
        if count < lag + turns:
            return 0.0
        last, before = imbalances[-turns:].mean(), imbalances[-turns - lag : -lag].mean()
        return float(abs(last - before)) / lag

    return steps * min(pace(turns), pace(max(count // 4, turns)))


def _settled_in(scene: Scene, course: Course, settled: float) -> float | None:
    """Settling time [s] from full speed on, where so much imbalance [kg m] is left; None: not in time."""
    time = last_crossing(course.times, course.residuals, settled + SETTLED * reference_imbalance(scene))
    return None if time is None else max(time - scene.full_speed, 0.0)


def _final(scene: Scene, end: Array, ball_speeds: tuple[float, ...], bearings: tuple[float, ...]) -> End:
    first, count = 2 * len(scene.support.names), len(scene.ball_masses)
    x, y = scene.axis_place(end[:, None])[:, 0].tolist()
    vx, vy = scene.axis_velocity(end[:, None])[:, 0].tolist()
    tilt, turned = scene.support.tilt(end[: first // 2]), scene.support.turned(end)
    return End(
        t=scene.duration,
        x=x,
        y=y,
        vx=vx,
        vy=vy,
        ball_angles=tuple(to_si(wrapped_deg(angle), "deg") for angle in end[first : first + count].tolist()),
        ball_speeds=ball_speeds,
        ball_rates=tuple(end[first + count : first + 2 * count].tolist()),
        rotor_speed=float(scene.rotor.turning(scene.duration, end, scene.speed)[1]),
        tilt_x=None if tilt is None else -tilt[1],
        tilt_y=None if tilt is None else tilt[0],
        arm_angle=None if turned is None else float(turned),
        bearing_amplitudes=bearings or None,
    )


def _mean(values: Array) -> Array:
    """Mean over equally spaced times of whole turns, both ends among them, by Simpson's rule: means of what turns are
    exact, and what dies out meanwhile counts as long as it lasts.
    """
    ends, odd, even = values[..., [0, -1]], values[..., 1::2], values[..., 2:-1:2]
    total = ends.sum(-1, keepdims=True) + 4 * odd.sum(-1, keepdims=True) + 2 * even.sum(-1, keepdims=True)
    return np.asarray(total / (3 * (values.shape[-1] - 1)))


def _squares(place: Array, middle: Array, first: int, count: int) -> Array:
    """Squared distances from the middle."""
    return np.asarray(((place[:, first : first + count] - middle) ** 2).sum(axis=0))


def _largest_radius(place: Array, middle: Array) -> float:
    """Largest distance from the middle of samples, equally spaced but for the first; its square refined by a quartic
    through five.
    """
    count = place.shape[1]
    tops = [first + int(_squares(place, middle, first, BLOCK).argmax()) for first in range(0, count, BLOCK)]
    squares = [float(_squares(place, middle, top, 1)[0]) for top in tops]
    largest = max(squares)
    top = tops[squares.index(largest)]
    if 2 < top < count - 2 and largest > 0:
        near = QUARTIC @ (_squares(place, middle, top - 2, 5) / largest)
        crests = [root.real for root in np.roots(np.polyder(near)).tolist() if root.imag == 0 and abs(root.real) <= 1]
        largest *= max([1.0, *np.polyval(near, crests).tolist()])
    return math.sqrt(largest)
