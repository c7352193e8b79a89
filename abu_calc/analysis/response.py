"""What one run says: amplitude, velocity, level, settling, residual imbalance, and where everything ended."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.receptance import unbalanced_amplitude
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.units import level_from_velocity

SAMPLES_PER_REVOLUTION = 64
"""In the amplitude window."""

SETTLING_SAMPLES_PER_REVOLUTION = 16
"""Over the whole run: the residual ripples with the speed, and a crest may be the last to pass the limit."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Window:
    """The amplitude window: moments [s], equally spaced up to the end, and how many of the last make whole turns."""

    times: Array
    whole: int


@dataclass(frozen=True)
class FinalState:
    """Where the run ended: race centre [m, m/s], ball angles [rad] unwrapped, their mean speeds in the window."""

    t: float
    x: float
    y: float
    vx: float
    vy: float
    ball_angles: tuple[float, ...]
    ball_speeds: tuple[float, ...]


@dataclass(frozen=True)
class Response:
    """Results of one scene in SI; level [dB] None without any velocity, settling_time None if not settled in time."""

    scene: str
    duration: float
    settling_time: float | None
    residual_imbalance: float
    axis_amplitude: float
    velocity_rms: float
    level: float | None
    unbalanced_amplitude: float
    final: FinalState


def amplitude_window(scene: Scene) -> Window:
    """The last twentieth of the run, but at least one revolution, sampled 64 times per revolution."""
    length = max(scene.duration / 20, scene.revolution)
    turns = int(length / scene.revolution * (1 + 1e-12))
    step = scene.revolution / SAMPLES_PER_REVOLUTION
    times = scene.duration - step * np.arange(math.ceil(length / step - 1e-9), -1, -1)
    return Window(times=np.maximum(times, 0.0), whole=turns * SAMPLES_PER_REVOLUTION)


def settling_moments(scene: Scene) -> Array:
    """Equally spaced moments [s] from 0 to the end, 16 per revolution, at which settling is judged."""
    count = math.ceil(scene.duration / scene.revolution * SETTLING_SAMPLES_PER_REVOLUTION)
    return np.linspace(0.0, scene.duration, count + 1)


def needed_moments(scene: Scene) -> Array:
    """All moments [s] a trajectory must be sampled at to be evaluated."""
    return np.union1d(settling_moments(scene), amplitude_window(scene).times)


def evaluate(scene: Scene, trajectory: Trajectory) -> Response:
    """The results of a trajectory that was sampled at least at `needed_moments`."""
    window, moments = amplitude_window(scene), settling_moments(scene)
    size, balls = len(scene.support.names), len(scene.race.ball_masses)
    P = np.array(scene.support.race_map)
    states = trajectory.at(window.times)
    whole = states[:, -window.whole :]
    place, velocity = P @ states[:size], P @ whole[size : 2 * size]
    amplitude = _largest_radius(place - (P @ whole[:size]).mean(axis=1, keepdims=True))
    rms = float(np.sqrt((velocity**2).mean(axis=1)).max())
    residuals = np.abs(total_imbalance(scene, trajectory.at(moments)[2 * size : 2 * size + balls]))
    settled = float(np.abs(total_imbalance(scene, whole[2 * size : 2 * size + balls])).mean())
    end = states[:, -1]
    theta = states[2 * size : 2 * size + balls, [-1 - window.whole, -1]]
    span = float(window.times[-1] - window.times[-1 - window.whole])
    x, y = (P @ end[:size]).tolist()
    vx, vy = (P @ end[size : 2 * size]).tolist()
    return Response(
        scene=scene.name,
        duration=scene.duration,
        settling_time=settling_time(moments, residuals, settled + 0.1 * reference_moment(scene)),
        residual_imbalance=float(residuals[-1]),
        axis_amplitude=amplitude,
        velocity_rms=rms,
        level=level_from_velocity(rms) if rms > 0 else None,
        unbalanced_amplitude=unbalanced_amplitude(scene),
        final=FinalState(
            t=scene.duration,
            x=x,
            y=y,
            vx=vx,
            vy=vy,
            ball_angles=tuple(end[2 * size : 2 * size + balls].tolist()),
            # The mean of a speed is the way made; exact, whatever the samples.
            ball_speeds=tuple(((theta[:, 1] - theta[:, 0]) / span).tolist()),
        ),
    )


def reference_moment(scene: Scene) -> float:
    """max(m₀e, 1 % of Σ m R_p) [kg m]: what a residual imbalance is small against."""
    return max(scene.imbalance, 0.01 * scene.race.static_moment)


def total_imbalance(scene: Scene, angles: Array) -> NDArray[np.complex128]:
    """m₀e e^{iφ} + Σ m R_p e^{iθ} [kg m] for ball angles [ball, moment]."""
    moments = np.array(scene.race.ball_masses, dtype=float) * scene.race.pitch_radius
    own = scene.imbalance * np.exp(1j * scene.imbalance_angle)
    return np.asarray(own + moments @ np.exp(1j * angles), dtype=complex)


def settling_time(t: Array, residuals: Array, limit: float) -> float | None:
    """The earliest moment [s] after which the residual stays below the limit; None if after 95 % of the run.

    Between two samples the residual is taken as straight.
    """
    above = np.flatnonzero(residuals > limit)
    if not len(above):
        return 0.0
    last = int(above[-1])
    if last == len(t) - 1:
        return None
    before, after = float(residuals[last]), float(residuals[last + 1])
    moment = float(t[last] + (t[last + 1] - t[last]) * (before - limit) / (before - after))
    return moment if moment <= 0.95 * t[-1] else None


def _largest_radius(place: Array) -> float:
    """Largest √(x² + y²) of equally spaced samples, its square refined by the parabola through the largest three."""
    square = (place**2).sum(axis=0)
    top = int(square.argmax())
    if 0 < top < len(square) - 1:
        a, b, c = square[top - 1 : top + 2].tolist()
        bend = 2 * b - a - c
        if bend > 0:
            return math.sqrt(b + (c - a) ** 2 / (8 * bend))
    return math.sqrt(float(square[top]))
