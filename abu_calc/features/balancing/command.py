"""`abu balance READINGS`: balancing of a rotor in one plane or two from runs on a rig or in the field."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from abu_calc.cli.command import EXPLAIN, REQUIRED, SET, Command, FurtherFile, Option
from abu_calc.foundation.errors import InputError, Place

if TYPE_CHECKING:
    from abu_calc.features.balancing.read import Readings
    from abu_calc.features.balancing.study import BalanceResult


def _readings(file: str, overrides: Sequence[str]) -> "Readings":
    from abu_calc.features.balancing.read import read_readings

    return read_readings(file, overrides)


def _stored(result: "BalanceResult", _: Mapping[str, Any]) -> Iterator[str]:
    """Text of the influence coefficients; raises InputError for an answer without them."""
    if result.coefficients_text is None:
        raise InputError(
            "influence coefficients come from trial masses", place=Place(key="--save-coefficients"),
            found=f"an answer by {result.method}", remedy="Make a run with a trial mass in each plane.",
        )  # fmt: skip
    yield result.coefficients_text


COMMAND = Command(
    "balancing.study:balance",
    (
        Option("readings", str, "READINGS", "File of readings or name of a preset.", default=REQUIRED, reads=_readings),
        Option("coefficients", str, "--coefficients FILE", "Use influence coefficients that were saved in this file."),
        Option(
            "save_coefficients",
            Path,
            "--save-coefficients FILE",
            "Save the influence coefficients of the trial runs.",
            writes=FurtherFile(".toml", _stored),
        ),
        *(SET, EXPLAIN),
    ),
    "The report gives correction masses, their angles, their uncertainty and the verification run.",
)
