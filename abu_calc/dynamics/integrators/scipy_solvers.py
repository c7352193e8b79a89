"""Integration by SciPy: explicit steps for smooth motion, implicit ones for stiff equations, and located events.

DOP853: Hairer, Nørsett & Wanner 1993, Solving Ordinary Differential Equations I, II.5. Radau IIA of order 5 for stiff
equations: Hairer & Wanner 1996, the second volume, IV.8. Events are the times at which a watched number falls below
zero, on the dense output.
"""

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.codegen.tracer import Function, functions, numbers_of
from abu_calc.dynamics.equations.assemble import Equations, jacobian
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS, NOT_FINITE, Array, IntegrationRun, exceeded, lost
from abu_calc.dynamics.rotor import Modes
from abu_calc.dynamics.switching.modes import watches
from abu_calc.dynamics.trajectory import Times, Trajectory
from abu_calc.foundation.roots import root

if TYPE_CHECKING:
    from scipy.integrate import OdeSolver

CHECKS = (0.25, 0.5, 0.75)
"""Places in a step at which events are looked for, beside its end."""


@dataclass
class Watcher:
    """Looks for the first time at which one of the watched numbers falls below zero."""

    watched: Function
    t: float
    state: Array
    evaluations: int = 0

    def __post_init__(self) -> None:
        # A number that starts at zero has just been switched: it counts once it has risen.
        self.before = self._values(self.t, self.state)
        self.since = self.t

    def _values(self, t: float, y: Array) -> Array:
        self.evaluations += 1
        return np.array(self.watched(t, y), dtype=float)

    def event(self, dense: Any, start: float, end: float) -> float | None:
        """The first event between two times, None when there is none."""
        times, rows = [self.since], [self.before]
        checks = [*(start + part * (end - start) for part in CHECKS), end]
        for t, y in zip(checks, dense(np.array(checks)).T, strict=True):
            values = self._values(t, y)
            times.append(t)
            rows.append(values)
            event_times = self._dips(dense, times[-3:], rows[-3:])
            if len(fallen := np.flatnonzero(values < 0)):
                event_times.append(self._first(fallen, dense, t))
            if event_times:
                return min(event_times)
            self.before, self.since = values, t
        return None

    def _dips(self, dense: Any, times: list[float], rows: list[Array]) -> list[float]:
        """Events of numbers that fall below zero and rise again within three checks, by a parabola through them."""
        if len(times) < 3:
            return []
        (a, b, c), (first, second, third) = times, rows
        slope, later = (second - first) / (b - a), (third - second) / (c - b)
        bend = (later - slope) / (c - a)
        lowest = (a + b) / 2 - slope / (2 * np.where(bend > 0, bend, 1.0))
        depth = first + (lowest - a) * (slope + bend * (lowest - b))
        dips = (bend > 0) & (lowest > a) & (lowest < c) & (depth < 0) & (first > 0) & (second > 0) & (third > 0)
        event_times = []
        for index in np.flatnonzero(dips):
            t = float(lowest[index])
            if self._values(t, dense(t))[index] < 0:
                event_times.append(self._crossing(int(index), dense, a if t < b else b, t))
        return event_times

    def _first(self, fallen: NDArray[np.intp], dense: Any, t: float) -> float:
        """The first of the events that lie behind at t; each is looked for before the one found last."""
        while len(fallen):
            t = self._located(int(fallen[0]), dense, t)
            fallen = fallen[1:][self._values(t, dense(t))[fallen[1:]] < 0]
        return t

    def _located(self, index: int, dense: Any, t: float) -> float:
        if self.before[index] <= 0:  # it never rose: the event is the very start
            return self.since
        return self._crossing(index, dense, self.since, t)

    def _crossing(self, index: int, dense: Any, above: float, below: float) -> float:
        xtol = 1e-15 * max(abs(below), 1e-300)
        return root(lambda s: self._values(s, dense(s))[index], above, below, xtol=xtol, rtol=1e-14)


Method = Literal["scipy-dop853", "scipy-rk45", "scipy-lsoda", "scipy-radau", "scipy-bdf"]

KINDS = {
    "scipy-dop853": "DOP853",
    "scipy-rk45": "RK45",
    "scipy-lsoda": "LSODA",
    "scipy-radau": "Radau",
    "scipy-bdf": "BDF",
}

STAGES = {"scipy-dop853": 12, "scipy-rk45": 6}
"""Evaluations of every step; those of the other methods vary."""

LOOSE, ORDER = 1e-3, 8
"""Tolerance below which the longest step shrinks as DOP853's own steps do, and that method's order.

If the longest step ruled two runs of different tolerance alike, they would agree without being right.
"""


