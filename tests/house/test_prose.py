"""Texts that commands print keep the rules of prose."""

import json
from pathlib import Path

import pytest
from hypothesis import Phase, given, seed, settings

from tests.cli.runner import abu, once
from tests.hard_machines import FILES_BY_HAND
from tests.house.prose import error_texts, found_in, screens, static_texts, violations
from tests.sizing.test_case import machines
from tests.studies.random_machines import family_of, machine_text


@pytest.mark.parametrize(
    ("text", "rules"),
    [
        ("Deciding runs are repeated at a tighter tolerance.", []),
        ("What decides is run again.", ["headless"]),
        ("What does PASS prove?", []),
        ("Of the 20 start cases all balance.", ["headless"]),
        ("The ledger lists 1 effects.", ["ledger → list of effects", "1 of many"]),
        ("It is off by 2.14e-11 mm.", ["tiny number"]),
        ("level: None", ["no value"]),
        ("word " * 25 + "end.", ["26 words"]),
        ("This sentence stands twice on one screen. This sentence stands twice on one screen.", ["twice"]),
        ("mass      5.6 kg      None of these is a sentence that counts", []),
    ],
    ids=lambda value: str(value)[:30],
)
def test_rules(text: str, rules: list[str]) -> None:
    assert [each.rule for each in violations(text, "here")] == rules


def test_help_explanations_schemas_templates_and_presets() -> None:
    assert found_in(static_texts()) == []


def test_errors_of_wrong_files(tmp_path: Path) -> None:
    assert found_in(error_texts(tmp_path)) == []


@pytest.mark.slow
def test_reports_of_presets() -> None:
    assert found_in(screens()) == []


def _usual(value: object) -> object:
    """A number as people write it: a report repeats what stands in the file, and 3e-11 is no number of the program."""
    if isinstance(value, (list, tuple)):
        return [_usual(each) for each in value]
    return 0.0 if isinstance(value, float) and abs(value) < 1e-6 else value


def _report_of(command: str, changes: dict) -> tuple[str, str]:
    """Whole report of a random machine; simulations of `size` end after a few seconds, the effects need none."""
    options = [
        f"{path.replace('__', '.', 1)}={json.dumps(_usual(value))}" for path, value in changes.items() if "__" in path
    ]
    limited = ("--patience", "4") if command == "size" else ()
    seen = abu(command, "msh-230", "--full", *limited, *(word for option in options for word in ("--set", option)))
    return f"abu {command} {options}", f"{seen.out}\n\n{seen.err}"


@pytest.mark.hard
@given(machines())
@settings(max_examples=8, deadline=None, derandomize=True, phases=[Phase.generate])
def test_reports_of_random_machines(changes: dict) -> None:
    """Of small ones, whose balls are chosen soon."""
    for key, most in (("max_outer_diameter_mm", 80.0), ("bore_diameter_mm", 16.0)):
        changes[f"autobalancer__{key}"] = min(changes[f"autobalancer__{key}"], most)
    assert found_in([_report_of("effects", changes)]) == []


@pytest.mark.hard
@pytest.mark.parametrize("part", range(10))
def test_reports_of_many_random_machines(part: int) -> None:
    """300 machines; violations are not shrunk, since each report takes seconds."""
    texts = list[tuple[str, str]]()

    @seed(part)
    @settings(max_examples=30, deadline=None, database=None, phases=[Phase.generate])
    @given(machines())
    def read(changes: dict) -> None:
        texts.extend(_report_of(command, changes) for command in ("effects", "size"))

    read()
    assert found_in(texts) == []


@pytest.mark.hard
@pytest.mark.parametrize("part", range(30))
def test_reports_of_plausible_machines(part: int, tmp_path: Path) -> None:
    """300 machines of all families, each screen and whole report; simulations end after a few seconds."""
    file, whole, texts = tmp_path / "machine.toml", tmp_path / "whole.txt", list[tuple[str, str]]()
    for number in range(10 * part, 10 * part + 10):
        family = family_of(number)
        file.write_text(machine_text(number, family), encoding="utf-8")
        seen = abu("size", str(file), "--patience", "8", "--output", str(whole), "--force")
        assert seen.width <= 80 and len(seen.out.splitlines()) <= 48, (number, family)
        name, report = f"abu size {number} ({family})", whole.read_text(encoding="utf-8")
        assert max(map(len, report.splitlines())) <= 80, (number, family)
        texts += [(name, f"{seen.out}\n\n{seen.err}"), (f"{name} --full", report)]
    assert len(texts) == 20 and found_in(texts) == []


@pytest.mark.parametrize("file", FILES_BY_HAND)
def test_reports_of_hard_machines(file: Path) -> None:
    texts = []
    for words in (("size", str(file)), ("size", str(file), "--full")):
        seen = once(*words)
        texts.append((f"abu {words[0]} {file.name}", f"{seen.out}\n\n{seen.err}"))
    assert found_in(texts) == []
