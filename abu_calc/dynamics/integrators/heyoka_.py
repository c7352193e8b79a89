"""Integration by heyoka: Taylor series of high order, compiled (Biscani & Izzo 2021, MNRAS 504(2), 2614; step size of
Jorba & Zou 2005, Experimental Mathematics 14(1), 99).

The one right-hand side is traced and compiled; every number of the scene is a parameter of the compiled code, so that
it serves all scenes of one structure (number of balls, kind of support, effects) and all their modes. heyoka keeps it
on disk for later processes.

heyoka bounds the error of a step by (its tolerance) × (the largest state, or 1 where all are below 1), and compiles its
tolerance in, as the order. So the states are counted in units of scale × tolerance / (compiled tolerance): they stay
below 1, and one compiled order serves many tolerances.
"""

import importlib
import os
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled.cache import FOLDER
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS, NOT_FINITE, Array, Run, exceeded, lost
from abu_calc.dynamics.parameters import Acting, Modes
from abu_calc.dynamics.switching.modes import watches
from abu_calc.dynamics.tracing.plain import functions
from abu_calc.dynamics.tracing.traced import cached, numbers_of, trace
from abu_calc.dynamics.trajectory import Times, Trajectory

COMPILED = 1e-9, 1e-12, 1e-15
"""heyoka's own tolerances: orders 12, 15 and 19. The first that leaves even angles of balls that stand still in space,
which grow with every turn, below 1."""

LEAST_ORDER = 12

MOST_UNROLLED = 120
"""Products in a smooth scene's equations up to which its code is unrolled: it runs in half the time, but takes two
seconds (four balls) to four (seven) to be compiled for the first time. Where there are events, they take the time."""

FAINT = 1e-30
"""Factor on watched numbers: heyoka counts them among the states whose error it bounds, and they have no scale."""

ABOVE = 1e-18
"""Added to watched numbers, since heyoka finds no root at all of one that starts at exactly zero. It means nothing:
these numbers are near 1, so it is far below what rounding does to them."""

AT_ONCE = 10_000
"""Revolutions between two returns from heyoka, within which no interrupt is heard: some tenths of a second."""


ON_DISK = 50_000_000
"""Bytes of compiled code that are kept on disk, some dozens of structures: what heyoka finds there it counts through
each time, which takes it a third of a second for a gigabyte."""

DAMAGED = "corrupt", "malformed", "not a database"
"""What heyoka says of a folder that holds something else than it wrote."""


def load() -> None:
    """Import the library, so that the time of the first run is that of compilation and integration."""
    importlib.import_module("heyoka")


def integrate(
    equations: Equations,
    tolerance: float,
    sample_times: Times,
    most_evaluations: int = MOST_EVALUATIONS,
) -> Trajectory:
    """The motion from t = 0 to the last of `sample_times` [s], ascending.

    The error of a step is held below tolerance × (scale of the state). A step of order p counts as p evaluations, for
    it computes as many derivatives. Raises InputError for times that do not ascend from 0, RangeError for the
    tolerance, and NotTrustworthyError, naming the time, when the motion leaves the finite numbers, stalls in events,
    or the steps become too many.
    """
    return _Run(equations, tolerance, sample_times, most_evaluations).trajectory()


