"""Common parts of all integrators: the way from event to event, samples, and how a run is refused or ends.

`Recorder` hands samples from an integrator to their readers. Memory is taken only for samples that are held.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.work_estimates import rates
from abu_calc.dynamics.rotor import Modes
from abu_calc.dynamics.switching.modes import at_break, settled, starting
from abu_calc.dynamics.trajectory import Samples, Sampling, Times, Trajectory
from abu_calc.foundation import patience
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.validity import Range

Array = NDArray[np.float64]


BLOCK = 2**14
"""Samples that are read at once where not all are held: few enough for little memory, many enough for arrays to pay."""


@dataclass
class Recorder:
    """Is filled with states, sample by sample or many at once."""

    sampling: Sampling
    done: int = 0
    """Number of filled samples."""
    read: int = 0
    """Number of filled samples that the readers have seen."""
    block: Array = field(init=False)
    """States since then; of the whole run where all are held."""
    held: Array = field(init=False)

    def __post_init__(self) -> None:
        times = self.sampling.times
        if not (len(times) and times[0] >= 0 and 0 < times[-1] < np.inf and np.all(times[1:] > times[:-1])):
            raise InputError("sample times must be finite and ascend from 0 or later")
        self.block = self.held = np.empty((0, 0))

    def fill(self, states: Array) -> None:
        """The next samples, one column each."""
        if not self.block.size:
            self._begin(len(states))
        filled = 0
        while filled < states.shape[1]:
            at = self.done - self.read
            part = states[:, filled : filled + self.block.shape[1] - at]
            self.block[:, at : at + part.shape[1]] = part
            filled, self.done = filled + part.shape[1], self.done + part.shape[1]
            if self.done - self.read == self.block.shape[1]:
                self._hand_on()
        if self.sampling.report:
            self.sampling.report(self.done / len(self.sampling.times))

    def samples(self) -> Samples:
        """Held samples, when the run is over."""
        self._hand_on()
        times, held = self.sampling.times, self.sampling.held
        return Samples(times[: self.done], self.block[:, : self.done]) if held is None else Samples(held, self.held)

    def enough(self, t: float) -> bool:
        """True if the run may end at a time, up to which all samples are filled."""
        until = self.sampling.until
        if until is None or t not in until.times:
            return False
        return until.enough(Samples(self.sampling.times[: self.done], self.block[:, : self.done]))

    def _begin(self, states: int) -> None:
        times, held = self.sampling.times, self.sampling.held
        self.block = np.empty((states, len(times) if held is None else min(BLOCK, len(times))))
        self.held = np.empty((states, 0 if held is None else len(held)))

    def _hand_on(self) -> None:
        """The block to the readers, and what is held of it to its place."""
        if self.done == self.read:
            return
        block = Samples(self.sampling.times[self.read : self.done], self.block[:, : self.done - self.read])
        for read in self.sampling.readers:
            read(block)
        if self.sampling.held is not None:
            first = np.searchsorted(self.sampling.held, block.t[0])
            last = np.searchsorted(self.sampling.held, block.t[-1], side="right")
            self.held[:, first:last] = block.at(self.sampling.held[first:last])
        self.read = self.done


TOLERANCE = Range("tolerance", 1e-13, 0.1)
"""Range of tolerances: below, rounding decides; above, a method's own error estimate means nothing."""

MOST_EVALUATIONS = 12_000_000
"""Some minutes of SciPy's time; a scene that needs more is stiff or too long for this method."""

EVENT, LOOP_EVENT = 50, 2
"""Evaluations that the work of an event is worth beside its own: modes are settled, and the integrator starts anew. In
the loop, compiled or not, that is next to nothing."""

DECISION, DECISION_BALLS = 2500, 3
"""Evaluations of the loop that an event is worth whose modes Python decides: some milliseconds. And the number of balls
up to which that holds; more take as much longer, and twice as long where they move across their race.
"""

CROWDED = 100
"""Events of each ball, and of the axis, in a revolution or a cycle of what oscillates faster: beyond, balls chatter,
and nothing that is found of them can be trusted. Presets have a dozen."""


def decision_work(equations: Equations) -> int:
    """Evaluations of the loop that a decision of Python is worth."""
    scene = equations.scene
    share = max(1.0, (1 + len(scene.ball_masses)) / (1 + DECISION_BALLS))
    return int(DECISION * share * (2 if scene.ball_states else 1))


NOT_FINITE = "a state is no longer finite"

STALLED, MOST_STALLED = 1e-9, 200
"""Revolutions within which so many events in a row mean that the motion does not go on."""


