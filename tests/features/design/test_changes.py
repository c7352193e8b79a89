"""Changes that are proposed for start cases that fail: which ones, in which order, and that the file takes them."""

import math
from functools import cache
from itertools import pairwise
from typing import Any

import pytest

from abu_calc.features.design.changes import (
    LEAST,
    MOST_OILS,
    MOST_OTHERS,
    changes_for_starts,
    design_with,
    more_damping,
)
from abu_calc.features.design.start_rules import StartFacts
from abu_calc.simulation.ensemble import simulate_members
from abu_calc.simulation.scene_of_design import guided
from abu_calc.simulation.start_cases import Ensemble, Member, StartOutcome
from abu_calc.sizing import size, usable
from abu_calc.sizing.actions import pins, with_entries
from abu_calc.sizing.design import Design
from tests.features.design.test_start_rules import outcome
from tests.simulation.test_ensemble import ALL, PINNED
from tests.simulation.test_ensemble import design as machine_of
from tests.sizing.machines import machine

OIL = {"grade": "VG 68", "fill_ml": 1.0}
LATE = {"quiet_time": 1.5}
STALLED = {"slip": 0.8}


@cache
def design(**given: Any) -> Design:
    """The machine of the tests of sizing, with entries changed."""
    tables = {key: value if "__" in key else dict(value) for key, value in given.items()}
    return size(machine(**tables))


def proposed(design: Design, *starts: StartOutcome, loud: bool = False) -> list[dict[str, Any]]:
    """All that is proposed if the start cases end like this."""
    return list(changes_for_starts(StartFacts(design, Ensemble(design.case.drag, starts, ())), loud=loud))


def start(design: Design, share: float = 1.0, run_up: float = 0.0, **changed: float | None) -> StartOutcome:
    """A start case at a share of the drag rate."""
    return outcome(Member("spread", share * design.case.drag, run_up), **changed)


def of(changes: list[dict[str, Any]], key: str) -> list[dict[str, Any]]:
    """Those that set a key."""
    return [entries for entries in changes if key in entries]


def followed(made: Design, entries: dict[str, Any]) -> Design:
    """The design with entries of its file replaced."""
    other = design_with(made, entries)
    assert other is not None
    return other


@pytest.mark.parametrize(
    ("shares", "changed", "more", "less"),
    [
        ((1 / 3,), LATE, True, False),
        ((3.0,), LATE, False, True),
        ((1.0,), LATE, True, True),
        ((1 / 3, 3.0), LATE, True, True),
        ((1.0,), STALLED, True, False),
    ],
)
@pytest.mark.parametrize("oil", [tuple(OIL.items()), None])
def test_oils_are_proposed_by_where_start_cases_fail(
    oil: object, shares: tuple[float, ...], changed: dict[str, float], more: bool, less: bool
) -> None:
    """Hot oil alone: more viscous ones; cold oil alone: less. By grade and index, the lower index and nearest first."""
    made = design(oil=oil) if oil else design()
    oils = of(proposed(made, start(made), *(start(made, share, **changed) for share in shares)), "oil.grade")
    rates = [(entries["oil.viscosity_index"], followed(made, entries).case.drag) for entries in oils]
    assert max(MOST_OILS) < len(rates) <= sum(MOST_OILS) and [index for index, _ in rates] == sorted(
        index for index, _ in rates
    )
    assert any(rate > made.case.drag for _, rate in rates) is more
    assert any(rate < made.case.drag for _, rate in rates) is less
    for (index, rate), (next_index, next_rate) in pairwise(rates):
        assert index != next_index or off(rate, made) <= off(next_rate, made)
    assert all(("oil.fill_ml" in entries) is (oil is None) for entries in oils)


def off(rate: float, made: Design) -> float:
    return abs(math.log(rate / made.case.drag))


def test_a_file_that_gives_a_drag_rate_gets_oils() -> None:
    """Nobody can set a drag rate: an oil with its fill takes its place, and counts with its cold and hot drag."""
    made = design(autobalancer__rolling_drag_per_s=15.0)
    changes = proposed(made, start(made, 3.0, **LATE))
    assert not any("drag" in key for entries in changes for key in entries)
    oils = of(changes, "oil.grade")
    assert oils and all({"oil.viscosity_index", "oil.fill_ml"} <= entries.keys() for entries in oils)
    case = followed(made, oils[0]).case
    assert case.oil is not None and not case.oil.overridden and case.drag == case.oil.working.drag < 15.0
    assert case.drag_shares == case.oil.shares


