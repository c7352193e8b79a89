"""Advice of a machine with two races: it holds when it is followed to the letter."""

import math
import shlex
from dataclasses import replace
from functools import cache

import pytest

import abu_calc
from abu_calc.features.design.start_rules import checks_of_starts
from abu_calc.features.spindle.case import SpindleDesign, size_races
from abu_calc.features.spindle.judgement import facts_of, judge, level_checks, proposals
from abu_calc.features.spindle.records import SpindleSizeResult
from abu_calc.features.spindle.start_cases import (
    level_of,
    speed_ends,
    start_cases,
    start_of,
    start_once,
)
from abu_calc.foundation.checks import RANK, Check
from abu_calc.foundation.progress import silent
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.ensemble import TOLERANCE, WORK
from abu_calc.simulation.start_cases import Ensemble, Lost, StartOutcome


@cache
def design_of(*overrides: str) -> SpindleDesign:
    return size_races(read_machine("pedestal-grinder", overrides))


def sized(*overrides: str) -> SpindleSizeResult:
    result = abu_calc.size(read_machine("pedestal-grinder", overrides))
    assert isinstance(result, SpindleSizeResult)
    return result


@pytest.mark.slow
def test_changes_are_proposed_for_what_does_not_pass_alone() -> None:
    """Entries of both tables; a larger ball for start cases that are late, never a drag rate, which nobody can set."""
    judgement = judge(read_machine("pedestal-grinder"), 0.05, silent, 1)
    assert list(proposals(judgement)) == []
    late = replace(judgement, checks=(Check("ABU702", "quiet time", "fail", "late"),))
    assert all("ball_diameter_mm" in entry for entry in next(proposals(late)))
    weak = replace(judgement, checks=(Check("ABU201", "capacity", "fail", "small"),))
    assert not any("drag" in entry for judged in (late, weak) for entries in proposals(judged) for entry in entries)


@pytest.mark.hard
@pytest.mark.parametrize(
    "overrides",
    [("limits.vibration_level_db=93.5",), ("limits.quiet_time_s=0.2",),
     ("autobalancer.0.max_mass_fraction=0.005", "autobalancer.1.max_mass_fraction=0.005")],
)  # fmt: skip
def test_the_next_step_holds_when_followed(overrides: tuple[str, ...]) -> None:
    """Loud, late, and too heavy: followed as printed, the verdict and the promised number come true."""
    result = sized(*overrides)
    assert result.verdict.word in ("does-not-suit", "suits-but")
    if result.verdict.next is None:
        assert "No change" in "".join(check.remedy or "" for check in result.checks)
        return
    words = shlex.split(result.verdict.next)
    followed = sized(*overrides, *(words[k + 1] for k, word in enumerate(words) if word == "--set"))
    promise, value = result.verdict.promise, followed.to_dict()
    assert promise is not None
    for key in str(promise["path"]).split("."):
        value = value[int(key)] if isinstance(value, list) else value[key]
    assert value == promise["to"]
    before = {check.name: RANK.index(check.status) for check in result.checks}
    assert all(RANK.index(check.status) >= before[check.name] for check in followed.checks)


def outcome(**values: object) -> StartOutcome:
    """A start case that is quiet after 0.1 s and at rest after 0.4 s."""
    member = start_of(design_of(), "bunched", (0.0,))
    usual = StartOutcome(member, 9.0, 0.1, 0.4, False, 1e-5, 90.0, 0.0, 1e-6, 1e-5, displacements=(1e-5, 1e-5))
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


def late_by(longest: float | None, *runs: StartOutcome) -> tuple[str, str, float | None]:
    """Status, message and value of the check of the quiet time under a limit of the rest time [s]."""
    design = design_of()
    limits = design.case.table.limits.model_copy(update={"rest_time_s": longest})
    table = design.case.table.model_copy(update={"limits": limits})
    found = checks_of_starts(facts_of(replace(design, case=replace(design.case, table=table)), judged([*runs])))
    check = next(check for check in found if check.code == "ABU702")
    return check.status, check.message, check.value


@pytest.mark.slow
def test_rest_times_are_judged_where_the_file_limits_them() -> None:
    """Both races must rest in time at the given drag rate; in hot or cold oil a late one warns. Quiet alone decides
    without that limit.
    """
    run, drag = outcome(), design_of().case.drag
    hot = replace(run, member=start_of(design_of(), drag=drag / 3), rest_time=0.6)
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
    ranged = start_once(design, start_of(design, "spread", speed=120 * math.pi), 0.05, TOLERANCE, WORK)
    alone = start_once(alone, start_of(alone, "spread"), 0.05, TOLERANCE, WORK)
    assert isinstance(ranged, StartOutcome) and isinstance(alone, StartOutcome)
    assert ranged.displacements == alone.displacements
    assert ranged.settling_time == alone.settling_time
    assert (ranged.quiet_time, ranged.rest_time) == (alone.quiet_time, alone.rest_time)
    assert ranged.level == alone.level
