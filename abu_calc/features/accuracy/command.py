"""`abu accuracy MACHINE|SCENE`: computing time against accuracy."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Accuracy, Duration, File, Overrides, WhichScene, WhichStart, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.accuracy.study import AccuracyResult

    pass


Quantity = Annotated[
    str, option("--quantity NAME", "Quantity to compare: amplitude, level, quiet, rest, settling, angles.")
]
Budget = Annotated[float, option("--time-budget --budget S", "Computing time to spend.")]


def accuracy(
    how: Delivery,
    file: File,
    set_: Overrides = None,
    scene: WhichScene = None,
    start: WhichStart = None,
    quantity: Quantity = "amplitude",
    accuracy: Accuracy = 0.01,
    budget_s: Budget = 20.0,
    duration_s: Duration = None,
) -> Outcome:
    """Compare methods of simulation by error and computing time."""
    from abu_calc.features.accuracy.study import accuracy as study
    from abu_calc.simulation.scene_file import read_any

    with progress(how) as tell:
        result = study(
            read_any(file, set_ or ()),
            scene,
            start,
            quantity=quantity,
            accuracy=accuracy,
            budget_s=budget_s,
            duration_s=duration_s,
            progress=tell,
        )
    return outcome_of(result)


def outcome_of(result: "AccuracyResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.accuracy.view import accuracy_blocks, accuracy_screen

    return Outcome.of(result, lambda: accuracy_blocks(result), lambda: accuracy_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "accuracy", accuracy, simulates=True)
