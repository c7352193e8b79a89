"""`abu accuracy MACHINE|SCENE`: what accuracy costs in time."""

from typing import Annotated

import typer

from abu_calc.checks import Check, overall, verdict
from abu_calc.cli.command import Overrides, add_command
from abu_calc.cli.deliver import Delivery
from abu_calc.cli.progress import progress
from abu_calc.cli.simulate import Accuracy
from abu_calc.cli.subject import File, WhichScene, WhichStart, one_of, subject_of
from abu_calc.report.outcome import Outcome

LEAST_BUDGET, MOST_BUDGET = 0.1, 3600.0


def accuracy(
    how: Delivery,
    file: File,
    set_: Overrides = None,
    scene: WhichScene = None,
    start: WhichStart = None,
    quantity: Annotated[
        str, typer.Option("--quantity", help="amplitude (default), level, settling or angles.")
    ] = "amplitude",
    asked: Accuracy = 0.01,
    budget: Annotated[float, typer.Option("--budget", metavar="SECONDS", help="Time to spend.")] = 20.0,
    duration: Annotated[float | None, typer.Option("--duration", metavar="S", help="Seconds to simulate.")] = None,
) -> Outcome:
    """What accuracy costs: every way to compute a scene, its error and its time."""
    from abu_calc.analysis.accuracy import study
    from abu_calc.analysis.differences import QUANTITIES
    from abu_calc.analysis.ledger import chosen
    from abu_calc.analysis.simulate import ACCURACY
    from abu_calc.cli.load import source_of
    from abu_calc.report.accuracy import study_blocks, study_result
    from abu_calc.report.common import default_blocks, warning_blocks
    from abu_calc.report.simulation import scene_model
    from abu_calc.scenes.from_scene import lasting
    from abu_calc.validity import Range

    ACCURACY.check(asked)
    one_of("--quantity", quantity, tuple(QUANTITIES))
    Range("budget", LEAST_BUDGET, MOST_BUDGET, "s", key="--budget").check(budget)
    subject = subject_of(file, set_, scene, start)
    with subject.source.located():
        full = lasting(subject.scene, duration, "scene.duration_s" if duration is None else "--duration")
        ledger = chosen(full, asked)
    with progress(how) as tell:
        measured = study(full, ledger, quantity, asked, budget, tell)
    result = study_result(measured)
    best = measured.chosen
    message = "a way to compute was measured whose error is below the accuracy"
    check = Check("ABU811", "accuracy affordable", verdict(best is not None), message,
                  None if best is None else best.error, asked, None,
                  None if best else "More time (--budget), or less accuracy.")  # fmt: skip
    told = (*warning_blocks(subject.warnings), *default_blocks(subject.source.defaults_used))
    blocks = (*study_blocks(subject.title, full.name, measured), *told)
    return Outcome("accuracy", result, blocks, source_of(subject.source), (check,), scene_model(ledger.scene),
                   subject.warnings, overall((check,)))  # fmt: skip


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "accuracy", accuracy)
