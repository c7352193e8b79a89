"""Checks of many start cases: which start decides, and what is said of those without an answer."""

from dataclasses import replace
from functools import cache

import pytest

from abu_calc.features.design.start_rules import StartFacts, checks_of_starts, level_check
from abu_calc.foundation.checks import Check, Finding, coded
from abu_calc.simulation.start_cases import ALIKE, SLACK, Ensemble, Lost, Member, StartOutcome
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import PINNED, machine

DRAG = 10.0
CLOSED = Finding("pass", "closed", 105.0, 109.0)


@cache
def design() -> Design:
    return size(machine(**PINNED))


def outcome(member: Member | None = None, **changed: float | None) -> StartOutcome:
    """A start that passes, unless it is changed."""
    given = {"settling_time": 0.5, "quiet_time": 0.2, "rest_time": 0.6, "creeping": False, "residual": 1e-5,
             "level": 100.0, "slip": 0.0, "imbalance": 1e-5, "allowed": 3e-5}  # fmt: skip
    return StartOutcome(member or Member("bunched", DRAG), **{**given, **changed})  # type: ignore[arg-type]


def by_code(*outcomes: StartOutcome, lost: tuple[Lost, ...] = ()) -> dict[str, Check]:
    """Checks by code."""
    return {check.code: check for check in checks_of_starts(StartFacts(design(), Ensemble(DRAG, outcomes, lost)))}


def test_the_worst_start_stands_beside_its_limit() -> None:
    balance = by_code(outcome(), outcome(Member("spread", DRAG), imbalance=4e-5, quiet_time=1.5))["ABU701"]
    assert (balance.status, balance.value, balance.limit) == ("fail", pytest.approx(40.0), pytest.approx(30.0))
    assert "1 of 2 start cases balance. 1 does not: spread, given drag rate 10 1/s" in balance.message
    assert balance.remedy is None, "what helps is told by the change that was tried"


@pytest.mark.parametrize(
    ("changed", "passes"),
    [
        ({}, True),
        ({"level": 109.0, "quiet_time": 1.0}, True),
        ({"level": 109.01}, False),
        ({"quiet_time": 1.01}, False),
        ({"imbalance": 4e-5}, False),
        ({"rest_time": 1.01}, False),
    ],
)
def test_listed_start_cases_pass_by_those_at_the_given_drag_rate(changed: dict[str, float], passes: bool) -> None:
    limited = size(machine(**PINNED, limits={"rest_time_s": 1.0}))
    for drag in (DRAG, 3 * DRAG):
        bad = outcome(Member("spread", drag), **changed)
        facts = StartFacts(limited, Ensemble(DRAG, (outcome(), bad), ()))
        assert facts.listed_pass is (passes or drag != DRAG)
        facts = StartFacts(limited, Ensemble(DRAG, (outcome(),), (Lost(bad.member, "no answer", 1),)))
        assert facts.listed_pass is (drag != DRAG)
    late = StartFacts(design(), Ensemble(DRAG, (outcome(rest_time=1.01),), ()))
    assert late.listed_pass, "rest counts only if the file limits it"


def test_only_the_first_start_case_is_named() -> None:
    failing = [outcome(Member(start, DRAG), imbalance=4e-5) for start in ("bunched", "behind", "spread", "standstill")]
    message = by_code(*failing)["ABU701"].message
    assert "0 of 4 start cases balance. 4 do not: one is bunched, given drag rate 10 1/s." in message


def test_the_race_centre_is_named_unless_it_is_opposite_the_imbalance() -> None:
    alike = outcome(Member("spread", DRAG, eccentricity=ALIKE), quiet_time=1.5)
    assert "spread, race centre 0°, given drag rate" in by_code(alike)["ABU702"].message
    assert "race centre" not in by_code(outcome(Member("spread", DRAG), quiet_time=1.5))["ABU702"].message


def test_a_machine_that_is_never_quiet_has_no_number() -> None:
    check = by_code(outcome(quiet_time=None))["ABU702"]
    assert (check.status, check.value, check.limit) == ("fail", None, 1.0) and "10 1/s, never" in check.message
    assert by_code(outcome(settling_time=None))["ABU702"].status == "pass", "the old yardstick is told, not judged"


