"""Changes of the file that are tried for a check that fails."""

import re
from collections.abc import Iterable

import pytest

from abu_calc.foundation.units import from_si
from abu_calc.sizing import size
from abu_calc.sizing.case import Case, read_case
from abu_calc.sizing.trials import harder, more_room, remedy, stronger
from tests.sizing.machines import DRUM, check_of, machine


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
            marks=pytest.mark.slow,
        ),
    ],
)
def test_what_was_tried_holds_as_promised(code: str, given: dict[str, object]) -> None:
    """The file with the change in it: the check passes, with the balls named, and all of the autobalancer's if told."""
    check = check_of(size(machine(**given)), code)
    found = re.fullmatch(r"Tried: with (.*), (\d+) × Ø([\d.]+) mm holds it, (.*)\.", check.remedy or "")
    assert check.status == "fail" and found, check.remedy
    changes: dict[str, object] = {
        f"autobalancer__{key}": float(value) if value[0].isdigit() else value.strip('"')
        for key, value in re.findall(r'(\w+) = ([\d.]+|"[\w-]+")', found[1])
    }
    if "pinned" in found[1]:
        changes |= {f"autobalancer__{pin}": None for pin in ("ball_count", "ball_diameter_mm", "race_radius_mm")}
    made = size(machine(**{**given, **changes}))
    assert changes and check_of(made, code).status == "pass"
    balls = made.autobalancer
    assert (str(balls.ball_count), f"{from_si(balls.ball_diameter, 'mm'):.5g}") == found.groups()[1:3]
    if found[4].startswith("and what else"):
        own = {"ABU201", "ABU202", "ABU203", "ABU301", "ABU303", "ABU304"}
        assert not own & {one.code for one in made.checks if one.status == "fail"}


def test_what_no_change_holds_is_said() -> None:
    remedy = check_of(size(machine(autobalancer__max_mass_fraction=0.001)), "ABU203").remedy or ""
    assert remedy.startswith("Tried without success: design") and "capacity_margin = 1" in remedy


def words_of(changes: Iterable[tuple[str, Case]]) -> list[str]:
    return [words for words, _ in changes]


def test_only_what_is_pinned_is_freed() -> None:
    free, pinned = read_case(machine()), read_case(machine(autobalancer__ball_count=4, autobalancer__min_wall_mm=2.0))
    assert words_of(stronger(free)) == []
    ((words, freed),) = stronger(pinned)
    assert words == "ball_count not pinned" and freed.autobalancer.ball_count is None
    assert freed.autobalancer.min_wall_mm == 2.0 and freed.table.autobalancer == freed.autobalancer


def test_more_room_enlarges_width_and_diameter_alike() -> None:
    case = read_case(machine(autobalancer__capacity_margin=1.0, autobalancer__max_outer_diameter_mm=60.0))
    sizes = [(each.autobalancer.max_outer_diameter_mm, each.autobalancer.max_width_mm) for _, each in more_room(case)]
    assert sizes == [(66.0, 35.2), (75.0, 40.0), (90.0, 48.0)]  # 10, 25 and 50 % above 60 by 32 mm


def test_a_race_as_hard_as_can_be_is_not_made_harder() -> None:
    assert words_of(harder(read_case(machine(autobalancer__race_hardness_HRC=63.0)))) == []
    assert words_of(harder(read_case(machine(autobalancer__race_hardness_HRC=60.0)))) == ["race_hardness_HRC = 63"]


def test_a_change_that_no_race_fits_is_no_remedy() -> None:
    case = read_case(machine())
    small = read_case(machine(autobalancer__max_outer_diameter_mm=30.0))
    remedied = remedy(case, 250e-6, iter([("a smaller envelope", small)]), lambda *_: True)
    assert remedied == "What can be changed was not found."
