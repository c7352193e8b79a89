"""Starts that nobody listed: they cover the race, they find what the listed ones miss, and each can be repeated."""

import math
import shlex
import tempfile
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.features.design import judgement, start_search
from abu_calc.features.design.start_rules import RULES, StartFacts
from abu_calc.features.design.start_search import (
    NEAR,
    PARTS,
    PLACES,
    SPEED_STEP,
    SPREADS,
    SearchResult,
    at_near_speeds,
    at_other_speeds,
    design_part,
    designed,
    exceeded,
    neighbours,
    search,
    tail_shape,
)
from abu_calc.features.design.starts import worst_further
from abu_calc.foundation.checks import Check, Finding, coded
from abu_calc.foundation.patience import limited
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.start_cases import ALIKE, SLACK, Member, StartOutcome, members
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.cli.runner import abu
from tests.remembered import recalled
from tests.studies.random_machines import family_of, machine_text

DESIGNED = 2 * PLACES + SPREADS + SPREADS // 3
"""How many there are."""

MACHINES = Path(__file__).parents[2] / "machines"


@cache
def design(name: str) -> Design:
    """Of a preset or a machine of the tests."""
    file = MACHINES / f"{name}.toml"
    return size(read_machine(str(file) if file.exists() else name).whole("size"))


