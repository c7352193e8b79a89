"""A run as who turns with the rotor sees it: balls on their way to rest, the axis, and what imbalance is left."""

from dataclasses import dataclass
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.analysis.course import axis_place, total_imbalance
from abu_calc.analysis.simulate import Simulation
from abu_calc.units import from_si

Array = NDArray[np.float64]

MOST: Final = 500
"""Samples that a picture needs."""


@dataclass(frozen=True, eq=False)
class RotorView:
    """Thinned samples of a run that was made; angles from the rotor's zero mark in its sense of rotation.

    x, y: the axis from its place at rest, along axes that turn with the rotor. `ball_angles_deg`: a row for each ball.
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
        times, scene = run.trajectory.t, run.scene
        if not len(times) or times[0] > 0:
            return None
        index = np.unique(np.linspace(0, len(times) - 1, MOST).round().astype(np.intp))
        t, states = times[index], run.trajectory.y[:, index]
        size, balls = len(scene.support.names), len(scene.ball_masses)
        x, y = axis_place(scene, states)
        seen = from_si(1.0, "um") * (x + 1j * y) * np.exp(-1j * scene.rotor.turning(t, states, scene.speed)[0])
        angles = states[2 * size : 2 * size + balls]
        return cls(
            t_s=t,
            x_um=seen.real,
            y_um=seen.imag,
            ball_angles_deg=from_si(1.0, "deg") * angles,
            residual_g_mm=from_si(1.0, "g_mm") * np.abs(total_imbalance(scene, angles)),
            imbalance_angle_deg=from_si(scene.imbalance_angle, "deg"),
        )
