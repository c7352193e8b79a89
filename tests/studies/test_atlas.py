"""The atlas: its cells are commands, its values have their intervals, its runner goes on where it stopped."""

import csv
import shlex
from pathlib import Path

import pytest

from tests.cli.runner import abu
from tests.studies.atlas import __main__ as atlas
from tests.studies.atlas import figures, fresh, page, records
from tests.studies.atlas.charts import AtlasChart, charts, place
from tests.studies.atlas.recipe import FOLDER, CellValue
from tests.studies.atlas.recipes import RECIPES

BY_NAME = {chart.name: chart for chart in charts()}
QUICK = {
    "a-2-plain": (1.5, 0.01, 4), "a-4-plain": (4.0, 0.5, 4), "b-light": (30.0, 0.05, 6), "b-hand": (10.0, 0.1, 4),
    "c-vertical": (0.3, 0.2, 500), "c-horizontal": (0.1, 0.5, 500), "f": (0.2, 0.4, 300), "g": (5.0, 100.0, 0),
    "h": (0.1, 0.02, 3),
}  # fmt: skip
"""Cells, with fewer starts than in the record, that are computed in seconds."""
EACH = {"a": 7, "e": 1000, "g": 1000}
"""Of how many cells the command of one is looked at: chart a sizes a machine for each, chart e seeks a wall."""


def _opened(chart: AtlasChart, across: float, up: float, starts: int) -> CellValue:
    """Value of a cell by its command, run as people run it."""
    command = shlex.split(RECIPES[chart.letter].command(chart, across, up, starts))
    return RECIPES[chart.letter].read(chart, abu(*command[1:], "--json").document["result"])


def test_every_cell_has_a_place_of_its_own() -> None:
    spots = [place(chart.name, x, y) for letter in records.letters() for chart, x, y in records.spots(letter)]
    assert len(set(spots)) == len(spots)
    assert records.letters() == tuple("abcdefgh") == tuple(sorted(RECIPES))


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_a_cell_opened_as_a_command_gives_its_value(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(FOLDER.parents[2])
    chart, (across, up, starts) = BY_NAME[name], QUICK[name]
    cell = RECIPES[chart.letter].computed(chart, across, up, starts)
    found = _opened(chart, across, up, starts)
    for value in ("value", "low", "high"):
        assert getattr(found, value) == pytest.approx(getattr(cell, value), rel=1e-9, abs=1e-12)


RECORDED = [("a-3-plain", 6.0, 0.5), ("a-8-contact", 2.0, 0.05), ("b-light", 60.0, 0.02), ("c-vertical", 0.2, 0.3),
            ("d-settled", 0.2, 2.25), ("d-earlier", 0.2, 2.25), ("e", 0.3, 0.1), ("e", 0.05, 0.3), ("f", 0.3, 0.2),
            ("g", 40.0, 100.0)]  # fmt: skip
LONG = [("b-hand", 100.0, 0.02), ("h", 0.03, 0.01)]


@pytest.mark.parametrize(
    ("name", "across", "up"),
    [
        *(pytest.param(*cell, marks=pytest.mark.slow) for cell in RECORDED),
        *(pytest.param(*cell, marks=pytest.mark.hard) for cell in LONG),
    ],
)
def test_the_command_of_the_record_gives_the_recorded_value(
    name: str, across: float, up: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(FOLDER.parents[2])
    chart = BY_NAME[name]
    row = records.stored(chart.letter)[place(name, across, up)]
    found = RECIPES[chart.letter].read(chart, abu(*shlex.split(row["command"])[1:], "--json").document["result"])
    assert found.value == pytest.approx(float(row["value"]), abs=2e-4, rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("letter", records.letters())
def test_a_record_is_whole_with_values_in_their_intervals_and_commands_of_their_cells(letter: str) -> None:
    rows = records.stored(letter)
    spots = records.spots(letter)
    assert len(rows) == len(spots)
    for row in (rows[place(chart.name, across, up)] for chart, across, up in spots):
        assert float(row["low"]) <= float(row["value"]) <= float(row["high"])
    for chart, across, up in spots[:: EACH.get(letter, 1)]:
        row = rows[place(chart.name, across, up)]
        wanted = int(row["starts"])
        command = RECIPES[letter].command(chart, across, up, wanted)
        # Without friction there are no starts, whatever number the command asks for.
        kept = None if wanted else -2
        assert shlex.split(row["command"])[:kept] == shlex.split(command)[:kept]
        if chart.share:
            met = round(float(row["value"]) * wanted)
            assert (float(row["low"]), float(row["high"])) == pytest.approx(
                (CellValue.share(met, wanted).low, CellValue.share(met, wanted).high), abs=1e-4
            )


@pytest.mark.slow
def test_the_page_and_the_figures_are_those_of_the_records() -> None:
    assert page.PAGE.read_text("utf-8") == page.text()
    assert all(figures.figure(letter).exists() for letter in records.letters())


def test_fresh_seeds_agree_in_95_of_100_cells() -> None:
    same, compared = fresh.agreement()
    assert compared >= 100 and same >= 0.95 * compared


def test_values_that_differ_do_not_agree() -> None:
    row = {"starts": "20", "value": "0.5", "low": "0.3", "high": "0.7"}
    assert fresh.agree(True, row, CellValue.share(11, 20)) and not fresh.agree(True, row, CellValue.share(20, 20))
    assert fresh.agree(False, row, CellValue(0.7, 0.6, 0.8)) and not fresh.agree(False, row, CellValue(1.0, 0.9, 1.1))


def test_a_second_run_computes_only_what_the_first_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried = []

    class Counted:
        starts = 20

        def computed(self, chart: AtlasChart, across: float, up: float, starts: int) -> CellValue:
            tried.append(place(chart.name, across, up))
            return CellValue.share(1, starts)

        def command(self, *given: object) -> str:
            return "abu"

    monkeypatch.setattr(records, "record", lambda letter: tmp_path / f"{letter}.csv")
    monkeypatch.setattr(records, "letters", lambda: ("h",))
    monkeypatch.setattr(atlas, "RECIPES", {"h": Counted()})
    monkeypatch.setattr(atlas.figures, "draw", lambda letter: None)
    monkeypatch.setattr(atlas.page, "write", lambda: None)
    atlas.main(["0"])
    assert not tried
    atlas.main(["60", "--starts", "2"])
    first = len(tried)
    atlas.main(["60", "--starts", "2"])
    assert len(tried) == len(set(tried)) == first == len(records.spots("h"))
    atlas.main(["60", "--starts", "3"])
    assert len(tried) == 2 * first
    with (tmp_path / "h.csv").open(encoding="utf-8", newline="") as file:
        assert {row["starts"] for row in csv.DictReader(file)} == {"3"}
