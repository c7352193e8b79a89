"""`abu size MACHINE`: from one file about a machine to a sized and simulated design."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Machine, Overrides, add_command
from abu_calc.cli.deliver import Delivery
from abu_calc.cli.progress import progress
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.spec.read import Loaded


def size(
    how: Delivery,
    machine: Machine,
    set_: Overrides = None,
    explain: Annotated[bool, typer.Option("--explain", help="Show every formula with its numbers and source.")] = False,
    accuracy: Annotated[float, typer.Option("--accuracy", help="Accuracy asked of the simulation.")] = 0.01,
) -> Outcome:
    """Size the autobalancer of a machine: region, capacity, balls, track, seats, simulation."""
    from abu_calc.cli.load import load

    with progress(how) as tell:
        return sized(load(machine, set_), explain=explain, accuracy=accuracy, tell=tell)


def sized(
    loaded: "Loaded", *, explain: bool = False, accuracy: float = 0.01, tell: Callable[[str], None] = lambda _: None
) -> Outcome:
    """The outcome of sizing a file that is read already."""
    from abu_calc.analysis.idle import idle_checks, not_simulated
    from abu_calc.analysis.machine import simulated
    from abu_calc.analysis.region import true_region
    from abu_calc.checks import overall
    from abu_calc.cli.load import located, machine_of, source_of
    from abu_calc.report.simulation import scene_model
    from abu_calc.report.size import size_model, size_result
    from abu_calc.report.size_text import size_blocks
    from abu_calc.sizing import size as size_design

    machine = machine_of(loaded, "size")
    with located(loaded):
        design = size_design(machine)
        runs, failures = simulated(design, accuracy, tell)
        region = true_region(design)
    checks = (*design.checks, *(not_simulated(failure.scene, failure.reason) for failure in failures))
    for run in runs:
        if run.ledger.scene.name == "idle":
            checks += idle_checks(design, run.simulation.response)
    told = (f"{run.ledger.scene.name}: {text}" for run in runs for text in run.simulation.warnings)
    warnings = (*loaded.warnings, *design.warnings, *region.warnings, *told)
    result, model = size_result(design, runs, region), size_model(design)
    model["scenes"] = {run.ledger.scene.name: scene_model(run.ledger.scene) for run in runs}
    status = overall(checks)
    blocks = size_blocks(
        machine.machine.name, design.case.autobalancer, result, status, checks, warnings, loaded.defaults_used
    )
    if explain:
        from abu_calc.report.explain import explanation_blocks

        blocks += explanation_blocks(result, model)
    return Outcome("size", result, blocks, source_of(loaded), checks, model, warnings, status)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "size", size)
