"""A motion as CSV: the axis in mm, ball angles in degrees, unwrapped."""

import csv
import io

import numpy as np

from abu_calc.studies.motion import Motion

DIGITS = 12


def trajectory_csv(motion: Motion) -> str:
    """Columns t_s, x_mm, y_mm, ball1_deg, …; a row for each time."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    balls = range(1, len(motion.ball_angles_deg) + 1)
    writer.writerow(("t_s", "x_mm", "y_mm", *(f"ball{k}_deg" for k in balls)))
    for row in np.vstack([motion.t_s, motion.x_mm, motion.y_mm, motion.ball_angles_deg]).T.tolist():
        writer.writerow([f"{value:.{DIGITS}g}" for value in row])
    return buffer.getvalue()
