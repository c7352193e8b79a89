"""Exact derivatives of the equations of motion."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.column import at_samples
from abu_calc.dynamics.equations.assemble import Equations

Array = NDArray[np.float64]

STEP = 1e-100
"""An imaginary step cancels nothing, so it may be so small that its square is nothing."""


def jacobian(equations: Equations, t: float, y: Array, modes: tuple[Any, ...] | None = None) -> Array:
    """∂(rhs)/∂y at (t, y), in the first modes unless others are given; see `jacobians`."""
    matrix: Array = jacobians(equations, np.array([t]), np.array([y]), modes)[0]
    return matrix


def jacobians(equations: Equations, times: Array, states: Array, modes: tuple[Any, ...] | None = None) -> Array:
    """∂(rhs)/∂y, [time, row, column], at these times and the state of each, exact to rounding.

    By the complex step J[i, j] = Im rhs_i(y + i·h·e_j)/h (Squire & Trapp 1998, SIAM Review 40(1)), all times and all
    directions at once.
    """
    acting, size = equations.acting if modes is None else equations.in_mode(modes), states.shape[1]
    moved = states.T[:, :, None] + 1j * STEP * np.eye(size)[:, None, :]

    def rates(t: Any, y: Any) -> Any:
        return equations.rhs(np, t, y, acting)

    every = np.repeat(times, size), moved.reshape(size, -1)
    slopes = at_samples(rates, *every, at_once=equations.parameters.traceable)
    return np.asarray(np.imag(slopes).reshape(moved.shape).transpose(1, 0, 2) / STEP, dtype=float)