def load() -> None:
    """Import the library, so that the time of the first run is that of the integration."""
    importlib.import_module("scipy.integrate")


def integrate(
    equations: Equations,
    tolerance: float,
    sample_times: Times,
    most_evaluations: int = MOST_EVALUATIONS,
    method: Method = "scipy-dop853",
) -> Trajectory:
    """The motion from t = 0 to the last of `sample_times` [s], ascending.

    The error of a step is held below tolerance × (scale of the state, plus its size where `relative`). Events are
    located on the dense output. Raises InputError for times that do not ascend from 0, RangeError for the tolerance,
    and NotTrustworthyError, naming the time, when the motion leaves the finite numbers, stalls in events, or the
    steps become too small or too many.
    """
    return _SciPyRun(equations, tolerance, sample_times, most_evaluations, method=method).trajectory()


@dataclass
class _SciPyRun(IntegrationRun):
    """One integration by a solver of SciPy's."""

    method: Method = "scipy-dop853"

    def __post_init__(self) -> None:
        super().__post_init__()
        self.per_step = STAGES.get(self.method, 1)
        self.longest *= min(1.0, (self.tolerance / LOOSE) ** (1 / ORDER))
        self.step = self.longest / 100
        self.numbers = numbers_of(self.equations)

    @property
    def name(self) -> str:
        """The method."""
        return self.method

    def segment(self, t: float, state: Array, modes: Modes, bound: float) -> tuple[float, Array, bool]:
        """Step by step; events are looked for within each."""
        rates, watched = functions(self.equations, self.numbers, modes)
        solver = self._solver(rates, t, state, modes, bound)
        watcher = Watcher(watched, t, state) if watches(self.equations) else None
        spent = self.evaluations
        while solver.status == "running":
            self.evaluations = spent + _evaluations(solver, watcher)
            if self.evaluations > self.most_evaluations:
                raise exceeded(solver.t, self.evaluations, self.events)
            self.heed_patience(solver.t)
            try:
                message = solver.step()
            except ValueError:  # implicit methods meet a number that is none in their matrices
                raise lost(solver.t, NOT_FINITE) from None
            if message is not None or not np.isfinite(solver.y).all():
                raise lost(solver.t, message or NOT_FINITE)
            self.steps, self.step = self.steps + 1, solver.step_size or self.step
            # Interpolation costs a quarter of a step, so only where it is asked for.
            asked = watcher is not None or self.samples[self.done] <= solver.t
            dense = solver.dense_output() if asked else None
            event = watcher.event(dense, solver.t_old, solver.t) if watcher else None
            self.evaluations = spent + _evaluations(solver, watcher)
            if dense is not None:
                last = int(np.searchsorted(self.samples, solver.t if event is None else event, side="right"))
                if last > self.done:
                    self.fill(dense(self.samples[self.done : last]))
            if event is not None:
                if event == t:  # what was just switched shows in a short step, before the error of a long one hides it
                    self.step = (solver.t - t) / 10
                return event, dense(event), True  # type: ignore[misc]
        return bound, solver.y, False

    def _solver(self, rates: Function, t: float, state: Array, modes: Modes, bound: float) -> "OdeSolver":
        import scipy.integrate

        equations = self.equations
        # SciPy accepts nothing below 100 units of rounding. It takes an array, though its type stubs know numbers only.
        relative: Any = np.where(equations.relative, self.tolerance, 100 * np.finfo(float).eps)
        absolute: Any = self.tolerance * np.array(equations.scales)
        implicit: Any = {}
        if self.method in ("scipy-radau", "scipy-bdf", "scipy-lsoda"):
            implicit = {"jac": lambda t, y: jacobian(equations, t, y, modes)}
        if self.method in ("scipy-radau", "scipy-bdf"):  # their Newton iteration takes one number only
            relative = max(self.tolerance, 1e-12)
        kind = getattr(scipy.integrate, KINDS[self.method])
        solver: OdeSolver = kind(
            rates,
            t,
            state,
            bound,
            rtol=relative,
            atol=absolute,
            max_step=self.longest,
            # SciPy's own guess depends on the unit of time (1e-6 of it for motion from rest).
            first_step=min(self.step, self.longest, bound - t),
            **implicit,
        )
        return solver


def _evaluations(solver: "OdeSolver", watcher: Watcher | None) -> int:
    """Evaluations of the equations so far; a Jacobian takes one for each state."""
    return int(solver.nfev + solver.njev * solver.n + (watcher.evaluations if watcher else 0))
