"""Advice of a machine with two races: it holds when it is followed to the letter."""

import math
from dataclasses import replace
from functools import cache

import pytest

import abu_calc
from abu_calc.features.two_races import advice
from abu_calc.features.two_races.case import read_case
from abu_calc.features.two_races.checks import capacity_checks, level_checks, mass_checks, race_checks, start_checks
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.records import TwoRaceSizeResult
from abu_calc.features.two_races.start_cases import (
    TwoRaceOutcome,
    ensemble_of,
    level_of,
    speed_ends,
    start,
    start_cases,
    start_once,
)
from abu_calc.foundation.progress import silent
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.ensemble import TOLERANCE, WORK
from abu_calc.simulation.ensemble_results import Ensemble, Lost, StartOutcome


@cache
def design_of(*overrides: str) -> TwoRaceDesign:
    tables = read_machine("pedestal-grinder", overrides).two_races
    assert tables is not None
    return choose_both(read_case(tables))


@pytest.mark.slow
def test_a_change_goes_into_both_tables() -> None:
    change = advice.changed(design_of(), {"rolling_drag_per_s": 30.0})
    assert change is not None
    assert change.design.case.drags == (30.0, 30.0)
    assert change.overrides == ("autobalancer.0.rolling_drag_per_s=30", "autobalancer.1.rolling_drag_per_s=30")
    assert change.text == "rolling_drag_per_s = 30"


@pytest.mark.slow
def test_eccentricity_and_friction_reach_what_is_simulated() -> None:
    change = advice.changed(design_of(), {"race_eccentricity_mm": 0.005, "rolling_friction_mm": 0.001})
    assert change is not None
    assert change.design.case.eccentricity == pytest.approx(5e-6)
    assert change.design.case.friction_arm == pytest.approx(1e-6)


@pytest.mark.slow
def test_a_change_that_cannot_be_made_or_breaks_a_check_is_none() -> None:
    assert advice.changed(design_of(), {"max_width_mm": 1.0}) is None
    assert advice.changed(design_of(), {"max_mass_fraction": 0.001}) is None


@pytest.mark.hard
def test_the_quieter_change_holds_when_followed() -> None:
    design = design_of("limits.vibration_level_db=109.0")
    before = ensemble_of(design, 0.05, silent, 1)
    limit = max(outcome.level for outcome in before.outcomes) - 0.5
    table = design.case.table
    table = table.model_copy(update={"limits": table.limits.model_copy(update={"vibration_level_db": limit})})
    strict = replace(design, case=replace(design.case, table=table))
    action = advice.quieter_change(strict, before, 0.05, silent, 1)
    assert action is not None and "(simulated" in action.text
    followed = ensemble_of(design_of(*action.overrides), 0.05, silent, 1)
    assert not followed.lost and all(run.balanced and run.level <= limit for run in followed.outcomes)


@pytest.mark.hard
def test_the_sturdier_change_holds_when_followed() -> None:
    overrides = ("autobalancer.0.max_mass_fraction=0.005", "autobalancer.1.max_mass_fraction=0.005")
    design = design_of(*overrides)
    failing = [*capacity_checks(design), *race_checks(design), *mass_checks(design)]
    assert any(check.status == "fail" for check in failing)
    action = advice.sturdier_change(design)
    assert action is not None
    assert "(calculated)" in action.text
    followed = design_of(*overrides, *action.overrides)
    checks = [*capacity_checks(followed), *race_checks(followed), *mass_checks(followed)]
    assert {check.status for check in checks} == {"pass"}


@pytest.mark.hard
def test_a_late_start_is_mended_as_told() -> None:
    overrides = ("limits.quiet_time_s=1.0",)
    result = abu_calc.size(read_machine("pedestal-grinder", overrides))
    assert isinstance(result, TwoRaceSizeResult)
    late = next(check for check in result.checks if check.code == "ABU702")
    assert late.status in ("fail", "warn")
    if late.overrides:
        again = abu_calc.size(read_machine("pedestal-grinder", [*overrides, *late.overrides]))
        assert next(check for check in again.checks if check.code == "ABU702").status == "pass"


def outcome(**values: object) -> TwoRaceOutcome:
    """A start case that is quiet after 0.1 s and at rest after 0.4 s."""
    member = start(design_of(), "bunched", (0.0,))
    usual = TwoRaceOutcome(member, 9.0, 0.1, 0.4, False, 1e-5, 90.0, 0.0, 1e-6, 1e-5, displacements=(1e-5, 1e-5))
    return replace(usual, **values)  # type: ignore[arg-type]


