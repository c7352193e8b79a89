"""`abu declare MACHINE`: the type test simulated; `abu declare --recordings FILE`: the same from measured runs."""

from collections.abc import Sequence
from typing import Any, Final

from abu_calc.cli.command import MACHINE, SET, Answer, Command, Option, Study
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress

MEASURED: Final = "Measured runs"
"""Panel of the options about recordings."""


def _tested(
    study: Study,
    machine: object = None,
    set_: Sequence[str] = (),
    recordings: Sequence[str] = (),
    *,
    progress: Progress,
    sensitivity: Sequence[str] = (),
    automatic_balancing: bool = False,
    **given: Any,
) -> Answer:
    if recordings:
        from abu_calc.features.declare.measured import declare_recordings

        for name, file in (("MACHINE", machine), ("--set", set_)):
            if file:
                raise InputError(
                    "a machine or recordings, not both",
                    place=Place(key=name),
                    remedy=f"Leave {name} out, or --recordings.",
                )
        return declare_recordings(
            recordings, sensitivity=sensitivity, automatic_balancing=automatic_balancing, progress=progress
        )
    if machine is None:
        raise InputError(
            "nothing to declare", place=Place(key="MACHINE"), remedy="Name a machine file, or give --recordings FILE."
        )
    if sensitivity or automatic_balancing:
        key = "--sensitivity" if sensitivity else "--automatic-balancing"
        raise InputError("for recordings only", place=Place(key=key), remedy="Leave it out, or give --recordings FILE.")
    return study(machine, progress=progress, **given)


COMMAND = Command(
    "declare.study:declare",
    (
        *(MACHINE._replace(default=None), SET),
        Option("starts", int, "--starts N", "Starts of the balls to simulate.", default=10_000),
        Option(
            "recordings",
            list[str],
            "--recordings FILE",
            "Recorded run (CSV or WAV; repeatable), or a TOML file that lists the runs.",
            MEASURED,
        ),
        Option(
            "sensitivity",
            list[str],
            "--sensitivity [CHANNEL=]VALUE",
            "Sensitivity of sensors in V or mV, such as 100 mV/g; repeatable.",
            MEASURED,
        ),
        Option(
            "automatic_balancing",
            bool,
            "--automatic-balancing",
            "The machine has an autobalancer: multiply by 1.3.",
            MEASURED,
        ),
    ),
    "The type test of ISO 28927-4 is simulated for a machine, without and with the autobalancer, or evaluated from "
    "recordings of runs.",
    around=_tested,
    simulates=True,
)
