"""`abu measure-plan MACHINE|SCENE`: what to record for `abu identify`, and what it will tell."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import File, Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.identification.plan import MeasurePlanResult


def measure_plan(
    how: Delivery,
    file: File,
    set_: Overrides = None,
    runs: Annotated[int, option("--runs N", "Starts to record.")] = 10,
    noise_um: Annotated[float, option("--noise UM", "Noise of a recorded place over two revolutions, µm.")] = 0.3,
    run_up: Annotated[float | None, option("--run-up S", "Run-up time instead of the file's.")] = None,
) -> Outcome:
    """Plan the recordings for `abu identify`.

    Starts of this machine are simulated and identified like recordings: the intervals are those to expect.
    """
    from abu_calc.features.identification.plan import measure_plan as study
    from abu_calc.simulation.scene_file import read_any

    with progress(how) as tell:
        result = study(read_any(file, set_ or ()), runs=runs, noise_um=noise_um, run_up_s=run_up, progress=tell)
    return outcome_of(result)


def outcome_of(result: "MeasurePlanResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.identification.view import plan_blocks, plan_screen

    return Outcome.of(result, lambda: plan_blocks(result), lambda: plan_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "measure-plan", measure_plan)
