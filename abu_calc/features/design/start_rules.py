"""Rules of the checks that start cases decide, and the checks made by them: the idle level, balance, times, stalling.

A rule tells what the listed start cases say, and which further ones break it.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from operator import attrgetter
from typing import Any, Final, NamedTuple

from abu_calc.features.design.start_search import RARE, SearchResult, fails, loudness, slowness
from abu_calc.foundation import patience
from abu_calc.foundation.checks import CHECK_CODES, Action, Check, Finding, Grade, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.simulation.records import finite
from abu_calc.simulation.scene_of_design import guided
from abu_calc.simulation.start_cases import OPPOSITE, SLACK, Ensemble, StartOutcome
from abu_calc.sizing.vibration import decibels


class Measure(NamedTuple):
    """A quantity of start cases that an action moves: the largest value of them, or how many have it if it `counts`."""

    quantity: str
    unit: str
    value: Callable[[StartOutcome], float]
    counts: bool = False

    def of(self, outcomes: Iterable[StartOutcome]) -> float:
        """The quantity of some start cases."""
        values = map(self.value, outcomes)
        return float(sum(values)) if self.counts else max(values, default=0.0)

    def worst(self, outcomes: Iterable[StartOutcome]) -> StartOutcome | None:
        """The start case with the largest value, None without any."""
        return max(outcomes, key=self.value, default=None)


STARTS = FULL, ONE, NONE = "full", "one", "none"
"""Start cases that `size` simulates: all, the first at the given drag rate, none."""

UNCARRIED: Final = Finding("not-done", "The balls, side by side, cannot carry the imbalance",
                           action="Add balls or specify larger ones, see ABU201.")  # fmt: skip


@dataclass(frozen=True)
class StartFacts:
    """What is known of a design by its start cases.

    `design`: of one race or of two; `ensemble`: outcomes of the listed start cases, None without any; `searched`: of
    further ones; `starts`: those that were simulated.
    """

    design: Any
    ensemble: Ensemble | None
    searched: SearchResult | None = None
    starts: str = FULL
    unsimulated: Finding = UNCARRIED
    """What is known without start cases."""
    advice: Callable[[str, Grade], Action | str | None] | None = None
    """Action of a check that is not passed, by its code and status."""
    warnings: tuple[str, ...] = ()

    @property
    def listed_pass(self) -> bool:
        """True if every listed start case at the given drag rate balances, in time and within the level."""
        ensemble, limits, level = self.ensemble, self.design.case.table.limits, self.design.case.level_limit
        if ensemble is None or any(start.member.drag == ensemble.drag for start in ensemble.lost):
            return False
        return all(start.holds(limits, level) for start in ensemble.given)

    @property
    def holds(self) -> bool:
        """True if no promised start case that was searched breaks a limit."""
        return self.searched is None or not any(fails(self.design, outcome) for outcome in self.searched.outcomes)


Advise = Callable[[Grade], Action | str | None]
"""The action of a check by its status."""


class StartRule(NamedTuple):
    """Rule of one check that start cases decide: what the listed ones say, and which further ones break it.

    `measure`: what it judges; `repeated`: name of the start case that is repeated; `breaks`: whether a further start
    case breaks it; `order`: by what these are ordered, whose largest value decides unless they are counted; `words`:
    what they do, by the worst.
    """

    code: str
    measure: Measure
    repeated: str
    listed: Callable[[StartFacts, Ensemble, Advise], Finding]
    breaks: Callable[[StartOutcome, Any], bool]
    order: Callable[[StartOutcome], float]
    words: Callable[[StartOutcome], str]
    surely: Callable[[Any, StartOutcome], bool] = fails
    """Whether one that breaks it fails, not only warns."""
    foresees: bool = False
    """Whether the time that one of 1000 start cases exceeds counts, too."""

    @property
    def key(self) -> str:
        """The key of the check."""
        return CHECK_CODES[self.code].key

    def finding(self, facts: StartFacts, unsimulated: Finding) -> Finding:
        """What the listed start cases say."""

        def advise(status: Grade) -> Action | str | None:
            """The action given."""
            return None if status == "pass" or facts.advice is None else facts.advice(self.code, status)

        return unsimulated if facts.ensemble is None else self.listed(facts, facts.ensemble, advise)

    def worst(self, searched: SearchResult, design: Any) -> tuple[StartOutcome | None, list[StartOutcome]]:
        """The worst further start case, None where none breaks the rule or comes near to that, and those that do."""
        broken = [outcome for outcome in searched.outcomes if self.breaks(outcome, design)]
        near = self.foresees and searched.foreseen > design.case.table.limits.longest_quiet_time
        return max(broken or (searched.outcomes if near else ()), key=self.order, default=None), broken

    def check(self, facts: StartFacts, listed: Finding) -> Check:
        """The check, by what the listed start cases say and by what lies beyond them."""
        found = self._with_further(facts, listed)
        if found.value is None and found.limit is None:
            return coded(self.code, found.status, found.message, remedy=found.action)
        return coded(self.code, *found)

    def _with_further(self, facts: StartFacts, listed: Finding) -> Finding:
        """The finding with start cases that were left out, gave no answer, or break the rule; promised ones fail it."""
        searched, status, said, action = facts.searched, listed.status, f"{listed.message}. ", listed.action
        if facts.starts != FULL and status != "fail":
            said = f'{"" if listed is facts.unsimulated else said}Start cases were left out: starts="{facts.starts}"'
            return listed._replace(status="not-done", message=said, action='Call size with starts="full".')
        if searched is None or status not in ("pass", "warn"):
            return listed
        worst, broken = self.worst(searched, facts.design)
        if not broken and searched.hurried:
            said += "--patience ended the search of further start cases"
            return listed._replace(status="not-done", message=said)
        if not broken and searched.lost:
            return listed._replace(status="warn", message=f"{said}Further start cases without answer: {searched.lost}")
        if worst is None:
            return listed
        value = float(len(broken)) if self.measure.counts else finite(self.order(worst))
        surely = any(self.surely(facts.design, outcome) for outcome in broken)
        if broken:
            said += f"Further start cases: {len(broken)} of {len(searched.outcomes)} {self.words(worst)}"
        else:
            said += (
                f"By the slowest of {len(searched.drawn)} start cases, one of {1 / RARE:.0f} takes "
                f"{searched.foreseen:.3g} s (limit {listed.limit:g} s). The slowest further start case is quiet after "
                f"{worst.quiet_time_or_inf:.3g} s"
            )
            value = searched.foreseen
        if listed.status == "warn" and not surely and not self.measure.counts and listed.limit is not None:
            slowest = math.inf if listed.value is None else listed.value
            value = finite(max(slowest, self.order(worst))) if slowest > listed.limit else value
        return listed._replace(status="fail" if surely else "warn", message=said, value=value, action=action)


def level_check(facts: StartFacts) -> Check:
    """The check of the idle level, by sizing and by start cases."""
    return LEVEL.check(facts, LEVEL.finding(facts, facts.design.level))


def checks_of_starts(facts: StartFacts) -> Iterator[Check]:
    """Checks that the balls balance in every start case, soon enough, and that none stalls.

    Start cases at the given viscous drag rate fail a check, those at a third and at three times it warn.
    """
    yield from (rule.check(facts, rule.finding(facts, facts.unsimulated)) for rule in OF_STARTS)


LOUDEST: Final = Measure("the loudest start case", "dB", attrgetter("level"))
LEFT: Final = Measure("the largest imbalance left by a start case", "g·mm", lambda run: from_si(run.imbalance, "g_mm"))
SLOWEST: Final = Measure("the slowest start case", "s", slowness)
LAST_AT_REST: Final = Measure("the rest time of the slowest start case", "s", attrgetter("rest_time_or_inf"))
STALLED: Final = Measure("the number of start cases with stalled balls", "", attrgetter("hanging"), counts=True)


def _level(facts: StartFacts, ensemble: Ensemble, advise: Advise) -> Finding:
    """The idle level with the loudest start case beside the calculated cases; the worse of both stands.

    NOT EVALUATED if the patience that was asked for left out a start case.
    """
    closed: Finding = facts.design.level
    limit = closed.limit
    given, loudest = LOUDEST.worst(ensemble.given), LOUDEST.worst(ensemble.outcomes)
    if limit is None or closed.value is None:
        return closed
    if patience.over() and ensemble.lost and closed.status != "fail":
        return Finding("not-done", "Not all start cases were simulated in the time of --patience", None, limit)
    if given is None or loudest is None:
        return closed
    message = f"{closed.message}. Loudest start case: {_of_limit(given, ensemble, limit)}"
    value, quieter = max(given.level, closed.value), advise("warn")
    if given.level > limit and given.level > closed.value:
        # A truer race helps where the closed form fails, too; what helps a start that does not balance was tried.
        advice = closed.action if closed.status == "fail" and given.balanced else quieter
        return Finding("fail", message, value, limit, advice)
    if closed.status == "pass" and loudest.level + SLACK > limit:
        if loudest is not given:
            message += f". Loudest start case at another drag rate: {_of_limit(loudest, ensemble, limit)}"
        if loudest.level <= limit:
            message += f". The error of its simulation, {SLACK:g} dB, leaves open whether the limit is kept"
        return Finding("warn", message, loudest.level, limit, quieter)
    return closed._replace(message=message, value=value)


def _of_limit(outcome: StartOutcome, ensemble: Ensemble, limit: float) -> str:
    return f"{decibels(outcome.level, limit)} (limit {limit:g} dB), {_named(outcome, ensemble)}"


def _balances(_: StartFacts, ensemble: Ensemble, advise: Advise) -> Finding:
    worst, status = LEFT.worst(ensemble.given), _grade(ensemble, attrgetter("balanced"))
    sentences = [f"{ensemble.balanced} of {_starts(ensemble.members)} balance"]
    unbalanced = (start for start in ensemble.outcomes if not start.balanced)
    others = sorted(unbalanced, key=lambda start: start.member.drag != ensemble.drag)
    if others:
        verb = "does" if len(others) == 1 else "do"
        sentences.append(f"{len(others)} {verb} not: {_first(others, ensemble)}")
    if worst and worst.imbalance > worst.moved:
        sentences.append("The balls increase the imbalance: they gather on the heavy side or stall")
    sentences += [f"No answer from {_words(lost.member.name, lost.member.drag, ensemble)}: {lost.reason}"
                  for lost in ensemble.lost[:1]]  # fmt: skip
    if worst:
        sentences.append("The value is the largest imbalance left at the given drag rate")
    value, limit = (worst.imbalance, worst.allowed) if worst else (None, None)
    return Finding(status, ". ".join(sentences), value, limit, advise(status))


def _settles(facts: StartFacts, ensemble: Ensemble, advise: Advise) -> Finding:
    limits = facts.design.case.table.limits
    limit = limits.longest_quiet_time
    longest = math.inf if limits.rest_time_s is None else limits.rest_time_s
    status = _grade(ensemble, lambda outcome: outcome.in_time(limits))
    late, latest = SLOWEST.worst(ensemble.given), SLOWEST.worst(ensemble.outcomes)
    sentences = ["No start case gave an answer" if late is None else f"Slowest start case: {_time(late, ensemble)}"]
    if status == "warn" and latest and latest.quiet_time_or_inf > limit:
        sentences.append(f"Slowest at another drag rate: {_time(latest, ensemble)}")
    if guided(facts.design, 0.0).pause:
        sentences.append("Times count from full speed, after the temporary speed reduction")
    elif any(outcome.member.run_up for outcome in ensemble.given):
        sentences.append("Times count from full speed, after the run-up")
    creeping = [outcome for outcome in ensemble.outcomes if outcome.creeping and not outcome.hanging]
    if creeping:
        sentences.append(f"The balls still creep at the end of {_starts(len(creeping))}: {_first(creeping, ensemble)}")
        status = "warn" if status == "pass" else status
    elif (rested := LAST_AT_REST.worst(ensemble.given)) is not None and rested.rest_time is not None:
        allowed = "" if math.isinf(longest) else f" (limit {longest:g} s)"
        sentences.append(f"The balls rest after {rested.rest_time:#.3g} s at the latest{allowed}")
    decides = latest if status == "warn" and latest and latest.quiet_time_or_inf > limit else late
    value = None if decides is None else decides.quiet_time
    return Finding(status, ". ".join(sentences), value, limit, advise(status))


def _none_stalls(_: StartFacts, ensemble: Ensemble, advise: Advise) -> Finding:
    status = _grade(ensemble, lambda outcome: not outcome.hanging)
    message = "No ball stalls in any start case"
    if ensemble.hanging:
        count = f"{len(ensemble.hanging)} of {_starts(ensemble.members)}"
        message = f"Balls stall in {count}: {_first(ensemble.hanging, ensemble)}"
    for lost in ensemble.lost[:1]:
        message += f". No answer from {_words(lost.member.name, lost.member.drag, ensemble)}"
    return Finding(status, message, float(len(ensemble.hanging)), 0.0, advise(status))


def _grade(ensemble: Ensemble, good: Callable[[StartOutcome], bool]) -> Grade:
    """fail by a start at the drag given, not-done where one of these has no answer, warn by any other."""
    given = ensemble.given
    if not all(map(good, given)):
        return "fail"
    if not given or any(lost.member.drag == ensemble.drag for lost in ensemble.lost):
        return "not-done"
    return verdict(True, all(map(good, ensemble.outcomes)) and not ensemble.lost)


def _time(outcome: StartOutcome, ensemble: Ensemble) -> str:
    time = outcome.quiet_time
    return f"{_named(outcome, ensemble)}, {'never' if time is None else f'{time:#.3g} s'}"


def _named(outcome: StartOutcome, ensemble: Ensemble) -> str:
    """The start case in words, with the race's centre unless that is opposite the imbalance, as in other commands."""
    usual = outcome.member.eccentricity == OPPOSITE or outcome.member.phases is not None
    side = "" if usual else f", race centre {outcome.member.race_centre_deg:g}°"
    return _words(f"{outcome.member.name}{side}", outcome.member.drag, ensemble)


