"""Cost of accuracy: computing time against error for every model level, integrator and tolerance of a scene.

Every way to compute is compared with a verified reference: the full scene, integrated by two methods.
"""

import math
import statistics
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import field, replace
from functools import partial
from typing import Annotated, Any, ClassVar, Final, NamedTuple

from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators.run import EVENT, TooMuchWorkError, work
from abu_calc.dynamics.scene import Scene, only, with_parted_balls
from abu_calc.dynamics.trajectory import Sampling, Trajectory
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import AbuError, InputError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, Stage, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.validity import Range
from abu_calc.simulation.arguments import checked, one_of
from abu_calc.simulation.model_level import QUANTITIES, Measures, ModelEstimate, averaged, closed_form
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.response import Response, evaluate, needed_times
from abu_calc.simulation.result import Result
from abu_calc.simulation.simulate import ACCURACY
from abu_calc.simulation.subject import Ledger, Source, subject_of

TOLERANCES: Final = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)
ENVELOPE_TOLERANCES: Final = (1e-3, 1e-4, 1e-6)
TRIAL, ORDER = 1e-3, 8
"""Tolerance of a first, loose run, and the order by which tighter ones take longer."""

FINEST: Final = 2e-6
"""Accuracy for which the verifying integrators are at the tightest tolerances they have; no reference is finer."""

QUICK: Final = (*choice.LOOP, "scipy-dop853")
"""Integrators that are measured first."""
MOST_EVALUATIONS, MOST_IN_PYTHON = 2_000_000, 150_000
"""Most evaluations of one run, events included, in compiled code and in Python: some seconds.

Runs that need more are left out.
"""

ASKED: Final = 3e-3
"""Time of an event by the second of the verifying integrators [s], whose decisions are made in Python."""

REPEATS: Final = 3
REFERENCE: Final = 0.25
"""Share of the budget above which the reference is left to the methods of the loop alone."""
FINER: Final = (1.0, 0.1, 0.1)
"""Factors on the tolerances of a quick reference, tried in turn until its two runs agree."""
LATEST: Final = 2.0
"""Budgets after which a reference that was expected sooner is broken off."""
LONG, LOADING = 0.5, 3.0
"""Seconds above which one repeat has to do, and that are more than loading and compiling take."""


class OverBudgetError(TooMuchWorkError):
    """A run was broken off, since its time is over."""


@record
class MeasuredPoint(Record):
    """One way to compute; without a number of it, `note` says why."""

    rung: Annotated[str, Quantity("rung", "", 4, "closed-form, envelope, equations, or everything: with all effects")]
    integrator: Annotated[str | None, Quantity("by")]
    tolerance: Annotated[float | None, Quantity("tolerance", "", 1)]
    error: Annotated[float | None, Quantity("error", "", 2, "against the reference")]
    evaluations: Annotated[int, Quantity("evaluations")]
    steps: Annotated[int, Quantity("steps")]
    wall_s: Annotated[float | None, Quantity("warm", "", 3, "median of repeats, everything loaded")] = field(
        compare=False
    )
    cold_s: Annotated[float | None, Quantity("cold", "", 3, "the first run, with import and compilation")] = field(
        compare=False
    )
    note: Annotated[str, Quantity("note")] = ""


@record
class Reference(Record):
    """Reference of the errors: two methods and their disagreement; no error is known better than that."""

    left_out: ClassVar[frozenset[str]] = frozenset({"response"})

    integrators: Annotated[tuple[str, ...], Quantity("integrators")]
    tolerances: Annotated[tuple[float, ...], Quantity("tolerances", "", 1)]
    disagreement: Annotated[float, Quantity("disagreement", "", 2)]
    wall_s: Annotated[float, Quantity("time it took", "", 3)] = field(compare=False)
    response: Response = field(compare=False, repr=False)


class PriceList(NamedTuple):
    """The price list of a scene; `chosen` is the cheapest point whose error is below the accuracy, if there is one."""

    quantity: str
    accuracy: float
    reference: Reference
    points: tuple[MeasuredPoint, ...]
    chosen: MeasuredPoint | None
    skipped: tuple[str, ...]


@dataclass(frozen=True)
class Method:
    """One way to compute, named: `run` is what is timed, `read` finds in that the measures, evaluations and steps."""

    rung: str
    integrator: str | None
    tolerance: float | None
    run: Callable[[float], Any]
    """Takes the seconds after which it is broken off."""
    read: Callable[[Any], tuple[Measures, int, int]]

    @property
    def name(self) -> str:
        """Rung, integrator and tolerance in words."""
        parts = (self.rung, self.integrator, None if self.tolerance is None else f"{self.tolerance:g}")
        return " ".join(part for part in parts if part)


