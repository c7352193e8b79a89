"""The table [identified]: intervals that hold the values in force."""

from pathlib import Path

import pytest

from abu_calc.inputs.autobalancer import Autobalancer
from abu_calc.inputs.machine import Identified, identified_note
from tests.inputs.samples import BASIC, read, refused

BAD = [
    ("rolling_drag_per_s = 15.0", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [15.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [12.0, 15.0, 18.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [18.0, 12.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [0.0, 18.0]", "rolling_drag_per_s"),
    ("rolling_drag_per_s = [nan, 18.0]", "rolling_drag_per_s"),
    ("drag_per_s = [12.0, 18.0]", "drag_per_s"),
    ("starts = 0", "starts"),
    ("starts = 2.5", "starts"),
]


@pytest.mark.parametrize(("entry", "key"), BAD)
def test_bad_intervals_are_refused_with_their_key(tmp_path: Path, entry: str, key: str) -> None:
    assert f"identified.{key}" in str(refused(tmp_path, f"{BASIC}\n[identified]\n{entry}\n"))


def test_intervals_without_an_autobalancer_are_refused(tmp_path: Path) -> None:
    text = BASIC.replace("[autobalancer]\nmax_outer_diameter_mm = 68.0\nmax_width_mm = 32.0\n", "")
    assert "no autobalancer" in str(refused(tmp_path, f"{text}\n[identified]\nstarts = 8\n"))


@pytest.mark.parametrize(
    ("key", "interval", "value"),
    [
        ("rolling_drag_per_s", "[16.0, 18.0]", "15"),
        ("rolling_friction_mm", "[0.003, 0.004]", "0.002"),
        ("race_eccentricity_mm", "[0.001, 0.004]", "0.01"),
    ],
)
def test_an_interval_that_does_not_hold_the_value_is_not_used(
    tmp_path: Path, key: str, interval: str, value: str
) -> None:
    machine = read(tmp_path, f"{BASIC}\n[identified]\n{key} = {interval}\n", ())
    tables = machine.whole("size")
    assert list(identified_note(tables.identified, tables.autobalancer)) == []
    assert any(f"does not hold autobalancer.{key} = {value}" in warning for warning in machine.warnings)


def test_the_note_names_every_identified_value(tmp_path: Path) -> None:
    text = f"{BASIC}\n[identified]\nstarts = 9\nrolling_drag_per_s = [12.0, 18.0]\n"
    tables = read(tmp_path, text, ()).whole("size")
    (note,) = identified_note(tables.identified, tables.autobalancer)
    assert "9 recorded starts" in note and "15 1/s (12 … 18)" in note
    abu = Autobalancer(max_outer_diameter_mm=68.0, max_width_mm=32.0)
    assert list(identified_note(None, abu)) == list(identified_note(Identified(starts=8), abu)) == []
