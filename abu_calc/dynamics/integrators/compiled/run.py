"""Integration in compiled code, from one general decision to the next: steps, events and natural next modes."""

from dataclasses import dataclass, field, fields, replace
from functools import lru_cache
from typing import Any

import numpy as np

from abu_calc.dynamics.effects.ball_contact import Neighbours
from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled import arrays
from abu_calc.dynamics.integrators.compiled.code import Code, code, text
from abu_calc.dynamics.integrators.compiled.kernels import METHODS, Method
from abu_calc.dynamics.integrators.compiled.layout import constants, decides, layout, numbers_places, rules
from abu_calc.dynamics.integrators.compiled.order import Places, in_order
from abu_calc.dynamics.integrators.compiled.plain import Plain
from abu_calc.dynamics.integrators.compiled.program import widened
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS, NOT_FINITE, Array, Run, exceeded, lost
from abu_calc.dynamics.parameters import Modes
from abu_calc.dynamics.switching.modes import at_break, settled, starting
from abu_calc.dynamics.tracing.traced import Numbers, cached
from abu_calc.dynamics.trajectory import Times, Trajectory

WAYS = {True: "compiled", False: "plain"}
"""First words of the integrators' names, with a compiler and without."""

AT_ONCE = 20_000
"""Evaluations between two returns from compiled code, within which no interrupt is heard: some hundredths of a
second."""

REASONS = {
    arrays.NOT_FINITE: NOT_FINITE,
    arrays.TOO_SMALL: "Required step size is less than spacing between numbers.",
    arrays.STALL: "the motion stalls in ever more events",
}


def integrate(
    equations: Equations,
    tolerance: float,
    sample_times: Times,
    most_evaluations: int = MOST_EVALUATIONS,
    compiled: bool = True,
    method: Method = "rk45",
) -> Trajectory:
    """The motion from t = 0 to the last of `sample_times` [s], ascending; in plain Python if not `compiled`.

    Raises as SciPy's does, and CompilerError where there is no compiler that works.
    """
    ordered, places = in_order(equations)
    given = np.argsort(places)
    run = _Run(ordered, tolerance, sample_times, most_evaluations, given=given, compiled=compiled, method=method)
    return run.trajectory()


