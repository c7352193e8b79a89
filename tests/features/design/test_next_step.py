"""The next step: which change of those tried is taken, what is said of it, and that it holds when followed."""

import math
import shlex
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, reduce
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import abu_calc
from abu_calc.features.design import judgement
from abu_calc.features.design import next_step as module
from abu_calc.features.design.judgement import TrialWatcher, judge
from abu_calc.features.design.next_step import (
    LEAST_WORK,
    NUMBERS,
    PROMISING,
    REPEATED,
    ChangeWatcher,
    Judge,
    NextStep,
    NotBetterError,
    Tried,
    _as_one,
    actions,
    next_step,
    promise,
    proposals,
    together,
)
from abu_calc.foundation.checks import RANK, Check, Grade, OptionalCheck
from abu_calc.foundation.progress import Progress, silent
from abu_calc.inputs.read_machine import Machine, variant_of
from abu_calc.simulation.start_cases import Ensemble, Member, StartOutcome
from abu_calc.sizing import size
from abu_calc.sizing.actions import PINS
from abu_calc.sizing.design import Design
from tests.cli.runner import abu
from tests.features.design.test_start_rules import DRAG, outcome
from tests.sizing.machines import BASE, PINNED, machine

KEY = "autobalancer.rolling_drag_per_s"
FRICTION, RUN_OUT, THICK = (
    "autobalancer.rolling_friction_mm=0.001",
    "autobalancer.race_eccentricity_mm=0.005",
    f"{KEY}=27",
)
LIMITS = {"ABU201": 100.0, "ABU203": 8.0, "ABU401": 109.0, "ABU702": 1.0}


def judged(
    grades: Mapping[str, Grade], *, level: float = 100.0, quiet: float | None = 0.2, capacity: float = 150.0,
    share: float = 0.05, work: int = 0, entries: Mapping[str, tuple[str, ...]] | None = None,
) -> Any:  # fmt: skip
    """A judgement with checks of these grades, which decide alone, and numbers that actions tell."""
    checks = tuple(
        Check(code, f"name of {code}", grade, "…", limit=LIMITS.get(code), overrides=(entries or {}).get(code, ()),
              remedy="Other balls (calculated)." if code in (entries or {}) else None,
              bound="least" if code == "ABU201" else "most")
        for code, grade in grades.items()
    )  # fmt: skip
    run = outcome(level=level, quiet_time=quiet)
    balls = SimpleNamespace(
        capacity=1e-6 * capacity, capacity_ratio=capacity / 100, mass_fraction=share,
        ball_count=4, ball_diameter=0.016, race_radius=0.031,
    )  # fmt: skip
    design = SimpleNamespace(
        autobalancer=balls, case=SimpleNamespace(oil=None, table=machine()), autobalancers=(balls,),
        frequency=SimpleNamespace(balancing_possible=True), checks=(),
    )  # fmt: skip
    facts = SimpleNamespace(design=design, ensemble=Ensemble(DRAG, (run,), ()), searched=None)
    return SimpleNamespace(
        checks=checks, outcomes=(SimpleNamespace(work=work),), facts=facts, level_after=level, arm=None
    )


FAILS: dict[str, Grade] = {"ABU701": "fail", "ABU702": "pass"}
WARNS: dict[str, Grade] = {"ABU701": "warn", "ABU702": "pass"}
PASSES: dict[str, Grade] = {"ABU701": "pass", "ABU702": "pass"}
MOVES_IT: dict[str, Grade] = {"ABU701": "pass", "ABU702": "warn"}
BRINGS_ANOTHER: dict[str, Grade] = {**PASSES, "ABU703": "warn"}


def searched(before: Any, after: list[Mapping[str, Grade]], work: int = 0) -> tuple[NextStep, list[float]]:
    """The next step if the changes of the drag rate lead to these grades, and the drag rates that were judged."""
    calls = list[float]()

    def judged_with(given: Machine, _: Progress, trial: TrialWatcher) -> Any:
        calls.append(drag := given.whole("size").autobalancer.rolling_drag_per_s)
        other = judged(after[int(drag) - 1])
        trial.work += work
        trial.checked(other.checks)
        return other

    refused, tried = (f"{KEY}=-1",), [(f"{KEY}={1 + k}",) for k in range(len(after))]
    judge_by = Judge(judged_with, never)
    return next_step(abu_calc.read(BASE), before, [refused, *tried], judge_by, silent), calls


