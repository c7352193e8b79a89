"""Which changes are tried where starts fail, and when a design passes."""

from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any

import pytest

from abu_calc.features.design.verification import LEAST, changes, other_drags, passes, proven
from abu_calc.simulation.ensemble_results import StartOutcome
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import machine

DRAG = 15.0


@pytest.fixture(scope="module")
def design() -> Design:
    return size(machine(autobalancer={"max_outer_diameter_mm": 68.0, "max_width_mm": 32.0, "rolling_drag_per_s": DRAG}))


def start(**values: Any) -> SimpleNamespace:
    member = SimpleNamespace(run_up=values.pop("run_up", False), speed=None, drag=values.pop("drag", DRAG))
    usual = {"balanced": True, "hanging": False, "slip": 0.0, "level": 99.0}
    times = {"quiet_time_or_inf": 0.3, "rest_time_or_inf": 9.0, "settling_time_or_inf": 9.0}
    made = SimpleNamespace(member=member, **(usual | times | values))
    made.in_time = partial(StartOutcome.in_time, made)  # its own rules, by these values
    made.holds = partial(StartOutcome.holds, made)
    return made


def ensemble(*starts: SimpleNamespace) -> Any:
    lost = [each for each in starts if not each.balanced]
    given = [each for each in starts if each.member.drag == DRAG]
    return SimpleNamespace(given=given, lost=lost, drag=DRAG, hanging=[each for each in starts if each.hanging])


def test_the_nearest_drags_come_first_and_none_that_is_the_same() -> None:
    """Off 15 by factors of 1.2, 1.25, 1.8, 1.875, 2.67; 17 is off 18 by 1.06, which counts as the same."""
    assert other_drags(15.0, only_more=False) == [18.0, 12.0, 27.0, 8.0, 40.0]
    assert 18.0 not in other_drags(17.0, only_more=True)
    assert all(drag > 15 for drag in other_drags(15.0, only_more=True))
    assert other_drags(0.0, only_more=False)[0] == 3.0
    assert other_drags(60.0, only_more=True) == []


def test_a_design_passes_when_every_start_at_its_drag_does(design: Design) -> None:
    limits, level = design.case.table.limits, design.case.level_limit
    assert passes(design, ensemble(start(), start(level=level, quiet_time_or_inf=limits.longest_quiet_time)))
    assert not passes(design, ensemble(start(), start(level=level + 0.01)))
    assert not passes(design, ensemble(start(), start(quiet_time_or_inf=limits.longest_quiet_time + 0.01)))
    assert not passes(design, ensemble(start(), start(balanced=False)))
    assert passes(design, ensemble(start(), start(balanced=False, drag=5.0)))  # hot oil: told, not decided by


def test_a_design_passes_by_the_rest_time_only_if_the_file_limits_it(design: Design) -> None:
    table = design.case.table
    limits = table.limits.model_copy(update={"rest_time_s": 0.5})
    asked = replace(design, case=replace(design.case, table=table.model_copy(update={"limits": limits})))
    late, soon = start(rest_time_or_inf=0.51), start(rest_time_or_inf=0.5)
    assert passes(design, ensemble(late)) and passes(asked, ensemble(soon)) and not passes(asked, ensemble(soon, late))


def test_stalled_balls_are_offered_more_drag_and_a_slower_rotor(design: Design) -> None:
    """Balls that stall at a fifth of the speed are caught below two thirds of it."""
    offered = list(changes(design, ensemble(start(balanced=False, hanging=True, slip=0.8))))
    names = [change.name for change in offered]
    assert names[0].startswith("rolling_drag_per_s = ")
    (pause,) = [change for change in offered if "pause_speed_rpm" in change.name]
    assert len(pause.designs(design)) == 2
    slow = pause.designs(design)[0].case.table.run_up
    assert slow is not None and slow.pause_speed_rpm == pytest.approx(2 / 3 * 0.2 * 5800, rel=0.02)
    hardly = ensemble(start(balanced=False, hanging=True, slip=1 - LEAST / 2))
    assert not any("pause" in change.name for change in changes(design, hardly))


def test_damping_is_doubled_and_nothing_else(design: Design) -> None:
    (damped,) = [change for change in changes(design, ensemble(start())) if "damping_ratios" in change.name]
    (other,) = damped.designs(design)
    before, after = design.case.suspension, other.case.suspension
    assert after.damping == pytest.approx([2 * value for value in before.damping])  # type: ignore[union-attr]
    assert other.autobalancer.ball_count == design.autobalancer.ball_count and other.imbalance == design.imbalance


def test_balls_that_cannot_carry_the_imbalance_are_not_simulated(design: Design) -> None:
    heavy = replace(design, imbalance=replace(design.imbalance, value=10 * design.autobalancer.capacity))
    assert proven(heavy).ensemble is None
