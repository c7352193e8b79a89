"""Many starts of one machine: which verdict they give, and that neither order nor workers change it."""

import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators.compiled.run import integrate
from abu_calc.dynamics.scene import with_parted_balls
from abu_calc.features.design.judgement import proven
from abu_calc.features.design.start_rules import StartFacts, checks_of_starts, level_check
from abu_calc.features.design.start_search import designed
from abu_calc.foundation.checks import Check, Finding
from abu_calc.foundation.progress import silent
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation import ensemble
from abu_calc.simulation.design_scenes import simulated
from abu_calc.simulation.ensemble import TOLERANCE, WORK, followed_until, outcome_of, simulate_members, start_once
from abu_calc.simulation.start_cases import Ensemble, Lost, Member, StartOutcome, members, scene_of_member
from abu_calc.sizing import size
from abu_calc.sizing.design import Design

MACHINES = Path(__file__).parents[1] / "machines"
ALL = 1e9
"""A drag below which balls are taken to be in danger of hanging: slow run-ups of all members."""


@cache
def design(name: str, **changed: object) -> Design:
    """A machine, sized, with some keys of its autobalancer changed."""
    overrides = [f"autobalancer.{key}={value}" for key, value in changed.items()]
    place = MACHINES / f"{name}.toml"
    return size(read_machine(str(place if place.exists() else name), overrides).whole("size"))


PINNED = {
    "friction-elsewhere": {"ball_count": 4, "ball_diameter_mm": 12.0, "race_radius_mm": 26.5},
    "late-settling": {"ball_count": 5, "ball_diameter_mm": 14.2875, "race_radius_mm": 35.5},
    "hanging-balls": {"ball_count": 5, "ball_diameter_mm": 11.1125, "race_radius_mm": 25.5},
}
"""What once passed from one start: others have been found since that do so honestly."""


def statuses(found: Design, ensemble: Ensemble) -> dict[str, str]:
    """Of the checks that starts decide."""
    facts = StartFacts(found, ensemble)
    return {one.code: one.status for one in (level_check(facts), *checks_of_starts(facts))}


def level(closed: Finding, ensemble: Ensemble) -> Check:
    """The check of the idle level with another one by sizing."""
    return level_check(StartFacts(replace(design("msh-230"), level=closed), ensemble))


def judged(name: str, doubtful: float = 0.0, **changed: object) -> dict[str, str]:
    """A machine's checks by its starts."""
    found = design(name, **PINNED.get(name, {}), **changed)
    return statuses(found, simulate_members(found, doubtful=doubtful))


@pytest.mark.parametrize("drag", [3.0, pytest.param(4.0, marks=pytest.mark.slow)])
@pytest.mark.slow
def test_balls_hang_from_standstill(drag: float) -> None:
    """130 dB, where one easy start at full speed ends at 97."""
    found = judged("hanging-balls", rolling_drag_per_s=drag)
    assert found == {"ABU401": "fail", "ABU701": "fail", "ABU702": "fail", "ABU704": "fail"}


@pytest.mark.slow
def test_a_slow_run_up_catches_balls_that_others_do_not() -> None:
    """At a drag of 6 1/s all starts at full speed balance, and so does a run-up in one second."""
    assert judged("hanging-balls")["ABU704"] == "warn"
    assert judged("hanging-balls", ALL)["ABU704"] == "fail"


@pytest.mark.slow
def test_friction_holds_other_arrangements_than_the_fan() -> None:
    """Bunched behind the imbalance the balls stay where they leave 112 dB, limit 109."""
    assert judged("friction-elsewhere")["ABU401"] == "fail"


@pytest.mark.slow
def test_standstill_settles_later_than_bunched() -> None:
    """1.03 s where the bunched start takes 0.07, limit 1."""
    assert judged("late-settling")["ABU702"] == "fail"


@pytest.mark.slow
def test_hands_are_not_chaotic() -> None:
    """All starts balance in time; gravity leaves little of the friction, so that the level passes, too."""
    found = judged("hands-called-chaotic")
    assert found == {"ABU401": "pass", "ABU701": "pass", "ABU702": "pass", "ABU704": "pass"}