def price_list(
    full: Scene, ledger: Ledger, quantity: str, accuracy: float, budget: float, progress: Progress
) -> PriceList:
    """Measure within `budget` seconds; what no longer fits is skipped, and named.

    The time begins when the integrators of the reference are loaded and compiled; what runs when it is over is broken
    off. Raises NotTrustworthyError when the reference takes longer, or two methods do not agree on it better than the
    accuracy, and InputError for a quantity nobody knows.
    """
    if quantity not in QUANTITIES:
        raise InputError("not one of the known quantities", found=quantity, allowed=", ".join(QUANTITIES))
    full, _ = with_parted_balls(full)
    progress("reference")
    _load(full, accuracy)
    end = time.perf_counter() + budget
    reference = _reference(full, quantity, accuracy, budget)
    points: list[MeasuredPoint] = []
    skipped: list[str] = []
    # Of the loop's own reference no error is known.
    by_loop = all(name in choice.LOOP for name in reference.integrators)
    itself = (reference.integrators[1], reference.tolerances[1]) if by_loop else None
    kinds = groups(full, with_parted_balls(ledger.scene)[0])
    waiting = [[method for method in kind if (method.integrator, method.tolerance) != itself] for kind in kinds]
    methods = [method for group in waiting for method in group]

    def told(method: Method) -> None:
        progress(Stage(method.name, methods.index(method) / len(methods)))

    while waiting:
        now = time.perf_counter()
        share = now + max(end - now, 0.0) / len(waiting)
        measured_points, left = _measured(full, waiting.pop(0), reference, quantity, share, told)
        points += measured_points
        skipped += left
    return PriceList(
        quantity, accuracy, reference, tuple(points), cheapest(points, accuracy, reference), tuple(skipped)
    )


def _measured(
    full: Scene,
    group: list[Method],
    reference: Reference,
    quantity: str,
    end: float,
    report: Callable[[Method], None],
) -> tuple[list[MeasuredPoint], list[str]]:
    """One kind of method from loose to tight as long as there is time, and the names of those left out."""
    points: list[MeasuredPoint] = []
    for place, method in enumerate(group):
        # A tighter tolerance takes longer than the one before.
        before = points[-1].cold_s or 0.0 if points else 0.0
        if time.perf_counter() + before > end:
            return points, [each.name for each in group[place:]]
        report(method)
        try:
            points.append(_point(full, method, reference, quantity, end))
        except TooMuchWorkError:
            return points, [each.name for each in group[place:]]
    return points, []


def cheapest(points: list[MeasuredPoint], accuracy: float, reference: Reference) -> MeasuredPoint | None:
    """The quickest point whose error, with what the reference is unsure of, is below the accuracy.

    So must be those of the same method at tighter tolerances, or it came near the reference by chance.
    """

    def holds(point: MeasuredPoint) -> bool:
        return point.error is not None and point.wall_s is not None and point.error + reference.disagreement <= accuracy

    def tighter(point: MeasuredPoint) -> list[MeasuredPoint]:
        same = [each for each in points if (each.rung, each.integrator) == (point.rung, point.integrator)]
        return [each for each in same if (each.tolerance or 0.0) < (point.tolerance or 0.0)]

    sure = [point for point in points if holds(point) and all(map(holds, tighter(point)))]
    return min(sure, key=lambda point: point.wall_s or 0.0, default=None)


def groups(full: Scene, scene: Scene) -> list[list[Method]]:
    """All ways to compute, those of one kind together from loose to tight; each gets an equal share of the time left.

    Cheap ones first; closed forms and envelope leave out what they cannot average.
    """
    smooth = only(scene, [effect.name for effect in scene.effects if effect.averaged])
    kinds = [[Method("closed-form", None, None, _after(partial(closed_form, smooth)), _estimated)]]
    kinds.append([
        Method("envelope", "scipy-lsoda", tolerance, _after(partial(averaged, smooth, tolerance)), _estimated)
        for tolerance in ENVELOPE_TOLERANCES
    ])  # fmt: skip
    here = list(choice.available(assemble(scene)))
    quick = [name for name in QUICK if name in here]
    kinds += [[_integration("equations", scene, name, tolerance) for tolerance in TOLERANCES] for name in quick]
    if full.effects != scene.effects:
        usable = [name for name in quick if name in choice.available(assemble(full))]
        kinds += [[_integration("everything", full, name, each) for each in TOLERANCES[1:5:2]] for name in usable]
    others = [name for name in here if name not in QUICK]
    return kinds + [[_integration("equations", scene, name, each) for each in TOLERANCES] for name in others]


