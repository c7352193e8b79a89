"""The atlas: its cells are commands, its shares have their intervals, and its runner goes on where it stopped."""

import csv
import shlex
from pathlib import Path

import pytest

from tests.cli.runner import abu
from tests.studies.atlas import __main__ as atlas
from tests.studies.atlas.charts import CHARTS, FOLDER

CELLS = [cell for chart in CHARTS for cell in chart.cells()]


def test_every_cell_has_a_place_of_its_own() -> None:
    assert len({cell.key for cell in CELLS}) == len(CELLS) == 640


@pytest.mark.parametrize("index", [2, 57, 130])
def test_a_cell_opened_as_a_command_gives_its_share(index: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(FOLDER.parents[2])
    balanced, undecided = atlas.computed(CELLS[index], 4)
    result = abu(*shlex.split(CELLS[index].command(4))[1:], "--json").document["result"]
    share = sum(each["share"] for each in result["attractors"] if each["kind"] == "balanced")
    assert share == pytest.approx(balanced / 4) and result["attractor_search"]["undecided_share"] == undecided / 4


def test_the_record_holds_shares_within_their_intervals_and_the_commands_of_its_cells() -> None:
    with atlas.FILE.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    cells = {cell.key: cell for cell in CELLS}
    assert rows
    for row in rows:
        share = int(row["balanced"]) / int(row["starts"])
        assert float(row["low"]) <= share <= float(row["high"]) and float(row["share"]) == pytest.approx(
            share, abs=1e-4
        )
        assert row["command"] == cells[row["chart"], row["speed_ratio"], row["drag"]].command(int(row["starts"]))


def test_a_second_run_computes_only_what_the_first_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried = []
    monkeypatch.setattr(atlas, "FILE", tmp_path / "balance.csv")
    monkeypatch.setattr(atlas, "_draw", lambda rows: None)
    monkeypatch.setattr(atlas, "computed", lambda cell, starts: (tried.append(cell.key), (starts, 0))[1])
    monkeypatch.setattr(atlas, "CHARTS", CHARTS[:1])
    atlas.main(["60", "2"])
    atlas.main(["60", "2"])
    assert len(tried) == len(set(tried)) == 80
    atlas.main(["60", "3"])
    assert len(tried) == 160