@pytest.mark.slow
def test_workers_change_nothing() -> None:
    """One after the other and by threads: the same numbers."""
    found = design("msh-230")
    assert simulate_members(found, workers=3) == simulate_members(found)


@pytest.mark.slow
def test_workers_change_no_scene() -> None:
    """The scenes of an arm, told as they are done."""
    found, told = design("swing-arm-grinder"), list[str]()
    runs, _ = simulated(found, 0.01)
    others, _ = simulated(found, 0.01, told.append, workers=2)
    assert [one.simulation.response for one in others] == [one.simulation.response for one in runs]
    assert told == ["1 of 3 scenes", "2 of 3 scenes", "3 of 3 scenes"]


def test_plain_runs_go_side_by_side() -> None:
    """Runs of one structure by threads, without compiled code: each has its own parameters."""
    found = design("msh-230", ball_count=2)
    equations = [
        assemble(with_parted_balls(scene_of_member(found, one))[0]) for one in members(found) if not one.run_up
    ]
    times = np.linspace(0, 0.05, 20)

    def states(one: Equations) -> Any:
        return integrate(one, 1e-3, times, compiled=False).y

    alone = [states(one) for one in equations]
    with ThreadPoolExecutor(4) as pool:
        for one, other in zip(alone, pool.map(states, equations), strict=True):
            assert np.array_equal(one, other)


def test_members() -> None:
    """Five starts at each of three drags; the run-up of the file; a slow one below the drag that is asked."""
    found = design("msh-230")
    all_of_them = list(members(found, 20.0))
    assert sorted({one.drag for one in all_of_them}) == pytest.approx([5, 15, 45])
    assert [one.run_up for one in all_of_them if one.drag == 45] == [0, 0, 0, 0, 1.0]
    assert [one.run_up for one in all_of_them if one.drag == 15] == 2 * [0, 0, 0, 0, 1.0, 4.0]
    assert {one.eccentricity for one in all_of_them if one.drag == 15} == {math.tau, math.pi}
    assert len(set(all_of_them)) == len(all_of_them)


@pytest.mark.slow
def test_the_ends_of_a_speed_range_are_tried() -> None:
    """At 2300 rpm balls hang that catch up at the rated 9000: 125 dB where 103 are left there."""
    changed = ["machine.speed_range_rpm=[2300, 9000]", "autobalancer.rolling_drag_per_s=5"]
    found = size(read_machine(str(MACHINES / "speed-range.toml"), changed).whole("size"))
    ensemble = simulate_members(found, shares=(1.0,), doubtful=0.0)
    assert {one.member.name for one in ensemble.hanging} == {"standstill (2300 rpm)", "run-up in 1 s (2300 rpm)"}
    assert {one.balanced for one in ensemble.rated} == {True}
    assert statuses(found, ensemble) == {"ABU401": "fail", "ABU701": "fail", "ABU702": "fail", "ABU704": "fail"}
    slow = next(one for one in ensemble.outcomes if one.member.name == "bunched (2300 rpm)")
    # The axis goes round its place: the level is that of its velocity at this speed; the rated one has 12 dB more.
    velocity = slow.residual * 2300 * math.pi / 30 / math.sqrt(2)
    assert slow.level == pytest.approx(20 * math.log10(velocity / 5e-8), abs=1.5)


def test_a_member_is_its_scene() -> None:
    found = design("msh-230")
    behind, cold = scene_of_member(found, Member("behind", 15.0)), scene_of_member(found, Member("spread", 45.0))
    middle = sum(behind.races[0].start_angles) / len(behind.races[0].start_angles)
    assert math.degrees(middle) == pytest.approx(-20)
    assert cold.races[0].drag == 45.0
    assert cold.duration < behind.duration, "what dies out sooner need not be followed as long"
    slow = scene_of_member(found, Member("bunched", 15.0, 4.0))
    assert slow.duration > 4.0 + behind.duration
    assert slow.effects[0].name == "run_up"


