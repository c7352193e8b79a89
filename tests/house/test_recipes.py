"""The recipes of docs/contributing.md name files that are there, and few of them."""

import re
import sys
import types
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import pytest

import abu_calc
from abu_calc import registry
from abu_calc.cli import app
from abu_calc.cli.command import REQUIRED, Command, Option
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.reporting import files
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.parts import facts
from abu_calc.sizing.case import Case, read_case
from tests.cli.runner import abu
from tests.house.structure import ROOT

CONTRIBUTING = (ROOT / "docs" / "contributing.md").read_text(encoding="utf-8")

MOST = {"an effect": 2, "a support": 1, "a sizing step": 5, "an output format": 1, "a feature with a command": 3}
"""Existing files that a newcomer of each kind may touch, its example in the tests included."""


def named_by(what: str) -> set[str]:
    """The files that the recipe for it names, but for faces, which are to be read, not to be touched."""
    found = re.search(rf"\*\*Adding {what}\.\*\*(.*?)(?=\n\*\*Adding|\n## )", CONTRIBUTING, re.DOTALL)
    assert found is not None
    return set(re.findall(r"`([a-z_/]+\.py)`", found[1])) - {"dynamics/support.py", "dynamics/effect.py"}


@pytest.mark.parametrize("what", MOST)
def test_a_recipe_touches_few_files(what: str) -> None:
    named = named_by(what)
    present = {name for name in named if (ROOT / "abu_calc" / name).is_file() or (ROOT / name).is_file()}
    assert named and named == present, f"not there: {named - present}"
    assert len(present) <= MOST[what], present


def test_a_sizing_step_is_a_function_of_the_case_with_its_formula(monkeypatch: pytest.MonkeyPatch) -> None:
    """A frozen result, a registered formula that `explain` shows, a record that reports show: nothing else is asked."""
    monkeypatch.setattr("abu_calc.foundation.formula.REGISTERED", {})
    case = read_case(abu_calc.read("msh-230").whole("size"))

    @dataclass(frozen=True)
    class RimSpeed:
        value: float

    @formula("Speed of the wheel's rim", "v = Ω·R_w", "m/s", source="geometry")
    def rim_speed(case: Case) -> RimSpeed:
        return RimSpeed(case.speed * case.wheel_radius)

    @record
    class Rim(Record):
        rim_speed_mm_per_s: Annotated[float, Quantity("speed of the rim", "v", 3)]

    found = rim_speed(case)
    assert found.value == pytest.approx(case.speed * 0.115, rel=1e-9)
    assert "Speed of the wheel's rim: v = Ω·R_w [m/s]." in (rim_speed.__doc__ or "")
    shown = facts(Rim(rim_speed_mm_per_s=1000 * found.value))
    assert shown.rows[0][:2] == ("speed of the rim", "v") and shown.rows[0][2].endswith(" mm/s")


def test_a_command_is_a_module_and_a_line(monkeypatch: pytest.MonkeyPatch) -> None:
    module = types.ModuleType("abu_calc.features.greet")

    def greet(name: str) -> Outcome:
        return Outcome("greet", {"greeted": name}, ())

    module.__dict__["greet"] = greet
    module.__dict__["COMMAND"] = Command(
        "greet:greet", (Option("name", str, "NAME", "Who is greeted.", default=REQUIRED),)
    )
    monkeypatch.setitem(sys.modules, "abu_calc.features.greet", module)
    monkeypatch.setattr(app, "COMMANDS", (*app.COMMANDS, "greet"))
    monkeypatch.setitem(registry.BY_NAME, "greet", registry.Feature("greet", "Greet.", "greet:COMMAND"))
    seen = abu("greet", "Ada", "--json")
    assert seen.status == 0 and seen.document["result"] == {"greeted": "Ada"}


def test_an_output_format_is_an_entry(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(files.FORMATS, ".shout", lambda outcome: outcome.status.upper())
    target = tmp_path / "design.shout"
    assert abu("check-fit", "mmg-3200k-knife-shaft", "--output", str(target)).status in (0, 1)
    assert target.read_text(encoding="utf-8") in ("PASS", "FAIL", "NOT-DONE")
