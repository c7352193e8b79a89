"""Results as files: JSON, TOML, CSV and text by their suffixes."""

import csv
import importlib.util
import io
import json
import tomllib
from pathlib import Path
from typing import Any

import pytest

from abu_calc.foundation.errors import OutputError
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.files import FORMULAS, as_file, check_extra
from abu_calc.reporting.outcome import Outcome
from tests.cli.runner import abu, again
from tests.reporting.test_screen import ACTING, HOSTILE, named


@pytest.mark.few(1)
@pytest.mark.parametrize("suffix", [".txt", ".csv", ".toml", ".json"])
def test_files_do(tmp_path: Path, suffix: str) -> None:
    output = tmp_path / f"out{suffix}"
    assert abu("check-fit", str(named(tmp_path, HOSTILE)), "--output", str(output)).status in (0, 1)
    text = output.read_text(encoding="utf-8")
    assert not ACTING.search(text)
    name = tomllib.loads(f'name = "{HOSTILE}"')["name"]
    if suffix == ".toml":
        assert tomllib.loads(text)["result"][0]["name"] == name
    if suffix == ".json":
        assert json.loads(text)["result"][0]["name"] == name


@pytest.mark.parametrize("first", FORMULAS)
def test_spreadsheets_compute_no_text(tmp_path: Path, first: str) -> None:
    output = tmp_path / "out.csv"
    abu("check-fit", str(named(tmp_path, f"{first}HYPERLINK(1)")), "--output", str(output))
    rows = list(csv.reader(io.StringIO(output.read_text(encoding="utf-8"))))
    assert ["result.0.name", f"'{first}HYPERLINK(1)", ""] in rows
    for path, value, _ in rows[1:]:
        assert not path.startswith(FORMULAS)
        if value.startswith(FORMULAS):
            float(value)  # a number stays one


def outcome(**changes: Any) -> Outcome:
    result = {"mass_g": 240.5, "list": [1.0, None, 2.0], "missing": None, "text": "a\nb"}
    return Outcome("size", result, (Paragraph("told"),), **changes)


def test_toml_keeps_places_in_lists_and_leaves_out_null_keys() -> None:
    result = tomllib.loads(as_file(outcome(), ".toml"))["result"]
    assert result["list"] == [1.0, "null", 2.0] and "missing" not in result


def test_csv_has_a_unit_beside_each_number() -> None:
    rows = list(csv.reader(io.StringIO(as_file(outcome(), ".csv"))))
    assert ["mass_g", "240.5", "g"] in rows and ["missing", "", ""] in rows
    assert ["text", "a\\nb", ""] in rows and rows[1] == ["status", "pass", ""]


def test_json_and_text_are_the_document_and_the_blocks() -> None:
    assert json.loads(as_file(outcome(), ".json"))["result"]["mass_g"] == 240.5
    assert as_file(outcome(), ".txt").strip() == "told"


def test_a_text_that_stands_for_itself_is_written_under_its_own_suffix_alone() -> None:
    preset = outcome(plain="[machine]\n", plain_suffix=".toml")
    assert as_file(preset, ".toml") == as_file(preset, ".txt") == "[machine]\n"
    assert json.loads(as_file(preset, ".json"))["abu"]["command"] == "size"
    with pytest.raises(OutputError) as caught:
        as_file(preset, ".csv")
    assert (caught.value.found, caught.value.allowed) == (".csv", ".toml .json .txt")


def test_a_format_without_its_package_is_refused_with_what_installs_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    check_extra(".svg")  # needs none
    with pytest.raises(OutputError, match="ezdxf") as caught:
        check_extra(".dxf")
    assert "abu-calc[report]" in str(caught.value)


@pytest.mark.slow
def test_toml_begins_with_the_verdict_and_its_codes(tmp_path: Path) -> None:
    """The status of a pass with warnings is "pass", so a comment says the rest."""
    output = tmp_path / "out.toml"
    assert (
        again("size", "avtovaz-707-222", "--set", "limits.quiet_time_s=0.8", "--quiet", "--output", str(output)).status
        == 0
    )
    text = output.read_text(encoding="utf-8")
    warned = dict.fromkeys(each["code"] for each in tomllib.loads(text)["checks"] if each["status"] == "warn")
    assert text.splitlines()[0] == f"# PASS WITH WARNINGS: {' '.join(warned)}" and warned
    assert tomllib.loads(text)["status"] == "pass"
