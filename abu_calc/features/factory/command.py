"""`abu factory [FILE …]`: measured levels of machines with autobalancers, beside predictions."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from abu_calc.cli.command import Command, Option

if TYPE_CHECKING:
    from abu_calc.inputs.read_machine import Machine


def _machines(files: Sequence[str], _: Sequence[str]) -> "list[Machine]":
    from abu_calc.inputs.read_machine import read

    return [read(file) for file in files]


COMMAND = Command(
    "factory.study:factory",
    (
        Option(
            "files",
            list[str],
            "[MACHINE …]",
            "Machine files with tables [[measured]]. Without them: the presets that a factory measured.",
            reads=_machines,
        ),
    ),
    simulates=True,
)
