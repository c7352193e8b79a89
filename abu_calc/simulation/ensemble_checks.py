"""Checks of `abu size` on the many start cases of an idle machine."""

import math
from collections.abc import Callable, Iterable

from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check, Grade, coded, verdict
from abu_calc.foundation.units import from_si
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome
from abu_calc.simulation.response import balanced_well
from abu_calc.simulation.scene_of_design import guided
from abu_calc.simulation.start_cases import OPPOSITE
from abu_calc.sizing.design import Design

WORK = 300_000
"""Evaluations that the simulation of one scene within `abu size` may take, some seconds. A wheel that bounces before it
stays on the work took SciPy 200 000, events counted in, until two runs agreed; other machines take a tenth of that."""

BALANCE = "What lets every start balance, see ABU701; else less friction and eccentricity of the race."

SEE = "See ABU701."

JUDGED = "ABU701", "ABU702", "ABU704"


def ensemble_checks(design: Design, ensemble: Ensemble | None, remedy: str | None = None) -> tuple[Check, ...]:
    """Balls that balance from every start, soon enough, and never hang.

    Starts at the drag given fail a check, those at a third and at three times it warn. `remedy`: what was tried. Not
    done without an ensemble: the balls, side by side, cannot carry the imbalance.
    """
    if ensemble is None:
        reason = "the balls cannot carry the imbalance side by side"
        return tuple(coded(code, "not-done", reason, remedy="More or larger balls.") for code in JUDGED)
    first = _balances(design, ensemble, remedy)
    advice = SEE if first.remedy else remedy
    return first, _settles(design, ensemble, advice), _none_hangs(ensemble, advice)


def level_check(closed: Check, ensemble: Ensemble | None, remedy: str | None = None) -> Check:
    """The check of the idle level with what the starts show beside the closed form; the worse of both stands.

    `remedy`: what was tried. Not done where the patience that was asked for left out a start.
    """
    if ensemble is None or closed.status == "not-done" or closed.limit is None or closed.value is None:
        return closed
    if patience.over() and ensemble.lost and closed.status != "fail":
        return coded("ABU401", "not-done", "not all starts were simulated in the time of --patience", None,
                     closed.limit, "dB")  # fmt: skip
    given, worst = _loudest(ensemble.given), _loudest(ensemble.outcomes)
    if given is None or worst is None:
        return closed
    if given.level > closed.limit and given.level > closed.value:
        # A truer race helps where the closed form fails, too; what helps a start that does not balance was tried.
        advice = closed.remedy if closed.status == "fail" and given.balanced else remedy
        message = f"simulated, the loudest start is {_named(given)}"
        return coded("ABU401", "fail", message, given.level, closed.limit, "dB", advice or BALANCE)
    if closed.status == "pass" and worst.level > closed.limit:
        return coded("ABU401", "warn", f"kept at the drag given, but not {_named(worst)}: {worst.level:.1f} dB",
                     max(given.level, closed.value), closed.limit, "dB")  # fmt: skip
    if given.level <= closed.value:
        return closed
    return coded("ABU401", closed.status, f"simulated, the loudest start is {_named(given)}; {closed.message}",
                 given.level, closed.limit, "dB", closed.remedy)  # fmt: skip


def _balances(design: Design, ensemble: Ensemble, remedy: str | None) -> Check:
    given = ensemble.given
    failing = [outcome for outcome in given if not outcome.balanced]
    worst = max(given, key=lambda outcome: outcome.imbalance, default=None)
    status = _grade(ensemble, lambda outcome: outcome.balanced)
    left = f"{ensemble.balanced} of {ensemble.members} starts balance"
    others = failing or [outcome for outcome in ensemble.outcomes if not outcome.balanced]
    if others:
        left += f"; not {_listed(others)}"
    moved = design.imbalance.value * abs(design.autobalancer.requirement.plane_ratio)
    if worst and worst.imbalance > moved:
        left += "; the balls make it worse, they gather on the heavy side or hang"
    for lost in ensemble.lost[:1]:
        left += f"; without an answer {_words(lost.member.name, lost.member.drag)}: {lost.reason}"
    value, limit = (worst.imbalance, worst.allowed) if worst else (None, None)
    return coded("ABU701", status, f"{left}; imbalance left by the worst", _g_mm(value), _g_mm(limit), "g·mm",
                 None if status == "pass" else remedy)  # fmt: skip


