"""`abu init [--preset NAME|--scene] FILE`: write a commented machine or scene file to start from."""

from pathlib import Path
from typing import Annotated

import typer

from abu_calc.cli.command import add_command
from abu_calc.cli.deliver import Delivery
from abu_calc.errors import InputError
from abu_calc.report.blocks import Paragraph
from abu_calc.report.outcome import Outcome


def init(
    how: Delivery,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The file to write, ending in .toml.")],
    preset: Annotated[str | None, typer.Option("--preset", metavar="NAME", help="Copy this preset instead.")] = None,
    scene: Annotated[bool, typer.Option("--scene", help="Write a scene file, for `abu simulate`.")] = False,
) -> Outcome:
    """Write a complete machine file with a comment at every key; edit it, then run `abu size FILE`."""
    from abu_calc.report.write import Target, check_target
    from abu_calc.spec.presets import text_of
    from abu_calc.spec.template import scene_template, template

    check_target(file, force=how.force, suffixes=(".toml",))
    if scene and preset is not None:
        raise InputError("--scene and --preset exclude each other", remedy="Presets are machines.")
    text = text_of(preset) if preset is not None else scene_template() if scene else template()
    next_step = Paragraph(f"{file} is written. Edit it, then: abu {'simulate' if scene else 'size'} {file}", "pass")
    return Outcome("init", {"file": str(file), "preset": preset}, (next_step,), further=(Target(file, text),))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "init", init)
