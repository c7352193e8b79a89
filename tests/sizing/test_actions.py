"""Entries of actions: as options, as words, put into the tables of a file, and followed."""

import re

import pytest

from abu_calc.foundation.moved import Moved
from abu_calc.inputs.reading.overrides import parse_overrides
from abu_calc.sizing import size
from abu_calc.sizing.actions import followed, overrides, pins, set_action, speeds_from, with_entries, words
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
    assert list(speeds_from(case, 4000)) == [{"machine.speed_range_rpm": [4000, 6000]}]
    (both,) = speeds_from(case, 7000)
    assert both == {"machine.speed_rpm": 7000, "machine.speed_range_rpm": [7000, 7000]}


def test_another_choice_of_balls_is_named() -> None:
    """And pinned, so that whoever follows the action gets the number told."""
    present, other = size(machine()).autobalancer, size(machine(autobalancer__capacity_margin=2.0)).autobalancer
    moved = Moved("the mass", 5.0, 4.0, "%")
    action = set_action({"autobalancer.design": "light"}, other, moved, present=present)
    assert action.text.startswith(
        'Set design = "light": the mass falls from 5.00 to 4.00 % (calculated). The choice is'
    )
    assert action.overrides[0] == "autobalancer.design=light" and len(action.overrides) == 4
    assert "The choice" not in set_action({"run_up.time_s": 0.5}, present, moved, present=present).text


BODY = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
PRESSED = {"press_force_N": 45.0, "cutting_coefficient": 0.35}


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("ABU101", {"suspension__natural_frequencies_hz": [110.0, 110.0]}),
        ("ABU101", {"suspension__natural_frequencies_hz": [60.0, 60.0], "machine__speed_range_rpm": [3000, 6000]}),
        ("ABU102", {"machine__speed_range_rpm": [170, 5800], "suspension__natural_frequencies_hz": [0.5, 0.5]}),
        ("ABU205", {**BODY, "autobalancer__plane_offset_mm": -90.0, "limits": {"vibration_level_db": 98.0}}),
        ("ABU302", {"autobalancer__race_hardness_HRC": 45.0}),
        ("ABU402", {"wheel__imbalance_g_mm": 60.0, "autobalancer__rolling_friction_mm": 0.004}),
        ("ABU403", {"machine__power_W": 100.0, "grinding": PRESSED}),
    ],
)
def test_the_number_that_an_action_tells_comes_true(code: str, given: dict[str, object]) -> None:
    check = check_of(size(machine(**given)), code)
    told = re.search(r"(?:falls|rises) from (\S+) to (\S+) \S+ \(calculated\)", check.remedy or "")
    assert check.status == "fail" and told is not None and check.overrides, check
    after = check_of(size(with_entries(machine(**given), parsed(check.overrides))), code)
    assert after.status == "pass" and after.value is not None
    digits = len(told[2].partition(".")[2])
    assert after.value == pytest.approx(float(told[2]), abs=0.5001 * 10**-digits)


def parsed(entries: tuple[str, ...]) -> dict[str, object]:
    """Entries as they are read from a command line."""
    return {override.key: override.value for override in parse_overrides(list(entries))}


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
