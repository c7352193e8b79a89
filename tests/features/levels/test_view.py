"""The report of levels on one screen."""

from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.levels.view import _tenths, levels_screen
from abu_calc.reporting.blocks import Grid
from tests.cli.runner import abu
from tests.features.levels.test_study import sine_file


@pytest.mark.slow
def test_the_report_on_one_screen(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    for arguments in (("msh-230", "--minutes", "60"), (sine_file(tmp_path, seconds=0.9), "--minutes", "60")):
        seen = abu("levels", *arguments)
        assert len(seen.out.splitlines()) <= 40 and seen.width <= 80
        assert "125 " in seen.out and seen.out.count("checks pass") == 2


def test_a_level_of_nothing_but_rounding_is_not_told() -> None:
    assert [_tenths(value) for value in (None, 19.9, 20.0, 98.74)] == ["–", "<20", "20.0", "98.7"]


def test_an_octave_above_its_limit_says_so(tmp_path: Path) -> None:
    """Four times 14.09 mm/s are 121.0 dB in the octave of 125 Hz, whose limit is 109; that of 8 Hz is 115."""
    result = abu_calc.levels(sine_file(tmp_path, seconds=1.0, times=4.0))
    rows = {row[0]: row for block in levels_screen(result) if isinstance(block, Grid) for row in block.rows}
    assert rows["125"][1:] == ("121.0", "109", "FAIL") and rows["8"][1:] == ("–", "115", "NOT EVALUATED")
    assert rows["500"][-1] == "pass" and rows["weighted overall"][-1] == "FAIL"
