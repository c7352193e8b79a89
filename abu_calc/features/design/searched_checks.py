"""Checks that start cases decide, by the listed ones and by those that a search found, and what repeats the worst."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Final

from abu_calc.features.design.start_search import RARE, SearchResult, fails, loudness, slowness
from abu_calc.foundation.checks import Action, Check, coded
from abu_calc.foundation.units import from_si
from abu_calc.simulation.ensemble_checks import (
    LEFT,
    LOUDEST,
    SLOWEST,
    STALLED,
    TriedChange,
    ensemble_checks,
    level_check,
)
from abu_calc.simulation.ensemble_results import SLACK, Ensemble, StartOutcome
from abu_calc.simulation.start_cases import Member, Variation, ball_speed_rpm
from abu_calc.sizing.design import Design


def start_checks(
    design: Design, ensemble: Ensemble | None, searched: SearchResult | None, change: TriedChange | None = None
) -> dict[str, Check]:
    """Checks by code that start cases decide: the idle level, balancing, settling, stalling.

    `ensemble`: outcomes of the listed start cases; `searched`: of further ones; `change`: a simulated change.
    """
    closed = next(check for check in design.checks if check.code == "ABU401")
    listed = (level_check(closed, ensemble, change), *ensemble_checks(design, ensemble, change))
    return {check.code: with_searched(check, searched, design, change) for check in listed}


def repeated(outcome: StartOutcome, design: Design) -> str:
    """The options of `abu simulate` that repeat a start of a design, which they pin."""
    member, balls = outcome.member, design.autobalancer
    entries = {
        "autobalancer.ball_count": f"{balls.ball_count}",
        "autobalancer.ball_diameter_mm": f"{from_si(balls.ball_diameter, 'mm'):.10g}",
        **dict(_other_values(member, design)),
    }
    if member.run_up and not member.by_motor:
        entries["run_up.time_s"] = f"{member.run_up:.10g}"
    sets = [f"{key}={value}" for key, value in entries.items()]
    if member.angles:
        angles = ", ".join(f"{from_si(angle, 'deg'):.4f}" for angle in member.angles)
        sets.append(f"start.angles_deg=[{angles}]")
        if member.lag:
            sets.append(f"start.speeds_rpm={[ball_speed_rpm(design, member)] * len(member.angles)}")
    scene = "--scene run-up " if member.run_up else f"--start {member.start} " if not member.angles else ""
    scene += f"--duration {outcome.duration:.6g} " if outcome.duration else ""
    return f"{scene}--race-centre {member.race_centre_deg:g} {' '.join(f'--set {quoted(entry)}' for entry in sets)}"


def quoted(entry: str) -> str:
    """An entry as a shell takes it: quoted where it holds more than a name and a number."""
    return f"'{entry}'" if any(letter in entry for letter in '"[ ') else entry


def _other_values(member: Member, design: Design) -> Iterator[tuple[str, str]]:
    """Entries of what a start has otherwise than the file, with race and imbalance as they are.

    A motor runs up to its idle speed, whatever is rated.
    """
    case, varied = design.case, member.varied
    at_speed = member.speed is not None and case.table.motor is None
    if at_speed:
        yield "machine.speed_rpm", f"{from_si(member.speed or 0.0, 'rpm'):.10g}"
    if at_speed or varied != Variation():
        yield "autobalancer.race_radius_mm", f"{from_si(design.autobalancer.race_radius, 'mm'):.10g}"
        yield "wheel.imbalance_g_mm", f"{varied.imbalance * from_si(design.imbalance.value, 'g_mm'):.10g}"
    if member.drag != case.drag:
        yield "autobalancer.rolling_drag_per_s", f"{member.drag:.10g}"
    if varied.race_eccentricity != 1:
        eccentricity = varied.race_eccentricity * case.race_eccentricity
        yield "autobalancer.race_eccentricity_mm", f"{from_si(eccentricity, 'mm'):.10g}"
    if varied.friction_arm != 1:
        yield "autobalancer.rolling_friction_mm", f"{from_si(varied.friction_arm * case.friction_arm, 'mm'):.10g}"
    if varied.spindle_axis is not None:
        yield "machine.spindle_axis", f'"{varied.spindle_axis}"'
    given = case.table.suspension.frequencies
    if varied.natural_frequency != 1 and given is not None:
        values = ", ".join(f"{varied.natural_frequency * each:.10g}" for each in given)
        yield "suspension.natural_frequencies_hz", f"[{values}]"


def decisive(design: Design, ensemble: Ensemble, searched: SearchResult | None) -> StartOutcome | None:
    """The start case that decides the verdict: one that fails before one that breaks a limit, then the latest."""
    outcomes = (*ensemble.outcomes, *(() if searched is None else searched.outcomes))

    def order(outcome: StartOutcome) -> tuple[bool, bool, float, float]:
        """The decisive one last."""
        broken = any(breaks(outcome, design) for breaks, *_ in BROKEN.values())
        return outcome.member.promised and broken, broken, outcome.quiet_time_or_inf, outcome.level

    return max(outcomes, key=order, default=None)


def with_searched(
    check: Check, searched: SearchResult | None, design: Design, change: TriedChange | None = None
) -> Check:
    """A check of the listed starts that passes, with what a searched one breaks of it: that warns, or fails if all of
    it is promised. `change`: one with which no promised start breaks a limit, or what was tried.
    """
    if searched is None or check.status not in ("pass", "warn") or check.code not in BROKEN:
        return check
    breaks, order, words = BROKEN[check.code]
    broken = [outcome for outcome in searched.outcomes if breaks(outcome, design)]
    if not broken and searched.hurried:
        return replace(
            check, status="not-done", message=f"{check.message}. --patience ended the search of further start cases"
        )
    if not broken and searched.lost:
        return replace(
            check, status="warn", message=f"{check.message}. Further start cases without answer: {searched.lost}"
        )
    limit = design.case.table.limits.longest_quiet_time
    rare = check.code == "ABU702" and searched.outcomes and searched.foreseen > limit
    if not broken and not rare:
        return check
    worst = max(broken or searched.outcomes, key=order)
    value = float(len(broken)) if check.code == "ABU704" else DECIDES[check.code](worst)
    check = replace(check, value=value if broken else searched.foreseen)
    share = f"Further start cases: {len(broken)} of {len(searched.outcomes)} {words(worst)}"
    if not broken:
        share = (
            f"By the slowest of {len(searched.drawn)} start cases, one of {1 / RARE:.0f} takes "
            f"{searched.foreseen:.3g} s (limit {limit:g} s). The slowest further start case is quiet after "
            f"{worst.quiet_time_or_inf:.3g} s"
        )
    surely = [
        outcome for outcome in broken if fails(design, outcome) and not _within_error(check.code, outcome, design)
    ]
    message = f"{check.message}. {share}"
    if not surely:
        return replace(check, status="warn", message=message, remedy=check.remedy or NOT_TRIED)
    action = None if change is None else mended(change, check)
    if action is None:
        return replace(check, status="fail", message=message, remedy=check.remedy or NOT_TRIED)
    return coded(check.code, "fail", message, check.value, check.limit, check.unit, action)


def mended(change: TriedChange, check: Check) -> Action:
    """The action of a check that a promised start case fails, by the quantity that it judges."""
    if check.code == "ABU704":
        return change.counting(STALLED, lambda outcome: outcome.hanging, "")
    if check.code == "ABU701":
        return change.action(LEFT, lambda outcome: from_si(outcome.imbalance, "g_mm"), "g·mm", check.limit)
    if check.code == "ABU702":
        return change.action(SLOWEST, lambda outcome: outcome.quiet_time_or_inf, "s", check.limit)
    return change.action(LOUDEST, lambda outcome: outcome.level, "dB", check.limit)


def worst_further(searched: SearchResult, design: Design) -> Iterator[tuple[str, str, str]]:
    """Code of each check that further start cases break or come near to, the worst case in words, options to repeat it.

    The options are those of `abu simulate`. Quiet times count, too, if one start case of 1000 would be late.
    """
    limit = design.case.table.limits.longest_quiet_time
    for code, (breaks, order, _) in BROKEN.items():
        broken = [outcome for outcome in searched.outcomes if breaks(outcome, design)]
        if broken or (code == "ABU702" and searched.outcomes and searched.foreseen > limit):
            yield code, NAMES[code], repeated(max(broken or searched.outcomes, key=order), design)


def _late(outcome: StartOutcome, design: Design) -> bool:
    """True if it is late, or if its balls still creep at the end, however long it was followed."""
    return not outcome.in_time(design.case.table.limits) or (outcome.creeping and not outcome.hanging)


def _unbalanced(outcome: StartOutcome, design: Design) -> bool:
    """True if it does not balance; beyond what is promised, where friction leaves more, if it is not quiet either."""
    return not outcome.balanced and (outcome.member.promised or outcome.hanging or outcome.quiet_time is None)


def _loud(outcome: StartOutcome, design: Design) -> bool:
    """True if the level, with the error of a simulated one, is not below its limit."""
    return outcome.loudest + SLACK > design.case.level_limit


def _within_error(code: str, outcome: StartOutcome, design: Design) -> bool:
    """True if a level exceeds its limit by less than the error of its simulation, or not at all."""
    return code == "ABU401" and outcome.loudest <= design.case.level_limit + SLACK


def _time_in_words(outcome: StartOutcome) -> str:
    quiet, rest = (
        "never" if math.isinf(time) else f"after {time:.3g} s"
        for time in (outcome.quiet_time_or_inf, outcome.rest_time_or_inf)
    )
    return f"are late{' or still creep' * outcome.creeping}: the slowest is quiet {quiet}, at rest {rest}"


DECIDES: Final[dict[str, Callable[[StartOutcome], float | None]]] = {
    "ABU401": lambda outcome: outcome.loudest,
    "ABU701": lambda outcome: from_si(outcome.imbalance, "g_mm"),
    "ABU702": lambda outcome: outcome.quiet_time,
}
"""The value of a further start case that decides a check; of stalled balls the number of start cases counts."""
NOT_TRIED: Final = "No change was simulated; --full prints a command that repeats the start case, to try one."
NAMES: Final = {
    "ABU401": "loudest",
    "ABU701": "one with the largest imbalance left",
    "ABU702": "slowest",
    "ABU704": "one with the slowest ball",
}
"""The start case that is repeated for each check."""

Broken = tuple[Callable[[StartOutcome, Design], bool], Callable[[StartOutcome], float], Callable[[StartOutcome], str]]

BROKEN: Final[dict[str, Broken]] = {
    "ABU401": (
        _loud,
        loudness,
        lambda outcome: f"may be too loud, the loudest with {outcome.loudest:.1f} ± {SLACK:g} dB",
    ),
    "ABU701": (_unbalanced, lambda outcome: outcome.imbalance, lambda _: "do not balance"),
    "ABU702": (_late, slowness, _time_in_words),
    "ABU704": (lambda outcome, _: outcome.hanging, lambda outcome: outcome.slip, lambda _: "leave stalled balls"),
}
"""Rules of each check that start cases decide.

They give the failing cases, the worst of these, and the words for the failure.
"""
