"""`abu size MACHINE`: from one file about a machine to a sized and simulated design."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Machine, Overrides, add_command
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.spec.read import Loaded

LATER = {
    "grinding": "the scene `grinding`",
    "run_up": "the scene `run-up`",
    "motor": "the motor of limited power",
    "swing_arm": "the scenes `swing-arm-idle` and `swing-arm-cutting`",
}


def size(
    machine: Machine,
    set_: Overrides = None,
    explain: Annotated[bool, typer.Option("--explain", help="Show every formula with its numbers and source.")] = False,
    accuracy: Annotated[float, typer.Option("--accuracy", help="Accuracy asked of the simulation.")] = 0.01,
) -> Outcome:
    """Size the autobalancer of a machine: region, capacity, balls, track, seats, simulation."""
    from abu_calc.cli.load import load

    return sized(load(machine, set_), explain=explain, accuracy=accuracy)


def sized(loaded: "Loaded", *, explain: bool = False, accuracy: float = 0.01) -> Outcome:
    """The outcome of sizing a file that is read already."""
    from abu_calc.analysis.idle import WORK, idle_checks, not_simulated
    from abu_calc.analysis.simulate import simulate
    from abu_calc.checks import overall
    from abu_calc.cli.load import located, machine_of, source_of
    from abu_calc.dynamics.from_design import idle_scene
    from abu_calc.errors import NotTrustworthyError
    from abu_calc.report.simulation import scene_model
    from abu_calc.report.size import size_model, size_result
    from abu_calc.report.size_text import size_blocks
    from abu_calc.sizing import size as size_design

    machine = machine_of(loaded, "size")
    with located(loaded):
        design = size_design(machine)
        scene = idle_scene(design)
        checks, simulations = design.checks, []
        try:
            if scene is not None:
                simulations = [simulate(scene, accuracy, most_evaluations=WORK)]
        except NotTrustworthyError as error:
            checks += (not_simulated(str(error).splitlines()[0]),)
    for simulation in simulations:
        checks += idle_checks(design, simulation.response)
    warnings = (*loaded.warnings, *design.warnings, *(w for run in simulations for w in run.warnings))
    warnings += tuple(_not_simulated(loaded, scene is None))
    result, model = size_result(design, simulations), size_model(design)
    if scene is not None:
        model["scenes"] = {scene.name: scene_model(scene)}
    status = overall(checks)
    blocks = size_blocks(
        machine.machine.name, design.case.autobalancer, result, status, checks, warnings, loaded.defaults_used
    )
    if explain:
        from abu_calc.report.explain import explanation_blocks

        blocks += explanation_blocks(result, model)
    return Outcome("size", result, blocks, source_of(loaded), checks, model, warnings, status)


def _not_simulated(loaded: "Loaded", no_idle: bool) -> list[str]:
    """Scenes the file calls for that cannot be simulated yet."""
    missing = [what for table, what in LATER.items() if getattr(loaded.machine, table, None) is not None]
    if no_idle:
        missing.insert(0, "the scene `idle` on the suspension `hands`")
    return [f"Not simulated in this version: {', '.join(missing)}."] if missing else []


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "size", size)
