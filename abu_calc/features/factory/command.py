"""`abu factory [FILE …]`: measured levels of machines with autobalancers, beside predictions."""

from typing import Annotated

import typer

from abu_calc.cli.command import add_command
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome


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
    from abu_calc.features.factory.view import factory_blocks, factory_screen
    from abu_calc.inputs.read_machine import read

    machines = [read(file) for file in files or ()]
    with progress(how) as tell:
        result = study(machines, tell)
    return Outcome.of(result, lambda: factory_blocks(result), lambda: factory_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "factory", factory, simulates=True)
