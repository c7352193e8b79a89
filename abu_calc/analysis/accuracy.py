"""What accuracy costs in time: every rung, integrator and tolerance, against a reference that is verified."""

import math
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any, Final

from abu_calc.analysis.differences import QUANTITIES, Measures
from abu_calc.analysis.ledger import Ledger
from abu_calc.analysis.response import Response, evaluate, needed_times
from abu_calc.analysis.rungs import Estimate, averaged, closed_form
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators.run import EVENT, work
from abu_calc.dynamics.scene import Scene, only, with_parted_balls
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import AbuError, InputError, NotTrustworthyError
from abu_calc.progress import Progress

TOLERANCES: Final = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)
ENVELOPE_TOLERANCES: Final = (1e-3, 1e-4, 1e-6)
TRIAL, ORDER = 1e-3, 8
"""Tolerance of a first, loose run, and the order by which tighter ones take longer."""

FINEST: Final = 2e-6
"""Accuracy for which the verifying integrators are at the tightest tolerances they have; no reference is finer."""

QUICK: Final = ("heyoka", "scipy-dop853")
"""Integrators that are measured first."""
MOST_EVALUATIONS: Final = 2_000_000
"""Of one run; a method that needs more has no number."""

REPEATS: Final = 3
LONG, LOADING = 0.5, 3.0
"""Seconds above which one repeat has to do, and that are more than loading and compiling take."""


@dataclass(frozen=True)
class Point:
    """One computation: error against the reference, evaluations, and time of the integration alone.

    `wall_s` is the median of repeats when everything is loaded, `cold_s` the first run with import and compilation.
    `error` None: the method gave no number, `note` says why.
    """

    rung: str
    integrator: str | None
    tolerance: float | None
    error: float | None
    evaluations: int
    steps: int
    wall_s: float | None
    cold_s: float | None
    note: str = ""


@dataclass(frozen=True)
class Reference:
    """The full scene, integrated by two methods; `disagreement` is how far they are apart, and errors are no surer."""

    integrators: tuple[str, str]
    tolerances: tuple[float, float]
    disagreement: float
    response: Response
    wall_s: float


@dataclass(frozen=True)
class Study:
    """The price list of a scene; `chosen` is the cheapest point whose error is below the accuracy, if there is one."""

    quantity: str
    accuracy: float
    reference: Reference
    points: tuple[Point, ...]
    chosen: Point | None
    skipped: tuple[str, ...]


@dataclass(frozen=True)
class Method:
    """One way to compute, named: `run` is what is timed, `read` finds in that the measures, evaluations and steps."""

    rung: str
    integrator: str | None
    tolerance: float | None
    run: Callable[[], Any]
    read: Callable[[Any], tuple[Measures, int, int]]

    @property
    def name(self) -> str:
        """Rung, integrator and tolerance in words."""
        parts = (self.rung, self.integrator, None if self.tolerance is None else f"{self.tolerance:g}")
        return " ".join(part for part in parts if part)


def study(full: Scene, ledger: Ledger, quantity: str, accuracy: float, budget: float, progress: Progress) -> Study:
    """Measure within `budget` seconds; what no longer fits is skipped, and named.

    Raises NotTrustworthyError when two methods do not agree on the reference better than the accuracy, and InputError
    for a quantity nobody knows.
    """
    if quantity not in QUANTITIES:
        raise InputError("not one of the known quantities", found=quantity, allowed=", ".join(QUANTITIES))
    end = time.perf_counter() + budget
    full, _ = with_parted_balls(full)
    progress("reference")
    reference = _reference(full, quantity, accuracy, budget)
    points: list[Point] = []
    skipped: list[str] = []
    longest: dict[tuple[str, str | None], float] = {}
    for method in methods(full, with_parted_balls(ledger.scene)[0]):
        kind, name = (method.rung, method.integrator), method.name
        # A tighter tolerance takes longer than the one before.
        if time.perf_counter() + longest.get(kind, 0.0) > end:
            skipped.append(name)
            continue
        progress(name)
        points.append(_point(full, method, reference, quantity, end))
        longest[kind] = points[-1].cold_s or 0.0
    return Study(quantity, accuracy, reference, tuple(points), cheapest(points, accuracy, reference), tuple(skipped))


def cheapest(points: list[Point], accuracy: float, reference: Reference) -> Point | None:
    """The quickest point whose error, with what the reference is unsure of, is below the accuracy."""
    sure = [
        point for point in points
        if point.error is not None and point.wall_s is not None and point.error + reference.disagreement <= accuracy
    ]  # fmt: skip
    return min(sure, key=lambda point: point.wall_s or 0.0, default=None)


