"""Model levels that do not integrate the equations of motion: closed form and envelope, with their errors.

Differences between two runs of one scene, and the reason why no tolerance reached an accuracy.

Differences are measured as accuracy measures errors. Reasons: a motion that amplifies errors, or a settling time that
depends on them.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.averaging.envelope import (
    averages,
    ball_rate,
    envelope,
    followed,
    free_amplitude,
    natural_gap,
    not_averaged,
    whirl,
)
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import IntegratorChoice
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.resting import resting_angles
from abu_calc.dynamics.supports.steady_motion import reference_imbalance, unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.trajectory import Times, Trajectory
from abu_calc.formulas.motion import SETTLED
from abu_calc.formulas.slow_motion import decay_rate
from abu_calc.foundation.errors import ChaoticError, InputError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.simulation.quiet import TimeRange, last_crossing, range_of
from abu_calc.simulation.response import ABOVE_END, Course, Response, evaluate, least_velocity, sampling, settling_count


class Measures(Protocol):
    """Compared quantities of a run: of a response, or of an estimate that integrates no equations."""

    @property
    def axis_amplitude(self) -> float:
        """0–peak [m]."""

    @property
    def velocity_rms(self) -> float:
        """RMS velocity in the larger of x and y [m/s]."""

    @property
    def settling_time(self) -> float | None:
        """Settling time, from full speed [s]; None if later than the run."""

    @property
    def quiet(self) -> TimeRange:
        """Quiet time, from full speed [s]."""

    @property
    def rest(self) -> TimeRange:
        """Rest time, from full speed [s]."""

    @property
    def ball_angles(self) -> tuple[float, ...]:
        """Ball angles at the end [rad]."""


def difference(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """The largest of the differences in amplitude, times and ball angles."""
    return max(measure(scene, coarse, fine) for measure in (amplitude, settling, quiet, rest, angles))


def amplitude(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Relative to the finer amplitude, but at least to 1 % of that without balls."""
    apart = abs(coarse.axis_amplitude - fine.axis_amplitude)
    # Nothing at all to drive the axis leaves nothing to compare with.
    return apart / max(fine.axis_amplitude, weighing_amplitude(scene)) if apart > 0 else 0.0


