"""Events of SciPy's runs: the times at which one of the watched numbers falls below zero, on the dense output."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.integrators.run import Array
from abu_calc.dynamics.tracing.plain import Function
from abu_calc.roots import root

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