def methods(full: Scene, scene: Scene) -> Iterator[Method]:
    """All ways to compute, cheap ones first; closed forms and envelope leave out what they cannot average."""
    smooth = only(scene, [effect.name for effect in scene.effects if effect.averaged])
    yield Method("closed-form", None, None, lambda: closed_form(smooth), _estimated)
    for tolerance in ENVELOPE_TOLERANCES:
        yield Method("envelope", "scipy-lsoda", tolerance, partial(averaged, smooth, tolerance), _estimated)
    quick: list[str] = [name for name in QUICK if name in choice.available(assemble(scene))]
    for name in quick:
        for tolerance in TOLERANCES:
            yield _integration("equations", scene, name, tolerance)
    if full.effects != scene.effects:
        for name in (name for name in quick if name in choice.available(assemble(full))):
            for tolerance in TOLERANCES[1:5:2]:
                yield _integration("everything", full, name, tolerance)
    for name in (name for name in choice.available(assemble(scene)) if name not in QUICK):
        for tolerance in TOLERANCES:
            yield _integration("equations", scene, name, tolerance)


def _estimated(estimate: Estimate) -> tuple[Measures, int, int]:
    return estimate, estimate.evaluations, estimate.steps


def _integration(rung: str, scene: Scene, name: str, tolerance: float) -> Method:
    equations, times = assemble(scene), needed_times(scene)

    def read(trajectory: Trajectory) -> tuple[Measures, int, int]:
        """What is compared of a run, and its work."""
        return evaluate(scene, trajectory), trajectory.evaluations, trajectory.steps

    def run() -> Trajectory:
        """The integration alone."""
        return choice.integrate_with(name, equations, tolerance, times, MOST_EVALUATIONS)

    return Method(rung, name, tolerance, run, read)


def _point(full: Scene, method: Method, reference: Reference, quantity: str, end: float) -> Point:
    """One method, run once cold and then warm as long as there is time."""
    started = time.perf_counter()
    try:
        run = method.run()
    except AbuError as failure:
        note = str(failure).splitlines()[0]
        return Point(method.rung, method.integrator, method.tolerance, None, 0, 0, None, None, note)
    cold = time.perf_counter() - started
    warm = []
    for _ in range(REPEATS if cold < LONG else 1):
        if time.perf_counter() + cold > end:
            break
        started = time.perf_counter()
        method.run()
        warm.append(time.perf_counter() - started)
    measures, evaluations, steps = method.read(run)
    error = QUANTITIES[quantity](full, measures, reference.response)
    known = math.isfinite(error)
    return Point(
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


def _trial(name: str, equations: Equations, times: Any) -> tuple[Trajectory, float]:
    """A loose run, and its time [s]; a short one once more, since the first also loads and compiles."""
    for _ in range(2):
        started = time.perf_counter()
        run = choice.integrate_with(name, equations, TRIAL, times, MOST_EVALUATIONS)
        spent = time.perf_counter() - started
        if spent > LOADING:
            break
    return run, spent


def _reference(full: Scene, quantity: str, accuracy: float, budget: float) -> Reference:
    """Two methods at tight tolerances; they must agree better than half the accuracy.

    A loose run first shows how long they will take.
    """
    equations, times, started = assemble(full), needed_times(full), time.perf_counter()
    (one, loose), (other, tight) = choice.verifiers(equations, max(accuracy, FINEST))
    trial, spent = _trial(one, equations, times)
    # Events are as many and as long at every tolerance.
    steps = 1 - EVENT * trial.events / work(trial)
    expected = spent * (1 + (1 - steps) + steps * (TRIAL / loose) ** (1 / ORDER))
    if expected > budget:
        raise NotTrustworthyError(
            f"{full.name}: the reference alone takes about {expected:.0f} s, {trial.events} events among it\n"
            f"  give more time (--budget {2 * expected:.0f}, Python: budget_s=), "
            "or shorten the run (--duration, Python: duration_s=)"
        )
    first = evaluate(full, choice.integrate_with(one, equations, loose, times, MOST_EVALUATIONS))
    second = evaluate(full, choice.integrate_with(other, equations, tight, times, MOST_EVALUATIONS))
    apart = QUANTITIES[quantity](full, first, second)
    if not apart <= accuracy / 2:
        raise NotTrustworthyError(
            f"{full.name}: no reference: {one} and {other} differ by {apart:.2g} in the {quantity}\n"
            "  ask for less accuracy, or shorten the run: a chaotic motion has no reference"
        )
    return Reference((one, other), (loose, tight), apart, second, time.perf_counter() - started)
