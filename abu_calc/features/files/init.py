"""`abu init [--preset NAME|--scene|--readings [--method NAME]|--recordings] FILE`: write a commented file."""

from pathlib import Path
from typing import Annotated

import typer

from abu_calc.cli.command import add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.foundation.errors import InputError
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.outcome import Outcome


def init(
    how: Delivery,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="New file, ending in .toml.")],
    preset: Annotated[str | None, option("--preset NAME", "Copy this preset.")] = None,
    scene: Annotated[bool, option("--scene", "Write a scene file for `abu simulate`.")] = False,
    readings: Annotated[bool, option("--readings", "Write a file of readings for `abu balance`.")] = False,
    method: Annotated[
        str | None,
        option(
            "--method NAME",
            "With --readings, the method: rig-data, trials, single-plane, four-runs, least-squares or coefficients.",
        ),
    ] = None,
    recordings: Annotated[
        bool, option("--recordings", "Write a list of recordings for `abu declare --recordings`.")
    ] = False,
) -> Outcome:
    """Write a complete file with a comment at every key, to edit.

    Without options, the command writes a machine file for `abu size FILE`.
    """
    from abu_calc.inputs.read_machine import read_file
    from abu_calc.inputs.reading.kinds import BY_NAME, kind_of
    from abu_calc.inputs.reading.sources import text_of
    from abu_calc.reporting.write import Target, check_target

    check_target(file, force=how.force, suffixes=(".toml",))
    asked = [name for name, wanted in (("scene", scene), ("readings", readings), ("recordings", recordings)) if wanted]
    if len(asked) + (preset is not None) > 1:
        options = [f"--{name}" for name in asked] + (["--preset"] if preset is not None else [])
        raise InputError(
            f"{' and '.join(options)} exclude each other", remedy="Specify one of them: a preset has its own kind."
        )
    if method is not None and not readings:
        raise InputError("--method goes with --readings", remedy="Add --readings, or leave --method out.")
    if preset is not None:
        text, kind = text_of(preset), kind_of(read_file(preset).document.content)
    else:
        kind = BY_NAME[asked[0] if asked else "machine"]
        text = kind.call("template", method) if method is not None else kind.call("template")
    said = [Paragraph(f"{file} is written. Edit it, then: abu {kind.command} {file}", "pass")]
    if any(line.startswith("[expected]") for line in text.splitlines()):
        said.append(Paragraph(f"[expected] holds the preset's results. After an edit: abu verify --update {file}"))
    return Outcome("init", {"file": str(file), "preset": preset}, tuple(said), further=(Target(file, text),))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "init", init)
