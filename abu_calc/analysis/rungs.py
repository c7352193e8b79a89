"""The rungs of the ladder that integrate no equations of motion: closed form and envelope."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from abu_calc.analysis.response import settling_moments, settling_time, total_imbalance
from abu_calc.dynamics.envelope import averages, envelope, loaded, not_averaged
from abu_calc.dynamics.receptance import receptance, reference_moment
from abu_calc.dynamics.resting import resting_angles
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import InputError
from abu_calc.sizing.slow_motion import decay_rate


@dataclass(frozen=True)
class Estimate:
    """What a rung tells of a run, as `differences` compares it; `evaluations` of whatever it evaluates."""

    axis_amplitude: float
    velocity_rms: float
    settling_time: float | None
    ball_angles: tuple[float, ...]
    evaluations: int = 0
    steps: int = 0


def closed_form(scene: Scene) -> Estimate:
    """Stationary positions, the whirl they leave, and a settling time from the slow eigenvalue.

    Balanced: the axis keeps the races' offset Δ, and the residual dies out as e^{−λt} from what it is at the start, λ
    the slowest rate of the averaged motion. Range: one race whose balls can balance, where they do; constant speed.
    Raises InputError outside.
    """
    reason = not_averaged(scene)
    rest = resting_angles(scene) if len(scene.races) == 1 else None
    if reason or rest is None or not scene.ball_masses:
        raise InputError(reason or "closed forms are for one race whose balls can balance")
    model, race = averages(scene), scene.races[0]
    own = -float(model.forward[0, 2].real)
    stiffnesses = [moment / race.pitch_radius * scene.speed**4 * own for moment in scene.ball_moments]
    rate = decay_rate(stiffnesses, rest, race.drag, race.inertia_factor)
    if rate <= 0:
        raise InputError("the averaged motion does not come to rest in balance")
    start = abs(complex(total_imbalance(scene, np.array(scene.start_angles)[:, None])[0]))
    limit = 0.1 * reference_moment(scene)
    time = max(math.log(start / limit) / rate, 0.0) if start > limit else 0.0
    amplitude = abs(model.offset)
    return Estimate(
        axis_amplitude=amplitude,
        velocity_rms=amplitude * scene.speed / math.sqrt(2),
        settling_time=time if time <= 0.95 * scene.duration else None,
        ball_angles=rest,
    )


def averaged(scene: Scene, tolerance: float) -> Estimate:
    """The envelope of a run. Raises InputError where averages do not hold."""
    if reason := not_averaged(scene):
        raise InputError(reason)
    moments = settling_moments(scene)
    slow = envelope(scene, tolerance, moments)
    residuals = np.abs(total_imbalance(scene, slow.theta))
    window = moments >= 0.95 * scene.duration
    limit = float(residuals[window].mean()) + 0.1 * reference_moment(scene)
    return Estimate(
        axis_amplitude=slow.amplitude,
        velocity_rms=_velocity(scene, slow.theta[:, -1]),
        settling_time=settling_time(moments, residuals, limit),
        ball_angles=tuple(slow.theta[:, -1].tolist()),
        evaluations=slow.evaluations,
        steps=slow.steps,
    )


def _velocity(scene: Scene, theta: NDArray[np.float64]) -> float:
    """Ω/√2 times the larger of the whirl's extents along x and y [m/s]."""
    h, model = receptance(loaded(scene), scene.speed), averages(scene)
    total = model.own[0] + (model.moments * np.exp(1j * theta) + model.masses * model.offset).sum()
    X, Y = (h[:2, :2] @ (total * np.array((1, -1j))) * scene.speed**2).tolist()
    return float(max(abs(X), abs(Y))) * scene.speed / math.sqrt(2)
