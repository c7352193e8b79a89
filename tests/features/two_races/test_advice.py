"""Advice of a machine with two races: it holds when it is followed to the letter."""

import math
from dataclasses import replace
from functools import cache

import pytest

import abu_calc
from abu_calc.features.two_races import advice
from abu_calc.features.two_races import start_cases as start_cases_module
from abu_calc.features.two_races.case import read_case
from abu_calc.features.two_races.checks import capacity_checks, level_checks, mass_checks, race_checks, start_checks
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.records import TwoRaceSizeResult
from abu_calc.features.two_races.start_cases import (
    LostRun,
    StartCase,
    TwoRaceRun,
    all_work,
    run_of,
    speed_ends,
    start_cases,
)
from abu_calc.foundation.progress import silent
from abu_calc.inputs.read_machine import read_machine


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
def test_the_quieter_change_holds_when_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without balls that start spread: some of these end in a louder arrangement, whatever the race."""
    every = start_cases
    monkeypatch.setattr(
        start_cases_module, "start_cases", lambda design: [one for one in every(design) if one.start != "spread"]
    )
    design = design_of("limits.vibration_level_db=109.0")
    loud = run_of(design, StartCase("bunched", 1.0, (0.0,)), 0.05)
    assert isinstance(loud, TwoRaceRun)
    limit = loud.level - 2
    table = design.case.table
    table = table.model_copy(update={"limits": table.limits.model_copy(update={"vibration_level_db": limit})})
    strict = replace(design, case=replace(design.case, table=table))
    action = advice.quieter_change(strict, loud, 0.05, silent, 1, all_work())
    assert action is not None
    assert "race_eccentricity_mm" in action.text and "(simulated" in action.text
    followed = design_of(*action.overrides)
    runs = [run_of(followed, start, 0.05) for start in start_cases_module.start_cases(followed)]
    assert all(isinstance(run, TwoRaceRun) and run.balances and run.level <= limit for run in runs)


@pytest.mark.slow
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


@pytest.mark.slow
def test_levels_are_judged_at_the_speed_of_each_run() -> None:
    """The same displacement of 10 µm is 20·lg 2 = 6.02 dB louder at twice the speed; no range is passed by scaling."""
    design = design_of()
    vibration_limit = design.case.table.limits.vibration_level_db
    run = TwoRaceRun(StartCase("bunched"), (1e-5, 1e-5), (1e-5,), (1e-4,), 0.1, 0.1, 0.1, 0.0, True, 300.0)
    fast = replace(run, speed=600.0, case=StartCase("bunched", speed=600.0))
    assert run.level == pytest.approx(20 * math.log10(1e-5 * 300 / math.sqrt(2) / 5e-8))
    assert fast.level - run.level == pytest.approx(20 * math.log10(2))
    loud = replace(fast, displacements=(1e-5 * 10 ** ((vibration_limit + 1 - fast.level) / 20),))
    result = type("V", (), {"level_after_db": 90.0, "level_before_db": 110.0})()
    level, _ = level_checks(design, result, (run, loud))
    assert level.status == "fail"
    assert level.value == pytest.approx(vibration_limit + 1)
    lost = LostRun(StartCase("spread"), "more work than allowed")
    assert [check.status for check in level_checks(design, result, (run,))] == ["pass", "pass"]
    assert [check.status for check in level_checks(design, result, (run, lost))] == ["not-done", "not-done"]
    assert [check.status for check in level_checks(design, result, (run, loud, lost))] == ["fail", "not-done"]


def late_by(longest: float | None, *runs: TwoRaceRun) -> tuple[str, str, float | None]:
    """Status, message and value of the check of the quiet time under a limit of the rest time [s]."""
    design = design_of()
    limits = design.case.table.limits.model_copy(update={"rest_time_s": longest})
    table = design.case.table.model_copy(update={"limits": limits})
    found = start_checks(replace(design, case=replace(design.case, table=table)), runs, None)
    check = next(check for check in found if check.code == "ABU702")
    return check.status, check.message, check.value


def test_rest_times_are_judged_where_the_file_limits_them() -> None:
    """Both races must rest in time at the given drag rate; in hot or cold oil a late one warns. Quiet alone decides
    without that limit.
    """
    run = TwoRaceRun(StartCase("bunched"), (1e-5, 1e-5), (1e-5,), (1e-4,), 9.0, 0.1, 0.4, 0.0, True, 300.0)
    hot = replace(run, case=StartCase("bunched", 1 / 3), rest_time=0.6)
    never = replace(run, rest_time=None)
    assert late_by(None, run, hot)[0] == late_by(None, never, hot)[0] == late_by(0.7, run, hot)[0] == "pass"
    status, message, value = late_by(0.5, run, hot)
    assert status == "warn" and "rest after 0.60 s (limit 0.5 s)" in message and value == 0.1
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
        assert {case.start for case in own} == {"bunched", "spread", "standstill", "run-up"}
        assert {case.drag_factor for case in own} == {1.0, 1 / 3, 3.0}
        assert len({case.phases for case in own}) >= 2
    assert "1500 rpm" in next(case.name for case in cases if case.speed == ends[0])
    assert speed_ends(design_of().case) == ()


@pytest.mark.slow
def test_a_run_at_an_end_is_that_of_a_machine_of_that_speed() -> None:
    design = design_of("machine.speed_range_rpm=[2850.0, 3600.0]")
    ranged = run_of(design, StartCase("spread", speed=120 * math.pi), 0.05)
    alone = run_of(replace(design, case=replace(design.case, speed=120 * math.pi)), StartCase("spread"), 0.05)
    assert isinstance(ranged, TwoRaceRun) and isinstance(alone, TwoRaceRun)
    assert ranged.displacements == alone.displacements
    assert ranged.settling_time == alone.settling_time
    assert (ranged.quiet_time, ranged.rest_time) == (alone.quiet_time, alone.rest_time)
    assert ranged.speed == pytest.approx(120 * math.pi)
