"""A step of a method of the loop with any rates, and its dense output."""

from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.integrators.compiled.arrays import Step

Rates = Callable[[float, np.ndarray], Any]


class Stepping:
    """One step of `h` from `start` at `t`."""

    def __init__(
        self, method: ModuleType, rates: Rates, start: Any, t: float, h: float, patch: pytest.MonkeyPatch
    ) -> None:
        def put(t: float, y: Any, par: Any, dy: Any, *_: Any) -> None:
            dy[: self.n] = rates(t, np.asarray(y[: self.n]))

        for function in ("rates", "watched"):
            patch.setattr(method, function, put)
        self.method, self.start = method, np.atleast_1d(np.array(start, dtype=float))
        self.n = len(self.start)
        n = self.n
        self.k, self.end = np.zeros(n * method.KEPT), np.zeros(n)
        self.between = np.zeros(n * method.BETWEEN)
        self.k[:n] = rates(t, self.start)
        nothing = np.zeros(0)
        self.step: Any = Step(t, h, n, *(self.start, nothing, self.end, self.k, self.between, np.zeros(n)))  # type: ignore[arg-type]
        method.stages(self.step, nothing)
        method.prepared(self.step)

    def error(self, tolerance: float) -> float:
        """The estimate, in units of an absolute tolerance."""
        allowed = np.full(self.n, tolerance)
        return float(self.method.error(self.step, allowed, 0 * allowed))

    def at(self, share: float) -> np.ndarray:
        """State at a share of the step."""
        state = np.zeros(self.n)
        self.method.dense(share, self.n, self.start, self.between, state)
        return state
