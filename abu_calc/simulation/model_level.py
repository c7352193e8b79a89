"""Model levels that do not integrate the equations of motion: closed form and envelope, with their errors."""

import math
from dataclasses import replace
from typing import Final

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
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.resting import resting_angles
from abu_calc.dynamics.supports.steady_motion import reference_imbalance, unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.trajectory import Times, Trajectory
from abu_calc.formulas.motion import SETTLED
from abu_calc.formulas.slow_motion import decay_rate
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.simulation.nonconvergence import difference
from abu_calc.simulation.quiet import TimeRange, last_crossing, range_of
from abu_calc.simulation.response import ABOVE_END, least_velocity, settling_count

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
