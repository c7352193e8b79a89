"""`abu balance READINGS`: two-plane balancing of a roll from runs on a rig."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Overrides, add_command
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    pass


def balance(
    readings: Annotated[str, typer.Argument(metavar="READINGS", help="File of readings or name of a preset.")],
    set_: Overrides = None,
) -> Outcome:
    """Balance a roll in two planes from runs on a rig.

    The report gives correction masses, their angles, their uncertainty and the verification run.
    """
    from abu_calc.features.balancing.read import read_readings
    from abu_calc.features.balancing.study import balance as study
    from abu_calc.features.balancing.view import balance_blocks, balance_screen

    result = study(read_readings(readings, set_ or ()))
    return Outcome.of(result, lambda: balance_blocks(result), lambda: balance_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "balance", balance)