@dataclass
class _Run(Run):
    """One integration by heyoka."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.per_step, self.numbers = LEAST_ORDER, numbers_of(self.equations)
        turned = max(1.0, self.equations.scene.speed * float(self.samples[-1]))
        self.compiled = next((one for one in COMPILED if one * turned <= self.tolerance), COMPILED[-1])
        self.units = np.array(self.equations.scales) * (self.tolerance / self.compiled)

    @property
    def name(self) -> str:
        """The library: it has one method."""
        return "heyoka"

    def segment(self, t: float, state: Array, modes: Modes, bound: float) -> tuple[float, Array, bool]:
        """Through all samples; heyoka stops at an event."""
        acting = self.equations.in_mode(modes)
        structure, numbers = self.numbers.of(modes)
        system = cached(_systems, (self.compiled, *structure), lambda: _compile(self.equations, acting, self.compiled))
        integrator = system.integrator
        integrator.pars[:] = system.values([*self.units.tolist(), *numbers])
        self._put(integrator, t, state)
        if watches(self.equations) and self._falls_at_once(integrator, t, state, modes):
            return t, state, True
        bound = min(bound, t + AT_ONCE * self.equations.scene.revolution)
        passed = int(np.searchsorted(self.samples, t, side="right")) - self.done
        self.fill(np.repeat(state[:, None], max(passed, 0), axis=1))
        wanted = self.samples[self.done : np.searchsorted(self.samples, bound, side="right")]
        times = np.concatenate([[t], wanted, [bound] if bound not in wanted[-1:] else []])
        rows, stopped = self._propagate(integrator, times)
        rows *= self.units
        states = rows.T
        self.fill(states[:, 1 : 1 + len(wanted)])
        if stopped:
            return float(integrator.time), integrator.state * self.units, True
        # A copy: all these rows need not stay until the next are there.
        return bound, states[:, -1].copy(), False

    def _put(self, integrator: Any, t: float, state: Array) -> None:
        integrator.time, integrator.state[:] = t, state / self.units
        if integrator.with_events:
            integrator.reset_cooldowns()

    def _propagate(self, integrator: Any, times: Array) -> tuple[Array, bool]:
        """States at these times, as far as they were reached, and whether an event ended it."""
        import heyoka

        order = integrator.order
        left = max(1, (self.most_evaluations - self.evaluations) // order)
        outcome, _, _, steps, _, rows = integrator.propagate_grid(
            times, max_steps=left, max_delta_t=self.equations.longest_step
        )
        self.steps, self.evaluations = self.steps + steps, self.evaluations + steps * order
        if outcome == heyoka.taylor_outcome.step_limit:
            raise exceeded(integrator.time, self.evaluations, self.events)
        if outcome == heyoka.taylor_outcome.err_nf_state or not np.isfinite(rows).all():
            raise lost(integrator.time, NOT_FINITE)
        return rows, _fallen(outcome) is not None

    def _falls_at_once(self, integrator: Any, t: float, state: Array, modes: Modes) -> bool:
        """Whether a watched number is not above zero at the start, and after one step has still not risen.

        heyoka finds where a number crosses zero from above; this one never does.
        """
        _, watched = functions(self.equations, self.numbers, modes)
        low = np.array(watched(t, state)) <= 0
        if not low.any():
            return False
        fallen = _fallen(integrator.step(self.equations.longest_step)[0])
        if fallen is not None:  # it had risen
            low[fallen] = False
        after = watched(float(integrator.time), integrator.state * self.units)
        self._put(integrator, t, state)
        return bool((np.array(after)[low] < 0).any())


def _fallen(outcome: Any) -> int | None:
    """Which watched number ended a step or a run, by heyoka's way of counting them."""
    return -int(outcome) - 1 if -(2**32) < int(outcome) < 0 else None


@dataclass(frozen=True)
class _Compiled:
    """Code for all scenes of one structure, and how its parameters are made of theirs."""

    integrator: Any
    values: Callable[[Sequence[float]], list[float]]


_systems: dict[Any, _Compiled] = {}


def _compile(equations: Equations, acting: Acting, tolerance: float) -> _Compiled:
    import heyoka

    # It would warn on the standard output, of roots at the very start of a step, which are looked for here.
    heyoka.set_logger_level_error()
    _keep_apart(heyoka.llvm_state)
    states = [heyoka.expression(f"z{k}") for k in range(len(equations.states))]
    traced = trace(equations, acting, heyoka, states, scaled=True)
    nothing = 0.0 * traced.t
    parts = zip(states, traced.rates, traced.units, strict=True)
    rates = [(z, ((rate + nothing) / unit).expression()) for z, rate, unit in parts]
    integrator = heyoka.taylor_adaptive(
        rates,
        [0.0] * len(states),
        tol=tolerance,
        compact_mode=bool(traced.watched) or traced.tape.products > MOST_UNROLLED,
        t_events=[
            heyoka.t_event((FAINT * (value + ABOVE) + nothing).expression(), direction=heyoka.event_direction.negative)
            for value in traced.watched
        ],
    )
    return _Compiled(integrator, traced.tape.values())


def _keep_apart(state: Any) -> None:
    """Beside heyoka's own folder, which it lets grow to twenty gigabytes; another one that somebody chose stays.

    A folder that is damaged is emptied, one that cannot be used is done without, which a warning tells once.
    """
    path = Path(state.get_diskcache_path())
    if path.name != "heyoka":
        return
    folder = Path(os.environ.get(FOLDER) or path.with_name("abu-calc")).expanduser()
    state.set_diskcache_path(str(folder))
    try:
        try:
            state.set_diskcache_limit(ON_DISK)
        except RuntimeError as error:
            if not any(word in str(error) for word in DAMAGED):
                raise
            for file in folder.glob("cache.db*"):
                file.unlink(missing_ok=True)
            state.set_diskcache_limit(ON_DISK)
    except (RuntimeError, OSError) as error:
        state.set_diskcache_enabled(False)
        reason = str(error).splitlines()[0]
        warnings.warn(f"heyoka's compiled code is not kept: {folder}: {reason}", RuntimeWarning, stacklevel=2)