def design_of(text: str, *overrides: str) -> Design:
    """Of the text of a file, with entries replaced."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "machine.toml"
        file.write_text(text, encoding="utf-8")
        return size(read_machine(str(file), overrides).whole("size"))


@pytest.mark.few(1)
@pytest.mark.parametrize("name", ["avtovaz-707-222", "swing-arm-grinder", "late-run-up-hands"])
def test_designed_starts_cover_the_race_without_overlap(name: str) -> None:
    """Bunches all round, every other one in a run-up, the race off to both sides of each kind."""
    found = design(name)
    starts, half = list(designed(found)), found.autobalancer.half_angle
    assert len(set(starts)) == len(starts) == DESIGNED
    for start in starts:
        angles = sorted(start.angles)
        gaps = [b - a for a, b in pairwise([*angles, angles[0] + math.tau])]
        assert min(gaps) > 2 * half * (1 - 1e-9)
    middles = sorted(start.angles[0] for start in starts[: 2 * PLACES : 2])
    assert max(b - a for a, b in pairwise(middles)) < math.tau / PLACES + 1e-9
    for kind in (False, True):
        assert len({start.eccentricity for start in starts if bool(start.run_up) is kind}) == 2


@pytest.mark.slow
def test_a_range_is_started_at_both_ends_and_in_the_middle() -> None:
    """The upper end is the rated speed, which the designed starts have. In the search the speed moves within the
    range.
    """
    found = design("late-between-speeds")
    low, high = found.case.speed_range
    starts = list(at_other_speeds(found))
    assert found.case.speed == high and {start.speed for start in starts} == {low, (low + high) / 2}
    assert len(set(starts)) == len(starts) == 2 * (SPREADS + SPREADS // 3)
    near = [start.speed for start in at_near_speeds(starts[0], found)]
    assert len(near) == 1 and near[0] is not None and low < near[0] < high
    assert [start.speed for start in at_near_speeds(next(designed(found)), found)] == pytest.approx(
        [high - SPEED_STEP * (high - low)]
    )
    for single in ("avtovaz-707-222", "motor-no-load-speed"):
        machine = design(single)
        assert not list(at_other_speeds(machine))
        assert not [start for first in designed(machine) for start in at_near_speeds(first, machine)]


def made(code: str, listed: Finding, searched: SearchResult | None, found: Design) -> Check:
    """The check by what the listed start cases say and by further ones."""
    (rule,) = (rule for rule in RULES if rule.code == code)
    return rule.check(StartFacts(found, None, searched), listed)


def test_a_level_within_its_error_of_the_limit_warns() -> None:
    """A run below the limit by less than the error of a simulated level does not prove that the limit is kept."""
    found, listed = design("avtovaz-707-222"), Finding("pass", "as listed", 1.0, 2.0)
    limit = found.case.level_limit
    assert made("ABU401", listed, SearchResult((outcome(0.1, level=limit - 1.1 * SLACK),)), found).status == "pass"
    told = made("ABU401", listed, SearchResult((outcome(0.1, level=limit - 0.9 * SLACK),)), found)
    assert told.status == "warn" and "Further start cases: 1 of 1 may be too loud" in told.message


def test_neighbours_are_near_and_other() -> None:
    found = design("late-run-up-hands")
    for start in designed(found):
        near = list(neighbours(start))
        assert start not in near and len(set(near)) == len(near) >= 4
        assert all(other.drag == start.drag for other in near)
    corner = Member("behind", 10.0)
    assert [other.eccentricity for other in neighbours(corner)] == [ALIKE], "no ball of it is placed"


@pytest.mark.slow
def test_the_search_is_the_same_whatever_the_workers() -> None:
    found = design("avtovaz-707-305")
    alone, together = search(found, 0.01), search(found, 0.01, workers=3)
    assert alone == together and len(alone.outcomes) >= DESIGNED


@pytest.mark.few(0, 1)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["late-bunched-elsewhere", "late-run-up-hands"])
def test_balls_that_rest_late_may_be_quiet_soon(name: str) -> None:
    """A further start case has balls that find their places after the limit, or nearly; nobody hears that."""
    sized = recalled("size", abu_calc.read(str(MACHINES / f"{name}.toml")))
    assert sized.ensemble is not None and sized.ensemble.further_starts is not None
    further, (check,) = sized.ensemble.further_starts, (check for check in sized.checks if check.code == "ABU702")
    assert further.rest_time_s is None or further.rest_time_s > 1.0
    assert further.quiet_time_s is not None and further.quiet_time_s < 0.5
    assert check.status == "pass" and further.repeats == ()


@pytest.mark.slow
def test_what_the_listed_starts_miss_fails_and_can_be_repeated() -> None:
    """By the very options that the report prints, with the very time it says; the action is no such command."""
    file = str(MACHINES / "late-between-speeds.toml")
    sized = recalled("size", abu_calc.read(file))
    (check,) = (check for check in sized.checks if check.code == "ABU702")
    assert check.status == "fail" and check.remedy and "start.angles_deg" not in check.remedy
    time = float(check.message.rsplit("quiet after ", 1)[1].partition(" s")[0])
    assert sized.ensemble is not None and sized.ensemble.further_starts is not None
    further = sized.ensemble.further_starts
    assert f"of {further.members} are late: the slowest is quiet after {further.quiet_time_s:.3g} s" in check.message
    (line,) = (each.options for each in further.repeats if each.check == "ABU702")
    again = abu("simulate", file, *shlex.split(line), "--json").document
    assert again["result"]["quiet_time_s"] == pytest.approx(time, rel=0.02)


def outcome(
    time: float, level: float = 90.0, imbalance: float = 1.0, slip: float = 0.0, settling: float = 9.0
) -> StartOutcome:
    """Of a start of the preset, allowed 2, quiet after a time; when |U| settles decides nothing."""
    member = next(designed(design("avtovaz-707-222")))
    quiet = None if math.isinf(time) else time
    return StartOutcome(member, settling, quiet, quiet, False, 0.0, level, slip, imbalance, 2.0)


@pytest.mark.parametrize(
    ("code", "bad"),
    [
        ("ABU401", outcome(0.1, level=120.0)),
        ("ABU701", outcome(0.1, imbalance=3.0)),
        ("ABU702", outcome(1.1)),
        ("ABU702", outcome(math.inf)),
        ("ABU704", outcome(0.1, slip=0.5)),
    ],
)
def test_each_check_is_broken_by_its_own(code: str, bad: StartOutcome) -> None:
    """A pass becomes a warning, by a promised start that a closer run confirms a failure; what failed or was not done
    stays, and what breaks nothing changes nothing.
    """
    found, good = design("avtovaz-707-222"), outcome(0.1)
    for status in ("pass", "warn", "fail", "not-done"):
        listed = Finding(status, "as listed", 1.0, 2.0)
        check = coded(code, *listed)
        assert made(code, listed, SearchResult((good,)), found) == check == made(code, listed, None, found)
        told = made(code, listed, SearchResult((good, bad)), found)
        if status in ("fail", "not-done"):
            assert told == check
        else:
            assert told.status == "warn" and told.message.startswith("as listed. Further start cases: 1 of 2")
            surely = made(code, listed, SearchResult((good, replace(bad, confirmed=True))), found)
            assert surely.status == "fail" and surely.message == told.message
            of_usual = replace(bad, confirmed=True, member=replace(bad.member, promised=False))
            if code == "ABU701":  # more friction leaves more, and that is no matter where the machine is quiet
                assert made(code, listed, SearchResult((good, of_usual)), found) == check
                of_usual = replace(of_usual, quiet_time=None)
            assert made(code, listed, SearchResult((good, of_usual)), found) == told
            assert code in [each.check for each in worst_further(SearchResult((good, bad)), found)]
    passed = Finding("pass", "as listed", 1.0, 2.0)
    assert made(code, passed, SearchResult((good,), lost=1), found).status == "warn"
    assert made(code, passed, SearchResult((good,), lost=1, hurried=True), found).status == "not-done"


def test_further_balls_that_still_creep_warn() -> None:
    """Followed for ten times the limit they have no time of rest: that is no failure, but it is told."""
    found, listed = design("avtovaz-707-222"), Finding("pass", "as listed", 0.2, 1.0)
    creeping = replace(outcome(0.1), creeping=True, rest_time=None, confirmed=True)
    told = made("ABU702", listed, SearchResult((outcome(0.2), creeping)), found)
    assert (
        told.status == "warn" and "1 of 2 are late or still creep" in told.message and "at rest never" in told.message
    )


def test_a_long_tail_of_quiet_times_warns_before_one_is_too_late() -> None:
    """Balls that linger leave as e^{λt}: of 40 times with that tail the rare ones are foreseen within 25 %."""
    found, listed = design("avtovaz-707-222"), Finding("pass", "as listed", 0.2, 1.0)
    quiet = SearchResult(tuple(outcome(0.1 + 0.01 * k) for k in range(24)))
    assert made("ABU702", listed, quiet, found).status == "pass"
    lingering = SearchResult(quiet.outcomes[:20], listed=tuple(outcome(time) for time in (0.5, 0.6, 0.7, 0.9)))
    told = made("ABU702", listed, lingering, found)
    assert told.status == "warn" and "one of 1000 takes" in told.message
    times = [0.1 - 0.2 * math.log(1 - (k + 0.5) / 40) for k in range(40)]
    assert exceeded(times, 1e-3) == pytest.approx(0.1 + 0.2 * math.log(1000), rel=0.25)
    assert exceeded([*times, math.inf], 1e-3) == math.inf and exceeded([], 1e-3) == 0.0


TAILS: dict[str, Callable[[np.random.Generator, int], np.ndarray]] = {
    "exponential": lambda rng, n: rng.exponential(1.0, n),
    "a fifth creeps": lambda rng, n: np.where(rng.random(n) < 0.2, rng.exponential(1.0, n), rng.uniform(0, 0.05, n)),
    "ends": lambda rng, n: rng.uniform(0, 1, n),
}


@pytest.mark.few(1)
@pytest.mark.parametrize("tail", TAILS)
def test_how_often_rare_starts_are_missed_and_wrongly_told(tail: str) -> None:
    """138 starts drawn at random, the limit at a known share of all: 1 of 100 late, 3 of 1000, 1 of 100 000 or none.

    The limits are quantiles of a million draws, not of the estimate.
    """
    rng = np.random.default_rng(5)
    draw = TAILS[tail]
    many, estimates = draw(rng, 1_000_000), [exceeded(list(draw(rng, 138)), 1e-3) for _ in range(300)]

    def told(limit: float) -> float:
        return float(np.mean(np.array(estimates) > limit))

    assert told(np.quantile(many, 0.99)) > 0.93
    assert told(np.quantile(many, 0.997)) > 0.85
    assert told(1.15 * many.max() if tail == "ends" else np.quantile(many, 1 - 1e-5)) < 0.12


def test_a_tail_ends_only_if_its_scatter_is_too_small_for_an_exponential_one() -> None:
    """An exponential tail is taken for one that ends in about one case of 20, an even one nearly always."""
    rng = np.random.default_rng(7)
    ends = [tail_shape(list(rng.exponential(1.0, 35))) < 0 for _ in range(1000)]
    assert 0.01 < np.mean(ends) < 0.08
    shapes = [tail_shape(list(rng.uniform(0, 1, 35))) for _ in range(300)]
    assert np.mean([shape < 0 for shape in shapes]) > 0.9 and np.median(shapes) == pytest.approx(-1, abs=0.25)
    assert tail_shape([]) == tail_shape([0.0] * 40) == tail_shape([1.0] * 40) == 0


def test_starts_that_a_result_chose_do_not_tell_how_long_rare_ones_take() -> None:
    """Neighbours of the slowest start count as starts that may be late, not as draws of the tail."""
    drawn = tuple(outcome(0.1 + 0.01 * k) for k in range(32))
    near = tuple(outcome(0.9 + 0.01 * k) for k in range(8))
    with_near = SearchResult((*drawn, *near), near=len(near))
    assert with_near.drawn == drawn and with_near.foreseen == SearchResult(drawn).foreseen < 1
    assert SearchResult((*drawn, *near)).foreseen > 1
    found, listed = design("avtovaz-707-222"), Finding("pass", "as listed", 0.2, 1.0)
    assert made("ABU702", listed, with_near, found).status == "pass"
    late = SearchResult((*drawn, outcome(1.1)), near=1)
    assert made("ABU702", listed, late, found).status == "warn"


@pytest.mark.parametrize("name", ["avtovaz-707-222", "late-between-speeds", "motor-no-load-speed"])
@pytest.mark.slow
def test_parts_of_the_designed_set_have_no_start_in_common(name: str) -> None:
    found = design(name)
    parts = [list(design_part(found, part)) for part in range(PARTS)]
    assert len({len(part) for part in parts[1:]}) == 1 < len(parts[1]) < len(parts[0])  # the first has the corners
    assert len({start for part in parts for start in part}) == sum(map(len, parts))


def drawn_of_part(machine: Design, part: int) -> int:
    """How many promised starts a part has."""
    return sum(member.promised for member in design_part(machine, part))


@pytest.mark.hard
def test_a_late_start_is_found_among_more_parts_if_rare_ones_seem_late(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rare quiet times seem late by the first part; the following parts have a start that is late indeed."""
    machine = design_of(machine_text(120, family_of(120)), "limits.quiet_time_s=0.28")
    with monkeypatch.context() as patch:
        patch.setattr(start_search, "NEAR", 4.0)
        drawn = search(machine, 0.01).drawn
    few, first = [outcome.quiet_time_or_inf for outcome in drawn], drawn_of_part(machine, 0)
    assert len(few) == sum(drawn_of_part(machine, part) for part in range(PARTS))
    assert max(few[:first]) < machine.case.table.limits.longest_quiet_time < max(few)
    # Far above the time permitted, no further part could lower the estimate enough: it warns at once.
    long_tailed = design_of(machine_text(81, "held"), "limits.quiet_time_s=0.4")
    alone = search(long_tailed, 0.01)
    assert len(alone.drawn) == drawn_of_part(long_tailed, 0)
    assert alone.foreseen > NEAR * long_tailed.case.table.limits.longest_quiet_time
    quiet = search(design("avtovaz-707-305"), 0.01)
    assert len(quiet.outcomes) - quiet.near == len(list(design_part(design("avtovaz-707-305"), 0)))