def _words(name: str, drag: float, ensemble: Ensemble) -> str:
    """A start case and its viscous drag rate: as given, or that of hot or cold oil.

    >>> _words("standstill", 5.0, Ensemble(15.0, (), ()))
    'standstill, drag rate 5 1/s (hot oil)'
    >>> _words("standstill", 5.0, Ensemble(15.0, (), (), (40.0, 80.0, 5.0)))
    'standstill, drag rate 5 1/s (hot oil, 80 °C)'
    """
    degrees = ensemble.temperatures
    if drag == ensemble.drag:
        by_oil = "given drag rate" if degrees is None else f"oil at {degrees[0]:g} °C, drag rate"
        return f"{name}, {by_oil} {drag:.4g} 1/s"
    oil, place = ("hot", 1) if drag < ensemble.drag else ("cold", 2)
    return f"{name}, drag rate {drag:.4g} 1/s ({oil} oil{'' if degrees is None else f', {degrees[place]:g} °C'})"


def _starts(count: int) -> str:
    return f"{count} start case{'' if count == 1 else 's'}"


def _first(outcomes: Sequence[StartOutcome], ensemble: Ensemble) -> str:
    """The first of several start cases in words."""
    first = _named(outcomes[0], ensemble)
    return first if len(outcomes) == 1 else f"one is {first}"


