"""`abu grinding MACHINE`: does the autobalancer help at work, and how does the wheel wear?"""

from typing import TYPE_CHECKING

import typer

from abu_calc.cli.command import Machine, Overrides, add_command
from abu_calc.cli.deliver import Delivery
from abu_calc.cli.progress import progress
from abu_calc.cli.scene_options import Accuracy
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.report.figures.figure import Extras
    from abu_calc.studies.grinding import GrindingResult


def grinding(how: Delivery, machine: Machine, set_: Overrides = None, accuracy: Accuracy = 0.01) -> Outcome:
    """The machine at its work: where balls rest, how it moves, how wheel and work press, how the wheel wears."""
    from abu_calc.report.grinding import grinding_blocks
    from abu_calc.report.grinding_screen import grinding_screen
    from abu_calc.spec.read import read_machine
    from abu_calc.studies.grinding import grinding as study

    with progress(how) as tell:
        result = study(read_machine(machine, set_ or ()), accuracy, tell)
    return Outcome.of(
        result, lambda: grinding_blocks(result), lambda: grinding_screen(result), extras=lambda: _extras(result)
    )


def _extras(result: "GrindingResult") -> "Extras":
    from abu_calc.report.figures.grinding import grinding_extras

    return grinding_extras(result)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "grinding", grinding, simulates=True)
