"""Residual history of a run, read as it goes on: three numbers of each sample.

Settling and the largest amplitude need no more of a run.
"""

import math
from copy import copy

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Array, Samples
from abu_calc.errors import NotTrustworthyError

SAMPLES_PER_REVOLUTION = 16
"""Settling samples per revolution, over the whole run.

The residual imbalance ripples with the speed, and a crest may be the last value above the limit.
"""


class Course:
    """Residual imbalance [kg m] and the axis's place x, y [m] at the settling times of a run; a reader of its samples.

    `lost`: what to raise for a motion that left what its support stands for.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene, self.count = scene, settling_count(scene)
        self.residuals = np.empty(self.count + 1)
        self.places = np.empty((2, self.count + 1))
        self.lost: NotTrustworthyError | None = None

    @property
    def times(self) -> Array:
        """Settling times [s] that have been read or will be read."""
        return settling_times(self.scene)[: self.count + 1]

    def until(self, t: float) -> "Course":
        """The same up to one of its times."""
        short = copy(self)
        short.count = round(t / (self.scene.duration / self.count))
        short.residuals, short.places = self.residuals[: short.count + 1], self.places[:, : short.count + 1]
        return short

    def __call__(self, samples: Samples) -> None:
        """Read these."""
        scene, size = self.scene, len(self.scene.support.names)
        self.lost = self.lost or scene.support.lost(samples.t, samples.y[:size])
        step = scene.duration / self.count
        index = np.rint(samples.t / step).astype(np.intp)
        here = (index * step == samples.t) | (samples.t == scene.duration)
        index, states = index[here], samples.y[:, here]
        self.residuals[index] = np.abs(total_imbalance(scene, states[2 * size : 2 * size + len(scene.ball_masses)]))
        self.places[:, index] = axis_place(scene, states)


def settling_count(scene: Scene) -> int:
    """Number of intervals between settling times."""
    return math.ceil(scene.duration / scene.revolution * SAMPLES_PER_REVOLUTION)


def settling_times(scene: Scene) -> Array:
    """Equally spaced times [s] from 0 to the end, 16 per revolution, at which settling is judged."""
    count = settling_count(scene)
    times = np.arange(count + 1.0)
    times *= scene.duration / count
    times[-1] = scene.duration
    return times


def axis_place(scene: Scene, states: Array, plane: float = 0.0) -> Array:
    """x, y of the axis [m] at a plane z [m] from the centre of mass, for states [state, time].

    Of a swing arm: from where it lies along +x.
    """
    return scene.support.axis(states[: len(scene.support.names)], plane)


def total_imbalance(scene: Scene, angles: Array) -> NDArray[np.complex128]:
    """m₀e e^{iφ} + Σ m R_p e^{iθ} [kg m] for ball angles [ball, time]."""
    total = np.full(angles.shape[1:], scene.imbalance * np.exp(1j * scene.imbalance_angle))
    for static_moment, angle in zip(scene.static_moments, angles, strict=True):
        total += static_moment * np.exp(1j * angle)
    return total
