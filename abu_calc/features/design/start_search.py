"""Search for start cases beyond the listed ones: a designed set over the whole race, then round the worst.

The listed start cases decide the checks. The search looks for worse ones: balls together at any angle to the imbalance,
as they lie at the bottom of a horizontal race, and balls anywhere, each at full speed and in run-ups of several times.
The neighbourhood of the slowest and of the loudest is searched last.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.foundation.units import from_si
from abu_calc.simulation.ensemble import every_start, first_tolerance
from abu_calc.simulation.ensemble_results import SLACK, StartOutcome
from abu_calc.simulation.scene_of_design import contact_half_angle
from abu_calc.simulation.start_cases import ALIKE, OPPOSITE, Member, usual_run_up
from abu_calc.sizing.case import EQUAL_SPEEDS
from abu_calc.sizing.design import Design

PLACES: Final = 8
"""Angles round the race at which balls lie together."""

SPREADS: Final = 12
"""Ways in which balls lie anywhere: the slowest starts are near arrangements that all but stay. Every third is tried in
a run-up, too."""

TIMES: Final = (1.0, 0.6, 1.6)
"""Factors on the run-up time of the file, used in turn."""

ROUNDS: Final = 2
"""Rounds of the search about the worst start case so far."""

HALF, MARGIN = 0.5, 2.0
"""Share of the permitted settling time, and distance below the permitted level [dB].

