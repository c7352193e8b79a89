"""Cost of accuracy: every way to compute a scene, its error and its time."""

from dataclasses import field
from typing import Annotated, ClassVar, Final

from abu_calc.features.accuracy.price_list import PriceList
from abu_calc.features.accuracy.price_list import study as measured
from abu_calc.foundation.checks import Check, verdict
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.validity import Range
from abu_calc.simulation.arguments import checked, one_of
from abu_calc.simulation.nonconvergence import QUANTITIES
from abu_calc.simulation.records import SceneModel
from abu_calc.simulation.result import Result
from abu_calc.simulation.simulate import ACCURACY
from abu_calc.simulation.subject import Source, subject_of

BUDGET: Final = Range("budget", 0.1, 3600.0, "s", key="budget_s")


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
    note: Annotated[str, Quantity("note")]


@record
class Reference(Record):
    """Reference of the errors: two methods and their disagreement; no error is known better than that."""

    integrators: Annotated[tuple[str, ...], Quantity("integrators")]
    tolerances: Annotated[tuple[float, ...], Quantity("tolerances", "", 1)]
    disagreement: Annotated[float, Quantity("disagreement", "", 2)]
    wall_s: Annotated[float, Quantity("time it took", "", 3)] = field(compare=False)


@record
class AccuracyResult(Result):
    """The price list of a scene."""

    command: ClassVar[str] = "accuracy"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"scene"}

    model: SceneModel
    scene: str
    quantity: Annotated[str, Quantity("quantity", "", 4, "amplitude, level, settling or angles")]
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
    study = measured(subject.scene, ledger, quantity, accuracy, budget_s, progress)
    return AccuracyResult.read(
        subject, study, checks=(_affordable(study),), model=SceneModel.of(ledger.scene), scene=subject.scene.name
    )


def _affordable(study: PriceList) -> Check:
    best = study.chosen
    message = "a way to compute was measured whose error is below the accuracy"
    return Check("ABU811", "accuracy affordable", verdict(best is not None), message,
                 None if best is None else best.error, study.accuracy, None,
                 None if best else "More time (--time-budget, Python: budget_s=), or less accuracy.")  # fmt: skip
