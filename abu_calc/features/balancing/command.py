"""`abu balance READINGS`: balancing of a rotor in one plane or two from runs on a rig or in the field."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.balancing.study import BalanceResult


def balance(
    how: Delivery,
    readings: Annotated[str, typer.Argument(metavar="READINGS", help="File of readings or name of a preset.")],
    coefficients: Annotated[
        str | None, option("--coefficients FILE", "Use influence coefficients that were saved in this file.")
    ] = None,
    save_coefficients: Annotated[
        Path | None, option("--save-coefficients FILE", "Save the influence coefficients of the trial runs.")
    ] = None,
    set_: Overrides = None,
    explain: Annotated[bool, option("--explain", "Print the whole report and every formula with its numbers.")] = False,
) -> Outcome:
    """Balance a rotor in one plane or two from runs on a rig or in the field.

    The report gives correction masses, their angles, their uncertainty and the verification run.
    """
    from abu_calc.features.balancing.read import read_readings
    from abu_calc.features.balancing.study import balance as study
    from abu_calc.reporting.write import Target, check_target

    if save_coefficients is not None:
        check_target(save_coefficients, force=how.force, suffixes=(".toml",), option="--save-coefficients")
    result = study(read_readings(readings, set_ or ()), coefficients)
    outcome = outcome_of(result, explain=explain)
    return replace(outcome, further=(Target(save_coefficients, _stored(result)),)) if save_coefficients else outcome


def _stored(result: "BalanceResult") -> Iterator[str]:
    """Text of the influence coefficients; raises InputError for an answer without them."""
    if result.coefficients_text is None:
        raise InputError(
            "influence coefficients come from trial masses", place=Place(key="--save-coefficients"),
            found=f"an answer by {result.method}", remedy="Make a run with a trial mass in each plane.",
        )  # fmt: skip
    yield result.coefficients_text


def outcome_of(result: "BalanceResult", *, explain: bool = False) -> Outcome:
    """Outcome of a result: how it is shown and written; `explain`: with every formula."""
    from abu_calc.features.balancing.figures import balance_note
    from abu_calc.features.balancing.view import balance_blocks, balance_screen

    if explain:
        return Outcome.of(result, lambda: balance_blocks(result) + balance_note(result))
    return Outcome.of(result, lambda: balance_blocks(result), lambda: balance_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "balance", balance)
