"""`abu grinding MACHINE`: effect of the autobalancer at work, and wear of the wheel."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Accuracy, Machine, Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.registry import imported
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.grinding.study import GrindingResult


def grinding(
    how: Delivery,
    machine: Machine,
    set_: Overrides = None,
    accuracy: Accuracy = 0.01,
    wheel: Annotated[int | None, option("--wheel N", "With two races: only this wheel at work, by its number.")] = None,
) -> Outcome:
    """Calculate vibration, contact force and wheel wear while grinding."""
    from abu_calc.features.grinding.study import grinding as study
    from abu_calc.inputs.read_machine import read_machine

    with progress(how) as tell:
        result = study(read_machine(machine, set_ or ()), accuracy, tell, wheel)
    return outcome_of(result)


def outcome_of(result: "GrindingResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.grinding.study import GrindingResult
    from abu_calc.features.grinding.view import grinding_blocks, grinding_screen

    if not isinstance(result, GrindingResult):
        outcome: Outcome = imported("spindle.work_view:work_outcome")(result)
        return outcome
    return Outcome.of(result, lambda: grinding_blocks(result), lambda: grinding_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "grinding", grinding, simulates=True)
