"""Simulation of known accuracy: by the envelope if that suffices, otherwise by two runs that agree.

Remarks of the effects on a run are given once each, with those on effects that the scene leaves out.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import field, replace
from typing import Annotated, ClassVar, Final

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.integrators.run import too_much
from abu_calc.dynamics.integrators.work_estimates import softer
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.dynamics.trajectory import Array, Samples, Sampling, Trajectory
from abu_calc.formulas import motion
from abu_calc.foundation import patience
from abu_calc.foundation.errors import ChaoticError, InputError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, share_of, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.model_level import FinestRuns, Offer, difference, offer, unreached
from abu_calc.simulation.quiet import lasting
from abu_calc.simulation.response import Course, Response, evaluate, needed_times, sampling

MOST_ASKED: Final = 4000
"""Samples of a run, of those that results need, that are kept for effects that look at all of it: some tenths of a
second. They are drawn by lot, so that no phase of a revolution is left out."""

STEEL: Final = 7800.0
"""Density [kg/m³] by which a ball's mass tells its radius where that is not given."""


class Remarks:
    """A reader of a run's samples at the times that results need; `texts` in the order of the effects.

    Further samples change no result, and a million of them would take an effect minutes.
    """

    def __init__(self, equations: Equations, needed: Array) -> None:
        self.equations, self.needed = equations, needed
        self.found: list[tuple[str, ...]] = [() for _ in equations.scene.effects]
        self.asked = _drawn(needed) if any(effect.whole_run for effect in equations.scene.effects) else needed[:0]
        self.kept: list[Samples] = []

    def __call__(self, samples: Samples) -> None:
        """Ask the effects that have had no remark yet; keep what others are asked of when the run is over."""
        here, asked = _within(self.needed, samples), _within(self.asked, samples)
        if len(asked):
            self.kept.append(Samples(asked, samples.at(asked).copy()))
        if len(here) < len(samples.t):
            samples = Samples(here, samples.at(here))
        for index, effect in enumerate(self.equations.scene.effects):
            if not effect.whole_run:
                self.found[index] = self.found[index] or effect.remarks(self.equations, samples)

    @property
    def texts(self) -> tuple[str, ...]:
        """Remarks of the scene and of all effects."""
        scene, remarks = self.equations.scene, self.found
        if self.kept:
            whole = Samples(np.concatenate([part.t for part in self.kept]), np.hstack([part.y for part in self.kept]))
            rows = zip(scene.effects, remarks, strict=True)
            remarks = [effect.remarks(self.equations, whole) if effect.whole_run else prior for effect, prior in rows]
        return (*without_size(scene), *(text for texts in remarks for text in texts))


def _drawn(times: Array) -> Array:
    """Some of these times, always the same and the last among them; all of a few."""
    if len(times) <= MOST_ASKED:
        return times
    chosen = np.random.default_rng(0).choice(len(times) - 1, MOST_ASKED - 1, replace=False)
    drawn: Array = times[[*np.sort(chosen), -1]]
    return drawn


def _within(times: Array, samples: Samples) -> Array:
    """Return the times that lie within the samples."""
    inside: Array = times[np.searchsorted(times, samples.t[0]) : np.searchsorted(times, samples.t[-1], side="right")]
    return inside


def without_size(scene: Scene) -> tuple[str, ...]:
    """Remark that balls of unknown size are run up without their own spin.

    It gives the share of their lag that this is, (J − 1) r/R_p. A race that speeds up turns the balls that
    roll in it; r is that of steel balls of the same mass.
    """
    balls = scene.balls
    unknown = (balls.sizes == 0) & (balls.factors > 1)
    if not scene.rotor.states or not unknown.any():
        return ()
    radii = np.minimum(np.cbrt(3 * balls.masses / (4 * math.pi * STEEL)), balls.radii)
    shares = np.where(unknown, (balls.factors - 1) * radii / balls.radii, 0.0)
    most, k = float(shares.max()), int(shares.argmax())
    return (
        f"The speed changes, but [[scene.race]] has no ball_radius_mm: the spin that the race gives the balls is left "
        f"out. That is about {most:.0%} of their lag while the speed rises (steel ball of "
        f"{1000 * balls.masses[k]:.3g} g, r = {1000 * radii[k]:.2g} mm)",
    )


ACCURACY = motion.ACCURACY

WORK, WORK_FAST = 10_000_000, 2_000_000
"""Work that a simulation may take, each unit five evaluations of the loop (up to six balls) or one of SciPy's: some
minutes of SciPy's methods, half a minute in compiled code. A preset takes some ten thousand, the swing arm two hundred
thousand, over a million for its levels. The second, where something oscillates far faster than the rotor turns: mostly
a stiffness in another unit, worth some seconds."""

WORK_PLAIN = 700_000
"""The same for plain code that was asked for, at some 25 µs for each evaluation of its own: a minute or two."""

