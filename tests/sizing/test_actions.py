"""Entries of actions: as options, as words, put into the tables of a file, and followed."""

import math

import pytest

from abu_calc.foundation.units import to_si
from abu_calc.sizing import size
from abu_calc.sizing.actions import followed, overrides, pins, speeds_from, two_digits, with_entries, words
from tests.sizing.machines import check_of, machine


def test_entries_are_written_as_options_and_as_words() -> None:
    entries = {"autobalancer.race_eccentricity_mm": 0.005, "machine.speed_range_rpm": [2600.0, 9000.0]}
    assert overrides(entries) == ("autobalancer.race_eccentricity_mm=0.005", "machine.speed_range_rpm=[2600,9000]")
    assert words(entries) == "race_eccentricity_mm = 0.005 and machine.speed_range_rpm = [2600, 9000]"


def test_entries_are_checked_as_those_of_a_file() -> None:
    table = with_entries(machine(), {"run_up.time_s": 0.5, "autobalancer.design": "light"})
    assert table.run_up is not None and table.run_up.time_s == 0.5
    assert table.autobalancer is not None and table.autobalancer.design == "light"
    with pytest.raises(ValueError, match="less than or equal"):
        with_entries(machine(), {"autobalancer.race_hardness_HRC": 1000.0})


def test_a_pinned_candidate_is_the_only_choice() -> None:
    design = size(machine())
    again = followed(design.case, pins(design.autobalancer))
    assert again is not None and again.candidate == design.autobalancer
    assert followed(design.case, {"autobalancer.max_outer_diameter_mm": 20.0}) is None


def test_the_lowest_speed_is_raised_with_the_rated_one_if_it_must() -> None:
    case = size(machine(machine__speed_range_rpm=[3000, 6000])).case
    assert list(speeds_from(case, to_si(4000, "rpm"))) == [{"machine.speed_range_rpm": [4000, 6000]}]
    (both,) = speeds_from(case, to_si(7000, "rpm"))
    assert both == {"machine.speed_rpm": 7000, "machine.speed_range_rpm": [7000, 7000]}


def test_two_digits_never_round_the_wrong_way() -> None:
    assert two_digits(86.41, math.ceil) == 87.0 and two_digits(0.08649, math.floor) == 0.086


@pytest.mark.parametrize(
    ("imbalance", "grade"), [(70.0, "fail"), (80.0, "fail"), (82.0, "warn"), (92.0, "warn"), (150.0, "pass")]
)
def test_a_gain_that_cannot_be_measured_is_no_pass(imbalance: float, grade: str) -> None:
    """The lighter the imbalance, the less the balls lower the level: PASS needs a gain that an instrument shows."""
    check = check_of(size(machine(wheel__imbalance_g_mm=imbalance)), "ABU402")
    assert check.value is not None and check.limit is not None
    gain = check.limit - check.value
    expected = "fail" if gain <= -0.3 else "warn" if gain < 1 else "pass"
    assert check.status == expected == grade, gain
    told = f"by less than {1 if gain > 0 else 0.3:g} dB"
    assert (told in check.message) is (grade == "warn")