@pytest.mark.slow
def test_a_race_without_drag() -> None:
    """Has no hot and cold oil; balls at rest never take up the speed of the race."""
    found = design("msh-230", rolling_drag_per_s=0)
    assert len(list(members(found))) == 10
    assert statuses(found, simulate_members(found))["ABU701"] == "fail"


def test_settling_counts_from_full_speed() -> None:
    """Of a slow run-up: at once, where the balls find their places on the way up; quiet and rest do so, too."""
    found = simulate_members(design("avtovaz-707-222"), shares=(3.0,), doubtful=ALL)
    (slow,) = [one for one in found.outcomes if one.member.run_up == 4.0]
    assert slow.settling_time == slow.quiet_time == slow.rest_time == 0.0
    assert slow.balanced


def outcome(drag: float = 10.0, start: str = "bunched", **changed: float | None) -> StartOutcome:
    """One that passes, unless it is changed."""
    given = {"settling_time": 0.5, "quiet_time": 0.2, "rest_time": 0.6, "creeping": False, "residual": 1e-5,
             "level": 100.0, "slip": 0.0, "imbalance": 1e-5, "allowed": 3e-5}  # fmt: skip
    return StartOutcome(Member(start, drag), **{**given, **changed})  # type: ignore[arg-type]


def checked(*outcomes: StartOutcome, lost: tuple[Lost, ...] = ()) -> dict[str, str]:
    """Checks of an ensemble made by hand, the drag given being 10 1/s."""
    found = design("msh-230")
    return statuses(found, Ensemble(10.0, outcomes, lost))


@pytest.mark.parametrize(
    ("changed", "failing"),
    [
        ({"level": 110.0}, {"ABU401"}),
        ({"imbalance": 4e-5}, {"ABU701"}),
        ({"quiet_time": None}, {"ABU702"}),
        ({"quiet_time": 1.5}, {"ABU702"}),
        ({"settling_time": None, "rest_time": None}, set()),
        ({"slip": 0.06}, {"ABU701", "ABU704"}),
        ({"slip": 0.04}, set()),
    ],
)
def test_starts_at_the_drag_given_fail_and_others_warn(changed: dict[str, float | None], failing: set[str]) -> None:
    at_given = checked(outcome(), outcome(start="spread", **changed))
    at_other = checked(outcome(), outcome(drag=30.0, start="spread", **changed))
    for code, status in at_given.items():
        assert status == ("fail" if code in failing else "pass"), code
    for code, status in at_other.items():
        assert status == ("warn" if code in failing else "pass"), code


def test_a_start_without_an_answer_is_not_done() -> None:
    """At the drag given; at another it warns; beside one that fails it changes nothing."""
    lost = (Lost(Member("spread", 10.0), "too much work", 1),)
    assert checked(outcome(), lost=lost)["ABU701"] == "not-done"
    assert checked(outcome(), lost=(replace(lost[0], member=Member("spread", 30.0)),))["ABU701"] == "warn"
    assert checked(outcome(imbalance=1.0), lost=lost)["ABU701"] == "fail"
    assert set(checked(lost=lost).values()) >= {"not-done"}


