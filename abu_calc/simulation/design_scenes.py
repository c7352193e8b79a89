"""The scenes a machine file calls for, simulated with the effects they call for."""

from collections.abc import Sequence
from typing import Final

from abu_calc.dynamics.integrators.run import TooMuchWorkError
from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check, Grade, coded
from abu_calc.foundation.errors import ChaoticError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import side_by_side
from abu_calc.foundation.progress import Progress, counted, silent
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.simulation.simulate import Simulation
from abu_calc.simulation.subject import Ledger, chosen, simulate_chosen
from abu_calc.sizing.design import Design

WORK = 300_000
"""Evaluations that the simulation of one scene within `abu size` may take, some seconds. A wheel that bounces before it
stays on the work took SciPy 200 000, events counted in, until two runs agreed; other machines take a tenth of that."""
MORE = 10
"""Times the work of a first try that a second may take, where the first did not suffice."""


@dataclass(frozen=True)
class SceneRun:
    """One scene that was simulated, and which of its effects were."""

    ledger: Ledger
    simulation: Simulation


@dataclass(frozen=True)
class SceneFailure:
    """One scene that gave no number to be trusted, and why."""

    scene: str
    reason: str


def scenes_of(design: Design) -> tuple[str, ...]:
    """Names of the scenes the file calls for, the idle one first."""
    table = design.case.table
    grinding = ("grinding",) if table.grinding else ()
    return ("idle", *grinding, *(("swing-arm-idle", "swing-arm-cutting") if table.swing_arm else ()))


def simulated(
    design: Design, accuracy: float, progress: Progress = silent, names: Sequence[str] | None = None,
    workers: int = 1,
) -> tuple[tuple[SceneRun, ...], tuple[SceneFailure, ...]]:  # fmt: skip
    """All of them, or those of some names, each within the work that `abu size` may take."""
    names = scenes_of(design) if names is None else names
    alone = workers == 1 or len(names) == 1
    watched = progress if alone else silent  # of those side by side, each on its own
    tasks = [(design, name, accuracy, watched) for name in names]

    whole = counted(silent if alone else progress, "{} of {} scenes", len(names))
    runs = list(side_by_side(_simulated, tasks, workers, whole))
    return tuple(run for run in runs if isinstance(run, SceneRun)), tuple(
        run for run in runs if isinstance(run, SceneFailure)
    )


def _simulated(design: Design, name: str, accuracy: float, progress: Progress) -> SceneRun | SceneFailure:
    try:
        ledger = chosen(scene_of_design(design, name), accuracy)
        try:
            return SceneRun(*simulate_chosen(ledger, accuracy, most_evaluations=WORK, progress=progress))
        except TooMuchWorkError:
            return SceneRun(*simulate_chosen(ledger, accuracy, most_evaluations=MORE * WORK, progress=progress))
    except ChaoticError as error:
        if error.ended is not None and error.ended.scene.effect("lift_off"):  # the arm has its own check of that
            return SceneRun(ledger, error.ended)
        return SceneFailure(name, str(error).splitlines()[0])
    except NotTrustworthyError as error:
        return SceneFailure(name, str(error).splitlines()[0])


IDLE: Final = ("idle", "swing-arm-idle")
"""Scenes that many start cases repeat."""


def not_simulated(scene: str, reason: str, *, answered: bool = False, mean: str | None = None) -> Check:
    """The check of a scene whose simulation gave no number to be trusted.

    `answered`: whether many starts of the machine, idle as in this scene, gave theirs: then one that did not is no
    veto. `mean`: what a chaotic motion comes to on average, where that is known.
    """
    if mean is not None:
        return coded("ABU703", "warn", mean, remedy="Keep the wheel on the workpiece, see `abu grinding FILE`.",
            of=scene,
        )  # fmt: skip
    status: Grade = "warn" if answered and scene in IDLE and not patience.over() else "not-done"
    return coded("ABU703", status, f"No simulation of this scene can be trusted: {reason}",
        remedy="Specify a drag rate nearer to the optimum, or less accuracy (--accuracy, Python: accuracy=).", of=scene,
    )  # fmt: skip