def _after(estimate: Callable[[], ModelEstimate]) -> Callable[[float], ModelEstimate]:
    """One that is done too soon to be broken off."""
    return lambda _: estimate()


def _estimated(estimate: ModelEstimate) -> tuple[Measures, int, int]:
    return estimate, estimate.evaluations, estimate.steps


def _integration(rung: str, scene: Scene, name: str, tolerance: float) -> Method:
    equations, times = assemble(scene), needed_times(scene)
    most = MOST_EVALUATIONS if name.startswith("compiled") else MOST_IN_PYTHON

    def read(trajectory: Trajectory) -> tuple[Measures, int, int]:
        """Return the compared quantities of a run, its evaluations and its steps."""
        return evaluate(scene, trajectory), trajectory.evaluations, trajectory.steps

    def run(seconds: float) -> Trajectory:
        """The integration alone."""
        return choice.integrate_with(name, equations, tolerance, _until(times, seconds), most)

    return Method(rung, name, tolerance, run, read)


def _point(full: Scene, method: Method, reference: Reference, quantity: str, end: float) -> MeasuredPoint:
    """One method, run once cold and then warm as long as there is time."""
    started = time.perf_counter()
    try:
        run = method.run(end - started)
    except TooMuchWorkError:
        raise
    except AbuError as failure:
        note = str(failure).splitlines()[0]
        return MeasuredPoint(
            rung=method.rung, integrator=method.integrator, tolerance=method.tolerance, error=None, evaluations=0,
            steps=0, wall_s=None, cold_s=None, note=note,
        )  # fmt: skip
    cold = time.perf_counter() - started
    warm = []
    for _ in range(REPEATS if cold < LONG else 1):
        if time.perf_counter() + cold > end:
            break
        started = time.perf_counter()
        method.run(math.inf)
        warm.append(time.perf_counter() - started)
    measures, evaluations, steps = method.read(run)
    error = QUANTITIES[quantity](full, measures, reference.response)
    known = math.isfinite(error)
    return MeasuredPoint(
        rung=method.rung,
        integrator=method.integrator,
        tolerance=method.tolerance,
        error=error if known else None,
        evaluations=evaluations,
        steps=steps,
        wall_s=statistics.median(warm) if warm else cold,
        cold_s=cold,
        note="" if known else "not settled alike",
    )


def _until(times: Any, seconds: float) -> Any:
    """The same times, for a run that raises OverBudgetError after so many seconds of the processor."""
    end = time.thread_time() + seconds

    def check(_: float) -> None:
        """Raise OverBudgetError once the time is over."""
        if time.thread_time() > end:
            raise OverBudgetError(f"more than {seconds:.2g} s of the processor")

    return Sampling.of(times).telling(check)


def _trial(name: str, equations: Equations, times: Any, seconds: float) -> tuple[Trajectory, float]:
    """A loose run, and its time [s]; a short one once more, since the first also loads and compiles."""
    for _ in range(2):
        started = time.perf_counter()
        run = choice.integrate_with(name, equations, TRIAL, _until(times, seconds), MOST_EVALUATIONS)
        spent = time.perf_counter() - started
        if spent > LOADING:
            break
    return run, spent


def _load(full: Scene, accuracy: float) -> None:
    """Load and compile the integrators of the reference, by one revolution of the scene."""
    short = replace(full, duration=full.revolution)
    equations, times = assemble(short), needed_times(short)
    for name, _ in choice.verifiers(assemble(full), max(accuracy, FINEST)):
        with suppress(AbuError):
            choice.integrate_with(name, equations, TRIAL, _until(times, LOADING), MOST_IN_PYTHON)


def _unaffordable(full: Scene, takes: str, enough: float) -> NotTrustworthyError:
    return NotTrustworthyError(
        f"{full.name}: the reference alone takes {takes}\n"
        f"  give more time (--time-budget {enough:.1f}, Python: budget_s=), "
        "or shorten the run (--duration, Python: duration_s=)"
    )


