"""What an integrator hands on."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Trajectory:
    """States over time: y[state, time] at the times asked for, in ascending order [s]; a run that fails raises.

    `evaluations` counts calls of the right-hand side and of what is watched (order × steps stands for them with heyoka,
    which makes none).
    """

    t: NDArray[np.float64]
    y: NDArray[np.float64]
    integrator: str
    tolerance: float
    evaluations: int
    steps: int
    events: int = 0
    """Switches of modes."""

    def at(self, times: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]:
        """y at times that were asked for of the integrator; raises ValueError for any other."""
        wanted = np.asarray(times, dtype=float)
        index = np.minimum(np.searchsorted(self.t, wanted), len(self.t) - 1)
        if not np.array_equal(self.t[index], wanted):
            raise ValueError("the trajectory was not sampled at these times")
        return self.y[:, index]
