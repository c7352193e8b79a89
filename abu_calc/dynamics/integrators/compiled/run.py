"""Integration in compiled code, from one general decision to the next: steps, events and natural next modes.

`layout` and `constants` place the data of a scene in the arrays of the loop, with the constants that it needs beside
the equations.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.codegen.tracer import Numbers, cached
from abu_calc.dynamics.effect import ACROSS_RATE, Effect, Rule
from abu_calc.dynamics.effects.ball_contact import LIFT, MARGIN, Neighbours
from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled import arrays
from abu_calc.dynamics.integrators.compiled.code import Code, code, text
from abu_calc.dynamics.integrators.compiled.kernels import METHODS, Method
from abu_calc.dynamics.integrators.compiled.plain import Plain
from abu_calc.dynamics.integrators.compiled.program import Places, Program, in_order, places, widened
from abu_calc.dynamics.integrators.run import (
    MOST_EVALUATIONS,
    NOT_FINITE,
    STALLED,
    IntegrationRun,
    decision_work,
    exceeded,
    lost,
)
from abu_calc.dynamics.rotor import Modes
from abu_calc.dynamics.switching.modes import at_break, settled, starting
from abu_calc.dynamics.switching.stick_slip import AT_REST
from abu_calc.dynamics.trajectory import Times, Trajectory

Array = NDArray[np.float64]

Loader = Callable[[Equations, Method], bool]
"""Makes the code of a scene for a method; False where no compiled code runs."""

LOOSE = 1e-3
"""Tolerance below which the longest step shrinks as the method's own steps do, as with SciPy."""

LIFT_SHARE = 0.02
"""Share of the tolerance by which balls must part [rad] for a rebound to be one."""

SHARES: dict[Method, float] = {"rk45": 0.1, "dop853": 0.3}
"""Share of the tolerance to which a step is held, for each method.

Events are located on the dense output, whose error is not that of the steps' ends. With these shares
the motion is about as far off by both methods.
"""


def rules(equations: Equations, modes: Modes) -> list[Rule | None]:
    """Rule by which compiled code finds each effect's next mode; none if balls move across their race."""
    across = ACROSS_RATE in equations.scene.ball_states
    mode_rules = [effect.rule(mode) for effect, mode in zip(equations.scene.effects, modes, strict=True)]
    return [None if across and rule and rule.name != "one-sided contact" else rule for rule in mode_rules]


def decides(effects: tuple[Effect, ...], modes: Modes, mode_rules: list[Rule | None]) -> bool:
    """True if compiled code may decide the very first modes: no effect has modes unknown to it."""
    rows = zip(effects, modes, mode_rules, strict=True)
    return all(rule is not None or mode is None or not effect.switches for effect, mode, rule in rows)


def layout(
    equations: Equations, modes: Modes, program: Program, mode_places: list[dict[str, int]]
) -> NDArray[np.int64]:
    """Places of all data, in the order that `arrays` names."""
    p, watched, criteria = equations.parameters, 0, sum(program.watched)
    flags = arrays.BEHIND + 2 * p.balls + 2
    positions = np.full(flags + criteria, -1, dtype=np.int64)
    positions[arrays.APPARENT] = flags
    for criterion, states in program.apparent.items():
        positions[flags + criterion] = len(positions)
        positions = np.append(positions, (len(states), *states))
    positions[arrays.SEEN], positions[arrays.ORDER] = len(program.apparent), len(positions)
    others = (index for index in range(criteria) if index not in program.apparent)
    positions = np.append(positions, np.array((*program.apparent, *others), dtype=np.int64))
    first = min(min(row.values(), default=program.numbers) for row in mode_places)
    positions[: arrays.NUMBERS + 1] = (
        len(equations.states), p.balls, 2 * p.size + p.balls, criteria, program.values, first, mode_places[-1][""],
        program.numbers,
    )  # fmt: skip
    for k, (rule, mode, row) in enumerate(zip(rules(equations, modes), modes, mode_places, strict=False)):
        if rule and rule.name == "dry friction":
            positions[arrays.FRICTION : arrays.SIDE + 1] = watched, criteria, row["direction"], row["side"]
        if rule and rule.name == "ball contact":
            numbers = (row[name] for name in ("turns", "touching", "least", "joined"))
            positions[arrays.GAPS : arrays.JOINED + 1] = watched, len(mode.joined), *numbers
            positions[arrays.BEHIND : arrays.BEHIND + 2 * len(mode.joined)] = (*mode.behind, *mode.ahead)
        if rule and rule.name == "one-sided contact":
            positions[arrays.ONE_SIDED], positions[arrays.TOUCHES] = watched, row[""]
        watched, criteria = watched + program.watched[k], criteria + program.criteria[k]
    return positions


