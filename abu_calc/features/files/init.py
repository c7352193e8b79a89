"""`abu init FILE`: write the file of a new machine, or a commented file of another kind, or a copy of a preset."""

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import typer

from abu_calc.cli.output import Delivery
from abu_calc.features.files.new_machine import completed, machine_text
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read, read_file
from abu_calc.inputs.reading.kinds import BY_NAME, kind_of
from abu_calc.inputs.reading.sources import text_of
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.write import Target, check_target


def init(
    how: Delivery,
    file: Path,
    preset: str | None = None,
    method: str | None = None,
    *,
    scene: bool = False,
    readings: bool = False,
    recordings: bool = False,
    all_keys: bool = False,
    **answers: Any,
) -> Outcome:
    """Write the short file of a machine from the answers to questions about it, or a file of another kind."""
    check_target(file, force=how.force, suffixes=(".toml",))
    kinds = (("scene", scene), ("readings", readings), ("recordings", recordings), ("all-keys", all_keys))
    asked = [name for name, wanted in kinds if wanted]
    if len(asked) + (preset is not None) > 1:
        options = [f"--{name}" for name in asked] + (["--preset"] if preset is not None else [])
        raise InputError(
            f"{' and '.join(options)} exclude each other", remedy="Specify one of them: a preset has its own kind."
        )
    if method is not None and not readings:
        raise InputError("--method goes with --readings", remedy="Add --readings, or leave --method out.")
    if asked or preset is not None:
        if answers:
            raise InputError(
                f"--{next(iter(answers))} describes a machine of a short file",
                remedy="Leave it out here, or the other option.",
            )
        text, command = _whole(preset, "machine" if all_keys else asked[0] if asked else "", method)
    else:
        text, command = _short(answers), "size"
    said = [Paragraph(f"{file} is written. Edit it, then: abu {command} {file}", "pass")]
    if any(line.startswith("[expected]") for line in text.splitlines()):
        said.append(Paragraph(f"[expected] holds the preset's results. After an edit: abu verify --update {file}"))
    return Outcome("init", {"file": str(file), "preset": preset}, tuple(said), further=(Target(file, text),))


def _whole(preset: str | None, kind: str, method: str | None) -> tuple[str, str]:
    """A preset, or the commented file of a kind, and the command for it."""
    if preset is not None:
        return text_of(preset), kind_of(read_file(preset).document.content).command
    if method is not None:
        from abu_calc.registry import imported

        return imported("balancing.read:readings_template")(method), BY_NAME[kind].command
    from abu_calc.inputs.reading.template import template_of

    return template_of(kind), BY_NAME[kind].command


def _short(answers: Mapping[str, Any]) -> str:
    """The short file of a machine, read as a check before it is written."""

    def ask(words: str, usual: str) -> str:
        """An answer from the terminal; the usual one where none is given."""
        return str(typer.prompt(f"{words} [{usual}]" if usual else words, default="", show_default=False, err=True))

    text = machine_text(*completed(answers, ask if sys.stdin.isatty() else None))
    read(text)
    return text
