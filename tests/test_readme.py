"""The README shows what is so."""

import re
from pathlib import Path

import pytest

from abu_calc.cli.app import COMMANDS
from tests.cli.runner import again, once
from tests.house.structure import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


NUMBER = re.compile(r"\d+(?:\.\d+)?")


def test_the_example_is_real_output() -> None:
    """Word for word; numbers to 5 %, since what a simulation leaves over differs a little between platforms."""
    shown = re.search(r"\$ abu size avtovaz-707-222\n(.*?)\n```", README, re.DOTALL)
    assert shown is not None
    example = shown[1].splitlines()
    real = once("size", "avtovaz-707-222").out.splitlines()
    assert [NUMBER.sub("#", line) for line in real] == [NUMBER.sub("#", line) for line in example]
    numbers = [[float(number) for number in NUMBER.findall("\n".join(lines))] for lines in (real, example)]
    assert numbers[0] == pytest.approx(numbers[1], rel=0.05) and len(numbers[0]) > 20


def test_it_stays_short() -> None:
    assert len(README.splitlines()) <= 150


def test_the_picture_is_what_the_program_makes(tmp_path: Path) -> None:
    shown = re.search(r'src="(docs/[^"]+\.svg)"', README)
    assert shown is not None
    made = tmp_path / "section.svg"
    assert again("size", "avtovaz-707-222", "--quiet", "--figure", f"section={made}").status == 0
    assert made.read_text("utf-8") == (ROOT / shown[1]).read_text("utf-8")


@pytest.mark.slow
def test_measured_and_predicted_levels_are_those_of_the_factory_comparison() -> None:
    """Every row that the model predicts, with its range, median and miss; 0.15 dB are left for other platforms."""
    rows = once("factory", "--json").document["result"]["rows"]
    expected = []
    for row in rows:
        if row["miss_db"] is not None:
            state = "" if row["state"] == "not said" else f" {row['state']}"
            kinds = ("with_measured_db", "with_predicted_db"), ("lowered_measured_db", "lowered_predicted_db")
            span, median = kinds[row["with_measured_db"] is None]
            expected.append((f"{row['short']}{state}", *row[span], row[median], row["miss_db"]))
    pattern = r"\| ([\w-]+(?: idle| loaded)?)[^|]*\| Kladiev[^|]*\| (\d+)–(\d+) dB \| (\d+\.\d) dB \| (\d+\.\d) dB \|"
    shown = re.findall(pattern, README)
    assert [name for name, *_ in shown] == [name for name, *_ in expected] and len(shown) == 6
    for (_, *words), (_, *numbers) in zip(shown, expected, strict=True):
        assert [float(word) for word in words] == pytest.approx(numbers, abs=0.15)


def test_every_command_is_named() -> None:
    assert len(COMMANDS) >= 8
    assert all(f"`abu {name}" in README for name in COMMANDS)
