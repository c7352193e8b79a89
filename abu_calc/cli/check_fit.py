"""`abu check-fit [MACHINE]`: bearing seats of a file, or of one bearing given by options."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.bearing_options import BANDS, NAMES, OPTIONS, band, missing, several
from abu_calc.cli.command import Overrides, add_command
from abu_calc.errors import InputError
from abu_calc.report.blocks import Block
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.report.drawing.shapes import Drawing
    from abu_calc.report.figures.figure import Extras
    from abu_calc.spec.read import Machine
    from abu_calc.studies.check_fit import CheckFitResult


def check_fit(
    machine: Annotated[
        str | None, typer.Argument(metavar="[MACHINE]", help="A machine file, or a preset's name.")
    ] = None,
    set_: Overrides = None,
    explain: Annotated[bool, typer.Option("--explain", help="The whole report, every formula with numbers.")] = False,
    **bearing: object,
) -> Outcome:
    """Judge bearing seats, or say which fits to write: interference, creep, stress, clearance left."""
    from abu_calc.studies.check_fit import check_fit as study

    given = {key: value for key, value in bearing.items() if value is not None}
    source = _of_options(given, set_ or ()) if machine is None else _of_file(machine, set_ or (), given)
    result = study(source)
    short = None if explain else lambda: _screen(result)
    return Outcome.of(
        result,
        lambda: _blocks(result, explain),
        short,
        lambda: _drawings(result),
        lambda: _extras(result),
    )


def _screen(result: "CheckFitResult") -> tuple[Block, ...]:
    from abu_calc.report.fit_screen import check_fit_screen

    return check_fit_screen(result)


def _blocks(result: "CheckFitResult", explain: bool) -> tuple[Block, ...]:
    from abu_calc.report.fit_report import check_fit_blocks

    return (*check_fit_blocks(result), *(_note(result) if explain else ()))


def _note(result: "CheckFitResult") -> tuple[Block, ...]:
    """Every formula with the numbers of each bearing."""
    from abu_calc.report.explain import step_blocks
    from abu_calc.report.fit_numbers import seat_numbers
    from abu_calc.report.steps import STEPS
    from abu_calc.studies.seat_model import bearing_models

    return tuple(step_blocks(STEPS["seats"], seat_numbers(bearing_models(result), result.seats)))


def _drawings(result: "CheckFitResult") -> "tuple[Drawing, ...]":
    from abu_calc.report.drawing.sheets import seat_sheets

    return seat_sheets(result)


def _extras(result: "CheckFitResult") -> "Extras":
    from abu_calc.report.figures.check_fit import check_fit_figures
    from abu_calc.report.figures.figure import Extras

    return Extras(tuple(check_fit_figures(result)), _note(result))


def _of_file(machine: str, overrides: Sequence[str], given: Mapping[str, object]) -> "Machine":
    from abu_calc.spec.read import read_machine

    if given:
        raise InputError("a file and options of one bearing exclude each other", found=NAMES[next(iter(given))])
    return read_machine(machine, overrides)


def _of_options(given: dict[str, object], overrides: Sequence[str]) -> "Machine":
    from abu_calc.spec.one_bearing import machine_of_bearings

    if overrides:
        raise InputError("--set overrides entries of a file, and none is given", found=f"--set {overrides[0]}")
    if absent := missing(given):
        raise InputError("a file, or the options of one bearing, are needed", found="no " + ", ".join(absent))
    bands = {key: band(key, str(given[key])) for key in BANDS if key in given}
    return machine_of_bearings(several(given | bands), NAMES)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "check-fit", check_fit, (option.parameter for option in OPTIONS), drawn=(".svg",))
