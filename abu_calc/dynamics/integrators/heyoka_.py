"""Integration by heyoka: Taylor series of high order, compiled (Biscani & Izzo 2021, MNRAS 504(2), 2614; step size of
Jorba & Zou 2005, Experimental Mathematics 14(1), 99).

The one right-hand side is traced and compiled; every number of the scene is a parameter of the compiled code, so that
it serves all scenes of one structure (number of balls, kind of support, effects) and all their modes. heyoka keeps it
on disk for later processes.

heyoka bounds the error of a step by (its tolerance) × (the largest state, or 1 where all are below 1), and compiles its
tolerance in, as the order. So the states are counted in units of scale × tolerance / COMPILED: they stay below 1, and
one compiled order serves every tolerance.
"""

import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np

from abu_calc.dynamics.assemble import Equations
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS, Array, Run, lost
from abu_calc.dynamics.integrators.symbols import Functions, Tape
from abu_calc.dynamics.modes import Modes, watched, watches
from abu_calc.dynamics.parameters import Parameters
from abu_calc.dynamics.trajectory import Trajectory

COMPILED = 1e-15
"""heyoka's own tolerance: order 19."""

FAINT = 1e-30
"""Factor on watched numbers: heyoka counts them among the states whose error it bounds, and they have no scale."""

ABOVE = 1e-18
"""Added to watched numbers, since heyoka finds no root at all of one that starts at exactly zero. It means nothing:
these numbers are near 1, so it is far below what rounding does to them."""

AT_ONCE = 10_000
"""Revolutions between two returns from heyoka, within which no interrupt is heard: some tenths of a second."""

MOST_KEPT = 32
"""Compiled systems kept in this process."""


def load() -> None:
    """Import the library, so that the time of the first run is that of compilation and integration."""
    importlib.import_module("heyoka")


def integrate(
    equations: Equations,
    tolerance: float,
    sample_times: Sequence[float] | Array,
    most_evaluations: int = MOST_EVALUATIONS,
) -> Trajectory:
    """The motion from t = 0 to the last of `sample_times` [s], ascending.

    The error of a step is held below tolerance × (scale of the state). A step of order p counts as p evaluations, for
    it computes as many derivatives. Raises InputError for moments that do not ascend from 0, RangeError for the
    tolerance, and NotTrustworthyError, naming the moment, when the motion leaves the finite numbers, stalls in events,
    or the steps become too many.
    """
    return _Run(equations, tolerance, sample_times, most_evaluations).trajectory()


@dataclass
class _Run(Run):
    """One integration by heyoka."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.units = np.array(self.equations.scales) * (self.tolerance / COMPILED)

    @property
    def name(self) -> str:
        """The library: it has one method."""
        return "heyoka"

    def segment(self, t: float, state: Array, modes: Modes, bound: float) -> tuple[float, Array, bool]:
        """Through all samples; heyoka stops at an event."""
        parameters = self.equations.in_mode(modes)
        structure, numbers = _taken_apart(self.equations, parameters)
        system = _compiled(self.equations, parameters, structure)
        integrator = system.integrator
        integrator.pars[:] = system.tape.values([*self.units.tolist(), *numbers])
        self._put(integrator, t, state)
        if self._falls_at_once(integrator, t, state, parameters):
            return t, state, True
        bound = min(bound, t + AT_ONCE * self.equations.scene.revolution)
        passed = int(np.searchsorted(self.samples, t, side="right")) - self.done
        self.fill(np.repeat(state[:, None], max(passed, 0), axis=1))
        wanted = self.samples[self.done : np.searchsorted(self.samples, bound, side="right")]
        moments = np.concatenate([[t], wanted, [bound] if bound not in wanted[-1:] else []])
        rows, stopped = self._propagate(integrator, moments)
        states = (rows * self.units).T
        self.fill(states[:, 1 : 1 + len(wanted)])
        if stopped:
            return float(integrator.time), integrator.state * self.units, True
        return bound, states[:, -1], False

    def _put(self, integrator: Any, t: float, state: Array) -> None:
        integrator.time, integrator.state[:] = t, state / self.units
        if integrator.with_events:
            integrator.reset_cooldowns()

    def _propagate(self, integrator: Any, moments: Array) -> tuple[Array, bool]:
        """States at the moments, as far as they were reached, and whether an event ended it."""
        import heyoka

        order = integrator.order
        left = max(1, (self.most_evaluations - self.evaluations) // order)
        outcome, _, _, steps, _, rows = integrator.propagate_grid(
            moments, max_steps=left, max_delta_t=self.equations.longest_step
        )
        self.steps, self.evaluations = self.steps + steps, self.evaluations + steps * order
        if outcome == heyoka.taylor_outcome.step_limit:
            raise lost(integrator.time, f"more work than allowed, {self.evaluations} evaluations")
        if outcome == heyoka.taylor_outcome.err_nf_state or not np.isfinite(rows).all():
            raise lost(integrator.time, "a state is no longer finite")
        return rows, _fallen(outcome) is not None

    def _falls_at_once(self, integrator: Any, t: float, state: Array, parameters: Parameters) -> bool:
        """Whether a watched number is not above zero at the start, and after one step has still not risen.

        heyoka finds where a number crosses zero from above; this one never does.
        """
        if not watches(self.equations):
            return False
        low = np.array(watched(self.equations, t, state, parameters)) <= 0
        if not low.any():
            return False
        fallen = _fallen(integrator.step(self.equations.longest_step)[0])
        if fallen is not None:  # it had risen
            low[fallen] = False
        after = watched(self.equations, float(integrator.time), integrator.state * self.units, parameters)
        self._put(integrator, t, state)
        return bool((np.array(after)[low] < 0).any())


def _fallen(outcome: Any) -> int | None:
    """Which watched number ended a step or a run, by heyoka's way of counting them."""
    return -int(outcome) - 1 if -(2**32) < int(outcome) < 0 else None


