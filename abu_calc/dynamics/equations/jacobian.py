"""Exact derivatives of the equations of motion."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import Equations

STEP = 1e-100
"""An imaginary step cancels nothing, so it may be so small that its square is nothing."""


def jacobian(
    equations: Equations, t: float, y: NDArray[np.float64], modes: tuple[Any, ...] | None = None
) -> NDArray[np.float64]:
    """∂(rhs)/∂y at (t, y) by the complex step, exact to rounding (Squire & Trapp 1998, SIAM Review 40(1)).

    J[i, j] = Im rhs_i(y + i·h·e_j)/h.
    """
    acting = equations.acting if modes is None else equations.in_mode(modes)
    columns = np.empty((len(y), len(y)))
    for j in range(len(y)):
        moved = np.array(y, dtype=complex)
        moved[j] += 1j * STEP
        columns[:, j] = equations.rhs(np, t, moved, acting).imag / STEP
    return columns
