"""A motion as CSV: the axis in mm, ball angles in degrees, unwrapped, and what else of the scene moves."""

from collections.abc import Iterator

import numpy as np

from abu_calc.frozen import dataclass
from abu_calc.studies.motion import Motion

DIGITS = 12

BLOCK = 10_000
"""Rows that are text at once: a million of them would take a gigabyte."""


@dataclass(frozen=True)
class TrajectoryCsv:
    """Columns t_s, x_mm, y_mm, ball1_deg, … and those of `further`; a row for each time; in pieces of some rows."""

    motion: Motion

    def __len__(self) -> int:
        """Number of pieces."""
        return 1 + -(-len(self.motion.t_s) // BLOCK)

    def __iter__(self) -> Iterator[str]:
        columns = self.motion.columns
        yield ",".join(columns) + "\n"
        for first in range(0, len(self.motion.t_s), BLOCK):
            part = slice(first, first + BLOCK)
            rows = np.vstack([column[part] for column in columns.values()]).T
            yield "".join(",".join([f"{value:.{DIGITS}g}" for value in row]) + "\n" for row in rows.tolist())
