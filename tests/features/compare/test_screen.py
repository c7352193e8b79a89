"""The one screen of `abu compare`: levels and quiet times first, labels for keys, counts of what is left out."""

from functools import cache

import pytest

import abu_calc
from abu_calc.features.compare.screen import compare_screen, words_of
from abu_calc.features.compare.study import CompareResult
from abu_calc.reporting.screen import as_text
from tests.remembered import remembered


@cache
def drags() -> CompareResult:
    """A machine with its drag rate, and with three times as much."""
    machine = abu_calc.read("avtovaz-707-222")
    with remembered():
        return abu_calc.compare([machine, machine.changed({"autobalancer.rolling_drag_per_s": 45.0})])


@cache
def shafts() -> CompareResult:
    """One shaft with several tolerance classes."""
    shaft = abu_calc.read("mmg-3200k-knife-shaft")
    classes = ("j6", "js6", "k5", "m5", "m6", "n6")
    return abu_calc.compare([shaft, *(shaft.changed({"bearing[0].shaft_fit": fit}) for fit in classes)])


def line_of(screen: str, start: str) -> str:
    return next(line for line in screen.splitlines() if line.strip().startswith(start))


@pytest.mark.slow
def test_levels_and_quiet_times_stand_first_case_by_case_with_their_limits() -> None:
    """The early-pressed run is 15 dB quieter with more drag: that is what the reader compares variants for."""
    screen = as_text(compare_screen(drags()))
    assert screen.index("Vibration, dB re 5e-8 m/s (limit 109)") < screen.index("Quiet time, s (limit 1.00)")
    assert screen.index("Quiet time, s") < screen.index("Checks that differ")
    assert line_of(screen, "pressed earlier").split()[-2:] == ["119.6", "104.9"]
    assert line_of(screen, "Slowest listed start case, any oil").split()[-2:] == ["0.93", "0.33"]
    assert line_of(screen, "bound of friction").split()[-2:] == ["105.4", "105.4"]  # equal ones stand there, too


def test_machines_have_the_words_of_their_verdicts() -> None:
    machine = abu_calc.read("msh-230")
    loud = machine.changed({"limits.vibration_level_db": 90.0})
    with remembered():
        lines = as_text(compare_screen(abu_calc.compare([machine, loud]))).splitlines()
    assert lines[1].startswith("  DOES NOT SUIT: ") and " checks pass" in lines[1]
    assert [line.partition(":")[0].strip() for line in lines[3:5]] == ["A  SUITS", "B  DOES NOT SUIT"]


@pytest.mark.hard
def test_a_machine_without_an_autobalancer_has_no_level() -> None:
    with remembered():
        result = abu_calc.compare([abu_calc.read("msh-230"), abu_calc.read("mmg-3200k-knife-shaft")])
    screen = as_text(compare_screen(result))
    assert line_of(screen, "Idle, without").split()[-1] == "–" and len(screen.splitlines()) <= 48


@pytest.mark.slow
def test_variants_of_one_machine_have_its_name_once_and_a_verdict_each() -> None:
    screen = as_text(compare_screen(shafts()))
    assert screen.count("MMG-3200K") == 1 and "A  FAIL: as the file stands" in screen
    assert 'F  FAIL: bearing[0].shaft_fit = "m6"' in screen
    assert len(screen.splitlines()) <= 48 and max(map(len, screen.splitlines())) <= 80


@pytest.mark.slow
def test_no_raw_keys_and_every_line_that_is_left_out_is_counted() -> None:
    screen = as_text(compare_screen(shafts()))
    table = screen[screen.index("Checks that differ") :]
    assert "fits." not in table and "Bearing 1: shaft fit" in table
    assert "Seat on the shaft, 7516 as built: least interference, µm" in table
    equal = len([row for row in shafts().alike if row.part == "file"])
    assert f"{equal} entries of\n  the files" in table or f"{equal} entries of the files" in table


def test_keys_as_words() -> None:
    assert words_of("limits.quiet_time_s") == "Limits: quiet time, s"
    assert words_of("bearing[1].name") == "Bearing 2: name"