The search continues about start cases that are worse than either.
"""

TURNED: Final = math.radians(15)
"""Angle by which a start case is turned in the search."""

SPEED_STEP: Final = 0.15
"""Share of a speed range by which the speed of a start case is changed in the search."""

RARE: Final = 1e-3
"""Share of all starts that may take longer than permitted."""

SLOWEST: Final = 0.25
"""Share of the starts that were tried whose settling times say how long rare ones take."""

FEWEST: Final = 3
"""Fewest of the slowest start cases that tell a tail of their own."""

GOLDEN: Final = (math.sqrt(5) - 1) / 2

Angles = tuple[float, ...]


@dataclass(frozen=True)
class SearchResult:
    """Outcomes of the searched starts at the drag given; `lost`: how many gave no answer; `hurried`: whether the
    patience that was asked for ended the search.
    """

    outcomes: tuple[StartOutcome, ...]
    lost: int = 0
    hurried: bool = False
    listed: tuple[StartOutcome, ...] = ()
    """Outcomes of the listed starts at the same drag."""

    @property
    def foreseen(self) -> float:
        """Settling time [s] that a share `RARE` of all starts exceeds, by those that were tried; infinite if one never
        settles.
        """
        return exceeded([outcome.settling_time_or_inf for outcome in (*self.outcomes, *self.listed)], RARE)


def exceeded(times: Sequence[float], share: float) -> float:
    """Time that a share of all starts exceeds, where their tail is exponential: the largest T_k + s_k ln(k/(n share)).

    T_k: the largest but k of n times, s_k: the mean excess of these over it, for each k from `FEWEST` to a quarter of
    n. Balls that linger in an unstable equilibrium leave it as e^{λt}, and balls that creep arrive as e^{−λt}, so that
    their settling times have such a tail. A few that creep among many that do not have one of their own, which only a
    small k shows. Source: Pickands 1975, Statistical inference using extreme order statistics, for the tail of shape
    zero.

    >>> round(exceeded([0.1] * 9 + [0.2, 0.3, 0.4], 1e-3), 3)
    1.204
    """
    slowest = sorted(times, reverse=True)
    quarter = round(SLOWEST * len(slowest))
    if not quarter or math.isinf(slowest[0]):
        return max(slowest, default=0.0)
    estimates = (
        slowest[k] + (sum(slowest[:k]) / k - slowest[k]) * math.log(k / (len(slowest) * share))
        for k in range(min(FEWEST, quarter), quarter + 1)
    )
    return max(slowest[0], *estimates)


def search(design: Design, accuracy: float, progress: Progress = silent, workers: int = 1) -> SearchResult:
    """The designed starts, and those near the worst of them. The same whatever the number of workers."""
    outcomes, tried, lost = list[StartOutcome](), set[Member](), 0
    round_of_starts = [*designed(design), *at_other_speeds(design)]
    for _ in range(1 + ROUNDS):
        tried.update(round_of_starts)
        answers = _run(design, round_of_starts, accuracy, progress, workers)
        lost += len(round_of_starts) - len(answers)
        outcomes += answers
        if not outcomes or patience.over():
            break
        worst = [max(outcomes, key=order) for order in (_slowness, _loudness)]
        doubtful = [outcome.member for outcome in worst if _doubtful(outcome, design)]
        near = (start for member in doubtful for start in (*neighbours(member), *at_near_speeds(member, design)))
        round_of_starts = [start for start in dict.fromkeys(near) if start not in tried]
    return SearchResult(tuple(outcomes), lost, hurried=patience.over())


def _doubtful(outcome: StartOutcome, design: Design) -> bool:
    """True if a start case near this one might exceed a limit."""
    late = outcome.settling_time_or_inf > HALF * design.case.table.limits.settling_time_s
    return late or outcome.loudest > design.case.level_limit - MARGIN


def _slowness(outcome: StartOutcome) -> float:
    return outcome.settling_time_or_inf


def _loudness(outcome: StartOutcome) -> float:
    return outcome.loudest


def designed(design: Design) -> Iterator[Member]:
    """Balls together at angles round the race, then spread anywhere; at full speed and in run-ups, the race off to
    either side in turn.
    """
    usual = usual_run_up(design)
    for k, angles in enumerate((*bunches(design), *spreads(design))):
        sides = (ALIKE, OPPOSITE) if k % 2 else (OPPOSITE, ALIKE)
        yield Member("placed", design.case.drag, 0.0, sides[0], angles=angles)
        if k >= PLACES and k % 3:
            continue
        run_up = usual.run_up if usual.by_motor else usual.run_up * TIMES[k % len(TIMES)]
        yield replace(usual, start="placed", run_up=run_up, eccentricity=sides[1], angles=angles)


def at_other_speeds(design: Design) -> Iterator[Member]:
    """Balls spread anywhere at the ends and in the middle of a speed range, every third in a run-up, too.

    The rated speed is that of the designed starts. A motor idles at one speed.
    """
    usual = usual_run_up(design)
    if usual.by_motor:
        return
    for place, speed in enumerate(_other_speeds(design)):
        for k, angles in enumerate(spreads(design)):
            sides = (ALIKE, OPPOSITE) if (k + place) % 2 else (OPPOSITE, ALIKE)
            yield Member("placed", design.case.drag, 0.0, sides[0], speed, angles=angles)
            if not k % 3:
                yield replace(usual, start="placed", eccentricity=sides[1], speed=speed, angles=angles)


def _other_speeds(design: Design) -> list[float]:
    """Ends and middle of the speed range [rad/s], but for the rated speed."""
    low, high = design.case.speed_range
    speeds = dict.fromkeys((low, (low + high) / 2, high))
    return [speed for speed in speeds if not math.isclose(speed, design.case.speed, rel_tol=EQUAL_SPEEDS)]


def at_near_speeds(member: Member, design: Design) -> Iterator[Member]:
    """The same start at speeds of the range a little below and above; a motor idles at one speed."""
    (low, high), speed = design.case.speed_range, member.speed or design.case.speed
    if design.case.table.motor is not None or math.isclose(low, high, rel_tol=EQUAL_SPEEDS):
        return
    for near in (max(speed - SPEED_STEP * (high - low), low), min(speed + SPEED_STEP * (high - low), high)):
        if not math.isclose(near, speed, rel_tol=EQUAL_SPEEDS):
            at_rated = math.isclose(near, design.case.speed, rel_tol=EQUAL_SPEEDS)
            yield replace(member, speed=None if at_rated else near)


def bunches(design: Design) -> Iterator[Angles]:
    """Neighbours touching, their middle at equal angles round the race."""
    count, step = design.autobalancer.ball_count, 2 * contact_half_angle(design)
    for place in range(PLACES):
        middle = math.tau * (place + 0.25) / PLACES  # neither on the imbalance nor opposite
        yield tuple((middle + (ball - (count - 1) / 2) * step) % math.tau for ball in range(count))


def spreads(design: Design) -> Iterator[Angles]:
    """Anywhere, without overlap: a low-discrepancy sequence shares the free way out among the gaps."""
    count, step = design.autobalancer.ball_count, 2 * contact_half_angle(design)
    free = max(math.tau - count * step, 0.0)
    for way in range(SPREADS):
        shares = [-math.log(1 - (((way * count + ball + 1) * GOLDEN) % 1.0)) for ball in range(count)]
        place, angles = math.tau * (way * GOLDEN % 1.0), list[float]()
        for share in shares:
            place += step + free * share / sum(shares)
            angles.append(place % math.tau)
        yield tuple(angles)


def neighbours(member: Member) -> Iterator[Member]:
    """Turned either way, with one ball elsewhere, with the race off to the other side, in other times."""
    for turned in (TURNED, -TURNED):
        yield replace(member, angles=tuple((angle + turned) % math.tau for angle in member.angles))
    first, *others = member.angles
    yield replace(member, angles=((first + 2 * TURNED) % math.tau, *others))
    yield replace(member, eccentricity=OPPOSITE if member.eccentricity == ALIKE else ALIKE)
    if member.run_up and not member.by_motor:
        yield replace(member, run_up=1.15 * member.run_up)
        yield replace(member, run_up=member.run_up / 1.15)


def _run(
    design: Design, starts: Sequence[Member], accuracy: float, progress: Progress, workers: int
) -> list[StartOutcome]:
    """Outcomes of the start cases that gave an answer."""
    early = [(start, True) for start in starts]
    answers = every_start(design, early, accuracy, first_tolerance(design), within(progress, "further"), workers)
    return [outcome for outcome in answers if isinstance(outcome, StartOutcome)]


def repeated(outcome: StartOutcome, design: Design) -> str:
    """The options of `abu simulate` that repeat a start of a design, which they pin."""
    member = outcome.member
    angles = ", ".join(f"{from_si(angle, 'deg'):.4f}" for angle in member.angles)
    balls = design.autobalancer
    sets = [
        f"autobalancer.ball_count={balls.ball_count}",
        f"autobalancer.ball_diameter_mm={from_si(balls.ball_diameter, 'mm'):.10g}",
        *(_pinned_at(member.speed, design) if member.speed is not None else ()),
        *([f"run_up.time_s={member.run_up:.10g}"] if member.run_up and not member.by_motor else []),
        f"'start.angles_deg=[{angles}]'",
    ]
    scene = "--scene run-up " if member.run_up else ""
    scene += f"--duration {outcome.duration:.6g} " if outcome.duration else ""
    return f"{scene}--race-centre {member.race_centre_deg:g} {' '.join(f'--set {entry}' for entry in sets)}"


def _pinned_at(speed: float, design: Design) -> Iterator[str]:
    """Entries that rate the machine at another speed [rad/s], with its race and imbalance as they are.

    A motor runs up to its idle speed, whatever is rated.
    """
    if design.case.table.motor is None:
        yield f"machine.speed_rpm={from_si(speed, 'rpm'):.10g}"
        yield f"autobalancer.race_radius_mm={from_si(design.autobalancer.race_radius, 'mm'):.10g}"
        yield f"wheel.imbalance_g_mm={from_si(design.imbalance.value, 'g_mm'):.10g}"


def with_searched(check: Check, searched: SearchResult | None, design: Design) -> Check:
    """A check of the listed starts that passes, with what a searched one breaks of it: that warns."""
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
    limit = design.case.table.limits.settling_time_s
    rare = check.code == "ABU702" and searched.outcomes and searched.foreseen > limit
    if not broken and not rare:
        return check
    worst = max(broken or searched.outcomes, key=order)
    share = f"Further start cases: {len(broken)} of {len(searched.outcomes)} {words(worst)}"
    if not broken:
        share = (
            f"By the slowest of all start cases, one of {1 / RARE:.0f} takes {searched.foreseen:.3g} s (limit "
            f"{limit:g} s). The slowest further start case settles in {worst.settling_time_or_inf:.3g} s"
        )
    return replace(check, status="warn", message=f"{check.message}. {share}", remedy=check.remedy or NOT_TRIED)


def worst_further(searched: SearchResult, design: Design) -> Iterator[tuple[str, str, str]]:
    """Code of each check that further start cases break or come near to, the worst case in words, options to repeat it.

    The options are those of `abu simulate`. Settling times count, too, if one start case of 1000 would be late.
    """
    limit = design.case.table.limits.settling_time_s
    for code, (breaks, order, _) in BROKEN.items():
        broken = [outcome for outcome in searched.outcomes if breaks(outcome, design)]
        if broken or (code == "ABU702" and searched.outcomes and searched.foreseen > limit):
            yield code, NAMES[code], repeated(max(broken or searched.outcomes, key=order), design)


def _late(outcome: StartOutcome, design: Design) -> bool:
    return outcome.settling_time_or_inf > design.case.table.limits.settling_time_s


def _loud(outcome: StartOutcome, design: Design) -> bool:
    """True if the level, with the error of a simulated one, is not below its limit."""
    return outcome.loudest + SLACK > design.case.level_limit


def _time_in_words(outcome: StartOutcome) -> str:
    return (
        "never settle"
        if math.isinf(outcome.settling_time_or_inf)
        else f"settle too late, the slowest in {outcome.settling_time_or_inf:.3g} s"
    )


NOT_TRIED: Final = "No change was simulated; --full prints a command to try one."
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
        _loudness,
        lambda outcome: f"may be too loud, the loudest with {outcome.loudest:.1f} ± {SLACK:g} dB",
    ),
    "ABU701": (lambda outcome, _: not outcome.balanced, lambda outcome: outcome.imbalance, lambda _: "do not balance"),
    "ABU702": (_late, _slowness, _time_in_words),
    "ABU704": (lambda outcome, _: outcome.hanging, lambda outcome: outcome.slip, lambda _: "leave stalled balls"),
}
"""Rules of each check that start cases decide.

They give the failing cases, the worst of these, and the words for the failure.
"""
