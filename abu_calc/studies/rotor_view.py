"""A run as who turns with the rotor sees it: balls on their way to rest, the axis, and what imbalance is left."""

from dataclasses import dataclass
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.analysis.course import SAMPLES_PER_REVOLUTION, axis_place, settling_times, total_imbalance
from abu_calc.analysis.simulate import Simulation
from abu_calc.units import from_si

Array = NDArray[np.float64]

MOST: Final = 500
"""Samples that a picture needs."""
HALF: Final = SAMPLES_PER_REVOLUTION // 2


@dataclass(frozen=True, eq=False)
class RotorView:
    """Thinned samples of a run that was made, without half a revolution at both ends.

    Angles from the rotor's zero mark in its sense of rotation.
    x, y: how the axis goes round, along axes that turn with the rotor: what it drifts, its mean over a revolution, is
    taken off. `ball_angles_deg`: a row for each ball.
    """

    t_s: Array
    x_um: Array
    y_um: Array
    ball_angles_deg: Array
    residual_g_mm: Array
    imbalance_angle_deg: float

    @classmethod
    def of(cls, run: Simulation) -> Self | None:
        """Of a run; None of one so long that its beginning is not held."""
        scene = run.scene
        times = settling_times(scene)
        try:
            states = run.trajectory.at(times)
        except ValueError:
            return None
        x, y = axis_place(scene, states)
        swinging = _swinging(x + 1j * y)
        times, states = times[HALF:-HALF], states[:, HALF:-HALF]
        if len(times) < 2:
            return None
        # Denser at the start, where all moves.
        index = np.unique(((len(times) - 1) * np.linspace(0, 1, MOST) ** 2).round().astype(np.intp))
        turn = scene.rotor.turning(times, states, scene.speed)[0]
        seen = (from_si(1.0, "um") * swinging * np.exp(-1j * turn))[index]
        size, balls = len(scene.support.names), len(scene.ball_masses)
        angles = states[2 * size : 2 * size + balls, index]
        return cls(
            t_s=times[index],
            x_um=seen.real,
            y_um=seen.imag,
            ball_angles_deg=from_si(1.0, "deg") * angles,
            residual_g_mm=from_si(1.0, "g_mm") * np.abs(total_imbalance(scene, angles)),
            imbalance_angle_deg=from_si(scene.imbalance_angle, "deg"),
        )


def _swinging(place: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Places without their mean over a revolution, half of one left out at both ends."""
    weights = np.ones(2 * HALF + 1)
    weights[[0, -1]] = 0.5
    swinging: NDArray[np.complex128] = place[HALF:-HALF] - np.convolve(place, weights / weights.sum(), "valid")
    return swinging