def never(_: object, member: Member, *__: object, **___: object) -> StartOutcome:
    """No start case is run alone."""
    raise AssertionError(member)


def not_judged(machine: Machine, *_: object) -> Any:
    """No machine is judged."""
    raise AssertionError(machine)


NEVER = Judge(not_judged, never)


@pytest.mark.parametrize(
    ("before", "after", "best", "calls"),
    [
        (FAILS, [MOVES_IT], None, 1),
        (FAILS, [BRINGS_ANOTHER], None, 1),
        (FAILS, [FAILS, FAILS], None, 2),
        (FAILS, [PASSES, PASSES], 1, 1),
        (FAILS, [FAILS, WARNS, MOVES_IT, PASSES, PASSES], 4, 4),
        (FAILS, [WARNS, FAILS, WARNS], 1, 3),
        (WARNS, [WARNS, FAILS, MOVES_IT], None, 3),
        (WARNS, [WARNS, PASSES], 2, 2),
        (PASSES, [PASSES], None, 0),
        ({"ABU701": "not-done"}, [{"ABU701": "fail"}, {"ABU701": "pass"}], 2, 2),
    ],
)
def test_a_change_is_taken_if_the_verdict_gets_better_and_no_check_worse(
    before: dict[str, Grade], after: list[dict[str, Grade]], best: int | None,
    calls: int,
) -> None:  # fmt: skip
    """The first with which all checks pass ends the search; one that only warns is taken if no other passes.

    Nothing is tried for a machine that passes. What the file refuses, a negative drag rate, counts as not tried.
    """
    step, tried = searched(judged(before), after)
    assert (None if step.best is None else step.best.entries) == (None if best is None else (f"{KEY}={best}",))
    assert tried == [1.0 + k for k in range(calls)]
    if best is None:
        assert step.without_success == tuple(f"rolling drag {drag:g} 1/s" for drag in tried)


def test_a_check_that_nobody_asked_for_decides_nothing() -> None:
    before = judged(FAILS)
    watcher = ChangeWatcher(before, RANK.index("fail"), NEVER)
    watcher.checked([OptionalCheck("ABU407", "handles", "fail", "no direction")])
    with pytest.raises(NotBetterError):
        watcher.checked([Check("ABU407", "handles", "warn", "…")])


@pytest.mark.parametrize(("given", "tried"), [(0, 2), (5 * LEAST_WORK, 5)])
def test_all_trials_take_half_the_work_of_the_file_as_it_is(given: int, tried: int) -> None:
    """The trial that exceeds it is the last."""
    step, calls = searched(judged(FAILS, work=given), [FAILS] * 20, work=int(0.6 * LEAST_WORK))
    assert step.hurried, "which is said"
    assert len(calls) == len(step.without_success) == tried and step.best is None


@pytest.mark.parametrize(
    ("entries", "expected"),
    [
        ({"ABU202": ("a.b=1", "c.d=2"), "ABU401": ("a.b=1", "e.f=3")},
         [("a.b=1", "c.d=2"), ("a.b=1", "e.f=3"), ("a.b=1", "c.d=2", "e.f=3")]),
        ({"ABU202": ("a.b=1",), "ABU401": ("a.b=2",)}, [("a.b=1",), ("a.b=2",)]),
        ({"ABU202": ("a.b=1",), "ABU401": ("a.b=1",)}, [("a.b=1",)]),
        ({"ABU201": ("a.b=1",)}, []),
        ({}, []),
    ],
)  # fmt: skip
def test_changes_of_checks_that_do_not_contradict_go_together(
    monkeypatch: pytest.MonkeyPatch, entries: dict[str, tuple[str, ...]], expected: list[tuple[str, ...]]
) -> None:
    """What fails comes first; then those for start cases, by themselves and with all of these; none twice."""
    grades: dict[str, Grade] = {"ABU401": "warn", "ABU202": "fail", "ABU201": "pass"}
    for_starts = {"e.f": 3.0, "g.h": 4.0}
    monkeypatch.setattr(module, "changes_for_starts", lambda *_, **__: [for_starts, for_starts])
    starts = ("e.f=3", "g.h=4")
    with_all = [] if not expected else [tuple(dict.fromkeys((*expected[-1], *starts)))]
    if entries == {"ABU202": ("a.b=1",), "ABU401": ("a.b=2",)}:
        with_all = []
    before = judged(grades, entries=entries)
    assert list(proposals(before)) == [*expected, starts, *with_all]
    before.facts.design.frequency.balancing_possible = False
    assert list(proposals(before)) == expected
    of_others = judged({**grades, "ABU401": "pass"}, entries=entries)
    assert starts not in list(proposals(of_others)), "a start case decides none of the checks that fail"