def _settles(design: Design, ensemble: Ensemble, remedy: str | None) -> Check:
    limit = design.case.table.limits.settling_time_s
    status = _grade(ensemble, lambda outcome: outcome.settling_time_or_inf <= limit)
    if status == "fail" and balanced_well(design) and all(outcome.balanced for outcome in ensemble.given):
        message = "the wheel is balanced so well that balls creep to their places; none leaves more than is allowed"
        return coded("ABU702", "warn", message, None, limit, "s")
    late = max(ensemble.given, key=lambda outcome: outcome.settling_time_or_inf, default=None)
    latest = max(ensemble.outcomes, key=lambda outcome: outcome.settling_time_or_inf, default=None)
    message = "no start gave an answer" if late is None else f"the slowest start is {_named(late)}"
    if status == "warn" and latest and latest.settling_time_or_inf > limit:
        when = "never" if math.isinf(latest.settling_time_or_inf) else f"{latest.settling_time_or_inf:.3g} s"
        message += f"; {_named(latest)}: {when}"
    if guided(design, 0.0).pause:
        message += "; counted from full speed, after the pause"
    elif any(outcome.member.run_up for outcome in ensemble.given):
        message += "; counted from full speed, after the run-up"
    value = None if late is None or math.isinf(late.settling_time_or_inf) else late.settling_time_or_inf
    return coded("ABU702", status, message, value, limit, "s", None if status == "pass" else remedy)


def _none_hangs(ensemble: Ensemble, remedy: str | None) -> Check:
    status = _grade(ensemble, lambda outcome: not outcome.hanging)
    message = "no start leaves balls going round behind the rotor"
    for lost in ensemble.lost[:1]:
        message += f"; without an answer {_words(lost.member.name, lost.member.drag)}"
    if ensemble.hanging:
        message = f"balls hang {_listed(ensemble.hanging)}"
    return coded("ABU704", status, message, float(len(ensemble.hanging)), 0.0, "starts",
                 None if status == "pass" else remedy)  # fmt: skip


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


def _named(outcome: StartOutcome) -> str:
    """The start in words, with the race's centre unless that is opposite the imbalance, as in other commands."""
    side = "" if outcome.member.eccentricity == OPPOSITE else f", race centre {outcome.member.race_centre_deg:g}°,"
    return _words(f"{outcome.member.name}{side}", outcome.member.drag)


def _words(name: str, drag: float) -> str:
    return f"{name} at a drag of {drag:.4g} 1/s"


def _listed(outcomes: Iterable[StartOutcome]) -> str:
    """The first few in words."""
    names = [_named(outcome) for outcome in outcomes]
    more = f" and {len(names) - 2} more" if len(names) > 2 else ""
    return "from " + ", ".join(names[:2]) + more


def _g_mm(value: float | None) -> float | None:
    return None if value is None else from_si(value, "g_mm")


def not_simulated(scene: str, reason: str, *, answered: bool = False, mean: str | None = None) -> Check:
    """The check of a scene whose simulation gave no number to be trusted.

    `answered`: whether many starts of the idle machine gave theirs: then one that did not is no veto. `mean`: what a
    chaotic motion comes to on average, where that is known.
    """
    if mean is not None:
        return coded("ABU703", "warn", mean, of=scene, remedy="What keeps the wheel on the work, see abu grinding.")
    status: Grade = "warn" if answered and scene == "idle" and not patience.over() else "not-done"
    return coded("ABU703", status, f"no trustworthy simulation: {reason}", of=scene,
                 remedy="A drag nearer to the optimum, or less accuracy (--accuracy, Python: accuracy=).")  # fmt: skip