def test_a_run_up_gets_its_work_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A start at full speed that runs short is tried again with more work; a run-up has had that much."""
    tried: list[tuple[Member, int]] = []

    def short(_: Design, member: Member, _accuracy: float, _tolerance: float, work: int, *_more: object) -> Lost:
        tried.append((member, work))
        return Lost(member, "more work than allowed", work, short=True)

    monkeypatch.setattr(ensemble, "start_once", short)
    found = simulate_members(design("msh-230"))
    works = {member: [work for other, work in tried if other == member] for member, _ in tried}
    run_ups, others = ([works[member] for member in works if bool(member.run_up) is slow] for slow in (True, False))
    assert run_ups and others and not found.outcomes
    assert all(len(work) == 1 and work[0] > WORK for work in run_ups)
    assert all(len(work) == 2 and work[0] == WORK < work[1] for work in others)


@pytest.mark.parametrize("spent", [0, ensemble.MOST_MORE])
def test_second_runs_end_where_the_first_have_spent_the_work(monkeypatch: pytest.MonkeyPatch, spent: int) -> None:
    found, start = design("msh-230"), Member("spread", 10.0)
    lost, tried = Lost(start, "more work than allowed", WORK, short=True), list[int]()
    monkeypatch.setattr(ensemble, "start_once", lambda *given: tried.append(given[4]) or lost)
    runner = ensemble.Runner(ensemble.start_once, ensemble.called_for)
    assert ensemble._with_more(found, [lost], [(start, True)], 0.01, 1e-4, silent, 1, spent, runner) == [lost]
    assert tried == ([] if spent else [10 * WORK])


def test_balls_that_carry_too_little_are_not_done() -> None:
    found = design("msh-230", ball_count=2, ball_diameter_mm=5)
    assert proven(found).ensemble is None
    assert {one.status for one in checks_of_starts(StartFacts(found, None))} == {"not-done"}


def test_the_level_check_keeps_the_worse() -> None:
    """Of the closed form and of the starts."""
    closed = Finding("pass", "closed", 105.0, 109.0)
    failed = Finding("fail", "closed", 111.0, 109.0)

    def value(one: Finding, loud: float) -> tuple[str, float | None]:
        found = level(one, Ensemble(10.0, (outcome(level=loud),), ()))
        return found.status, found.value

    assert value(closed, 100.0) == ("pass", 105.0)
    assert value(closed, 107.0) == ("pass", 107.0)
    assert value(closed, 110.0) == ("fail", 110.0)
    assert value(failed, 100.0) == ("fail", 111.0)
    assert value(failed, 112.0) == ("fail", 112.0)


def test_a_start_that_rests_ends_early() -> None:
    """With the same answer as at the very end, and by no more work; nearer to the level allowed none does."""
    found = design("msh-230")
    for member in (Member("spread", 5.0), Member("bunched", 15.0, 1.0), Member("behind", 15.0)):
        early, whole = (start_once(found, member, 0.01, TOLERANCE, WORK, early_end) for early_end in (True, False))
        assert isinstance(early, StartOutcome)
        assert isinstance(whole, StartOutcome)
        assert early.work < 0.8 * whole.work
        assert early.balanced and whole.balanced and not early.hanging
        assert early.settling_time_or_inf == pytest.approx(whole.settling_time_or_inf, rel=0.02)
        assert early.quiet_time_or_inf == pytest.approx(whole.quiet_time_or_inf, rel=0.02)
        assert early.rest_time_or_inf == pytest.approx(whole.rest_time_or_inf, rel=0.02)
        assert 0 < whole.quiet_time_or_inf < whole.rest_time_or_inf < math.inf
        assert early.level == pytest.approx(whole.level, abs=0.3)
        strict = replace(found, case=replace(found.case, level_limit=whole.level + 0.5))
        followed = start_once(strict, member, 0.01, TOLERANCE, WORK, True)
        assert (followed.work, followed.level) == pytest.approx((whole.work, whole.level), rel=0.01)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    "name, member",
    [("msh-230", Member("behind", 15.0)), ("swing-arm-grinder", Member("spread", 15.0))],
)
@pytest.mark.slow
def test_a_start_near_a_limit_does_not_end_early(name: str, member: Member) -> None:
    """What creeps on makes it louder, and what it settles to is less: a run that ends early must not be the easier."""
    found = design(name)
    whole = start_once(found, member, 0.01, TOLERANCE, WORK, False)
    assert isinstance(whole, StartOutcome)
    limits = found.case.table.limits.model_copy(update={"quiet_time_s": 0.95 * whole.quiet_time_or_inf})
    table = found.case.table.model_copy(update={"limits": limits})
    late = start_once(replace(found, case=replace(found.case, table=table)), member, 0.01, TOLERANCE)
    loud = start_once(replace(found, case=replace(found.case, level_limit=whole.level - 0.2)), member, 0.01, TOLERANCE)
    assert isinstance(late, StartOutcome) and late.quiet_time_or_inf > limits.longest_quiet_time > 0
    assert isinstance(loud, StartOutcome) and loud.level > whole.level - 0.2


@pytest.mark.slow
def test_balls_that_linger_are_followed_until_they_leave() -> None:
    """Equations outside the product say 2.98 s and 95.7 dB; the scene lasts 1.17 s, where it is 108.7 dB still.

    That is below the limit, so the machine has been quiet long before.
    """
    found = size(read_machine(str(Path(__file__).parents[1] / "machines" / "lingering-balls.toml")).whole("size"))
    angles = tuple(math.radians(angle) for angle in (11.7, 52.0, 132.3, 204.5, 241.5))
    outcome = start_once(found, Member("placed", found.case.drag, 0.0, math.tau, angles=angles), 0.01, TOLERANCE)
    assert isinstance(outcome, StartOutcome) and outcome.duration == 6.0
    assert outcome.settling_time_or_inf == pytest.approx(2.98, rel=0.1)
    assert outcome.rest_time_or_inf == pytest.approx(2.98, rel=0.1) and outcome.level == pytest.approx(95.7, abs=0.2)
    assert outcome.quiet_time_or_inf < 0.5 and not outcome.creeping


def test_balls_that_still_creep_are_followed_ten_times_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three times where they linger; once and for all where they rest where they balance."""
    found, member = design("msh-230"), Member("behind", 15.0)
    scene, given = scene_of_member(found, member), simulated(found, 0.01)[0][0].simulation
    limit = found.case.table.limits.longest_quiet_time
    balanced = outcome_of(found, member, scene, given.response)

    def until(**changed: object) -> float | None:
        monkeypatch.setattr(ensemble, "outcome_of", lambda *_: replace(balanced, **changed))  # type: ignore[arg-type]
        return followed_until(found, scene, given.response, given.trajectory)

    assert until() is None
    assert until(creeping=True) == pytest.approx(scene.full_speed + ensemble.LONGEST_CREEPING * limit)
    far = 3 * balanced.allowed
    monkeypatch.setattr(ensemble, "linger", lambda *_: True)
    assert until(imbalance=far) == pytest.approx(scene.full_speed + ensemble.LONGEST_LINGERING * limit)
    # What is late already has its verdict.
    assert until(creeping=True, quiet_time=1.1 * limit) is None and until(creeping=True, slip=0.5) is None


