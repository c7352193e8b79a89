"""`abu effects [MACHINE|SCENE]`: the effects there are; with a file, which of them are simulated, and why."""

from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Overrides, add_command
from abu_calc.cli.simulate import Accuracy, With, Without, check_effects
from abu_calc.cli.subject import WhichScene, subject_of
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.cli.subject import Subject

Optional = Annotated[
    str | None, typer.Argument(metavar="[MACHINE|SCENE]", help="A machine file, a preset's name, or a scene file.")
]


def effects(
    file: Optional = None,
    set_: Overrides = None,
    scene: WhichScene = None,
    accuracy: Accuracy = 0.01,
    with_: With = None,
    without: Without = None,
) -> Outcome:
    """The effects there are; with a file: which are simulated, which are not, their weights and why."""
    from abu_calc.errors import InputError
    from abu_calc.report.effects import known_blocks, known_effects

    if file is None:
        if set_ or scene or with_ or without:
            raise InputError("these options need a file", remedy="Name a machine or a scene.")
        return Outcome("effects", {"effects": known_effects()}, known_blocks(), None, (), {}, (), "pass")
    return _of_file(subject_of(file, set_, scene), accuracy, with_, without)


def _of_file(subject: "Subject", accuracy: float, with_: list[str] | None, without: list[str] | None) -> Outcome:
    from abu_calc.analysis.ledger import chosen
    from abu_calc.analysis.simulate import ACCURACY
    from abu_calc.cli.load import source_of
    from abu_calc.report.common import default_blocks, warning_blocks
    from abu_calc.report.effects import ledger_blocks, ledger_result
    from abu_calc.report.simulation import scene_model

    ACCURACY.check(accuracy)
    check_effects(subject.scene.effects, with_, without)
    with subject.source.located():
        ledger = chosen(subject.scene, accuracy, with_ or (), without or ())
    result = {"scene": ledger.scene.name, "accuracy": accuracy, "effects": ledger_result(ledger.entries)}
    told = (*warning_blocks(subject.warnings), *default_blocks(subject.source.defaults_used))
    blocks = (*ledger_blocks(subject.title, ledger, accuracy), *told)
    return Outcome("effects", result, blocks, source_of(subject.source), (), scene_model(ledger.scene),
                   subject.warnings, "pass")  # fmt: skip


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "effects", effects)