def judged(outcomes: list[StartOutcome], lost: int = 0) -> Ensemble:
    """An ensemble of these."""
    drag = design_of().case.drag
    return Ensemble(drag, tuple(outcomes), (Lost(outcome().member, "more work than allowed", 1),) * lost)


@pytest.mark.slow
def test_levels_are_judged_at_the_speed_of_each_run() -> None:
    """The same displacement of 10 µm is 20·lg 2 = 6.02 dB louder at twice the speed; no range is passed by scaling."""
    assert level_of(1e-5, 300.0) == pytest.approx(20 * math.log10(1e-5 * 300 / math.sqrt(2) / 5e-8))
    assert level_of(1e-5, 600.0) - level_of(1e-5, 300.0) == pytest.approx(20 * math.log10(2))
    design = design_of()
    limit = design.case.table.limits.vibration_level_db
    run, loud = outcome(), outcome(level=limit + 1)
    result = type("V", (), {"level_after_db": 90.0, "level_before_db": 110.0})()
    level, _ = level_checks(design, result, judged([run, loud]))
    assert level.status == "fail"
    assert level.value == pytest.approx(limit + 1)
    for outcomes, lost, expected in (
        ([run], 0, ["pass", "pass"]), ([run], 1, ["not-done", "not-done"]), ([run, loud], 1, ["fail", "not-done"]),
    ):  # fmt: skip
        assert [check.status for check in level_checks(design, result, judged(outcomes, lost))] == expected


def late_by(longest: float | None, *runs: TwoRaceOutcome) -> tuple[str, str, float | None]:
    """Status, message and value of the check of the quiet time under a limit of the rest time [s]."""
    design = design_of()
    limits = design.case.table.limits.model_copy(update={"rest_time_s": longest})
    table = design.case.table.model_copy(update={"limits": limits})
    found = start_checks(replace(design, case=replace(design.case, table=table)), judged([*runs]), None)
    check = next(check for check in found if check.code == "ABU702")
    return check.status, check.message, check.value


@pytest.mark.slow
def test_rest_times_are_judged_where_the_file_limits_them() -> None:
    """Both races must rest in time at the given drag rate; in hot or cold oil a late one warns. Quiet alone decides
    without that limit.
    """
    run, drag = outcome(), design_of().case.drag
    hot = replace(run, member=start(design_of(), drag=drag / 3), rest_time=0.6)
    never = replace(run, rest_time=None)
    assert late_by(None, run, hot)[0] == late_by(None, never, hot)[0] == late_by(0.7, run, hot)[0] == "pass"
    status, message, value = late_by(0.5, run, hot)
    assert status == "warn" and "rest after 0.4" in message and "limit 0.5 s" in message and value == 0.1
    assert late_by(0.3, run, hot)[0] == late_by(0.5, never)[0] == "fail"
    late = replace(run, quiet_time=1.0 + design_of().case.table.limits.longest_quiet_time)
    assert late_by(None, late)[0] == late_by(None, replace(run, quiet_time=None))[0] == "fail"


@pytest.mark.slow
def test_both_ends_of_a_speed_range_are_started() -> None:
    design = design_of("machine.speed_range_rpm=[1500.0, 3600.0]")
    ends = speed_ends(design.case)
    assert [end * 30 / math.pi for end in ends] == pytest.approx([1500.0, 3600.0])
    cases = list(start_cases(design))
    for end in (None, *ends):
        own = [case for case in cases if case.speed == end]
        assert {case.start for case in own} == {"bunched", "spread", "standstill"} and any(case.run_up for case in own)
        assert {case.drag / design.case.drag for case in own} == {1.0, 1 / 3, 3.0}
        assert len({case.phases for case in own}) >= 2
    assert "1500 rpm" in next(case.name for case in cases if case.speed == ends[0])
    assert speed_ends(design_of().case) == ()


@pytest.mark.slow
def test_a_run_at_an_end_is_that_of_a_machine_of_that_speed() -> None:
    design = design_of("machine.speed_range_rpm=[2850.0, 3600.0]")
    alone = replace(design, case=replace(design.case, speed=120 * math.pi))
    ranged = start_once(design, start(design, "spread", speed=120 * math.pi), 0.05, TOLERANCE, WORK)
    alone = start_once(alone, start(alone, "spread"), 0.05, TOLERANCE, WORK)
    assert isinstance(ranged, TwoRaceOutcome) and isinstance(alone, TwoRaceOutcome)
    assert ranged.displacements == alone.displacements
    assert ranged.settling_time == alone.settling_time
    assert (ranged.quiet_time, ranged.rest_time) == (alone.quiet_time, alone.rest_time)
    assert ranged.level == alone.level
