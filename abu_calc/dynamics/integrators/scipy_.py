"""Integration by SciPy's DOP853 (Hairer, Nørsett & Wanner 1993, Solving Ordinary Differential Equations I, II.5)."""

import importlib
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations import Equations
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import InputError, NotTrustworthyError
from abu_calc.validity import Range

if TYPE_CHECKING:
    from scipy.integrate import DOP853

NAME = "scipy-dop853"

TOLERANCE = Range("tolerance", 1e-13, 0.1)
"""Below, rounding decides; above, the method's own estimate of its error means nothing."""

LOOSE, ORDER = 1e-3, 8
"""Below this tolerance the longest step shrinks as DOP853's own steps do: were it to rule two runs of different
tolerance alike, they would agree without being right."""

STIFF = 300.0
"""Largest |eigenvalue| × time of a linear system that an explicit method still takes cheaply."""

MOST_EVALUATIONS = 12_000_000
"""Some minutes of work; a scene that needs more is stiff or too long for this method."""


def load() -> None:
    """Import the library, so that the time of the first run is that of the integration."""
    importlib.import_module("scipy.integrate")


def integrate(
    equations: Equations,
    tolerance: float,
    sample_times: Sequence[float] | NDArray[np.float64],
    most_evaluations: int = MOST_EVALUATIONS,
) -> Trajectory:
    """The motion from t = 0 to the last of `sample_times` [s], ascending.

    The error of a step is held below tolerance × (scale of the state, plus its size where `relative`). Raises
    InputError for moments that do not ascend from 0, RangeError for the tolerance, and NotTrustworthyError, naming the
    moment, when the motion leaves the finite numbers or the steps become too small or too many.
    """
    from scipy.integrate import DOP853

    TOLERANCE.check(tolerance)
    samples = np.asarray(sample_times, dtype=float)
    if not (len(samples) and samples[0] >= 0 and 0 < samples[-1] < np.inf and np.all(np.diff(samples) > 0)):
        raise InputError("sample times must be finite and ascend from 0 or later")
    # SciPy accepts nothing below 100 units of rounding. It takes an array, though its type stubs know numbers only.
    relative: Any = np.where(equations.relative, tolerance, 100 * np.finfo(float).eps)
    absolute: Any = tolerance * np.array(equations.scales)
    longest = equations.longest_step * min(1.0, (tolerance / LOOSE) ** (1 / ORDER))
    # Overflow and invalid numbers are looked for after each step, where the moment can be told.
    with np.errstate(all="ignore"):
        solver = DOP853(
            lambda t, y: equations.rhs(np, t, y, equations.parameters),
            0.0,
            np.array(equations.initial, dtype=float),
            samples[-1],
            rtol=relative,
            atol=absolute,
            max_step=longest,
            # SciPy's own guess depends on the unit of time (1e-6 of it for motion from rest).
            first_step=min(longest / 100, samples[-1]),
        )
        states, steps = _march(solver, samples, most_evaluations)
    return Trajectory(
        t=samples,
        y=states,
        integrator=NAME,
        tolerance=tolerance,
        evaluations=solver.nfev,
        steps=steps,
        status="finished",
        message=f"reached the end at {samples[-1]:g} s",
    )


def transition(matrix: Callable[[float], NDArray[np.float64]], end: float) -> NDArray[np.float64]:
    """The map z(0) → z(end) of z' = A(t) z, errors below 1e-9 of what has grown; A(t) a small real matrix.

    DOP853, or Radau where A would force more than some hundred steps on it (Hairer & Wanner 1996, IV.8). Raises
    NotTrustworthyError when the integration fails.
    """
    from scipy.integrate import solve_ivp

    start = matrix(0.0)
    unit = np.eye(len(start))
    stiff = float(np.abs(np.linalg.eigvals(start)).max()) * end > STIFF
    # Of the columns of the map side by side, the Jacobian is A for each.
    implicit: Any = {"method": "Radau", "jac": lambda t, z: np.kron(matrix(t), unit)} if stiff else {"method": "DOP853"}
    try:
        with np.errstate(all="ignore"):
            done = solve_ivp(
                lambda t, z: (matrix(t) @ z.reshape(unit.shape)).ravel(),
                (0.0, end),
                unit.ravel(),
                rtol=1e-9,
                atol=1e-12,
                **implicit,
            )
    except ValueError as error:  # an implicit step meets a number that is none
        raise _not_integrated(str(error)) from None
    if not done.success or not np.isfinite(done.y[:, -1]).all():
        raise _not_integrated(done.message)
    return np.asarray(done.y[:, -1].reshape(unit.shape), dtype=float)


def _not_integrated(reason: str) -> NotTrustworthyError:
    return NotTrustworthyError(
        f"the linear motion cannot be integrated: {reason}\n"
        "  ask for a speed nearer to the natural frequencies, or for less drag"
    )


def _march(solver: "DOP853", samples: NDArray[np.float64], most_evaluations: int) -> tuple[NDArray[np.float64], int]:
    """The states at the samples, and the steps it took to get past them."""
    states = np.empty((len(solver.y), len(samples)))
    done = int(samples[0] == 0)
    states[:, :done] = solver.y[:, None]
    steps = 0
    while solver.status == "running":
        if solver.nfev > most_evaluations:
            raise _lost(solver, f"more work than allowed, {solver.nfev} evaluations")
        message = solver.step()
        if message is not None or not np.isfinite(solver.y).all():
            raise _lost(solver, message or "a state is no longer finite")
        steps += 1
        upto = int(np.searchsorted(samples, solver.t, side="right"))
        if upto > done:  # interpolation costs a quarter of a step, so only where it is asked for
            states[:, done:upto] = solver.dense_output()(samples[done:upto])
            done = upto
    return states, steps


def _lost(solver: "DOP853", reason: str) -> NotTrustworthyError:
    return NotTrustworthyError(
        f"integration lost at t = {solver.t:.6g} s: {reason.rstrip('.')}\n"
        "  shorten the run, or look for a drag, stiffness or speed that is far from any real machine"
    )
