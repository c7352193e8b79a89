"""Checks of many start cases: which start decides, and what is said of those without an answer."""

from functools import cache

import pytest

from abu_calc.foundation.checks import Check, coded
from abu_calc.simulation.ensemble_checks import ensemble_checks, level_check, not_simulated
from abu_calc.simulation.ensemble_results import Ensemble, Lost, StartOutcome
from abu_calc.simulation.start_cases import ALIKE, Member
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import PINNED, machine

DRAG = 10.0
CLOSED = coded("ABU401", "pass", "closed", 105.0, 109.0, "dB")


@cache
def design() -> Design:
    return size(machine(**PINNED))


def outcome(member: Member | None = None, **changed: float | None) -> StartOutcome:
    """A start that passes, unless it is changed."""
    given = {"settling_time": 0.5, "residual": 1e-5, "level": 100.0, "slip": 0.0, "imbalance": 1e-5, "allowed": 3e-5}
    return StartOutcome(member or Member("bunched", DRAG), **{**given, **changed})  # type: ignore[arg-type]


def by_code(*outcomes: StartOutcome, lost: tuple[Lost, ...] = (), remedy: str | None = None) -> dict[str, Check]:
    return {check.code: check for check in ensemble_checks(design(), Ensemble(DRAG, outcomes, lost), remedy)}


def test_the_worst_start_stands_beside_its_limit() -> None:
    checks = by_code(outcome(), outcome(Member("spread", DRAG), imbalance=4e-5), remedy="Try more oil.")
    balance = checks["ABU701"]
    assert (balance.status, balance.value, balance.limit) == ("fail", pytest.approx(40.0), pytest.approx(30.0))
    assert "1 of 2 starts balance; not from spread at a drag of 10 1/s" in balance.message
    assert balance.remedy == "Try more oil." and checks["ABU702"].remedy == "See ABU701."


def test_only_the_first_two_starts_are_named() -> None:
    failing = [outcome(Member(start, DRAG), imbalance=4e-5) for start in ("bunched", "behind", "spread", "standstill")]
    message = by_code(*failing)["ABU701"].message
    assert "from bunched" in message and "behind" in message and "and 2 more" in message and "spread" not in message


def test_the_race_centre_is_named_unless_it_is_opposite_the_imbalance() -> None:
    alike = outcome(Member("spread", DRAG, eccentricity=ALIKE), settling_time=1.5)
    assert "spread, race centre 0°, at a drag" in by_code(alike)["ABU702"].message
    assert "race centre" not in by_code(outcome(Member("spread", DRAG), settling_time=1.5))["ABU702"].message


def test_balls_that_never_settle_have_no_number() -> None:
    check = by_code(outcome(settling_time=None))["ABU702"]
    assert (check.status, check.value, check.limit) == ("fail", None, 1.0)


def test_hanging_starts_are_counted() -> None:
    check = by_code(outcome(), outcome(Member("behind", DRAG), slip=0.5))["ABU704"]
    assert (check.status, check.value, check.limit) == ("fail", 1.0, 0.0) and "behind" in check.message


def test_the_level_stays_as_it_is_without_starts_or_numbers() -> None:
    assert level_check(CLOSED, None) is CLOSED
    undone = coded("ABU401", "not-done", "not known", None, 109.0, "dB")
    assert level_check(undone, Ensemble(DRAG, (outcome(level=120.0),), ())) is undone


def test_a_loud_start_at_another_drag_warns() -> None:
    starts = Ensemble(DRAG, (outcome(), outcome(Member("spread", 3 * DRAG), level=112.0)), ())
    check = level_check(CLOSED, starts)
    assert (check.status, check.value) == ("warn", 105.0)
    assert "spread at a drag of 30 1/s: 112.0 dB" in check.message


def test_a_scene_that_was_not_simulated_passes_nothing() -> None:
    assert not_simulated("grinding", "chaotic").status == "not-done"
    assert not_simulated("grinding", "chaotic", answered=True).status == "not-done"
    assert not_simulated("idle", "chaotic", answered=True).status == "warn"
    check = not_simulated("grinding", "chaotic", mean="104 dB on average")
    assert (check.status, check.message) == ("warn", "104 dB on average") and check.name.endswith("grinding")