@pytest.mark.parametrize("with_entries", [(), ("ABU401",), ("ABU103", "ABU401", "ABU702")])
def test_without_a_change_one_check_lists_what_was_tried(with_entries: tuple[str, ...]) -> None:
    """One that fails; the others point to it. An action that entries make is not printed: they were tried."""
    grades: dict[str, Grade] = {"ABU103": "warn", "ABU201": "pass", "ABU401": "fail", "ABU702": "fail"}
    before = judged(grades, entries=dict.fromkeys(with_entries, ("a.b=1",)))
    checks = {check.code: check for check in actions(before, NextStep(None, ("a.b = 1", "c.d = 2 and e.f = 3")))}
    (listing,) = (check for check in checks.values() if "Tried" in (check.remedy or ""))
    assert listing.remedy == "No change was found with which the machine suits. Tried: a.b = 1; c.d = 2 and e.f = 3."
    assert listing.status == "fail" and checks.pop("ABU201") == before.checks[1]
    others = {check.remedy for check in checks.values() if check is not listing}
    assert others == {f"See the action of {listing.code}."} and not any(check.overrides for check in checks.values())


def test_an_action_that_no_entry_makes_stays() -> None:
    own = judged({"ABU401": "fail"})
    own.checks = (replace(own.checks[0], remedy="Specify machine.length_mm."),)
    assert [check.remedy for check in actions(own, NextStep(None))] == ["Specify machine.length_mm."]
    untried = actions(judged({"ABU401": "fail"}), NextStep(None))
    assert [check.remedy for check in untried] == ["No change of the file was found that mends this."]


def test_an_action_tells_its_number_and_what_still_warns() -> None:
    """All that helps is one change, for each check that it helps; a check that it leaves as it is has none."""
    codes = ("ABU401", "ABU702", "ABU701", "ABU103")
    before = judged(dict(zip(codes, ("fail", "fail", "fail", "warn"), strict=True)), level=112.0, quiet=None)
    some = judged(dict(zip(codes, ("pass", "pass", "warn", "warn"), strict=True)), level=100.0, quiet=0.5)
    entries = ("oil.grade=VG 100", "autobalancer.ball_count=5")
    level, time, balance, stable = actions(before, NextStep(Tried(entries, some)))
    then = "(simulated). Then ABU701, ABU103 still warn."
    oil = "Oil VG 100 instead of the assumed one"
    assert level.remedy == f"{oil}: the expected level falls from 112.0 to 100.0 dB {then}"
    assert time.remedy == f"{oil}: the slowest listed start case falls from never to 0.500 s {then}"
    assert balance.remedy == f"{oil}: name of ABU701 then warns {then}"
    assert {check.overrides for check in (level, time, balance)} == {entries} and stable.remedy is None
    every = NextStep(Tried(entries, judged(dict.fromkeys(codes, "pass"))))
    assert all((check.remedy or "").endswith("All checks then pass.") for check in actions(before, every))


def test_the_value_of_a_check_without_a_number_of_its_own_is_told() -> None:
    """Not where it stays, as if the limit alone moved."""
    before, after = judged({"ABU303": "fail"}), judged({"ABU303": "pass"})
    (check,) = before.checks
    for value, text in (
        (150.0, '"name of ABU303" falls from 300 to 150 MPa'),
        (300.0, "name of ABU303 then passes"),
    ):
        before.checks = (replace(check, value=300.0, limit=200.0, unit="MPa"),)
        after.checks = (replace(before.checks[0], status="pass", value=value),)
        (told,) = actions(before, NextStep(Tried(("a.b=1",), after)))
        assert told.remedy == f"A b 1: {text} (simulated). All checks then pass."


