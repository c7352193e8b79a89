"""The edge of the arm's tongue by Floquet theory: what averaging says of it only for a small imbalance.

(1 + 2κ cos t) z'' + 2κ (kσ − sin t) z' + k² z = 0 over one revolution; Kovalenko 2010, (17), κσ = h/ω₀, k = ω₀/ω.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.balanced import floquet
from abu_calc.roots import root

Array = NDArray[np.float64]

MOST: Final = 1.0
"""Twice what any σ_c of the tongue is at leading order."""


def arm_growth(kappa: float, ratio: float, sigma: float) -> float:
    """Growth per radian of rotation, ln|μ|/2π, of the arm's free motion; κ < 1/2.

    Raises NotTrustworthyError when the multipliers do not settle.

    >>> round(arm_growth(0.02, 0.5, 0.0), 6)  # κ/4 to leading order
    0.005001
    """

    def matrices(t: Array) -> Array:
        """Matrices of z and p = (1 + 2κ cos t) z', scaled to k z."""
        matrix = np.zeros((len(t), 2, 2))
        weight = 1 + 2 * kappa * np.cos(t)
        matrix[:, 0, 1], matrix[:, 1, 0], matrix[:, 1, 1] = ratio / weight, -ratio, -2 * kappa * sigma * ratio / weight
        return matrix

    largest = np.abs(floquet.multipliers(matrices, 2 * math.pi, np.eye(2))).max()
    return math.log(largest) / (2 * math.pi)


def floquet_edge(kappa: float, ratio: float) -> float:
    """σ_c at k: the damping above which the arm's free motion does not grow, 0 where it does not without any.

    >>> round(floquet_edge(0.1, 0.5), 5)
    0.49461
    """
    small = 1e-3  # undamped, outside the tongue, |μ| = 1: rounding would decide there
    if arm_growth(kappa, ratio, small) <= 0:
        return 0.0
    return root(lambda sigma: arm_growth(kappa, ratio, sigma), small, MOST, xtol=1e-6)