def level(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Difference of the rms velocities, likewise relative: 0.01 is 0.09 dB."""
    apart = abs(coarse.velocity_rms - fine.velocity_rms)
    least = weighing_amplitude(scene) * scene.speed / math.sqrt(2)
    return apart / max(fine.velocity_rms, least) if apart > 0 else 0.0


def settling(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Relative to the finer time, but at least to one revolution; infinite where only one of them has settled."""
    a, b = coarse.settling_time, fine.settling_time
    if a is None or b is None:
        return 0.0 if a is b else math.inf
    return abs(a - b) / max(b, scene.revolution)


def quiet(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Of the quiet times, likewise; 0 where each lies in the range of the other."""
    return coarse.quiet.apart(fine.quiet, scene.revolution)


def rest(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Of the rest times, likewise."""
    return coarse.rest.apart(fine.rest, scene.revolution)


def angles(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Largest difference on the circle [rad]; balls of one mass on one race may have changed places."""
    a, b, worst, first = np.array(coarse.ball_angles), np.array(fine.ball_angles), 0.0, 0
    for race in scene.races:
        masses = np.array(race.ball_masses)
        here = slice(first, first + len(masses))
        for mass in set(race.ball_masses):
            worst = max(worst, _circular_distance(a[here][masses == mass], b[here][masses == mass]))
        first += len(masses)
    return worst


QUANTITIES: Final[dict[str, Callable[[Scene, Measures, Measures], float]]] = {
    "amplitude": amplitude,
    "level": level,
    "settling": settling,
    "quiet": quiet,
    "rest": rest,
    "angles": angles,
}
"""Quantities for which the error of a computation can be requested."""


def _circular_distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Largest distance on the circle between two sets of angles, in the best pairing.

    On a circle the best pairing keeps the order round it, so only the rotations of one order have to be tried.

    >>> round(_circular_distance(np.array([0.1, 3.0]), np.array([3.0, 4 * math.pi - 0.1])), 9)
    0.2
    """
    a, b = np.sort(a % (2 * math.pi)), np.sort(b % (2 * math.pi))
    shifts = (np.angle(np.exp(1j * (a - np.roll(b, k)))) for k in range(len(b)))
    return min(float(np.abs(shift).max()) for shift in shifts)


MOVED: Final = 1e-9
"""Angle [rad] by which one ball of each race is moved at the start.

The ball moves into its widest gap, so that no balls overlap.
"""

SENSITIVE: Final = 1e5
"""Growth of an error beyond which a motion is called chaotic: what decides a run is less than anyone can measure."""

FELT: Final = 0.1
"""Share of the requested accuracy that the grown error must exceed for a motion to be called chaotic."""

COMPARED: Final = {
    "amplitude": "amplitude", "settling": "settling time", "quiet": "quiet time", "rest": "rest time",
    "angles": "ball angles",
}  # fmt: skip


@dataclass(frozen=True)
class FinestRuns:
    """The two finest runs of a scene, which do not agree."""

    coarse: Response
    fine: Response
    apart: float
    """Difference as accuracy measures errors; infinite if the balls made other turns."""
    choice: IntegratorChoice
    tolerance: float
    """Tolerance of the finer run."""


def unreached(
    scene: Scene, accuracy: float, runs: FinestRuns, most: int, otherwise: NotTrustworthyError | None = None
) -> NotTrustworthyError:
    """Error of an accuracy that is not reached; another run shows whether the motion is chaotic.

    `most`: work that this run may take. `otherwise`: what stopped the runs before rounding did.
    """
    worst, key = max((QUANTITIES[key](scene, runs.coarse, runs.fine), key) for key in COMPARED)
    by = "in whether they settle" if math.isinf(worst) else "in the turns of the balls"
    by = f"by {runs.apart:.2g}, most in the {COMPARED[key]}" if math.isfinite(runs.apart) else by
    first = f"{scene.name}: the accuracy {accuracy:.3g} is not reached, the two finest runs differ {by}"
    growth = _growth(scene, runs, most)
    # A run that more work would finish is chaotic only where what starts that small comes near the accuracy.
    if growth > SENSITIVE and (otherwise is None or growth * MOVED > FELT * accuracy):
        return ChaoticError(
            f"{first}. The motion is chaotic: {MOVED:g} rad at its start grow {growth:.0e} times\n"
            "  Shorten the run, start the balls at other places, or specify a greater drag rate."
        )
    if otherwise:
        return otherwise
    if math.isinf(worst):
        return NotTrustworthyError(
            f"{first}: the end of the run decides\n  Lengthen or shorten the run (--duration, Python: duration_s=)."
        )
    return NotTrustworthyError(
        f"{first}: rounding decides\n  Specify less accuracy, shorten the run, or start the balls at other places."
    )


def _growth(scene: Scene, runs: FinestRuns, most: int) -> float:
    """Growth of an error at the start, in amplitude and angles; 0 if that run cannot be finished."""
    moved = replace(scene, races=tuple(replace(race, start_angles=_moved(race.start_angles)) for race in scene.races))
    try:
        course, times, choice = Course(moved), sampling(moved), runs.choice
        work = choice.evaluations(most)
        trajectory = choice.integrate(assemble(moved), runs.tolerance, times.read_by(course), work)
        moved_response = evaluate(moved, trajectory, course)
        apart = [QUANTITIES[key](scene, moved_response, runs.fine) for key in ("amplitude", "angles")]
    except NotTrustworthyError:
        return 0.0
    return max(apart) / MOVED


def _moved(angles: tuple[float, ...]) -> tuple[float, ...]:
    """The angles [rad] with the ball moved that has most room ahead of it."""

    def room(ball: int) -> float:
        """Gap ahead of a ball [rad]."""
        turn = 2 * math.pi
        return min((turn - (angles[ball] - other) % turn for k, other in enumerate(angles) if k != ball), default=turn)

    first = max(range(len(angles)), key=room, default=None)
    return tuple(angle + MOVED * (k == first) for k, angle in enumerate(angles))


LEADING, SLOWNESS = 0.5, 10.0
"""Weights in the error of the envelope: of what its last order changes, and of (rate of the balls/gap)². Calibrated
over 300 random scenes, see tests/studies/claims.py: no error was above 0.42 of its estimate, mostly a fortieth."""

WIDEST: Final = 0.1
"""Beyond, an estimate of the envelope's error is not to be relied on: balls may come to rest in another arrangement."""

FINER, TIGHT = 1e-4, 1e-6
"""Tolerance of the envelope's integration: this share of the accuracy, and no more than that; it costs little."""

MOST_TIMES: Final = 1001
"""Most times at which a slow motion is evaluated; it is straight between two of them."""


@dataclass(frozen=True)
class ModelEstimate:
    """Results of a model level for a run, as `differences` compares them.

    `evaluations`: number of evaluations of the functions that this level needs.
    """

    axis_amplitude: float
    velocity_rms: float
    settling_time: float | None
    quiet: TimeRange
    rest: TimeRange
    ball_angles: tuple[float, ...]
    evaluations: int = 0
    steps: int = 0


@dataclass(frozen=True)
class Offer:
    """Estimated error of the envelope in place of the full equations; None if it does not hold at all.

    `trajectory`: the run, None if it is not accurate enough; `why` gives the reason in words.
    """

    error: float | None
    why: str
    trajectory: Trajectory | None = None


def closed_form(scene: Scene) -> ModelEstimate:
    """Stationary positions, the whirl they leave, and a settling time from the slow eigenvalue.

    Balanced: the axis keeps the races' offset Δ, and the residual dies out as e^{−λt} from what it is at the start, λ
    the slowest rate of the averaged motion. Range: one race whose balls can balance, where they do; constant speed.
    Raises InputError outside.
    """
    reason = _not_averaged(scene)
    rest = resting_angles(scene) if len(scene.races) == 1 else None
    if reason or rest is None or not scene.ball_masses:
        raise InputError(reason or "closed forms are for one race whose balls can balance")
    model, race = averages(scene), scene.races[0]
    own = -float(model.forward[0, 2].real)
    stiffnesses = [each / race.pitch_radius * scene.speed**4 * own for each in scene.static_moments]
    rate = decay_rate(stiffnesses, rest, race.drag, race.inertia_factor)
    if rate <= 0:
        raise InputError("the averaged motion does not come to rest in balance")
    start = abs(complex(scene.total_imbalance(np.array(scene.start_angles)[:, None])[0]))
    limit = SETTLED * reference_imbalance(scene)
    amplitude = abs(model.offset)
    velocity = amplitude * scene.speed / math.sqrt(2)
    most = max(ABOVE_END * velocity, least_velocity(scene)) if scene.quiet_velocity is None else scene.quiet_velocity
    loud = unbalanced_amplitude(scene, start) * scene.speed / math.sqrt(2)

    def dies_out(value: float, least: float) -> TimeRange:
        """Time in which a value falls to another at the slowest rate."""
        time = math.inf if least <= 0 else max(math.log(value / least) / rate, 0.0) if value > least else 0.0
        found = time if time <= 0.95 * scene.duration else None
        return TimeRange(found, found, found)

    rests = dies_out(start, limit)
    return ModelEstimate(
        axis_amplitude=amplitude,
        velocity_rms=velocity,
        settling_time=rests.time,
        quiet=dies_out(loud, most - velocity),
        rest=rests,
        ball_angles=rest,
    )


def averaged(scene: Scene, tolerance: float, order: int = 2) -> ModelEstimate:
    """The envelope of a run. Raises InputError where averages do not hold."""
    if reason := _not_averaged(scene):
        raise InputError(reason)
    times = slow_times(scene)
    slow = envelope(scene, tolerance, times, order)
    residuals = np.abs(scene.total_imbalance(slow.theta))
    window = times >= _window(scene)
    limit = float(residuals[window].mean()) + SETTLED * reference_imbalance(scene)
    whirls = (scene.small_motion.frame @ whirl(scene, slow.theta, slow.rate)[0])[:2]
    velocities = scene.speed / math.sqrt(2) * np.abs(whirls).max(axis=0)
    most = scene.quiet_velocity
    if most is None:
        most = max(ABOVE_END * float(np.sqrt((velocities[window] ** 2).mean())), least_velocity(scene))
    left = scene.total_imbalance(slow.theta)
    away = np.abs(left - left[window].mean())
    X, Y = whirls[:, window]
    return ModelEstimate(
        axis_amplitude=float((np.abs(X + 1j * Y) + np.abs(X - 1j * Y)).max()) / 2,
        velocity_rms=scene.speed / math.sqrt(2) * math.sqrt(max((np.abs(X) ** 2).mean(), (np.abs(Y) ** 2).mean())),
        settling_time=last_crossing(times, residuals, limit),
        quiet=range_of(times, velocities, most, 0.0),
        rest=range_of(times, away, SETTLED * reference_imbalance(scene), 0.0),
        ball_angles=tuple(slow.theta[:, -1].tolist()),
        evaluations=slow.evaluations,
        steps=slow.steps,
    )


def _window(scene: Scene) -> float:
    """Begin of the amplitude window [s]."""
    return scene.duration - max(scene.duration / 20, scene.revolution)


def slow_times(scene: Scene) -> NDArray[np.float64]:
    """Equally spaced times [s] at which slow motion is looked at: like the equations', but it has no ripple."""
    return np.linspace(0.0, scene.duration, min(settling_count(scene) + 1, MOST_TIMES))


def offer(scene: Scene, accuracy: float, times: Times) -> Offer:
    """The envelope at the times [s] if it is as accurate as that. What cannot be accurate enough is not even run."""
    falls = next((effect.name for effect in scene.effects if effect.falling), None)
    reason = f"{falls} is not averaged" if falls else not_averaged(scene)
    if reason or not scene.ball_masses:
        return Offer(None, reason or "there are no balls")
    least, limit = _least_error(scene), min(accuracy, WIDEST)
    if least > limit:
        return Offer(least, f"the error of the averages is estimated at {least:.2g} or more")
    try:
        return _followed(scene, limit, min(FINER * accuracy, TIGHT), times)
    except NotTrustworthyError as error:
        return Offer(None, str(error).splitlines()[0])


def _followed(scene: Scene, limit: float, tolerance: float, times: Times) -> Offer:
    """The envelope by its two orders, their difference and what neither knows of."""
    leading, full = (averaged(scene, tolerance, order) for order in (1, 2))
    free = free_amplitude(scene, _window(scene)) / max(full.axis_amplitude, weighing_amplitude(scene))
    ripple = scene.revolution / 2 / max(full.settling_time or scene.duration, scene.revolution)
    error = LEADING * difference(scene, leading, full) + _slowness(scene) + free + ripple
    if not error <= limit:
        return Offer(error, f"the error of the averages is estimated at {error:.2g}")
    run = followed(scene, tolerance, times)
    run = replace(run, evaluations=leading.evaluations + full.evaluations + run.evaluations)
    return Offer(error, "the averages are accurate enough, and cost less than the equations", run)


def _slowness(scene: Scene) -> float:
    """Error by the orders left out: the squared ratio of the fastest slow motion to the gap.

    The fastest motion is the balls' rate or their speed at the start; the gap is that of the natural
    frequencies.
    """
    fastest = max(ball_rate(scene), *(abs(speed) for race in scene.races for speed in race.start_speeds))
    return SLOWNESS * (fastest / natural_gap(scene)) ** 2


def _least_error(scene: Scene) -> float:
    """The error known before anything is run; settling is no better known than half a revolution, by the ripple."""
    return _slowness(scene) + scene.revolution / 2 / scene.duration


def _not_averaged(scene: Scene) -> str | None:
    """Why averages do not tell what a scene asks for; None where they do."""
    return "averages tell the level at the centre of mass alone" if scene.quiet_places else not_averaged(scene)