def test_changes_that_pin_other_balls_go_together_with_the_first_ones() -> None:
    first, starts = ("autobalancer.ball_count=5", "a.b=1"), ("autobalancer.ball_count=4", "c.d=2")
    both = ("autobalancer.ball_count=5", "a.b=1", "c.d=2")
    assert list(together([first], [starts], [("e.f=1",)])) == [first, ("e.f=1",), starts, both]


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (judged({"ABU401": "fail"}, level=112.0), judged({"ABU401": "pass"}, level=100.0),
         ("vibration.level_after_db", 112.0, 100.0)),
        (judged({"ABU702": "fail"}, quiet=None), judged({"ABU702": "pass"}, quiet=0.5),
         ("ensemble.quiet_time_s.worst", None, 0.5)),
        (judged({"ABU401": "warn", "ABU702": "fail"}, level=112.0, quiet=2.0), judged({"ABU401": "pass"}, quiet=0.5),
         ("ensemble.quiet_time_s.worst", 2.0, 0.5)),
        (judged({"ABU701": "fail"}), judged({"ABU701": "warn"}), ("verdict.word", "does-not-suit", "suits-but")),
        (judged({"ABU702": "fail"}), judged({"ABU702": "pass"}), ("verdict.word", "does-not-suit", "suits")),
        (judged({"ABU203": "fail"}, share=0.09), judged({"ABU203": "pass"}, share=0.07),
         ("autobalancer.mass_fraction", 0.09, 0.07)),
        (judged({"ABU201": "fail"}, capacity=90.0), judged({"ABU201": "pass"}, capacity=120.0),
         ("autobalancer.capacity_g_mm", 90.0, 120.0)),
    ],
)  # fmt: skip
def test_the_promise_is_a_number_that_broke_its_limit_and_keeps_it(
    before: Any, after: Any, expected: tuple[str, float | str | None, float | str]
) -> None:
    """Of the first check that decides the verdict; where no number broke its limit, the word of the verdict."""
    told = promise(before, NextStep(Tried(("a.b=1",), after)))
    assert told is not None and tuple(told) == ("path", "from", "to")
    path, *numbers = expected
    assert told["path"] == path
    assert [told["from"], told["to"]] == [pytest.approx(x) if isinstance(x, float) else x for x in numbers]
    assert promise(before, NextStep(None)) is None


@cache
def pinned() -> Design:
    return size(machine(**PINNED))