SAFETY, FALL, FLOOR = 3.0, 0.1, 100.0
"""Factors of the error estimate on three differences.

They apply to the difference of two runs, to that of the two before, and to the tolerance. Errors mostly
fall with the tolerance, but two runs may come near each other by chance. Found with 300 random scenes,
200 fast transients and both integrators: tests/studies/claims.py.
"""

LEAST = 0.9
"""Least share of a run's work that a run at a tighter tolerance takes.

Three integrators on 17 scenes took 0.98 and more.
"""

RESTING = 0.01
"""Share of the rotor's speed below which balls count as resting in the race.

It applies to the mean speed against the race; a bouncing wheel may still shake the balls.
"""

CHAOTIC_END = (
    "The motion is chaotic, so errors decide its way to the end. In every run the balls come to rest and carry the "
    "imbalance. The numbers are those of one run; another start case gives others"
)

LAST_TOLERANCE = 1e-13
"""Tightest tolerance; below it, rounding decides."""


@record
class Cost(Record):
    """Work of all runs of a simulation together; tolerance and steps of the one that is reported."""

    left_out: ClassVar[frozenset[str]] = frozenset({"work"})

    integrator: Annotated[str, Quantity("integrator")]
    tolerance: Annotated[float, Quantity("tolerance", "", 1)]
    evaluations: Annotated[int, Quantity("evaluations of the equations")]
    steps: Annotated[int, Quantity("steps")]
    events: Annotated[int, Quantity("events", "", 4, "switches of how effects act")]
    wall_s: Annotated[float, Quantity("time it took", "", 3)] = field(compare=False)
    why: Annotated[str, Quantity("why this integrator")]
    work: int = 0
    """Work, as `most_evaluations` counts it."""


@dataclass(frozen=True)
class Simulation:
    """A response, the trajectory, what it cost, and how far it may be off.

    The trajectory of a short run has all samples the response was read from; that of a long one, beyond 32 MB, the
    beginning, the times asked for and the amplitude window.

    `rung`: envelope or equations; `offered`: what the envelope was good for, and why it was taken or not.
    """

    scene: Scene
    response: Response
    trajectory: Trajectory
    cost: Cost
    error_estimate: float
    warnings: tuple[str, ...]
    rung: str
    offered: Offer


def simulate(
    scene: Scene,
    accuracy: float = 0.01,
    sample_times: Sequence[float] | Array = (),
    most_evaluations: int | None = None,
    integrator: str = "auto",
    progress: Progress = silent,
) -> Simulation:
    """The envelope where its error is below `accuracy`; otherwise the equations, tightened until that holds.

    `sample_times` [s] are further times to hold in the trajectory; `most_evaluations` bounds the work of all runs, see
    WORK: what takes more by counting is not begun; None: `usual_work`. `integrator` is auto, scipy,
    plain or compiled; any but auto asks for the equations. `progress` gets what is being done. Raises
    NotTrustworthyError when the work does not suffice, or when no tolerance reaches the accuracy: the motion is then
    chaotic, or decided by less than rounding.
    """
    ACCURACY.check(accuracy)
    scene, warnings = with_parted_balls(lasting(scene, None, "scene.duration"))
    wanted = np.asarray(sample_times, dtype=float)
    if not np.all((wanted >= 0) & (wanted <= scene.duration)):
        raise InputError("sample times must lie within the run", allowed=f"0 … {scene.duration:g} s")
    times, started = sampling(scene, wanted), time.perf_counter()
    request = _Request(scene, accuracy, times, most_evaluations, integrator, warnings, progress)
    offered = Offer(None, "the equations were asked for")
    progress(f"{scene.name}: averages")
    course = Course(scene)
    if integrator == "auto" and not len(wanted):
        offered = offer(scene, accuracy, times.read_by(course))
    if offered.trajectory is not None and offered.error is not None:
        run = offered.trajectory
        cost = _cost(run, run.evaluations, run.steps, time.perf_counter() - started, offered.why)
        return Simulation(scene, evaluate(scene, run, course), run, cost, offered.error, warnings, "envelope", offered)
    return _integrated(request, offered)


@dataclass(frozen=True)
class _Request:
    """A simulation as it was asked for: scene with its warnings, times of its samples, bounds and integrator."""

    scene: Scene
    accuracy: float
    times: Sampling
    most_evaluations: int | None
    integrator: str
    warnings: tuple[str, ...]
    progress: Progress

    @property
    def most(self) -> int:
        """Work that all runs may take together."""
        if patience.given():
            return patience.UNBOUNDED
        return self.most_evaluations or usual_work(self.scene, self.integrator)


