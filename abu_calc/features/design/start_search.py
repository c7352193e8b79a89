"""Search for start cases beyond the listed ones: a designed set over the whole race, then round the worst.

Rare settling times are estimated from the listed and the designed starts alone, which no result has chosen. If they
seem a little late, more parts of the designed set are run and estimate them anew.

The listed start cases decide the checks. The search looks for worse ones: balls together at any angle to the imbalance,
as they lie at the bottom of a horizontal race, and balls anywhere, each at full speed and in run-ups of several times.
The neighbourhood of the slowest and of the loudest is searched last.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import cycle
from operator import attrgetter
from typing import Final

from abu_calc.features.design.band import corners, promised, usual, worse_wheels
from abu_calc.foundation import patience
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.simulation.ensemble import (
    MORE,
    TIGHTER,
    WORK,
    Runner,
    Watch,
    called_for,
    every_start,
    first_tolerance,
    start_once,
)
from abu_calc.simulation.start_cases import ALIKE, OPPOSITE, SLACK, Member, StartOutcome, usual_run_up
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

PARTS: Final = 4
"""Parts of the designed set at most. One is run always, the others if rare starts seem late by the first."""

NEAR: Final = 1.5
"""Estimate of a rare settling time over that permitted, up to which more starts may lower it enough. On fifteen random
machines the other parts lowered one by a quarter mostly, by 41 % at most, and none above this below the time permitted.
"""

SLOWEST: Final = 0.25
"""Share of the starts that were tried whose settling times say how long rare ones take."""

FEWEST: Final = 3
"""Fewest of the slowest start cases that tell a tail of their own."""

MANY: Final = 20
"""Fewest of the slowest start cases that tell whether their tail ends."""

SURE: Final = 1.645
"""Standard deviations by which the scatter of an exponential tail exceeds that of one that ends: wrong in one of 20."""

MOST_CONFIRMED: Final = 8
"""Promised starts that break a limit of which closer runs are made, the slowest first."""

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
    near: int = 0
    """How many of the outcomes, the last, are of starts near the worst: a result chose them."""

    @property
    def drawn(self) -> tuple[StartOutcome, ...]:
        """Outcomes of the promised starts that no result has chosen: the designed and the listed ones."""
        designed = self.outcomes[: len(self.outcomes) - self.near]
        return *(outcome for outcome in designed if outcome.member.promised), *self.listed

    @property
    def foreseen(self) -> float:
        """Settling time [s] that a share `RARE` of all starts exceeds, by those drawn; infinite if one never settles.

        Starts near the slowest would count its part of the race many times, those near the loudest another.
        """
        return exceeded([outcome.quiet_time_or_inf for outcome in self.drawn], RARE)


def exceeded(times: Sequence[float], share: float) -> float:
    """Time that a share of all starts exceeds: the largest T_k + s_k ln(k/(n share)) of exponential tails.

    T_k: the largest but k of n times, s_k: the mean excess of these over it, for each k from `FEWEST` to a quarter of
    n. Balls that linger in an unstable equilibrium leave it as e^{λt}, and balls that creep arrive as e^{−λt}, so that
    their settling times have such a tail. A few that creep among many that do not have one of their own, which only a
    small k shows. Friction that lets no ball linger ends a tail: `tail_shape` ξ < 0 makes the estimates
    T_k + s_k (1 − ξ) ((k/(n share))^ξ − 1)/ξ. The largest of several estimates is some 12 % above the true time, on
    the safe side. Range: `times` of starts that none of the times has chosen, 30 or more of them; `share` down to about
    1/(30 n). Tails of a tenth of the starts or less need 100 times. Source: Pickands 1975, Statistical inference using
    extreme order statistics; Hosking & Wallis 1987 for the moments.

    >>> round(exceeded([0.1] * 9 + [0.2, 0.3, 0.4], 1e-3), 3)
    1.204
    """
    slowest = sorted(times, reverse=True)
    quarter = round(SLOWEST * len(slowest))
    if not quarter or math.isinf(slowest[0]):
        return max(slowest, default=0.0)
    shape = tail_shape([time - slowest[quarter] for time in slowest[:quarter]])
    estimates = []
    for k in range(min(FEWEST, quarter), quarter + 1):
        mean, rarer = sum(slowest[:k]) / k - slowest[k], math.log(k / (len(slowest) * share))
        scales = math.expm1(shape * rarer) * (1 - shape) / shape if shape else rarer
        estimates.append(slowest[k] + mean * scales)
    return max(slowest[0], *estimates)


def tail_shape(excesses: Sequence[float]) -> float:
    """Shape ξ = (1 − 1/c²)/2 of a generalised Pareto tail that ends, c the coefficient of variation; else 0.

    c is 1 for an exponential tail, with a standard error of about 1/√k. Only if c is lower by `SURE` of these does the
    tail count as one that ends. Fewer than `MANY` excesses cannot tell.

    >>> tail_shape([0.1 * k for k in range(1, 21)]) < 0 == tail_shape([0.1, 0.2, 0.3])
    True
    """
    count, mean = len(excesses), sum(excesses) / max(len(excesses), 1)
    if count < MANY or not mean:
        return 0.0
    variation = math.sqrt(sum((excess - mean) ** 2 for excess in excesses) / (count - 1)) / mean
    ends = 0 < variation < 1 - SURE / math.sqrt(count)
    return (1 - 1 / variation**2) / 2 if ends else 0.0


def search(
    design: Design,
    accuracy: float,
    progress: Progress = silent,
    workers: int = 1,
    listed: tuple[StartOutcome, ...] = (),
    watch: Watch | None = None,
    most: int | None = None,
) -> SearchResult:
    """The designed starts, and those near the worst of them. The same whatever the number of workers.

    `listed`: outcomes of the listed starts at the drag given; `watch`: looks at each outcome; `most`: designed starts
    at most, of all kinds, and none near the worst.
    """

    def run(starts: Sequence[Member]) -> tuple[StartOutcome, ...]:
        return _run(design, starts, accuracy, progress, workers, watch)

    starts = list(design_part(design, 0))
    if most is not None and most < len(starts):
        starts = [starts[k * len(starts) // most] for k in range(most)]
    found, asked, limit = run(starts), len(starts), design.case.table.limits.longest_quiet_time
    none_late = max((slowness(each) for each in found if each.member.promised), default=math.inf) <= limit
    seems_late = limit < SearchResult(found, listed=listed).foreseen <= NEAR * limit
    if none_late and seems_late and most is None:
        for part in range(1, PARTS):
            if not patience.over():
                starts = list(design_part(design, part))
                found, asked = (*found, *run(starts)), asked + len(starts)
    near, tried = tuple[StartOutcome, ...](), set[Member]()
    for _ in range(ROUNDS if most is None else 0):
        if not found or patience.over():
            break
        some = [outcome for outcome in (*found, *near) if outcome.member.promised]
        worst = [max(some, key=order) for order in (slowness, loudness)] if some else []
        doubtful = [outcome.member for outcome in worst if _doubtful(outcome, design)]
        neighbourhood = (
            start for member in doubtful for start in (*neighbours(member), *at_near_speeds(member, design))
        )
        tried.update(starts)
        starts = [start for start in dict.fromkeys(neighbourhood) if start not in tried]
        near, asked = (*near, *run(starts)), asked + len(starts)
    outcomes = _confirmed(design, (*found, *near), accuracy, progress, workers)
    return SearchResult(outcomes, asked - len(outcomes), patience.over(), listed, len(near))


def fails(design: Design, outcome: StartOutcome) -> bool:
    """True if a promised start case breaks a limit, by a closer run, too, and the level by more than its error."""
    kept = outcome.holds(design.case.table.limits, design.case.level_limit + SLACK)
    return outcome.member.promised and outcome.confirmed and not kept


def _confirmed(
    design: Design, outcomes: tuple[StartOutcome, ...], accuracy: float, progress: Progress, workers: int
) -> tuple[StartOutcome, ...]:
    """The same with the promised starts that break a limit run again, more closely."""
    limits, level = design.case.table.limits, design.case.level_limit
    broken = [k for k, each in enumerate(outcomes) if each.member.promised and not each.holds(limits, level)]
    broken = sorted(broken, key=lambda k: slowness(outcomes[k]), reverse=True)[:MOST_CONFIRMED]
    again = [(outcomes[k].member, True) for k in broken]
    tolerance = TIGHTER * first_tolerance(design)
    runs = every_start(design, again, accuracy, tolerance, within(progress, "closer"), workers, MORE * WORK)
    closer = {k: replace(run, confirmed=True) for k, run in zip(broken, runs, strict=True)
              if isinstance(run, StartOutcome)}  # fmt: skip
    return tuple(closer.get(k, each) for k, each in enumerate(outcomes))


def _doubtful(outcome: StartOutcome, design: Design) -> bool:
    """True if a start case near this one might exceed a limit."""
    late = outcome.quiet_time_or_inf > HALF * design.case.table.limits.longest_quiet_time
    return late or outcome.loudest > design.case.level_limit - MARGIN


slowness, loudness = attrgetter("quiet_time_or_inf"), attrgetter("loudest")
"""Quiet time [s], infinite if the machine never is; level at the loudest time and place [dB]."""


def design_part(design: Design, part: int) -> Iterator[Member]:
    """The designed starts of one part, at the rated speed and at others of a range; no part has a start of another.

    The first has those of machines anywhere in the band, too.
    """
    yield from designed(design, part)
    yield from at_other_speeds(design, part)
    if not part:
        yield from promised(design, anywhere(design, PARTS))
        yield from corners(design)
        yield from usual(design, anywhere(design, PARTS + 1))
        yield from worse_wheels(design, anywhere(design, PARTS + 2))


def anywhere(design: Design, part: int) -> Iterator[Member]:
    """Balls together and spread anywhere at the places of a part, at the speeds of a range in turn."""
    ranged: list[float | None] = [] if usual_run_up(design).by_motor else [*_other_speeds(design)]
    for angles, speed in zip((*bunches(design, part), *spreads(design, part)), cycle([None, *ranged]), strict=False):
        yield Member("placed", design.case.drag, speed=speed, angles=angles)


def designed(design: Design, part: int = 0) -> Iterator[Member]:
    """Balls together at angles round the race, then spread anywhere; at full speed and in run-ups, the race off to
    either side in turn.
    """
    own = usual_run_up(design)
    for k, angles in enumerate((*bunches(design, part), *spreads(design, part))):
        sides = (ALIKE, OPPOSITE) if k % 2 else (OPPOSITE, ALIKE)
        yield Member("placed", design.case.drag, 0.0, sides[0], angles=angles)
        if k >= PLACES and k % 3:
            continue
        times = 1.0 if own.by_motor else TIMES[k % len(TIMES)]
        yield replace(
            own, start="placed", run_up=times * own.run_up, eccentricity=sides[1], angles=angles,
            promised=times == 1,
        )  # fmt: skip


def at_other_speeds(design: Design, part: int = 0) -> Iterator[Member]:
    """Balls spread anywhere at the ends and in the middle of a speed range, every third in a run-up, too.

    The rated speed is that of the designed starts. A motor idles at one speed.
    """
    own = usual_run_up(design)
    if own.by_motor:
        return
    for place, speed in enumerate(_other_speeds(design)):
        for k, angles in enumerate(spreads(design, part)):
            sides = (ALIKE, OPPOSITE) if (k + place) % 2 else (OPPOSITE, ALIKE)
            yield Member("placed", design.case.drag, 0.0, sides[0], speed, angles=angles)
            if not k % 3:
                yield replace(own, start="placed", eccentricity=sides[1], speed=speed, angles=angles)


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


def bunches(design: Design, part: int = 0) -> Iterator[Angles]:
    """Neighbours touching, their middle at equal angles round the race; those of each part between those before."""
    count, step = design.autobalancer.ball_count, 2 * design.autobalancer.half_angle
    within_step = (0.25 + part * GOLDEN) % 1.0  # of the first part neither on the imbalance nor opposite
    for place in range(PLACES):
        middle = math.tau * (place + within_step) / PLACES
        yield tuple((middle + (ball - (count - 1) / 2) * step) % math.tau for ball in range(count))


def spreads(design: Design, part: int = 0) -> Iterator[Angles]:
    """Anywhere, without overlap: a low-discrepancy sequence shares the free way out among the gaps.

    Each part continues the sequence.
    """
    count, step = design.autobalancer.ball_count, 2 * design.autobalancer.half_angle
    free = max(math.tau - count * step, 0.0)
    for way in range(part * SPREADS, (part + 1) * SPREADS):
        shares = [-math.log(1 - (((way * count + ball + 1) * GOLDEN) % 1.0)) for ball in range(count)]
        place, angles = math.tau * (way * GOLDEN % 1.0), list[float]()
        for share in shares:
            place += step + free * share / sum(shares)
            angles.append(place % math.tau)
        yield tuple(angles)


def neighbours(member: Member) -> Iterator[Member]:
    """Turned either way and with one ball elsewhere, if balls are placed; with the race off to the other side; in other
    times.
    """
    if member.angles:
        for turned in (TURNED, -TURNED):
            yield replace(member, angles=tuple((angle + turned) % math.tau for angle in member.angles))
        first, *others = member.angles
        yield replace(member, angles=((first + 2 * TURNED) % math.tau, *others))
    yield replace(member, eccentricity=OPPOSITE if member.eccentricity == ALIKE else ALIKE)
    if member.run_up and not member.by_motor:
        yield replace(member, run_up=1.15 * member.run_up)
        yield replace(member, run_up=member.run_up / 1.15)


def _run(
    design: Design, starts: Sequence[Member], accuracy: float, progress: Progress, workers: int, watch: Watch | None
) -> tuple[StartOutcome, ...]:
    """Outcomes of the start cases that gave an answer. When balls rest decides nothing beside listed ones."""
    early, runner = (
        [(start, True) for start in starts],
        Runner(partial(start_once, to_rest=False), called_for, watch=watch),
    )
    answers = every_start(
        design, early, accuracy, first_tolerance(design), within(progress, "further"), workers, runner=runner
    )
    return tuple(outcome for outcome in answers if isinstance(outcome, StartOutcome))