def test_the_worst_start_cases_that_fail_are_repeated_first() -> None:
    """At the drag rate of the change, as far from it as before; not those that place other balls.

    What is not promised only where nothing may warn.
    """
    design, ran = pinned(), list[Member]()
    drag = design.case.drag
    shares = [0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    bad = [outcome(Member("spread", share * drag, promised=share != 6.0), quiet_time=1.1 + share) for share in shares]
    placed = outcome(Member("placed", drag, angles=(0.0, 1.0, 2.0)), quiet_time=9.0)
    outcomes = (outcome(Member("behind", drag)), *bad, placed)
    before: Any = SimpleNamespace(checks=(), outcomes=outcomes, facts=SimpleNamespace(design=design))
    thicker = replace(design, case=replace(design.case, drag=3 * drag))

    def repeated(result: Callable[[Member], StartOutcome], grade: Grade = "fail") -> ChangeWatcher:
        ran.clear()

        def once(_: object, member: Member, **__: object) -> StartOutcome:
            ran.append(member)
            return result(member)

        trial = ChangeWatcher(before, RANK.index(grade), Judge(NEVER.judged, once))
        trial.repeated(thicker)
        return trial

    trial = repeated(lambda member: replace(outcome(member), work=7))
    worst = sorted(bad, key=lambda run: -run.quiet_time_or_inf)
    promised = [3 * run.member.drag for run in worst if run.member.promised]
    assert [member.drag for member in ran] == pytest.approx(promised[: REPEATED - 1]) and trial.work == 7 * len(ran)
    repeated(outcome, "warn")
    assert [member.drag for member in ran] == pytest.approx([3 * run.member.drag for run in worst[: REPEATED - 1]])
    with pytest.raises(NotBetterError):
        repeated(lambda member: outcome(member, quiet_time=1.01))
    assert len(set(ran)) == 1, "the first that still fails ends the trial"


@pytest.mark.parametrize(
    ("values", "grade", "slack", "runs"),
    [
        ({"quiet_time": None}, "fail", 0.3, 0),
        ({"quiet_time": 3.0}, "fail", 0.3, 0),
        ({"quiet_time": 1.01}, "fail", 0.3, 1),
        ({"level": 108.9}, "warn", 0.3, 1),
        ({"level": 108.9}, "warn", 0.0, None),
        ({"level": 108.9}, "fail", 0.3, None),
        ({"creeping": True}, "warn", 0.3, 1),
        ({"creeping": True}, "fail", 0.3, None),
        ({"quiet_time": 0.9, "level": 108.0}, "warn", 0.3, None),
    ],
)
def test_a_start_case_ends_a_trial_where_a_check_would_warn(
    values: dict[str, Any], grade: Grade, slack: float, runs: int | None
) -> None:
    """Of a change after which all must pass; near its limits it is run again at a tighter tolerance. None: it holds."""
    design, again = pinned(), list[Member]()

    def once(_: object, member: Member, **__: object) -> StartOutcome:
        again.append(member)
        return replace(bad, work=3)

    bad = replace(outcome(Member("spread", design.case.drag)), work=5, **values)
    before: Any = SimpleNamespace(checks=(), outcomes=(), facts=SimpleNamespace(design=design))
    trial = ChangeWatcher(before, RANK.index(grade), Judge(not_judged, once, slack))
    if runs is None:
        trial.seen(design, bad)
        assert trial.held == 1 and not again
        return
    with pytest.raises(NotBetterError):
        trial.seen(design, bad)
    assert len(again) == runs and 0 <= trial.held < 1 and trial.work == 5 + 3 * runs


def test_a_start_case_that_ended_a_trial_comes_first_in_the_next_one() -> None:
    """At the drag rate that hot oil has then; none at a speed or in a run-up that the change takes away."""
    design, ran = pinned(), list[Member]()
    drag = design.case.drag
    hot, risen = Member("spread", drag / 3), Member("run-up", drag, run_up=1.0)
    before: Any = SimpleNamespace(checks=(), outcomes=(), facts=SimpleNamespace(design=design))
    refuting = list[tuple[Any, Member]]()

    def trial() -> ChangeWatcher:
        return ChangeWatcher(before, RANK.index("warn"), Judge(not_judged, once), refuting=refuting)

    def once(_: object, member: Member, **__: object) -> StartOutcome:
        ran.append(member)
        return outcome(member)

    for member in (risen, hot):
        with pytest.raises(NotBetterError):
            trial().seen(design, outcome(member, quiet_time=9.0))
    assert [member for _, member in refuting] == [hot, risen]
    oil = size(machine(**PINNED, oil={"grade": "VG 100", "fill_ml": 1.0}, run_up={"time_s": 0.5}))
    trial().repeated(oil)
    assert [member.drag for member in ran] == pytest.approx([oil.case.drag_shares[1] * oil.case.drag])


def test_the_least_race_eccentricity_is_probed_before_all_others() -> None:
    """If it is refused, so are the others. Two changes together take the truer race."""
    races = tuple((f"autobalancer.race_eccentricity_mm={value}",) for value in (0.009, 0.008, 0.007))
    _, tried = step_of({}, {}, changes=races)
    assert tried == [races[-1]]
    _, tried = step_of({races[-1]: WARNS}, {}, changes=races)
    assert tried[0] == races[-1] and tried.count(races[0]) == 1
    assert _as_one(races[0], (RUN_OUT,)) == (RUN_OUT,) == _as_one((RUN_OUT,), races[0])


def test_a_trial_that_seems_to_help_may_take_longer() -> None:
    """Where the start cases that fail as the file is hold with the change."""
    design = pinned()
    late, later, good = (outcome(Member("spread", time * design.case.drag), quiet_time=time) for time in (1.5, 2, 0.5))
    for runs, most in (((late, later), PROMISING), ((), 10.0)):
        before: Any = SimpleNamespace(checks=(), outcomes=runs, facts=SimpleNamespace(design=design))
        trial = ChangeWatcher(before, RANK.index("fail"), Judge(not_judged, lambda *_, **__: good), 10.0)
        trial.repeated(design)
        assert trial.most == most and trial.held == len(runs)


def step_of(
    grades: Mapping[tuple[str, ...], Mapping[str, Grade]], held: Mapping[tuple[str, ...], float], work: int = 1,
    changes: tuple[tuple[str, ...], ...] = ((FRICTION,), (RUN_OUT,), (THICK,)),
) -> tuple[NextStep, list[tuple[str, ...]]]:  # fmt: skip
    """The next step of a machine that fails, and the changes that were tried; those without grades leave it as it is.

    `held`: start cases that hold with a change before it ends.
    """
    tried = list[tuple[str, ...]]()

    def judged_with(given: Machine, _: Progress, trial: TrialWatcher) -> Any:
        entries = tuple(f"{override.key}={override.value}" for override in given.overrides)
        tried.append(entries)
        trial.work, trial.held = work, held.get(entries, 0.0)
        other = judged(grades.get(entries, FAILS))
        trial.checked(other.checks)
        return other

    return next_step(abu_calc.read(BASE), judged(FAILS), changes, Judge(judged_with, never), silent), tried


def test_two_changes_with_which_most_start_cases_hold_go_together_at_last() -> None:
    """The best two first, none twice; what held none is left out, and so are two that contradict each other."""
    held = {(FRICTION,): 2.5, (RUN_OUT,): 0.4, (THICK,): 7.0}
    both = (THICK, FRICTION)
    step, tried = step_of({both: PASSES}, held)
    assert step.best is not None and step.best.entries == both
    assert tried == [(FRICTION,), (RUN_OUT,), (THICK,), both]
    _, tried = step_of({}, held)
    assert tried[3:] == [both, (THICK, RUN_OUT), (FRICTION, RUN_OUT)]
    _, tried = step_of({}, {(FRICTION,): 1.0})
    assert len(tried) == 3
    _, tried = step_of({}, {(THICK,): 1.0, (f"{KEY}=9",): 2.0}, changes=((THICK,), (f"{KEY}=9",)))
    assert len(tried) == 2


def test_changes_are_tried_with_one_that_helps_too() -> None:
    """Its work is not charged: the others may take as much as without it."""
    step, tried = step_of({(FRICTION,): WARNS, (FRICTION, THICK): PASSES}, {}, work=int(0.3 * LEAST_WORK))
    assert step.best is not None and step.best.entries == (FRICTION, THICK)
    assert tried == [(FRICTION,), (RUN_OUT,), (FRICTION, RUN_OUT), (THICK,), (FRICTION, THICK)]


def test_a_trial_ends_before_further_start_cases_where_a_listed_one_warns(monkeypatch: pytest.MonkeyPatch) -> None:
    tables = machine(**PINNED)
    drag = pinned().case.drag
    late = Ensemble(drag, (outcome(Member("spread", drag)), outcome(Member("spread", drag / 3), quiet_time=1.5)), ())
    monkeypatch.setattr(judgement, "simulate_members", lambda *_, **__: late)
    monkeypatch.setattr(judgement, "search", lambda *_, **__: pytest.fail("further start cases were simulated"))
    before: Any = SimpleNamespace(checks=(), outcomes=(), facts=SimpleNamespace(design=pinned()))
    with pytest.raises(NotBetterError):
        judge(tables, 0.01, silent, 1, trial=ChangeWatcher(before, RANK.index("warn"), NEVER))


def at(document: Mapping[str, Any], path: str) -> Any:
    """The value at a path of a result; None if something on it is."""
    return reduce(lambda part, key: None if part is None else part[key], path.split("."), document)


@pytest.mark.slow
def test_each_number_is_the_one_at_its_path() -> None:
    """Of a machine in oil, with start cases in hot and cold oil and further ones."""
    given = abu_calc.read(WARNS_IN_HOT_OIL)
    document = abu_calc.size(given).to_dict()
    own = judge(given.whole("size"), 0.01, silent, 1)
    for number in (number for numbers in NUMBERS.values() for number in numbers):
        assert at(document, number.path) == number.of(own), number.path


HAND_GRINDER = """[machine]
name = "hand grinder"
layout = "straight"
mass_kg = 4.5
speed_rpm = 6000
spindle_axis = "horizontal"
[suspension]
model = "springs"
natural_frequencies_hz = [3, 3]
damping_ratios = [0.4, 0.4]
[wheel]
mass_kg = 0.3
diameter_mm = 180
imbalance_g_mm = 120
[autobalancer]
max_outer_diameter_mm = 70
max_width_mm = 18
bore_diameter_mm = 14
"""
WARNS_IN_HOT_OIL = f"""{HAND_GRINDER}
[oil]
grade = "VG 46"
fill_ml = 1
"""
RACE_IS_NOT_TRUE = f"{HAND_GRINDER}race_eccentricity_mm = 0.02\n"
BOLTED = HAND_GRINDER.replace("[3, 3]", "[130, 130]").replace("[0.4, 0.4]", "[0.04, 0.04]")


def followed(text: str, folder: Path) -> tuple[dict[str, Any], dict[str, Any] | None]:
    """The document of a file, and that of the next command that it prints, run literally."""
    file = folder / "my machine.toml"
    file.write_text(text, encoding="utf-8")
    before = abu("size", str(file), "--json").document
    command = before["result"]["verdict"]["next"]
    if command is None:
        return before, None
    program, *words = shlex.split(command)
    assert program == "abu" and words[:2] == ["size", str(file)]
    return before, abu(*words, "--json").document


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "word", "keys"),
    [
        (WARNS_IN_HOT_OIL, "suits-but", ["oil.grade", "oil.viscosity_index"]),
        (RACE_IS_NOT_TRUE, "does-not-suit", ["autobalancer.race_eccentricity_mm"]),
    ],
)
def test_the_next_command_keeps_its_promise(text: str, word: str, keys: list[str], tmp_path: Path) -> None:
    """An oil by grade and index, not a drag rate; a truer race. No check gets worse, and the number is the one told."""
    before, after = followed(text, tmp_path)
    verdict = before["result"]["verdict"]
    assert verdict["word"] == word and after is not None and after["result"]["verdict"]["word"] == "suits"
    entries = [entry.partition("=")[0] for entry in shlex.split(verdict["next"])[4::2]]
    assert sorted(entries) == sorted([*keys, *(f"autobalancer.{pin}" for pin in PINS)])
    told = verdict["promise"]
    assert at(before["result"], told["path"]) == told["from"] and told["to"] is not None
    assert math.isclose(at(after["result"], told["path"]), told["to"], rel_tol=1e-9)
    grades = {(check["code"], check["name"]): RANK.index(check["status"]) for check in before["checks"]}
    assert all(RANK.index(check["status"]) >= grades[check["code"], check["name"]] for check in after["checks"])


