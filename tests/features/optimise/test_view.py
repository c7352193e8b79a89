"""The report of an optimisation: one screen, the whole, the figure, and the file it writes."""

import tomllib
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.optimise.result import OptimiseResult, written_text
from abu_calc.features.optimise.view import front_plot, optimise_blocks, optimise_screen
from abu_calc.reporting.screen import LINES, height

pytestmark = pytest.mark.slow  # an optimisation, however small


def test_it_fits_one_screen(small: OptimiseResult) -> None:
    assert height(list(optimise_screen(small))) <= LINES
    assert height(list(optimise_blocks(small))) > height(list(optimise_screen(small)))


def test_the_figure_shows_all_of_the_front(small: OptimiseResult) -> None:
    plot = front_plot(small)
    costs = {point.x for point in plot.points}
    assert {point.cost for point in small.front} <= costs
    assert plot.limit is not None and plot.limit[0] == 100 * small.share
    assert plot.up.high <= 101


def test_the_written_file_has_the_values_the_scatter_and_its_comments(small: OptimiseResult, tmp_path: Path) -> None:
    machine = abu_calc.read("avtovaz-707-222")
    text = written_text(machine, small.recommended.set_, small)
    content = tomllib.loads(text)
    for key, value in small.recommended.set_.items():
        table, name = key.split(".")
        assert content[table][name] == value
    assert content["sweep"] == {"tolerances": True}
    assert "expected" not in content
    assert "# Source of the machine's figures" in text


def test_json_has_the_names_others_rely_on(small: OptimiseResult) -> None:
    result = small.to_dict()
    assert {"front", "recommended", "runners_up", "evaluated", "samples"} <= result.keys()
    assert {"cost", "share", "low", "high", "set"} <= result["front"][0].keys()
    assert {"value", "low", "high"} <= result["recommended"]["fresh_share"].keys()
