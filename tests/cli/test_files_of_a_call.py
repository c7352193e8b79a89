"""No command writes a file twice, or over one that it reads, whatever the option that names it, with --force, too."""

import inspect
import os
from pathlib import Path

import pytest
import typer.main

from abu_calc.cli.app import COMMANDS, build
from tests.cli.runner import abu

posix = pytest.mark.skipif(os.name == "nt", reason="links need rights there")

MACHINE, TABLE = "m.toml", "t.csv"
WRITTEN = (
    ("size", MACHINE, "-o", "x.toml", "-o", "./x.toml"),
    ("size", MACHINE, "-o", "x.svg", "--figure", "levels=x.svg"),
    ("size", MACHINE, "--figure", "section=x.svg", "--figure", "levels=x.svg"),
    ("simulate", MACHINE, "-o", "x.csv", "--trajectory", "x.csv"),
    ("balance", MACHINE, "-o", "x.toml", "--save-coefficients", "x.toml"),
    ("identify", MACHINE, TABLE, "-o", "x.toml", "--write", "x.toml"),
    ("optimise", MACHINE, "-o", "x.toml", "--write", "x.toml"),
    ("optimise", MACHINE, MACHINE, "-o", "x-2.toml", "--write", "x.toml"),
    ("optimise", MACHINE, "--store", "x.toml", "--write", "x.toml"),
    ("optimise", MACHINE, "--store", "x.toml", "-o", "x.toml"),
    ("sweep", MACHINE, "--store", "x.csv", "-o", "x.csv"),
    ("sweep", MACHINE, "--store", "x.svg", "--figure", "shares=x.svg"),
    ("init", "x.toml", "-o", "x.toml"),
)
"""Each option that names a file to write, with another one."""

READ = (
    *((command, MACHINE, "-o", MACHINE) for command in ("size", "check-fit", "simulate", "stability", "grinding",
      "effects", "accuracy", "balance", "levels", "declare", "measure-plan", "factory", "sweep", "optimise", "compare",
      "validate", "verify")),
    ("levels", TABLE, "-o", TABLE),
    ("verify", "--update", MACHINE, "-o", MACHINE),
    ("compare", "msh-230", MACHINE, "-o", MACHINE),
    ("optimise", "msh-230", MACHINE, "--write", "linked.toml"),
    ("optimise", MACHINE, "--write", MACHINE),
    ("optimise", MACHINE, "--store", MACHINE),
    ("sweep", MACHINE, "--store", MACHINE),
    ("balance", MACHINE, "--save-coefficients", MACHINE),
    ("balance", "balancing-example-6.toml", "--coefficients", MACHINE, "-o", MACHINE),
    ("identify", MACHINE, TABLE, "--write", MACHINE),
    ("identify", "msh-230", TABLE, "-o", TABLE),
    ("compare", "msh-230", "--measured", TABLE, "-o", TABLE),
    ("declare", "--recordings", TABLE, "-o", TABLE),
    ("declare", "--recordings", "list.toml", "-o", TABLE),
)  # fmt: skip
"""Each argument that names a file to read, given as a file to write."""


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    example = Path(__file__).parents[2] / "docs" / "examples" / "balancing-example-6.toml"
    (tmp_path / "balancing-example-6.toml").write_bytes(example.read_bytes())
    (tmp_path / MACHINE).write_text("kept", encoding="utf-8")
    (tmp_path / TABLE).write_text("kept", encoding="utf-8")
    (tmp_path / "linked-2.toml").hardlink_to(tmp_path / MACHINE)
    (tmp_path / "list.toml").write_text(f'[[recording]]\nfile = "{TABLE}"\n', encoding="utf-8")


@pytest.mark.parametrize("words", WRITTEN, ids=" ".join)
def test_two_outputs_are_never_one_file(words: tuple[str, ...], tmp_path: Path) -> None:
    before = sorted(tmp_path.iterdir())
    seen = abu(*words, "--force")
    assert seen.status == 2 and "two outputs name the same file" in seen.err and "another name" in seen.err
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize("words", READ, ids=" ".join)
def test_an_output_is_never_an_input(words: tuple[str, ...], tmp_path: Path) -> None:
    seen = abu(*words, "--force")
    assert seen.status == 2 and "the command reads the file that it would write" in seen.err, seen.err
    assert (tmp_path / MACHINE).read_text("utf-8") == (tmp_path / TABLE).read_text("utf-8") == "kept"


def test_every_option_that_names_a_file_to_write_is_tried() -> None:
    """Arguments whose type is a path are files to write; those of type text are read."""
    found = set()
    for name in COMMANDS:
        command = typer.main.get_command(build((name,)))
        function = getattr(command, "commands", {name: command})[name].callback
        for key, parameter in inspect.signature(inspect.unwrap(function)).parameters.items():
            if "Path" in str(parameter.annotation):
                found.add((name, key.replace("_", "-")))
    given = {(words[0], word.strip("-")) for words in WRITTEN for word in words if word.startswith("--")}
    shared = {(name, option) for name in COMMANDS for option in ("output", "figure")}
    assert found - shared == (given | {("init", "file")}) - shared


@posix
def test_an_unwritable_folder_is_refused_before_anything_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("abu_calc.reporting.outcome.os.access", lambda *_: False)
    seen = abu("size", MACHINE, "-o", "x.json")
    assert seen.status == 2 and "x.json: the folder cannot be written" in seen.err