@pytest.mark.slow
def test_a_machine_below_its_resonance_gets_no_change(tmp_path: Path) -> None:
    """The sentence says so, and no action has entries; a rated speed that the work needs is none to change."""
    before, after = followed(BOLTED, tmp_path)
    verdict = before["result"]["verdict"]
    assert after is None and (verdict["word"], verdict["next"], verdict["promise"]) == ("does-not-suit", None, None)
    assert verdict["sentence"].endswith("No change of the file was found that mends it.")
    assert not any("Set " in (check["remedy"] or "") for check in before["checks"])


@pytest.mark.slow
def test_workers_change_nothing_of_the_next_step() -> None:
    """Starts that run beside the one that ends a trial count no work, or all of it."""
    machine = abu_calc.read(str(Path(__file__).parents[2] / "machines" / "hanging-balls.toml"))
    alone, beside = (abu_calc.size(machine, workers=workers).verdict for workers in (1, 3))
    assert alone == beside and alone.next is not None


@pytest.mark.slow
def test_a_machine_that_fails_by_a_seat_alone_gets_its_tolerance_class() -> None:
    """6203 on g6 creeps under the rotating load; j5 is the class of the makers' catalogue."""
    bearing = {"designation": "6203", "shaft_fit": "g6", "housing_fit": "H7", "radial_load_kN": 0.8}
    machine = abu_calc.read("avtovaz-707-222").changed({"bearing": [bearing]})
    verdict = abu_calc.size(machine).verdict
    assert verdict.word == "does-not-suit" and "bearing.0.shaft_fit=j5" in (verdict.next or "")
    assert abu_calc.size(variant_of(machine, "bearing.0.shaft_fit=j5")).verdict.word == verdict.promise["to"]
