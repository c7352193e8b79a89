"""`abu declare MACHINE`: the type test simulated; `abu declare --recordings FILE`: the same from measured runs."""

from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.cli.command import Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.declare.measured import MeasuredDeclareResult
    from abu_calc.features.declare.study import DeclareResult

MEASURED: Final = "Measured runs"
"""Panel of the options about recordings."""


def declare(
    how: Delivery,
    machine: Annotated[str | None, typer.Argument(metavar="MACHINE", help="Machine file or name of a preset.")] = None,
    set_: Overrides = None,
    starts: Annotated[int, option("--starts N", "Starts of the balls to simulate.")] = 10_000,
    recordings: Annotated[
        list[str] | None,
        option(
            "--recordings FILE", "Recorded run (CSV or WAV; repeatable), or a TOML file that lists the runs.", MEASURED
        ),
    ] = None,
    sensitivity: Annotated[
        list[str] | None,
        option(
            "--sensitivity [CHANNEL=]VALUE",
            "Sensitivity of sensors in V or mV, such as 100 mV/g; repeatable.",
            MEASURED,
        ),
    ] = None,
    automatic_balancing: Annotated[
        bool, option("--automatic-balancing", "The machine has an autobalancer: multiply by 1.3.", MEASURED)
    ] = False,
) -> Outcome:
    """Give the declared vibration value of a type test.

    The type test of ISO 28927-4 is simulated for a machine, without and with the autobalancer, or evaluated from
    recordings of runs.
    """
    if recordings:
        for name, given in (("MACHINE", machine), ("--set", set_)):
            if given:
                raise InputError(
                    "a machine or recordings, not both",
                    place=Place(key=name),
                    remedy=f"Leave {name} out, or --recordings.",
                )
        return _measured(how, recordings, sensitivity or [], automatic_balancing)
    if machine is None:
        raise InputError(
            "nothing to declare", place=Place(key="MACHINE"), remedy="Name a machine file, or give --recordings FILE."
        )
    if sensitivity or automatic_balancing:
        key = "--sensitivity" if sensitivity else "--automatic-balancing"
        raise InputError("for recordings only", place=Place(key=key), remedy="Leave it out, or give --recordings FILE.")
    from abu_calc.features.declare.study import declare as study
    from abu_calc.inputs.read_machine import read_machine

    with progress(how) as tell:
        result = study(read_machine(machine, set_ or ()), starts, tell)
    return outcome_of(result)


def _measured(how: Delivery, recordings: list[str], sensitivity: list[str], automatic_balancing: bool) -> Outcome:
    from abu_calc.features.declare.measured import declare_recordings

    with progress(how) as tell:
        result = declare_recordings(
            recordings, sensitivity=sensitivity, automatic_balancing=automatic_balancing, progress=tell
        )
    return outcome_of(result)


def outcome_of(result: "DeclareResult | MeasuredDeclareResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.declare.measured import MeasuredDeclareResult
    from abu_calc.features.declare.measured_view import measured_blocks, measured_screen
    from abu_calc.features.declare.view import declare_blocks, declare_screen

    if isinstance(result, MeasuredDeclareResult):
        return Outcome.of(result, lambda: measured_blocks(result), lambda: measured_screen(result))
    return Outcome.of(result, lambda: declare_blocks(result), lambda: declare_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "declare", declare, simulates=True)
