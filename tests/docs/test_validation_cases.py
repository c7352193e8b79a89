"""Published cases of the validation page: each is shown, says what it ran, and tells a miss from a hit."""

import re
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from tests.house.structure import ROOT

pytest.importorskip("sphinx")
pytest.importorskip("matplotlib")
PAGE = ROOT / "docs" / "explanation" / "validation.md"


@pytest.fixture(scope="module")
def cases() -> Iterator[ModuleType]:
    sys.path.insert(0, str(ROOT / "docs" / "_ext"))
    import command_output
    import validation_cases

    shutil.copytree(ROOT / "docs" / "examples", command_output.FOLDER, dirs_exist_ok=True)
    yield validation_cases
    sys.path.remove(str(ROOT / "docs" / "_ext"))


def test_each_case_is_on_the_page_once(cases: ModuleType) -> None:
    shown = re.findall(r"^```\{abu-validation\} (\S+)$", PAGE.read_text("utf-8"), re.MULTILINE)
    assert sorted(shown) == sorted(cases.CASES)


def test_each_source_of_the_list_is_named() -> None:
    text = PAGE.read_text("utf-8")
    for source in ("Rodrigues et al. 2011", "Rodrigues et al. 2008", "Green et al. 2006", "Chung and Ro 1999",
                   "Wright and Peng 2019", "Lu and Hung 2008", "Machines 2020, 8(4), 74", "Kladiev 1996",
                   "Filimonikhin", "Shock and Vibration 2018"):  # fmt: skip
        assert source in text


def test_a_case_shows_few_commands_and_counts_the_others(cases: ModuleType) -> None:
    parts = cases.case_parts
    parts.RAN[:] = ["abu a", "abu a", "abu b", "abu c", "abu d", "abu e"]
    assert parts.commands() == "$ abu a\n$ abu b\n$ abu c\n# and 2 more with other values"
    parts.RAN.clear()
    assert parts.commands() == ""


def test_a_miss_is_shown(cases: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import published_cases

    numbers = [["the run-up decides", 0.0, 0.9], ["the run-up decides", 9.0, 0.88],
               ["the run-up may be ignored", 0.0, 1.0], ["the run-up may be ignored", 9.0, 1.0]]  # fmt: skip
    monkeypatch.setattr(published_cases, "study", lambda name: numbers)
    assert [row[-1] for row in published_cases.ramps(tmp_path).rows] == ["NO", "yes"]
    ranges = {"speeds": [1.0, 2.0], "stuck": [[0.9], [0.9]], "ranges": [[1.0, 2.0, 1, 1], [2.0, 3.0, 3, 2]],
              "deviations": [[0.01, 0.9, 0.91, 0.5]]}  # fmt: skip
    monkeypatch.setattr(published_cases, "study", lambda name: ranges)
    assert "1 of 4 ranges alike" in published_cases.stuck(tmp_path).agreement


@pytest.mark.slow
@pytest.mark.parametrize("name", ["transient", "routh", "eigenvalues", "stuck", "ramps", "stiction", "two-planes"])
def test_a_case_agrees_as_far_as_the_page_says(cases: ModuleType, name: str, tmp_path: Path) -> None:
    shown = cases.CASES[name](tmp_path)
    assert shown.rows and (tmp_path / f"{name}.svg").is_file() and cases.case_parts.commands()
    said = {
        "transient": "Largest difference: 1.", "routh": "e-08.", "eigenvalues": "5.1e-07", "stuck": "4 of 4",
        "ramps": "", "stiction": "scatters the starts: yes", "two-planes": "0.00",
    }  # fmt: skip
    assert said[name] in shown.agreement
    assert all("NO" not in map(str, row) for row in shown.rows)
