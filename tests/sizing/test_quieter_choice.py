"""A runner-up that keeps the limits of vibration is chosen before a lighter candidate that does not."""

from pathlib import Path

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import doubts, may_replace, size
from abu_calc.sizing.actions import pins, with_entries
from abu_calc.sizing.balls import Candidate, sound
from abu_calc.sizing.design import Design
from tests.studies.random_machines import family_of, machine_text

TOO_LOUD = "too loud, if only in the worst friction case"


def design(name: str, **changes: object) -> Design:
    table = read_machine(name).whole("size")
    return size(with_entries(table, {key.replace("__", "."): value for key, value in changes.items()}))


def pinned(chosen: Design, candidate: Candidate) -> Design:
    """The machine with the balls and the race of a candidate."""
    return size(with_entries(chosen.case.table, pins(candidate)))


def random_design(seed: int, folder: Path) -> Design:
    file = folder / "machine.toml"
    file.write_text(machine_text(seed, family_of(seed)), encoding="utf-8")
    return design(str(file))


@pytest.mark.parametrize("name", ["avtovaz-707-370", 32, 57])
def test_a_lighter_candidate_that_is_too_loud_is_passed_over(name: str | int, tmp_path: Path) -> None:
    chosen = design(name) if isinstance(name, str) else random_design(name, tmp_path)
    assert not doubts(chosen)
    lightest, why = chosen.choice.runners_up[0]
    assert why == TOO_LOUD and lightest.mass < chosen.autobalancer.mass
    assert doubts(pinned(chosen, lightest)) == {"ABU401"}
    same = pinned(chosen, chosen.autobalancer)
    assert same.speed_levels == chosen.speed_levels and not doubts(same)


def test_reasons_compare_with_the_candidate_that_was_chosen() -> None:
    chosen = design("avtovaz-707-370")
    for other, why in chosen.choice.runners_up[1:]:
        assert why.startswith(f"{1e3 * (other.mass - chosen.autobalancer.mass):.1f} g heavier")


def test_the_lightest_stays_where_no_runner_up_is_quieter() -> None:
    chosen = design("angle-grinder-125")
    assert doubts(chosen) == {"ABU401", "ABU404"}
    for other, _ in chosen.choice.runners_up:
        assert other.mass > chosen.autobalancer.mass
        assert not sound(chosen.case, other) or doubts(pinned(chosen, other)) & {"ABU401", "ABU404"}


def test_pinned_balls_stay_as_they_are() -> None:
    lightest = design("avtovaz-707-370").choice.runners_up[0][0]
    assert pinned(design("avtovaz-707-370"), lightest).choice.runners_up == ()


def test_three_balls_that_friction_may_hold_replace_no_more() -> None:
    """Upright, three balls would keep the limit of the worst friction case; shaken by gravity, three are as good as
    four.
    """
    upright = design("avtovaz-707-222", machine__spindle_axis="vertical")
    three = next(each for each, _ in upright.choice.runners_up if each.ball_count == 3)
    assert upright.autobalancer.ball_count == 4 and not doubts(pinned(upright, three))
    assert not may_replace(upright.case, three)
    level = design("avtovaz-707-222")
    assert may_replace(level.case, three) and may_replace(upright.case, upright.autobalancer)


def test_a_file_that_places_its_balls_keeps_their_number() -> None:
    angles = [0.0, 60.0, 120.0, 180.0, 240.0]
    placed = design("avtovaz-707-370", start__angles_deg=angles)
    assert placed.autobalancer.ball_count == 5 and doubts(placed) == {"ABU401"}
    free = design("avtovaz-707-370", start__angles_deg=[*angles, 300.0])
    assert free.autobalancer.ball_count == 6 and not doubts(free)
