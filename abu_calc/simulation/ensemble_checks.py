"""Checks of `abu size` on the many start cases of an idle machine, and the change with which all of them pass."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

from abu_calc.foundation import patience
from abu_calc.foundation.checks import Action, Check, Grade, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.moved import Moved
from abu_calc.foundation.units import from_si
from abu_calc.simulation.ensemble_results import SLACK, Ensemble, StartOutcome
from abu_calc.simulation.scene_of_design import guided
from abu_calc.simulation.start_cases import OPPOSITE
from abu_calc.sizing.actions import SIMULATED, set_action
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import decibels

IN_ALL_OILS: Final = " in hot or cold oil"
"""Words behind a quantity that is judged in hot and cold oil, too."""


@dataclass(frozen=True)
class TriedChange:
    """Entries with which all start cases at the given viscous drag rate pass, and the ensembles before and after.

    `after` None: none of the changes `without_success` makes them pass. `in_all_oils`: hot and cold oil are judged,
    too.
    """

    candidate: Candidate
    before: Ensemble
    entries: Mapping[str, object]
    after: Ensemble | None
    without_success: tuple[str, ...] = ()
    in_all_oils: bool = False
    by_oil: str = ""
    """Sentence on a drag rate that overrides the oil of the file."""

    def action(
        self, quantity: str, value: Callable[[StartOutcome], float], unit: str, limit: float | None = None
    ) -> Action:
        """The action, by the largest value of a quantity over the start cases that are judged."""
        return self._action(quantity, lambda ensemble: max(map(value, self._judged(ensemble)), default=0.0), unit,
                            limit)  # fmt: skip

    def counting(self, quantity: str, bad: Callable[[StartOutcome], bool], unit: str) -> Action:
        """The action, by the number of start cases that are judged."""
        return self._action(quantity, lambda ensemble: float(sum(map(bad, self._judged(ensemble)))), unit, 0.0)

    def _judged(self, ensemble: Ensemble) -> tuple[StartOutcome, ...]:
        return ensemble.outcomes if self.in_all_oils else ensemble.given

    def _action(self, quantity: str, value: Callable[[Ensemble], float], unit: str, limit: float | None) -> Action:
        if self.after is None:
            return Action(f"No change was found. Simulated without success: {'; '.join(self.without_success)}.")
        oils = IN_ALL_OILS if self.in_all_oils else ""
        moved = Moved(f"{quantity}{oils}", value(self.before), value(self.after), unit, limit)
        judged = "hot and cold oil included" if self.in_all_oils else "at the given drag rate"
        more = f"All {self.after.members} start cases, {judged}, then pass. {self.by_oil}".rstrip()
        return set_action(self.entries, self.candidate, moved, SIMULATED, more)


WORK = 300_000
"""Evaluations that the simulation of one scene within `abu size` may take, some seconds. A wheel that bounces before it
stays on the work took SciPy 200 000, events counted in, until two runs agreed; other machines take a tenth of that."""

BALANCE = "See the action of ABU701; else reduce the friction and the eccentricity of the race."

JUDGED = "ABU701", "ABU702", "ABU704"

FULL, ONE, NONE = "full", "one", "none"
"""Start cases that `size` simulates: all, the first at the given drag rate, none."""
STARTS: Final = (FULL, ONE, NONE)
NEED_STARTS: Final = (*JUDGED, "ABU401")
"""Checks that no calculation without all start cases can pass."""

UNCARRIED = "The balls, side by side, cannot carry the imbalance"
CARRY = "Add balls or specify larger ones, see ABU201."


def ensemble_checks(design: Any, ensemble: Ensemble | None, change: TriedChange | None = None) -> tuple[Check, ...]:
    """Checks that the balls balance in every start case, soon enough, and that none stalls.

    Start cases at the given viscous drag rate fail a check, those at a third and at three times it warn. `change`: a
    simulated change of the file; the first check that is not passed tells it. NOT EVALUATED without an ensemble: the
    balls, side by side, cannot carry the imbalance. `design`: of one race or of two.
    """
    if ensemble is None:
        return tuple(coded(code, "not-done", UNCARRIED, remedy=CARRY) for code in JUDGED)
    checks = list[Check]()
    for judged in (_balances, _settles, _none_stalls):
        earlier = next((check.code for check in checks if check.remedy), None)
        checks.append(judged(design, ensemble, change, earlier))
    return tuple(checks)


def unproven(check: Check, starts: str) -> Check:
    """A check of a calculation that left start cases out: one that needs them fails or is NOT EVALUATED."""
    if starts == FULL or check.code not in NEED_STARTS or check.status == "fail":
        return check
    known = f"{check.message}. " if starts == ONE or check.code == "ABU401" else ""
    message = f'{known}Start cases were left out: starts="{starts}"'
    value = check.value if known else None
    return coded(check.code, "not-done", message, value, check.limit, check.unit, 'Call size with starts="full".')


def level_check(closed: Check, ensemble: Ensemble | None, change: TriedChange | None = None) -> Check:
    """The check of the idle level with the loudest start case beside the calculated cases; the worse of both stands.

    `change`: a simulated change of the file. NOT EVALUATED if the patience that was asked for left out a start case.
    """
    if ensemble is None or closed.status == "not-done" or closed.limit is None or closed.value is None:
        return closed
    limit = closed.limit
    if patience.over() and ensemble.lost and closed.status != "fail":
        return coded("ABU401", "not-done", "Not all start cases were simulated in the time of --patience", None,
                     limit, "dB")  # fmt: skip
    given, loudest = _loudest(ensemble.given), _loudest(ensemble.outcomes)
    if given is None or loudest is None:
        return closed
    message = f"{closed.message}. Loudest start case: {_level(given, ensemble, limit)}"
    value = max(given.level, closed.value)
    if given.level > limit and given.level > closed.value:
        # A truer race helps where the closed form fails, too; what helps a start that does not balance was tried.
        advice: Action | str | None = closed.remedy and Action(closed.remedy, closed.overrides)
        if closed.status != "fail" or not given.balanced:
            advice = None if change is None else change.action(LOUDEST, lambda outcome: outcome.level, "dB", limit)
        return coded("ABU401", "fail", message, value, limit, "dB", advice or BALANCE)
    if closed.status == "pass" and loudest.level + SLACK > limit:
        if loudest is not given:
            message += f". Loudest start case at another drag rate: {_level(loudest, ensemble, limit)}"
        if loudest.level <= limit:
            message += f". The error of its simulation, {SLACK:g} dB, leaves open whether the limit is kept"
        loud = None if change is None else change.action(LOUDEST, lambda outcome: outcome.level, "dB", limit)
        return coded("ABU401", "warn", message, value, limit, "dB", loud)
    return replace(closed, message=message, value=value)


LOUDEST, SLOWEST = "the loudest start case", "the slowest start case"
LAST_AT_REST = "the rest time of the slowest start case"
LEFT, STALLED = "the largest imbalance left by a start case", "the number of start cases with stalled balls"


def _level(outcome: StartOutcome, ensemble: Ensemble, limit: float) -> str:
    return f"{decibels(outcome.level, limit)} (limit {limit:g} dB), {_named(outcome, ensemble)}"


def _see(earlier: str | None) -> str | None:
    """Reference to the earlier check that gives the action."""
    return None if earlier is None else f"See the action of {earlier}."


def _balances(design: Design, ensemble: Ensemble, change: TriedChange | None, earlier: str | None) -> Check:
    given = ensemble.given
    failing = [outcome for outcome in given if not outcome.balanced]
    worst = max(given, key=lambda outcome: outcome.imbalance, default=None)
    status = _grade(ensemble, lambda outcome: outcome.balanced)
    sentences = [f"{ensemble.balanced} of {_starts(ensemble.members)} balance"]
    others = [*failing, *(start for start in ensemble.outcomes if not start.balanced and start not in failing)]
    if others:
        verb = "does" if len(others) == 1 else "do"
        sentences.append(f"{len(others)} {verb} not: {_first(others, ensemble)}")
    if worst and worst.imbalance > worst.moved:
        sentences.append("The balls increase the imbalance: they gather on the heavy side or stall")
    sentences += [f"No answer from {_words(lost.member.name, lost.member.drag, ensemble)}: {lost.reason}"
                  for lost in ensemble.lost[:1]]  # fmt: skip
    if worst:
        sentences.append("The value is the largest imbalance left at the given drag rate")
    value, limit = (_g_mm(worst.imbalance), _g_mm(worst.allowed)) if worst else (None, None)
    action = None
    if change is not None and status != "pass":
        action = change.action(LEFT, lambda outcome: from_si(outcome.imbalance, "g_mm"), "g·mm", limit)
    return coded("ABU701", status, ". ".join(sentences), value, limit, "g·mm", action)


def _settles(design: Design, ensemble: Ensemble, change: TriedChange | None, earlier: str | None) -> Check:
    limits = design.case.table.limits
    limit = limits.longest_quiet_time
    longest = math.inf if limits.rest_time_s is None else limits.rest_time_s
    status = _grade(ensemble, lambda outcome: outcome.in_time(limits))
    late = max(ensemble.given, key=lambda outcome: outcome.quiet_time_or_inf, default=None)
    latest = max(ensemble.outcomes, key=lambda outcome: outcome.quiet_time_or_inf, default=None)
    sentences = ["No start case gave an answer" if late is None else f"Slowest start case: {_time(late, ensemble)}"]
    if status == "warn" and latest and latest.quiet_time_or_inf > limit:
        sentences.append(f"Slowest at another drag rate: {_time(latest, ensemble)}")
    if guided(design, 0.0).pause:
        sentences.append("Times count from full speed, after the temporary speed reduction")
    elif any(outcome.member.run_up for outcome in ensemble.given):
        sentences.append("Times count from full speed, after the run-up")
    creeping = [outcome for outcome in ensemble.outcomes if outcome.creeping and not outcome.hanging]
    rested = max(ensemble.given, key=lambda outcome: outcome.rest_time_or_inf, default=None)
    if creeping:
        sentences.append(f"The balls still creep at the end of {_starts(len(creeping))}: {_first(creeping, ensemble)}")
        status = "warn" if status == "pass" else status
    elif rested is not None and rested.rest_time is not None:
        allowed = "" if math.isinf(longest) else f" (limit {longest:g} s)"
        sentences.append(f"The balls rest after {rested.rest_time:#.3g} s at the latest{allowed}")
    value = None if late is None or math.isinf(late.quiet_time_or_inf) else late.quiet_time_or_inf
    action: Action | str | None = _see(earlier)
    if action is None and change is not None and any(not outcome.in_time(limits) for outcome in ensemble.outcomes):
        if any(outcome.quiet_time_or_inf > limit for outcome in ensemble.outcomes):
            action = change.action(SLOWEST, lambda outcome: outcome.quiet_time_or_inf, "s", limit)
        else:
            action = change.action(LAST_AT_REST, lambda outcome: outcome.rest_time_or_inf, "s", longest)
    return coded("ABU702", status, ". ".join(sentences), value, limit, "s", None if status == "pass" else action)


def _time(outcome: StartOutcome, ensemble: Ensemble) -> str:
    time = outcome.quiet_time_or_inf
    return f"{_named(outcome, ensemble)}, {'never' if math.isinf(time) else f'{time:#.3g} s'}"


def _none_stalls(design: Design, ensemble: Ensemble, change: TriedChange | None, earlier: str | None) -> Check:
    status = _grade(ensemble, lambda outcome: not outcome.hanging)
    message = "No ball stalls in any start case"
    if ensemble.hanging:
        count = f"{len(ensemble.hanging)} of {_starts(ensemble.members)}"
        message = f"Balls stall in {count}: {_first(ensemble.hanging, ensemble)}"
    for lost in ensemble.lost[:1]:
        message += f". No answer from {_words(lost.member.name, lost.member.drag, ensemble)}"
    action: Action | str | None = _see(earlier)
    if action is None and change is not None:
        action = change.counting(STALLED, lambda outcome: outcome.hanging, "")
    return coded("ABU704", status, message, float(len(ensemble.hanging)), 0.0, "start cases",
                 None if status == "pass" else action)  # fmt: skip


def _grade(ensemble: Ensemble, good: Callable[[StartOutcome], bool]) -> Grade:
    """fail by a start at the drag given, not-done where one of these has no answer, warn by any other."""
    given = ensemble.given
    if not all(map(good, given)):
        return "fail"
    if not given or any(lost.member.drag == ensemble.drag for lost in ensemble.lost):
        return "not-done"
    return verdict(True, all(map(good, ensemble.outcomes)) and not ensemble.lost)


def _loudest(outcomes: Iterable[StartOutcome]) -> StartOutcome | None:
    return max(outcomes, key=lambda outcome: outcome.level, default=None)


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


def _g_mm(value: float | None) -> float | None:
    return None if value is None else from_si(value, "g_mm")


IDLE: Final = ("idle", "swing-arm-idle")
"""Scenes that many start cases repeat."""


def not_simulated(scene: str, reason: str, *, answered: bool = False, mean: str | None = None) -> Check:
    """The check of a scene whose simulation gave no number to be trusted.

    `answered`: whether many starts of the machine, idle as in this scene, gave theirs: then one that did not is no
    veto. `mean`: what a chaotic motion comes to on average, where that is known.
    """
    if mean is not None:
        return coded(
            "ABU703", "warn", mean, of=scene, remedy="Keep the wheel on the workpiece, see `abu grinding FILE`."
        )
    status: Grade = "warn" if answered and scene in IDLE and not patience.over() else "not-done"
    return coded("ABU703", status, f"No simulation of this scene can be trusted: {reason}", of=scene,
                 remedy="Specify a drag rate nearer to the optimum, or less accuracy (--accuracy, Python: accuracy=).",
                 )  # fmt: skip
