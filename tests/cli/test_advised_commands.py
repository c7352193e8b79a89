"""Every command that a report advises runs as it stands, FILE replaced by the file of the report."""

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest

from abu_calc.cli.app import COMMANDS
from tests.cli.runner import again, once
from tests.hard_machines import FILES_BY_HAND

ADVISED = re.compile(r"`abu ([^`]+)`")
NAMED = re.compile(rf"(?<![`\w/-])abu (?:{'|'.join(COMMANDS)})\b(?!:)")
"""A command outside of backquotes; an error begins with its own command and a colon."""
REPORTS = ("size", "simulate", "levels", "stability", "effects", "grinding")
PLACEHOLDERS = {"FILE", "MACHINE"}


def reports(file: str, commands: tuple[str, ...] = REPORTS) -> Iterator[str]:
    """The texts that a file's reports show, on one line each; errors, too."""
    for command in commands:
        for options in ((), ("--full",)):
            seen = once(command, file, *options)
            yield " ".join(f"{seen.out} {seen.err}".split())


def failing(file: str, text: str) -> Iterator[str]:
    """The commands of a text that do not run; FILE of `abu init` is a new one in the current folder."""
    for words in dict.fromkeys(ADVISED.findall(text)):
        own = "new.toml" if words.startswith("init ") else file
        arguments = [own if word in PLACEHOLDERS else word for word in shlex.split(words)]
        if arguments[0] == "init" and len(arguments) == 2:  # which asks in a terminal
            arguments.append("--all-keys")
        if (seen := again(*arguments)).status not in (0, 1):
            yield f"abu {words}: {seen.err}"


@pytest.mark.few(0, 1)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["avtovaz-707-305", "swing-arm-grinder"])
def test_commands_advised_for_presets_run(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = " ".join(reports(name, ("size",)))
    assert len(ADVISED.findall(text)) > 1 and NAMED.findall(text) == [] and list(failing(name, text)) == []


@pytest.mark.few(0, 1)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230",
                                  "swing-arm-grinder", "mmg-3200k-knife-shaft"])  # fmt: skip
def test_commands_advised_in_every_report_of_a_preset_run(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = " ".join(reports(name))
    assert ADVISED.findall(text) and NAMED.findall(text) == [] and list(failing(name, text)) == []


@pytest.mark.few(0, 1)
@pytest.mark.parametrize("file", FILES_BY_HAND)
def test_commands_advised_for_hard_machines_run(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = " ".join(reports(str(file)))
    assert NAMED.findall(text) == [] and list(failing(str(file), text)) == []
