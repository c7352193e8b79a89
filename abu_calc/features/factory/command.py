"""`abu factory`: levels that a factory measured of its machines, beside predictions."""

import typer

from abu_calc.cli.command import add_command
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome


def factory(how: Delivery) -> Outcome:
    """Compare predicted levels with those that a factory measured."""
    from abu_calc.features.factory.study import factory as study
    from abu_calc.features.factory.view import factory_blocks, factory_screen

    with progress(how) as tell:
        result = study(tell)
    return Outcome.of(result, lambda: factory_blocks(result), lambda: factory_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "factory", factory, simulates=True)
