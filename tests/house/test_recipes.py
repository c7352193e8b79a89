"""What the README says of adding a thing is so: the files it names are there, and they are few."""

import re
import sys
import types
from pathlib import Path

import pytest

from abu_calc.cli import app
from abu_calc.report import files
from abu_calc.report.outcome import Outcome
from tests.cli.runner import abu
from tests.house.structure import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")

MOST = {"an effect": 4 + 1, "a support": 3, "a sizing step": 5, "an output format": 1, "a command": 3}
"""Existing files that a newcomer of each kind may touch; an effect also has its example in the tests."""


@pytest.mark.parametrize("what", MOST)
def test_a_recipe_touches_few_files(what: str) -> None:
    found = re.search(rf"\*\*Adding {what}\.\*\*(.*?)(?=\n\*\*Adding|\n## )", README, re.DOTALL)
    assert found is not None
    faces = {"dynamics/support.py"}  # to read, not to touch
    named = set(re.findall(r"`([a-z_/]+\.py)`", found[1])) - faces
    present = {name for name in named if (ROOT / "abu_calc" / name).is_file() or (ROOT / name).is_file()}
    assert named and named == present, f"not there: {named - present}"
    assert len(present) <= MOST[what], present


def test_a_command_is_a_module_and_a_line(monkeypatch: pytest.MonkeyPatch) -> None:
    module = types.ModuleType("abu_calc.cli.greet")

    def greet(name: str) -> Outcome:
        """Greet."""
        return Outcome("greet", {"greeted": name}, ())

    def register(to: object) -> None:
        from abu_calc.cli.command import add_command

        add_command(to, "greet", greet)  # type: ignore[arg-type]

    module.__dict__["register"] = register
    monkeypatch.setitem(sys.modules, "abu_calc.cli.greet", module)
    monkeypatch.setattr(app, "COMMANDS", (*app.COMMANDS, "greet"))
    seen = abu("greet", "Ada", "--json")
    assert seen.status == 0 and seen.document["result"] == {"greeted": "Ada"}


def test_an_output_format_is_an_entry(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(files.FORMATS, ".shout", lambda outcome: outcome.status.upper())
    target = tmp_path / "design.shout"
    assert abu("check-fit", "mmg-3200k-knife-shaft", "--output", str(target)).status in (0, 1)
    assert target.read_text(encoding="utf-8") in ("PASS", "FAIL", "NOT-DONE")