def _reference(full: Scene, quantity: str, accuracy: float, budget: float) -> Reference:
    """Two methods at tight tolerances; they must agree better than half the accuracy.

    A loose run first shows how long they will take; what is not done in twice the time is broken off.
    """
    try:
        return _verified(full, quantity, accuracy, budget)
    except OverBudgetError:
        raise _unaffordable(full, f"more than {LATEST * budget:g} s", 2 * LATEST * budget) from None


def _verified(full: Scene, quantity: str, accuracy: float, budget: float) -> Reference:
    equations, times, started = assemble(full), needed_times(full), time.perf_counter()
    integrators = choice.verifiers(equations, max(accuracy, FINEST))
    (integrator, loose), (other, tight) = integrators
    end = time.thread_time() + LATEST * budget
    trial, spent = _trial(integrator, equations, times, LATEST * budget)
    steps = 1 - EVENT * trial.events / work(trial)
    # Events are as many and as long at every tolerance; whoever is second asks Python for each.
    own = spent * ((1 - steps) + steps * (TRIAL / loose) ** (1 / ORDER))
    expected = own + trial.events * ASKED
    quick = choice.verifiers(equations, max(accuracy, FINEST), quick=True)
    if expected > REFERENCE * budget and quick != integrators:
        (integrator, loose), (other, tight) = quick
        expected = 2 * own
    if expected > budget:
        raise _unaffordable(full, f"about {expected:.1f} s, {trial.events} events among it", 2 * expected)
    until = _until(times, end - time.thread_time())
    for finer in FINER if (integrator, loose) == quick[0] else FINER[:1]:
        loose, tight = finer * loose, finer * tight
        first = evaluate(full, choice.integrate_with(integrator, equations, loose, until, MOST_EVALUATIONS))
        second = evaluate(full, choice.integrate_with(other, equations, tight, until, MOST_EVALUATIONS))
        apart = QUANTITIES[quantity](full, first, second)
        if apart <= accuracy / 2:
            break
    else:
        raise NotTrustworthyError(
            f"{full.name}: no reference: {integrator} and {other} differ by {apart:.2g} in the {quantity}\n"
            "  ask for less accuracy, or shorten the run: a chaotic motion has no reference"
        )
    return Reference(
        integrators=(integrator, other), tolerances=(loose, tight), disagreement=apart, response=second,
        wall_s=time.perf_counter() - started,
    )  # fmt: skip


BUDGET: Final = Range("budget", 0.1, 3600.0, "s", key="budget_s")


@record
class AccuracyResult(Result):
    """The price list of a scene."""

    command: ClassVar[str] = "accuracy"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"scene"}

    model: SceneModel
    scene: str
    quantity: Annotated[str, Quantity("quantity", "", 4, "amplitude, level, quiet, rest, settling or angles")]
    accuracy: Annotated[float, Quantity("accuracy asked for", "", 2)]
    reference: Reference
    points: tuple[MeasuredPoint, ...]
    chosen: MeasuredPoint | None
    """The quickest whose error is below the accuracy."""
    skipped: Annotated[tuple[str, ...], Quantity("not measured in the time allowed")]


@checked
def accuracy(
    source: Source,
    scene: str | None = None,
    start: str | None = None,
    *,
    quantity: str = "amplitude",
    accuracy: float = 0.01,
    budget_s: float = 20.0,
    duration_s: float | None = None,
    progress: Progress = silent,
) -> AccuracyResult:
    """Measure what the accuracy of a quantity of a scene costs, within a budget of time.

    `scene` and `start` choose among those of a machine. Raises InputError for what is wrong in file or arguments,
    NotTrustworthyError where two methods do not agree on a reference.
    """
    ACCURACY.check(accuracy)
    one_of("quantity", quantity, QUANTITIES)
    BUDGET.check(budget_s)
    subject = subject_of(source, scene, start, command="accuracy").lasting(duration_s)
    ledger = subject.ledger(accuracy)
    study = price_list(subject.scene, ledger, quantity, accuracy, budget_s, progress)
    return AccuracyResult(
        **study._asdict(), title=subject.title, checks=(_affordable(study),), warnings=subject.warnings,
        model=SceneModel.of(ledger.scene), provenance=subject.provenance, scene=subject.scene.name,
    )  # fmt: skip


def _affordable(study: PriceList) -> Check:
    best = study.chosen
    message = "a way to compute was measured whose error is below the accuracy"
    return coded("ABU811", verdict(best is not None), message, None if best is None else best.error, study.accuracy,
        None if best else "More time (--time-budget, Python: budget_s=), or less accuracy.",
    )  # fmt: skip