@dataclass
class IntegrationRun(ABC):
    """One integration on its way; each library says how it goes through one segment."""

    equations: Equations
    tolerance: float
    sample_times: Times
    most_evaluations: int
    evaluations: int = 0
    steps: int = 0
    events: int = 0
    recorder: Recorder = field(init=False)
    samples: Array = field(init=False)
    longest: float = field(init=False)
    """No step is longer [s]."""
    per_step: int = field(init=False, default=1)
    """Evaluations that a step takes at the least."""

    def __post_init__(self) -> None:
        TOLERANCE.check(self.tolerance)
        if patience.given():
            self.most_evaluations = patience.UNBOUNDED
        self.recorder = Recorder(Sampling.of(self.sample_times))
        self.samples, self.longest = self.recorder.sampling.times, self.equations.longest_step

    @property
    @abstractmethod
    def name(self) -> str:
        """Name of the integrator."""

    @property
    def done(self) -> int:
        """Number of filled samples."""
        return self.recorder.done

    @abstractmethod
    def segment(self, t: float, state: Array, modes: Modes, bound: float) -> tuple[float, Array, bool]:
        """Toward the bound, at most up to the next event: time and state reached, and whether it is an event."""

    def trajectory(self) -> Trajectory:
        """The whole run. Raises NotTrustworthyError, naming the time, when it cannot be finished."""
        self.heed_patience(0.0)
        least = float(self.samples[-1]) / self.longest * self.per_step
        if least > self.most_evaluations:
            raise too_much(f"at least {least:.3g}", self.most_evaluations)
        # Overflow and invalid numbers are looked for as the run goes on, where its time is known.
        with np.errstate(all="ignore"):
            self._go()
        samples = self.recorder.samples()
        return Trajectory(
            t=samples.t,
            y=samples.y,
            integrator=self.name,
            tolerance=self.tolerance,
            evaluations=self.evaluations,
            steps=self.steps,
            events=self.events,
        )

    def heed_patience(self, t: float) -> None:
        """Raise TooMuchWorkError where the seconds that were asked for are over."""
        if patience.over():
            raise TooMuchWorkError(_lost(t, "more time than --patience allows"), t)

    def fill(self, states: Array) -> None:
        """The next samples, one column each."""
        self.recorder.fill(states)

    def ends(self) -> list[float]:
        """Times [s] up to which a segment goes at most: of breaks, of what may be enough, and of the run."""
        end, until = float(self.samples[-1]), self.recorder.sampling.until
        inner = {*self.equations.breaks, *(until.times if until else ())}
        return [*sorted(moment for moment in inner if 0 < moment < end), end]

    def _crowded(self, t: float) -> bool:
        most = CROWDED * (1 + len(self.equations.scene.ball_masses))
        return self.events > most and self.events > most * (1 + t * self._fastest / (2 * np.pi))

    @cached_property
    def _fastest(self) -> float:
        return rates(self.equations)[1]

    def _go(self) -> None:
        equations, ends = self.equations, self.ends()
        end = ends[-1]
        state, modes = starting(equations)
        if self.samples[0] == 0:
            self.fill(state[:, None])
        t, stalled = 0.0, 0
        while t < end:
            before, bound = t, next(time for time in ends if time > t)
            t, state, happened = self.segment(t, state, modes, bound)
            if happened:
                self.events += 1
                stalled = stalled + 1 if t - before < STALLED * equations.scene.revolution else 0
                if stalled > MOST_STALLED or self._crowded(t):
                    raise lost(t, "the motion stalls in ever more events")
                if self.evaluations + EVENT * self.events > self.most_evaluations:
                    raise exceeded(t, self.evaluations, self.events)
                self.heed_patience(t)
            if t == bound:
                if self.recorder.enough(t):
                    return
                modes = at_break(equations, t, modes)
            if t < end:
                state, modes = settled(equations, t, state, modes)


def work(run: Trajectory, event: int = EVENT) -> int:
    """Work of a run, counted in evaluations; `event`: how many of them one event is worth."""
    return run.evaluations + event * run.events


class TooMuchWorkError(NotTrustworthyError):
    """A run needs more evaluations, or seconds, than it may take.

    It was given up at the time `reached` [s], after so many evaluations (0: it was not begun) and events.
    """

    def __init__(self, message: str, reached: float = 0.0, evaluations: int = 0, events: int = 0) -> None:
        super().__init__(message)
        self.reached, self.evaluations, self.events = reached, evaluations, events


def exceeded(t: float, evaluations: int, events: int) -> TooMuchWorkError:
    """The error of a run that was given up at its bound."""
    did = f"{evaluations} evaluations" + (f" and {events} events" if events else "")
    return TooMuchWorkError(_lost(t, f"more work than allowed, {did}"), t, evaluations, events)


def too_much(evaluations: str, most: int, remedy: str = "") -> TooMuchWorkError:
    """The error for a run that is not begun, since so much work is not allowed."""
    return TooMuchWorkError(
        f"the run takes more work than allowed (found {evaluations} evaluations; allowed: {most:.3g})\n"
        f"  {remedy}shorten the run, ask for less accuracy, or allow some seconds: --patience 60"
    )


def lost(t: float, reason: str) -> NotTrustworthyError:
    """The error that says where and why an integration was given up."""
    return NotTrustworthyError(_lost(t, reason))


def _lost(t: float, reason: str) -> str:
    return (
        f"integration lost at t = {t:.6g} s: {reason.rstrip('.')}\n"
        "  shorten the run, or look for a drag, stiffness or speed that is far from any real machine"
    )