@dataclass(frozen=True)
class _Compiled:
    """Code for all scenes of one structure, and how its parameters are made of theirs."""

    integrator: Any
    tape: Tape


_kept: dict[Any, _Compiled] = {}


def _compiled(equations: Equations, parameters: Parameters, structure: tuple[Any, ...]) -> _Compiled:
    """The code for the equations, compiled unless this process has it already."""
    if structure not in _kept:
        if len(_kept) >= MOST_KEPT:
            _kept.pop(next(iter(_kept)))
        _kept[structure] = _compile(equations, parameters)
    return _kept[structure]


def _compile(equations: Equations, parameters: Parameters) -> _Compiled:
    import heyoka

    # It would warn on the standard output, of roots at the very start of a step, which are looked for here.
    heyoka.set_logger_level_error()
    tape, count = Tape(heyoka), len(equations.states)
    units = [tape.parameter() for _ in range(count)]
    symbolic = _mapped(parameters, lambda _, nonzero: tape.parameter(nonzero), lambda _: None)
    states = [heyoka.expression(f"z{k}") for k in range(count)]
    t: Any = tape.variable(heyoka.time)
    y = np.array([unit * tape.variable(z) for unit, z in zip(units, states, strict=True)])
    rates = equations.rhs(Functions, t, y, symbolic)
    events = watched(equations, t, y, symbolic, Functions) if watches(equations) else []
    nothing = 0.0 * t
    integrator = heyoka.taylor_adaptive(
        [(z, ((rate + nothing) / unit).expression()) for z, rate, unit in zip(states, rates, units, strict=True)],
        [0.0] * count,
        tol=COMPILED,
        compact_mode=True,  # compiles several times as fast and runs half as fast
        t_events=[
            heyoka.t_event((FAINT * (value + ABOVE) + nothing).expression(), direction=heyoka.event_direction.negative)
            for value in events
        ],
    )
    return _Compiled(integrator, tape)


def _taken_apart(equations: Equations, parameters: Parameters) -> tuple[tuple[Any, ...], list[float]]:
    """What decides how the code looks, and the numbers it is run with."""
    structure: list[Any] = [equations.rhs, len(equations.states), watches(equations)]
    numbers: list[float] = []
    _mapped(parameters, lambda value, _: numbers.append(value), structure.append)
    return tuple(structure), numbers


ZEROS = {"effects": 0, "modes": None}
"""Zeros of how many dimensions are structure: plain numbers of effects, which decide by them whether they act at all;
elsewhere those of matrices, which tell how the support is built."""


def _mapped(
    value: Any, number: Callable[[float, bool], Any], fixed: Callable[[Any], None], zeros: int | None = 2
) -> Any:
    """The same with each number replaced by what `number` makes of it, and whether it is known not to be zero.

    `fixed` is told all else in it, in order.
    """
    if isinstance(value, float):
        if value == 0 and zeros == 0:
            fixed(0.0)
            return value
        fixed(float)
        return number(value, zeros == 0)
    if isinstance(value, np.ndarray):
        kept = value == 0 if value.ndim == zeros else np.full(value.shape, value.dtype.kind != "f")
        fixed((value.shape, kept.tobytes(), value[kept].tobytes()))
        found = value.astype(object)
        found[~kept] = [number(one, False) for one in value[~kept].tolist()]
        return value if kept.all() else found
    if is_dataclass(value) and not isinstance(value, type):
        fixed(type(value))
        copy = object.__new__(type(value))
        for part in fields(value):  # past checks of values, which symbols would not stand
            of = ZEROS.get(part.name, zeros) if isinstance(value, Parameters) else zeros
            object.__setattr__(copy, part.name, _mapped(getattr(value, part.name), number, fixed, of))
        return copy
    if isinstance(value, tuple):
        fixed(len(value))
        return tuple(_mapped(one, number, fixed, zeros) for one in value)
    fixed(value)
    return value