@dataclass
class _Run(Run):
    """One integration in compiled code, or in the same code as plain Python.

    The balls are in order, and handed on in the order `given`.
    """

    given: Places = field(kw_only=True)
    compiled: bool = field(kw_only=True)
    method: Method = field(kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        equations = self.equations
        self.modes = at_break(equations, 0.0, equations.first_modes)
        parts: tuple[Code | Plain, Array] = (prepared if self.compiled else written)(equations, self.method)
        self.code, self.numbers = parts
        program = self.code.program
        wide = widened(equations, self.modes)
        self.places = numbers_places(wide.modes, len(self.numbers))
        self.layout = layout(equations, self.modes, program, self.places)
        self.constants = constants(equations, self.modes, self.tolerance, self.method)
        self.parameters = np.empty(program.parameters)
        self.room = np.zeros(self._room(program.values))
        self.clock = np.array([0.0, self.constants[arrays.LONGEST] / 100, 0.0])
        self.counts = np.zeros(arrays.COUNTS + 2 * max(int(self.layout[arrays.PAIRS]), 0), dtype=np.int64)
        self.counts[arrays.MOST] = self.most_evaluations
        self.per_step, self.longest = METHODS[self.method].STAGES, float(self.constants[arrays.LONGEST])

    @property
    def name(self) -> str:
        """The method, and whether it is compiled."""
        return f"{WAYS[self.compiled]}-{self.method}"

    def _room(self, values: int) -> int:
        """Numbers that the loop works with."""
        states, pairs = len(self.equations.states), max(int(self.layout[arrays.PAIRS]), 0)
        deciding = states + len(self.numbers) + pairs * (6 + 2 * pairs + states)
        method = METHODS[self.method]
        return int(method.KEPT + 3 + method.BETWEEN) * states + 6 * values + deciding

    def _put(self, modes: Modes) -> None:
        """Modes as numbers."""
        for mode, row in zip(modes, self.places, strict=False):
            for name, at in row.items():
                value = np.ravel(getattr(mode, name) if name else mode)
                self.numbers[at : at + len(value)] = value

    def _taken(self, modes: Modes) -> Modes:
        """Modes from numbers; `modes` tells their kinds."""
        return tuple(self._one(mode, row) for mode, row in zip(modes, self.places, strict=False))

    def _one(self, mode: Any, row: dict[str, int]) -> Any:
        if "" in row:
            return float(self.numbers[row[""]])
        parts: dict[str, Any] = {
            part.name: self._part(getattr(mode, part.name), row[part.name])
            for part in (fields(mode) if row else ())
            if part.name in row
        }
        if isinstance(mode, Neighbours):
            parts["tied"] = bool(parts["joined"].any())
        return replace(mode, **parts) if parts else mode

    def _part(self, part: Any, place: int) -> Any:
        """A number or an array of a mode, as it was given."""
        return self.numbers[place : place + np.size(part)].copy() if np.ndim(part) else float(self.numbers[place])

    def segment(self, t: float, state: Array, modes: Modes, bound: float) -> tuple[float, Array, bool]:
        """Toward the bound, up to an event that needs the general decision."""
        self._put(modes)
        self.state = np.array(state, dtype=float)
        self.clock[arrays.TIME] = self.clock[arrays.BEGUN] = t
        self.constants[arrays.END] = bound
        how = arrays.PAUSED
        while how == arrays.PAUSED:
            how = self._go_on()
        self.steps, self.evaluations, self.events = (
            int(self.counts[index]) for index in (arrays.STEPS, arrays.EVALUATIONS, arrays.EVENTS)
        )
        now = float(self.clock[arrays.TIME])
        if how == arrays.TOO_MUCH:
            raise exceeded(now, self.evaluations, self.events)
        if how in REASONS:
            raise lost(now, REASONS[how])
        return now, self.state, how == arrays.UNDECIDED

    def _go_on(self) -> int:
        """Up to the next return from compiled code, with the samples that come until then."""
        far = float(self.clock[arrays.TIME]) + (AT_ONCE / self.per_step + 2) * self.longest
        times = self.samples[self.done : np.searchsorted(self.samples, far, side="right")]
        rows = np.empty((len(times), len(self.state)))
        self.counts[arrays.DONE], self.counts[arrays.SAMPLES] = 0, len(times)
        self.counts[arrays.PAUSE] = self.counts[arrays.EVALUATIONS] + AT_ONCE
        how = self.code.go(
            self.state, self.numbers, self.parameters, self.layout, self.constants, self.clock, self.counts, times,
            rows, self.room,
        )  # fmt: skip
        self.fill(rows[: self.counts[arrays.DONE]].T[self.given])
        if how == arrays.PAUSED:
            self.heed_patience(float(self.clock[arrays.TIME]))
        return int(how)

    def _go(self) -> None:
        equations, ends = self.equations, self.ends()
        end = ends[-1]
        state, modes = np.array(equations.initial, dtype=float), self.modes
        if decides(equations.scene.effects, modes, rules(equations, modes)):
            self.counts[arrays.START] = 1
        else:
            state, modes = starting(equations)
        t = 0.0
        while t < end:
            first, bound = bool(self.counts[arrays.START]), next(moment for moment in ends if moment > t)
            t, state, undecided = self.segment(t, state, modes, bound)
            if first and undecided and not self.counts[arrays.EVENTS]:
                state, modes = starting(equations)
                continue
            modes = self._taken(modes)
            if t == bound:
                if self.recorder.enough(t):
                    return
                if not undecided and t not in equations.breaks:
                    continue  # nothing has happened: it was looked whether this is enough
                modes = at_break(equations, t, modes)
            if t < end:
                state, modes = settled(equations, t, state, modes)


def prepared(equations: Equations, method: Method) -> tuple[Code, Array]:
    """The code of a scene whose balls are in order, and its numbers. Raises CompilerError."""
    wide, structure, numbers = described(equations)
    return code(structure, equations, wide, numbers, method), numbers.copy()


def written(equations: Equations, method: Method) -> tuple[Plain, Array]:
    """The same in plain Python."""
    wide, structure, numbers = described(equations)
    made = cached(_written, (structure, method), lambda: Plain(text(structure, equations, wide), method))
    return made, numbers.copy()


_written: dict[object, Plain] = {}


@lru_cache(maxsize=8)
def described(equations: Equations) -> tuple[Any, Any, Array]:
    """The widest modes, the structure and the numbers of a scene whose balls are in order."""
    wide = widened(equations, at_break(equations, 0.0, equations.first_modes))
    structure, numbers = Numbers(replace(equations, parameters=wide.parameters)).of(wide.modes)
    return wide, structure, np.array(numbers)