def test_other_balls_are_proposed_if_a_listed_start_case_fails_at_the_given_drag_rate() -> None:
    """Sound ones, each of them pinned; every other change has the balls and the race of the design."""
    made = design()
    own = pins(made.autobalancer)
    sound = [pins(other) for other, _ in made.choice.runners_up if usable(made.case, other)][:MOST_OTHERS]
    changes = proposed(made, start(made, **LATE))
    others = [entries for entries in changes if not own.items() <= entries.items()]
    assert others == sound and others
    hot = proposed(made, start(made), start(made, 1 / 3, **LATE))
    assert hot and all(own.items() < entries.items() for entries in hot)


def test_stalled_balls_get_a_temporary_speed_reduction_below_where_they_stall() -> None:
    """To two thirds of that speed; none if they hardly turn, if none stalls, in the working range, or for a motor."""

    def pauses(made: Design, **changed: float) -> list[dict[str, Any]]:
        return of(proposed(made, start(made, **changed)), "run_up.pause_speed_rpm")

    made = design()
    (slow,) = pauses(made, slip=0.8)
    slowed = followed(made, slow)
    reduced = guided(slowed, 1.0)
    assert reduced.low == pytest.approx(2 / 3 * 0.2 * made.case.speed, rel=0.05)
    assert reduced.rise == pytest.approx(1 - reduced.low / made.case.speed, rel=0.05)
    assert pauses(made, slip=1 - LEAST / 2) == pauses(made, slip=0.0) == pauses(slowed, slip=0.8) == []
    assert pauses(design(machine__speed_range_rpm=(500, 5800)), slip=0.8) == []
    assert pauses(design(motor=()), slip=0.8) == []


def test_a_faster_run_up_is_proposed_if_run_ups_alone_fail() -> None:
    made, key = design(run_up=(("time_s", 1.0),)), "run_up.time_s"
    risen, still = start(made, run_up=1.0, slip=0.5), start(made, slip=0.5)
    assert [entries[key] for entries in of(proposed(made, start(made), risen), key)] == [0.5]
    assert not of(proposed(made, still, risen), key) and not of(proposed(made, start(made, **LATE)), key)
    assert not of(proposed(design(), start(design(), run_up=1.0, slip=0.5)), key)


def test_the_damping_of_springs_is_doubled_but_not_that_of_hands() -> None:
    assert more_damping(design()) is None
    made = design(machine__held="as-given")
    (entries,) = of(proposed(made, start(made, **LATE)), "suspension.damping_ratios")
    damped = followed(made, entries)
    assert damped.case.suspension.damping == pytest.approx([2 * c for c in made.case.suspension.damping])  # type: ignore[union-attr]
    assert (damped.autobalancer, damped.imbalance) == (made.autobalancer, made.imbalance)
    assert more_damping(machine_of("hands-called-chaotic")) is None


def test_truer_races_come_first_if_start_cases_are_too_loud() -> None:
    made = design()
    keys = {"autobalancer.race_eccentricity_mm", "autobalancer.rolling_friction_mm"}
    truer = [bool(keys & entries.keys()) for entries in proposed(made, start(made, level=120.0), loud=True)]
    assert any(truer) and truer == sorted(truer, reverse=True)
    last = [bool(keys & entries.keys()) for entries in proposed(made, start(made, **LATE))]
    assert sum(last) == sum(truer) and last == sorted(last)


@pytest.mark.parametrize("changed", [LATE, STALLED, {"level": 120.0}])
def test_the_file_takes_every_change_and_none_is_the_machine_as_it_is(changed: dict[str, float]) -> None:
    made = design(run_up=(("time_s", 1.0),))
    changes = [pins(made.autobalancer), *proposed(made, start(made, run_up=1.0, **changed))]
    tables = [with_entries(made.case.table, entries) for entries in changes]
    assert len(tables) > 5 and all(first != other for k, first in enumerate(tables) for other in tables[:k])


def test_without_start_cases_nothing_is_proposed() -> None:
    assert list(changes_for_starts(StartFacts(design(), None), loud=True)) == []


@pytest.mark.parametrize("drag", [pytest.param(4.0, marks=pytest.mark.slow), pytest.param(6.0, marks=pytest.mark.hard)])
def test_a_temporary_speed_reduction_lets_balls_that_stall_catch_up(drag: float) -> None:
    """Every start case balances with it, which not every one does without."""
    found = machine_of("hanging-balls", **PINNED["hanging-balls"], rolling_drag_per_s=drag)
    first = StartFacts(found, simulate_members(found, shares=(1.0,), doubtful=ALL))
    assert first.ensemble is not None and first.ensemble.hanging and not first.listed_pass
    (slow,) = of(list(changes_for_starts(first, loud=False)), "run_up.pause_speed_rpm")
    slowed = followed(found, slow)
    assert StartFacts(slowed, simulate_members(slowed, shares=(1.0,), doubtful=ALL)).listed_pass