@pytest.mark.slow
def test_friction_that_gravity_shakes_makes_balls_creep() -> None:
    """Standing still they settle in 0.89 s, by equations outside the product; a scene for h₀ alone ended at 0.6 s."""
    text = (Path(__file__).parents[1] / "machines" / "creeping-balls.toml").read_text(encoding="utf-8")
    assert 'spindle_axis = "horizontal"' in text
    found = size(read_machine(str(Path(__file__).parents[1] / "machines" / "creeping-balls.toml")).whole("size"))
    outcome = start_once(found, Member("standstill", found.case.drag, 0.0, math.tau), 0.01, TOLERANCE)
    assert isinstance(outcome, StartOutcome)
    assert outcome.settling_time_or_inf == pytest.approx(0.89, rel=0.03)
    assert outcome.rest_time_or_inf == pytest.approx(0.89, rel=0.03) and outcome.level == pytest.approx(99.6, abs=0.2)


@pytest.mark.slow
def test_a_start_that_need_not_rest_takes_less_work_and_is_judged_alike() -> None:
    """Balls on an arm settle beside the places where they balance, and less is left there: they might go on."""
    found = design("swing-arm-grinder")
    members = [each for each in islice(designed(found), 12) if not each.run_up]
    pairs = [
        [start_once(found, each, 0.01, TOLERANCE, 10 * WORK, to_rest=to_rest) for each in members]
        for to_rest in (True, False)
    ]
    for whole, short in zip(*pairs, strict=True):
        assert isinstance(whole, StartOutcome) and isinstance(short, StartOutcome)
        assert (short.balanced, short.hanging) == (whole.balanced, whole.hanging) and short.work <= whole.work
        assert short.quiet_time_or_inf == pytest.approx(whole.quiet_time_or_inf, rel=0.02, abs=1e-3)
    work = [sum(outcome.work for outcome in outcomes) for outcomes in pairs]
    assert work[1] < 0.7 * work[0]
