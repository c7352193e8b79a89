"""`abu effects [MACHINE|SCENE]`: all effects; with a file, those that are simulated, and why."""

from collections.abc import Sequence
from typing import Any

from abu_calc.cli.command import ACCURACY, FILE, SCENE, SET, WITH, WITHOUT, Answer, Command, Study
from abu_calc.foundation.errors import InputError


def _listed(study: Study, source: object = None, set_: Sequence[str] = (), **given: Any) -> Answer:
    from abu_calc.features.effects.study import known_effects

    if source is not None:
        return study(source, **given)
    if set_ or given.keys() - {"accuracy"}:
        raise InputError("these options need a file", remedy="Name a machine or a scene.")
    return known_effects()


COMMAND = Command(
    "effects.study:effects",
    (FILE._replace(default=None), SET, SCENE, ACCURACY, WITH, WITHOUT),
    "Each effect has an estimated influence on the result.",
    around=_listed,
)
