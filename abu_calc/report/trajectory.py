"""A motion as CSV: the axis in mm, ball angles in degrees, unwrapped."""

from collections.abc import Iterator

import numpy as np

from abu_calc.studies.motion import Motion

DIGITS = 12

BLOCK = 10_000
"""Rows that are text at once: a million of them would take a gigabyte."""


def trajectory_csv(motion: Motion) -> Iterator[str]:
    """Columns t_s, x_mm, y_mm, ball1_deg, …; a row for each time; in pieces of some rows each."""
    yield ",".join(("t_s", "x_mm", "y_mm", *(f"ball{k + 1}_deg" for k in range(len(motion.ball_angles_deg))))) + "\n"
    for first in range(0, len(motion.t_s), BLOCK):
        part = slice(first, first + BLOCK)
        rows = np.vstack([motion.t_s[part], motion.x_mm[part], motion.y_mm[part], motion.ball_angles_deg[:, part]]).T
        yield "".join(",".join([f"{value:.{DIGITS}g}" for value in row]) + "\n" for row in rows.tolist())
