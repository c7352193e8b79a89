"""An audit: the same scene once more with every effect in, and what that really changed."""

from abu_calc.analysis.differences import difference
from abu_calc.analysis.ledger import Ledger
from abu_calc.analysis.simulate import Simulation, simulate, usual_work
from abu_calc.dynamics.scene import Scene
from abu_calc.frozen import dataclass
from abu_calc.progress import Progress, silent


@dataclass(frozen=True)
class Audit:
    """The true difference, counted as accuracy counts errors, beside what the weights of what was left out promised."""

    difference: float
    promise: float
    effects: tuple[str, ...]
    """Effects added to the scene for the audit."""
    evaluations: int
    wall_s: float


def audit(
    full: Scene, ledger: Ledger, run: Simulation, accuracy: float, most_evaluations: int | None,
    integrator: str = "auto", progress: Progress = silent,
) -> Audit:  # fmt: skip
    """Simulate the scene with all its effects to the same accuracy, by the work that the run has left.

    Raises NotTrustworthyError as `simulate` does.
    """
    added = tuple(entry.name for entry in ledger.entries if not entry.included)
    if not added:
        return Audit(0.0, 0.0, (), 0, 0.0)
    left = max((most_evaluations or usual_work(full, integrator)) - run.cost.work, 1)
    whole = simulate(full, accuracy, (), left, integrator=integrator, progress=progress)
    return Audit(
        difference=difference(run.scene, run.response, whole.response),
        promise=ledger.promise,
        effects=added,
        evaluations=whole.cost.evaluations,
        wall_s=whole.cost.wall_s,
    )