def _integrated(request: _Request, offered: Offer) -> Simulation:
    """The finer of two runs a decade of tolerance apart, the first whose difference promises the accuracy."""
    scene, accuracy, times, most, progress = (
        request.scene, request.accuracy, request.times, request.most, request.progress
    )  # fmt: skip
    equations, needed = assemble(scene), needed_times(scene)
    needed = needed if len(needed) < len(times.times) else times.times  # one array of both where they are the same
    choice = choose(equations, request.integrator, tolerances(accuracy)[0])
    about, fast = choice.expected(equations, tolerances(accuracy)[0]), softer(equations)
    if about > most:
        raise too_much(f"about {about:.2g}", most, fast)
    started, evaluations, steps, worked = time.perf_counter(), 0, 0, 0
    runs: list[Response] = []
    apart, spared, last, alike = math.nan, 0, 0, True
    ended: Simulation | None = None
    for tolerance in tolerances(accuracy):
        choice = choose(equations, request.integrator, tolerance, progress)
        text = f"{scene.name}: {choice.name}, tolerance {tolerance:g}"
        progress(text)
        course, remarks = Course(scene), Remarks(equations, needed)
        # What is held whole is looked at once, when the run is known to be the last.
        readers = (course, remarks) if runs and times.held is not None else (course,)
        try:
            if LEAST * last > most:
                raise too_much(f"at least {LEAST * last:.3g}", most, fast)
            watched = times.read_by(*readers).telling(share_of(progress, text))
            trajectory = choice.integrate(equations, tolerance, watched, choice.evaluations(most))
        except NotTrustworthyError as failure:
            if len(runs) < 2:
                raise
            finest = FinestRuns(runs[0], runs[1], apart, choice, 10 * tolerance)
            raise _with_end(unreached(scene, accuracy, finest, spared, failure), ended) from None
        progress(f"{scene.name}: reading what came of it")
        last = choice.work(trajectory)
        most, spared, worked = most - last, 2 * last, worked + last
        runs = [*runs[-1:], evaluate(scene, trajectory, course)]
        alike = alike and balls_rest(scene, runs[-1])
        evaluations, steps = evaluations + trajectory.evaluations, steps + trajectory.steps
        if len(runs) < 2:
            del trajectory  # it may be large
            continue
        before, apart = apart, run_difference(scene, *runs)
        error = max(SAFETY * apart, FLOOR * tolerance, FALL * before if before > 0 else 0.0)
        if error > accuracy and not alike:
            ended = None
            del trajectory
            continue
        cost = replace(_cost(trajectory, evaluations, steps, time.perf_counter() - started, choice.why), work=worked)
        if times.held is None:
            remarks(trajectory)
        texts = (*request.warnings, *remarks.texts)
        ended = Simulation(scene, runs[1], trajectory, cost, error, texts, "equations", offered)
        if error <= accuracy:
            return ended
    finest = FinestRuns(runs[0], runs[1], apart, choice, tolerance)
    raise _with_end(unreached(scene, accuracy, finest, spared), ended)


def balls_rest(scene: Scene, response: Response) -> bool:
    """True if all balls have come to rest in their races, and carry more of the imbalance than they add."""
    return (
        all(abs(speed) < RESTING * scene.speed for speed in response.final.ball_speeds)
        and response.residual_imbalance < reference_imbalance(scene)
    )  # fmt: skip


def _with_end(failure: NotTrustworthyError, ended: Simulation | None) -> NotTrustworthyError:
    """Add the known end of a chaotic motion to its error."""
    if isinstance(failure, ChaoticError) and ended is not None:
        failure.ended = replace(ended, warnings=(*ended.warnings, CHAOTIC_END))
    return failure


def usual_work(scene: Scene, integrator: str) -> int:
    """Work that a simulation may take if nothing says how much."""
    work = WORK_FAST if softer(assemble(scene)) else WORK
    return min(work, WORK_PLAIN) if integrator == "plain" else work


def _cost(run: Trajectory, evaluations: int, steps: int, spent: float, why: str) -> Cost:
    return Cost(
        integrator=run.integrator, tolerance=run.tolerance, evaluations=evaluations, steps=steps, events=run.events,
        wall_s=spent, why=why,
    )  # fmt: skip


def run_difference(scene: Scene, before: Response, response: Response) -> float:
    """Difference of two runs; infinite if the balls made other turns.

    Such runs took different paths and end alike by chance. If balls slip behind the rotor, errors far below
    the accuracy may decide which of several ends they reach, and loose tolerances may agree on the wrong
    one.
    """
    turns = zip(*(np.sort(run.ball_angles) for run in (before, response)), strict=True)
    return math.inf if any(abs(a - b) > math.pi for a, b in turns) else difference(scene, before, response)


def tolerances(accuracy: float) -> tuple[float, ...]:
    """Tolerances to try, a decade apart: from the loosest that usually is good enough to the last above rounding.

    >>> tolerances(0.01)[:3]
    (0.0002, 2e-05, 2e-06)
    """
    first = min(2e-4, accuracy / 50)
    return tuple(float(f"{first / 10**k:.3g}") for k in range(math.floor(math.log10(first / LAST_TOLERANCE)) + 1))
