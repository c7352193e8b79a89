"""`abu factory [FILE …]`: measured levels of machines with autobalancers, beside predictions."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import add_command
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.factory.study import FactoryResult


def factory(
    how: Delivery,
    files: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[MACHINE …]",
            help="Machine files with tables [[measured]]. Without them: the presets that a factory measured.",
        ),
    ] = None,
) -> Outcome:
    """Compare predicted levels with measured ones."""
    from abu_calc.features.factory.study import factory as study
    from abu_calc.inputs.read_machine import read

    machines = [read(file) for file in files or ()]
    with progress(how) as tell:
        result = study(machines, tell)
    return outcome_of(result)


def outcome_of(result: "FactoryResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.factory.view import factory_blocks, factory_screen

    return Outcome.of(result, lambda: factory_blocks(result), lambda: factory_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "factory", factory, simulates=True)