def _late(outcome: StartOutcome, design: Any) -> bool:
    """True if it is late, or if its balls still creep at the end, however long it was followed."""
    return not outcome.in_time(design.case.table.limits) or (outcome.creeping and not outcome.hanging)


def _unbalanced(outcome: StartOutcome, design: Any) -> bool:
    """True if it does not balance; beyond what is promised, where friction leaves more, if it is not quiet either."""
    return not outcome.balanced and (outcome.member.promised or outcome.hanging or outcome.quiet_time is None)


def _time_in_words(outcome: StartOutcome) -> str:
    times = outcome.quiet_time, outcome.rest_time
    quiet, rest = ("never" if time is None else f"after {time:.3g} s" for time in times)
    return f"are late{' or still creep' * outcome.creeping}: the slowest is quiet {quiet}, at rest {rest}"


LEVEL: Final = StartRule(
    "ABU401", LOUDEST, "loudest", _level,
    lambda start, design: start.loudest + SLACK > design.case.level_limit, loudness,
    lambda worst: f"may be too loud, the loudest with {worst.loudest:.1f} ± {SLACK:g} dB",
    surely=lambda design, start: fails(design, start) and start.loudest > design.case.level_limit + SLACK,
)  # fmt: skip
BALANCES: Final = StartRule(
    "ABU701", LEFT, "one with the largest imbalance left", _balances, _unbalanced, attrgetter("imbalance"),
    lambda _: "do not balance",
)  # fmt: skip
SETTLES: Final = StartRule("ABU702", SLOWEST, "slowest", _settles, _late, slowness, _time_in_words, foresees=True)
STALLS: Final = StartRule(
    "ABU704", STALLED, "one with the slowest ball", _none_stalls, lambda start, _: start.hanging, attrgetter("slip"),
    lambda _: "leave stalled balls",
)  # fmt: skip
OF_STARTS: Final = BALANCES, SETTLES, STALLS
RULES: Final = LEVEL, *OF_STARTS
"""Rules of the checks that no calculation without all start cases can pass."""
