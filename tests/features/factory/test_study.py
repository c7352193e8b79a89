"""The factory's machines: published figures as data, predictions as `abu size` and `abu levels` make them."""

import re
import tomllib
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.factory.study import factory_rows
from abu_calc.standards.vibration import octaves
from tests.cli.runner import once
from tests.remembered import recalled

ROOT = Path(__file__).resolve().parents[3]


def test_the_rows_are_what_was_published() -> None:
    """Kladiev 1996, written down a second time: machine, state, octave, without, with."""
    told = {
        ("avtovaz-707-222", "idle", 125.0): ((108, 111), (102, 103)),
        ("avtovaz-707-222", "loaded", 125.0): ((110, 113), (102, 103)),
        ("avtovaz-707-370", "not said", 125.0): (None, (102, 104)),
        ("avtovaz-707-305", "loaded", 31.5): ((111, 112), (102, 103)),
        ("msh-230", "not said", 16.0): (None, None),
        ("msh-230", "not said", 31.5): (None, None),
        ("msh-230", "not said", 63.0): (None, None),
    }
    rows = {(row.machine, row.state, row.octave): (row.without, row.fitted) for row in factory_rows() if not row.peak}
    assert {key: rows[key] for key in told} == told
    assert rows["avtovaz-707-305", "idle", 31.5] == ((109, 113), (98, 100)) and len(rows) == 8
    lowered = {row.octave: row.lowered for row in factory_rows() if row.machine == "msh-230"}
    assert lowered[63.0] == (6, 9) and lowered[16.0][1] >= 18 and lowered[31.5][1] >= 15  # type: ignore[index]
    assert any(row.peak and row.octave == 125 for row in factory_rows())


def test_every_row_is_of_a_preset_in_an_octave_with_a_word() -> None:
    nominal = {band.nominal for band in octaves()}
    for row in factory_rows():
        assert (ROOT / "presets" / f"{row.machine}.toml").is_file()
        assert row.octave in nominal and row.word.endswith(".") and not re.search(r"\d\.\d", row.word)


def test_presets_assume_alike() -> None:
    """The assumptions that the table says all presets share."""
    files = {row.machine for row in factory_rows()}
    tables = [tomllib.loads((ROOT / "presets" / f"{name}.toml").read_text(encoding="utf-8")) for name in files]
    for table, key, value in (
        ("autobalancer", "rolling_friction_mm", 0.002), ("autobalancer", "rolling_drag_per_s", 15.0),
        ("autobalancer", "race_eccentricity_mm", 0.010), ("grinding", "press_force_N", 45.0),
        ("suspension", "natural_frequencies_hz", [2.5, 2.5]), ("suspension", "damping_ratios", [0.5, 0.5]),
    ):  # fmt: skip
        assert all(one[table][key] == value for one in tables), key


@pytest.mark.slow
def test_predictions_are_those_of_the_other_commands_and_the_readme_shows_them() -> None:
    document = once("factory", "--json").document
    rows = {(row["machine"], row["state"], row["octave_hz"]): row for row in document["result"]["rows"]}
    sized = recalled("size", abu_calc.read("avtovaz-707-222"))
    idle, loaded = rows["avtovaz-707-222", "idle", 125.0], rows["avtovaz-707-222", "loaded", 125.0]
    assert sized.ensemble is not None
    assert sized.measured_after is not None
    assert idle["with_predicted_db"] == pytest.approx(sized.measured_after.predicted_level_db, abs=1e-6)
    assert idle["difference_db"] == pytest.approx(sized.measured_after.difference_db, abs=1e-6)
    assert idle["without_predicted_db"] == pytest.approx(111.0, abs=1e-9)
    settled = abu_calc.levels("avtovaz-707-222", "grinding", start="settled")
    work = {one.nominal_hz: one.level_db for one in settled.octaves}
    assert loaded["with_predicted_db"] == pytest.approx(work[125], abs=1e-9)
    assert rows["msh-230", "not said", 16.0]["with_predicted_db"] is None
    gap = idle["with_measured_db"][0] - idle["with_predicted_db"]
    assert idle["outside_db"] == pytest.approx(max(0.0, gap), abs=1e-9)
    assert len(once("factory").out.splitlines()) <= 48