def test_rest_is_judged_only_if_the_file_limits_it() -> None:
    late = outcome(rest_time=1.7)
    told = by_code(late)["ABU702"]
    assert told.status == "pass" and told.message.endswith("The balls rest after 1.70 s at the latest")
    for longest, status in ((1.8, "pass"), (1.6, "fail")):
        limited = size(machine(**PINNED, limits={"rest_time_s": longest}))
        facts = StartFacts(limited, Ensemble(DRAG, (outcome(), late), ()))
        judged = {one.code: one for one in checks_of_starts(facts)}["ABU702"]
        assert (judged.status, judged.value) == (status, 0.2) and f"(limit {longest:g} s)" in judged.message
    creeps = Ensemble(DRAG, (outcome(), outcome(rest_time=None, creeping=True)), ())
    assert {one.code: one for one in checks_of_starts(StartFacts(limited, creeps))}["ABU702"].status == "fail"
    other = Ensemble(DRAG, (outcome(), outcome(Member("bunched", 3 * DRAG), rest_time=1.7)), ())
    assert {one.code: one for one in checks_of_starts(StartFacts(limited, other))}["ABU702"].status == "warn"


def test_balls_that_still_creep_warn_unless_they_stall() -> None:
    creeping = outcome(Member("behind", DRAG), creeping=True, rest_time=None)
    check = by_code(outcome(), creeping)["ABU702"]
    assert (check.status, check.value) == ("warn", 0.2)
    assert "The balls still creep at the end of 1 start case: behind" in check.message
    assert by_code(outcome(creeping=True, quiet_time=1.5))["ABU702"].status == "fail"
    assert "creep" not in by_code(outcome(creeping=True, slip=0.5))["ABU702"].message


def test_hanging_starts_are_counted() -> None:
    check = by_code(outcome(), outcome(Member("behind", DRAG), slip=0.5))["ABU704"]
    assert (check.status, check.value, check.limit) == ("fail", 1.0, 0.0) and "behind" in check.message


def test_what_was_left_out_passes_nothing() -> None:
    """What fails with one start case fails; without any nothing is known of them."""
    one = Ensemble(DRAG, (outcome(quiet_time=1.5),), ())
    left_out = {check.code: check for check in checks_of_starts(StartFacts(design(), one, starts="one"))}
    assert {code: check.status for code, check in left_out.items()} == {
        "ABU701": "not-done", "ABU702": "fail", "ABU704": "not-done"
    }  # fmt: skip
    assert left_out["ABU704"].message == (
        'No ball stalls in any start case. Start cases were left out: starts="one"'
    ) and left_out["ABU704"].value == 0.0  # fmt: skip
    facts = StartFacts(design(), None, starts="none")
    assert {check.message for check in checks_of_starts(facts)} == {'Start cases were left out: starts="none"'}
    check = level(CLOSED, None, starts="none")
    assert (check.status, check.value) == ("not-done", 105.0) and check.message.startswith(
        "closed. Start cases were left"
    )
    assert level(CLOSED._replace(status="fail"), None, starts="none").status == "fail"


def level(closed: Finding, ensemble: Ensemble | None, starts: str = "full") -> Check:
    """The check of the idle level with another one by sizing."""
    return level_check(StartFacts(replace(design(), level=closed), ensemble, starts=starts))


def test_the_level_stays_as_it_is_without_starts_or_numbers() -> None:
    assert level(CLOSED, None) == coded("ABU401", *CLOSED)
    undone = Finding("not-done", "not known", None, 109.0)
    assert level(undone, Ensemble(DRAG, (outcome(level=120.0),), ())) == coded("ABU401", *undone)


def test_a_loud_start_at_another_drag_warns() -> None:
    starts = Ensemble(DRAG, (outcome(), outcome(Member("spread", 3 * DRAG), level=112.0)), ())
    check = level(CLOSED, starts)
    assert (check.status, check.value) == ("warn", 112.0)
    assert "112.0 dB (limit 109 dB), spread, drag rate 30 1/s (cold oil)" in check.message


def test_a_level_within_its_error_below_the_limit_warns() -> None:
    """The start case at the given drag rate or at another one; farther below, the level passes."""
    for drag in (DRAG, 3 * DRAG):
        near = outcome(Member("spread", drag), level=109.0 - 0.9 * SLACK)
        check = level(CLOSED, Ensemble(DRAG, (outcome(), near), ()))
        assert check.status == "warn" and "leaves open whether the limit is kept" in check.message
        far = outcome(Member("spread", drag), level=109.0 - 1.1 * SLACK)
        assert level(CLOSED, Ensemble(DRAG, (outcome(), far), ())).status == "pass"
