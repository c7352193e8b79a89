"""Changes of the file that are tried for a check that fails."""

import re
import tomllib
from collections.abc import Iterable

import pytest

from abu_calc.sizing import size
from abu_calc.sizing.case import read_case
from abu_calc.sizing.trials import Change, TriedRequirement, harder, more_room, remedy, stronger
from tests.sizing.machines import DRUM, check_of, machine


@pytest.mark.slow
@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("ABU201", {"wheel__imbalance_g_mm": 2000.0}),
        ("ABU201", {"autobalancer__ball_count": 2, "autobalancer__ball_diameter_mm": 10.0}),
        ("ABU203", {"autobalancer__capacity_margin": 3.0, "autobalancer__max_mass_fraction": 0.025}),
        ("ABU304", DRUM),
        pytest.param(
            "ABU301",
            {**DRUM, "machine__speed_rpm": 5000, "autobalancer__race_hardness_HRC": 58.0},
            marks=pytest.mark.hard,
        ),
    ],
)
def test_an_action_followed_literally_gives_the_number_it_tells(code: str, given: dict[str, object]) -> None:
    """The file with the entries of the action: the check passes, its number is the one told, and so are the balls."""
    check = check_of(size(machine(**given)), code)
    found = re.search(r"(falls|rises) from [\d.]+ to ([\d.]+) \S+ \(calculated\)\. (\w+)", check.remedy or "")
    assert check.status == "fail" and found and check.overrides, check.remedy
    made = size(machine(**{**given, **entries_of(check.overrides)}))
    after = check_of(made, code)
    assert after.status == "pass" and after.value is not None and after.limit is not None
    assert any(told(number, found[2]) for number in (after.value, after.limit)), (check.remedy, after)
    if found[3] == "All":
        own = {"ABU201", "ABU202", "ABU203", "ABU301", "ABU303", "ABU304"}
        assert not own & {one.code for one in made.checks if one.status == "fail"}


def told(number: float, text: str) -> bool:
    """Whether a number is the one that a text shows, to its last digit."""
    digits = len(text.partition(".")[2])
    return abs(number - float(text)) <= 0.5 * 10**-digits * (1 + 1e-9) or abs(number / float(text) - 1) < 5e-3


def entries_of(overrides: Iterable[str]) -> dict[str, object]:
    """Entries as the machines of these tests take them."""
    values = {entry.split("=")[0].replace(".", "__", 1): entry.split("=")[1] for entry in overrides}
    return {key: tomllib.loads(f"v = {value}")["v"] if value[0] in "0123456789[" else value
            for key, value in values.items()}  # fmt: skip


@pytest.mark.slow
def test_what_no_change_holds_is_said() -> None:
    remedy = check_of(size(machine(autobalancer__max_mass_fraction=0.001)), "ABU203").remedy or ""
    assert remedy.startswith("No change was found. Calculated without success: design")
    assert "capacity_margin = 1" in remedy


def test_only_what_is_pinned_is_freed() -> None:
    free, pinned = read_case(machine()), read_case(machine(autobalancer__ball_count=4, autobalancer__min_wall_mm=2.0))
    assert list(stronger(free)) == [] and list(stronger(pinned)) == [Change({}, free=True)]


def test_more_room_enlarges_width_and_diameter_alike() -> None:
    case = read_case(machine(autobalancer__capacity_margin=1.0, autobalancer__max_outer_diameter_mm=60.0))
    sizes = [tuple(change.entries.values()) for change in more_room(case)]
    assert sizes == [(66.0, 35.2), (75.0, 40.0), (90.0, 48.0)]  # 10, 25 and 50 % above 60 by 32 mm


def test_a_race_as_hard_as_can_be_is_not_made_harder() -> None:
    assert list(harder(read_case(machine(autobalancer__race_hardness_HRC=63.0)))) == []
    (change,) = harder(read_case(machine(autobalancer__race_hardness_HRC=60.0)))
    assert change.entries == {"autobalancer.race_hardness_HRC": 63.0}


def test_a_change_that_no_race_fits_is_no_action() -> None:
    design = size(machine())
    required = TriedRequirement("x", "", lambda *_: 1.0, lambda *_: 1.0, lambda *_: True)
    small = iter([Change({"autobalancer.max_outer_diameter_mm": 30.0})])
    assert remedy(design.case, design.autobalancer, small, required).text == "No change of the file was found."
