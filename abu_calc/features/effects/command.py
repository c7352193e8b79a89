"""`abu effects [MACHINE|SCENE]`: all effects; with a file, those that are simulated, and why."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Accuracy, Overrides, WhichScene, With, Without, add_command
from abu_calc.foundation.errors import InputError
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.effects.study import EffectsResult, KnownEffectsResult

Optional = Annotated[
    str | None, typer.Argument(metavar="MACHINE|SCENE", help="Machine file, scene file or name of a preset.")
]


def effects(
    file: Optional = None,
    set_: Overrides = None,
    scene: WhichScene = None,
    accuracy: Accuracy = 0.01,
    with_effects: With = None,
    without_effects: Without = None,
) -> Outcome:
    """List the effects; for a file, show which are simulated and why.

    Each effect has an estimated influence on the result.
    """
    from abu_calc.features.effects.study import effects as study
    from abu_calc.features.effects.study import known_effects
    from abu_calc.simulation.scene_file import read_any

    if file is None:
        if set_ or scene or with_effects or without_effects:
            raise InputError("these options need a file", remedy="Name a machine or a scene.")
        return outcome_of(known_effects())
    result = study(
        read_any(file, set_ or ()),
        scene,
        accuracy=accuracy,
        with_effects=with_effects or (),
        without_effects=without_effects or (),
    )
    return outcome_of(result)


def outcome_of(result: "EffectsResult | KnownEffectsResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.effects.study import EffectsResult
    from abu_calc.features.effects.view import effects_blocks, effects_screen, known_blocks

    if isinstance(result, EffectsResult):
        return Outcome.of(result, lambda: effects_blocks(result), lambda: effects_screen(result))
    return Outcome.of(result, lambda: known_blocks(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "effects", effects)