def constants(equations: Equations, modes: Modes, tolerance: float, method: Method) -> Array:
    """Constants of a scene that the loop needs beside its equations, in the order that `arrays` names."""
    p = equations.parameters
    order = METHODS[method].METHOD_ORDER
    longest = equations.longest_step * min(1.0, (tolerance / LOOSE) ** (1 / order))
    slow = equations.scales[2 * p.size + p.balls] if p.balls else 1.0
    inertias = p.static_moments * p.radii
    restitution = next((rule.restitution for rule in rules(equations, modes) if rule and rule.restitution), 0.0)
    held, rounding = SHARES[method] * tolerance, 100 * np.finfo(float).eps
    torque = (inertias.max() * p.speed**2, MARGIN * inertias.mean() * p.speed**2) if p.balls else (1.0, 1.0)
    return np.concatenate([
        (longest, 0.0, AT_REST * slow, slow, restitution, torque[0], STALLED * equations.scene.revolution, torque[1],
         lifted(tolerance)),
        held * np.array(equations.scales),
        np.where(equations.relative, max(held, rounding), rounding), inertias,
    ])  # fmt: skip


def lifted(tolerance: float) -> float:
    """Least way [rad] by which balls must part for a rebound to be one, with steps of this tolerance.

    Elastic balls that are pressed together bounce ever faster, as 1/√(this). At 1e-5 rad a start may end its bouncing
    otherwise and settle 6 % later; at a tolerance of 5e-5 and below it is that of the reference.

    >>> [f"{lifted(tolerance):.0e}" for tolerance in (1e-3, 2e-4, 2e-5, 1e-8)]
    ['2e-05', '4e-06', '1e-06', '1e-06']
    """
    return max(LIFT, LIFT_SHARE * tolerance)


def numbers_places(modes: Modes, count: int) -> list[dict[str, int]]:
    """Places of each mode's numbers among this many numbers, counted from the first."""
    return [{name: count + at for name, at in row.items()} for row in places(modes)]


WAYS = {True: "compiled", False: "plain"}
"""First words of the integrators' names, with a compiler and without."""

AT_ONCE = 20_000
"""Evaluations between two returns from compiled code, within which no interrupt is heard: some hundredths of a
second."""

AT_ONCE_SHORT = 4_000
"""The same of a run in plain Python that seemed short: after so many it goes on in compiled code."""

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
    long: Loader | None = None,
) -> Trajectory:
    """The motion from t = 0 to the last of `sample_times` [s], ascending; in plain Python if not `compiled`.

    `long` loads compiled code, in which a run in plain Python goes on that turns out to be long. Raises as SciPy's
    does, and CompilerError where there is no compiler that works.
    """
    ordered, places = in_order(equations)
    given = np.argsort(places)
    run = _CompiledRun(
        ordered, tolerance, sample_times, most_evaluations, given=given, compiled=compiled, method=method, long=long
    )
    return run.trajectory()


@dataclass
class _CompiledRun(IntegrationRun):
    """One integration in compiled code, or in the same code as plain Python.

    The balls are in order, and handed on in the order `given`.
    """

    given: Places = field(kw_only=True)
    compiled: bool = field(kw_only=True)
    method: Method = field(kw_only=True)
    long: Loader | None = field(kw_only=True, default=None)

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
        at_once = AT_ONCE_SHORT if self.long else AT_ONCE
        far = float(self.clock[arrays.TIME]) + (at_once / self.per_step + 2) * self.longest
        times = self.samples[self.done : np.searchsorted(self.samples, far, side="right")]
        rows = np.empty((len(times), len(self.state)))
        self.counts[arrays.DONE], self.counts[arrays.SAMPLES] = 0, len(times)
        self.counts[arrays.PAUSE] = self.counts[arrays.EVALUATIONS] + at_once
        how = self.code.go(
            self.state, self.numbers, self.parameters, self.layout, self.constants, self.clock, self.counts, times,
            rows, self.room,
        )  # fmt: skip
        self.fill(rows[: self.counts[arrays.DONE]].T[self.given])
        if how == arrays.PAUSED:
            self.heed_patience(float(self.clock[arrays.TIME]))
            if self.long is not None:
                self._compile(self.long)
        return int(how)

    def _compile(self, load: Loader) -> None:
        """Go on in compiled code, where it runs: it has the same arrays."""
        self.long = None
        if load(self.equations, self.method):
            self.compiled, self.code = True, prepared(self.equations, self.method)[0]

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
                self.counts[arrays.MOST] -= decision_work(equations)


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