@pytest.mark.slow
def test_if_each_start_takes_long_fewer_of_all_kinds_are_run_and_that_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """With no work left beside the listed starts eight are run; the warning counts them. Asked patience runs all."""
    machine = design("avtovaz-707-305")
    monkeypatch.setattr(judgement, "MOST_SEARCHED", 0)
    facts = judgement.proven(machine)
    assert facts.searched is not None and facts.searched.near == 0 and facts.listed_pass
    assert len(facts.searched.outcomes) == judgement.FEWEST_SEARCHED
    assert {outcome.member.promised for outcome in facts.searched.outcomes} == {True, False}
    every = len(list(design_part(machine, 0)))
    assert facts.warnings[0].startswith(f"Only {judgement.FEWEST_SEARCHED} of {every} {judgement.SEARCHED_LESS}")
    with limited(300):
        patient = judgement.proven(machine)
    assert not patient.warnings and patient.searched is not None and len(patient.searched.outcomes) >= every


@pytest.mark.hard
def test_machines_that_were_undone_for_work_are_judged() -> None:
    found = recalled("size", abu_calc.read(str(MACHINES / "not-evaluated-for-work.toml")))
    assert not [check.code for check in found.checks if check.requested and check.status in ("not-done", "fail")]


@pytest.mark.slow
def test_a_file_places_balls() -> None:
    """As many as there are; `abu simulate` starts there, `abu size` from there, too."""
    machine = abu_calc.read("avtovaz-707-222").changed({"start.angles_deg": [10.0, 100.0, 190.0, 280.0]})
    assert "start.angles_deg" in abu_calc.simulate(machine).start
    sized = size(machine.whole("size"))
    assert "placed" in {member.start for member in members(sized)}
    wrong = abu_calc.read("avtovaz-707-222").changed({"start.angles_deg": [10.0, 100.0]})
    with pytest.raises(abu_calc.InputError, match=r"2 angles.*4, as many as the design has balls"):
        abu_calc.simulate(wrong)
    with pytest.raises(abu_calc.InputError, match=r"no table \[start\]"):
        abu_calc.simulate(abu_calc.read("avtovaz-707-222"), start="placed")
