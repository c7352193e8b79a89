"""`abu factory [FILE …]`: measured levels of machines with autobalancers, beside predictions."""

from collections.abc import Sequence
from typing import Any

from abu_calc.cli.command import Answer, Command, Option, Study


def _read(study: Study, files: Sequence[str] = (), **given: Any) -> Answer:
    from abu_calc.inputs.read_machine import read

    return study([read(file) for file in files], **given)


COMMAND = Command(
    "factory.study:factory",
    (
        Option(
            "files",
            list[str],
            "[MACHINE …]",
            "Machine files with tables [[measured]]. Without them: the presets that a factory measured.",
        ),
    ),
    around=_read,
    simulates=True,
)
