"""A trajectory as CSV: the axis in mm, ball angles in degrees, unwrapped, at equally spaced moments."""

import csv
import io
from collections.abc import Sequence

import numpy as np

from abu_calc.analysis.response import axis_place
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.units import from_si

DIGITS = 12


def trajectory_moments(scene: Scene, samples: int) -> tuple[float, ...]:
    """Equally spaced moments [s], both ends included."""
    return tuple(np.linspace(0.0, scene.duration, samples).tolist())


def trajectory_csv(scene: Scene, trajectory: Trajectory, moments: Sequence[float]) -> str:
    """Columns t_s, x_mm, y_mm, ball1_deg, …; a row for each moment, at which the trajectory must have been sampled."""
    size, balls = len(scene.support.names), len(scene.ball_masses)
    states = trajectory.at(moments)
    centre = from_si(1.0, "mm") * axis_place(scene, states)
    angles = from_si(1.0, "deg") * states[2 * size : 2 * size + balls]
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(("t_s", "x_mm", "y_mm", *(f"ball{k}_deg" for k in range(1, balls + 1))))
    for row in np.vstack([np.array(moments), centre, angles]).T.tolist():
        writer.writerow([f"{value:.{DIGITS}g}" for value in row])
    return buffer.getvalue()
