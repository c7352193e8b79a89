"""`abu declare MACHINE`: the type test simulated; `abu declare --recordings FILE`: the same from measured runs."""

from typing import Annotated

import typer

from abu_calc.cli.command import Overrides, add_command
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.outcome import Outcome


def declare(
    how: Delivery,
    machine: Annotated[
        str | None, typer.Argument(metavar="[MACHINE]", help="Machine file or name of a preset.")
    ] = None,
    set_: Overrides = None,
    starts: Annotated[int, typer.Option("--starts", metavar="N", help="Starts to simulate.")] = 10_000,
    recordings: Annotated[
        list[str] | None,
        typer.Option(
            "--recordings",
            metavar="FILE",
            help="Recorded run (CSV or WAV), or a TOML file that lists the runs; repeatable.",
        ),
    ] = None,
) -> Outcome:
    """Give the declared vibration value of a type test.

    The type test of ISO 28927-4 is simulated for a machine, without and with the autobalancer, or evaluated from
    recordings of runs.
    """
    if machine is None:
        raise InputError(
            "nothing to declare", place=Place(key="MACHINE"), remedy="Name a machine file, or give --recordings FILE."
        )
    from abu_calc.features.declare.study import declare as study
    from abu_calc.features.declare.view import declare_blocks, declare_screen
    from abu_calc.inputs.read_machine import read_machine

    with progress(how) as tell:
        result = study(read_machine(machine, set_ or ()), starts, tell)
    return Outcome.of(result, lambda: declare_blocks(result), lambda: declare_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "declare", declare, simulates=True)
