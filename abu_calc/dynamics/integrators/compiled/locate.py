"""Event location: the first moment within a step at which a watched number falls below zero.

Numbers are taken from the dense output at quarters of the step. A number that starts at or below zero has just been
switched: it counts once it has risen, and if it never does, the event is the very start. A number that falls and rises
again within two quarters is located by a parabola through three of its values. If all numbers that cost an evaluation
are the same at both ends, or far from zero there, the others are looked at by themselves.
"""

from abu_calc.dynamics.integrators.compiled.arrays import (
    APPARENT,
    BALLS,
    EVALUATIONS,
    FOUND,
    FRICTION,
    ORDER,
    SEEN,
    VALUES,
    WATCHED,
    Integers,
    Reals,
    Step,
    Watch,
    apparent,
    watched,
)
from abu_calc.dynamics.integrators.compiled.dopri5 import dense, within

CHECKS = 4
NEVER = 2.0
"""No event in the step."""
PRESSED = 0.5
"""Least share of two forces, at both ends of a step, with which no ball leaves the race in between.

The race must press on all balls with this share of its largest normal force, and of the force that
keeps a ball on its way round with the rotor.
"""
FINE = 2e-16
"""Share of a step, or of the time itself, to which an event is located."""


def moving(lay: Integers, before: Reals, after: Reals) -> int:
    """Number of watched numbers, in their order, that may fall within a step, by all of them at its ends."""
    first, balls = lay[FRICTION] + 2 * lay[BALLS], lay[BALLS] if lay[FRICTION] >= 0 else 0
    for k in range(lay[SEEN], lay[WATCHED]):
        i = lay[lay[ORDER] + k]
        if before[i] != after[i] and not (i >= first and i < first + balls):
            return lay[WATCHED]
    least = PRESSED
    for i in range(first, first + balls):
        least = max(least, PRESSED * max(before[i], after[i]))
    for i in range(first, first + balls):
        if not (before[i] > least and after[i] > least):
            return lay[WATCHED]
    return lay[SEEN]


def look(many: int, x: float, step: Step, watch: Watch, w: Reals) -> None:
    """State and so many of the watched numbers at a share x of the step."""
    dense(x, step.n, step.y, step.between, step.at)
    if many > watch.lay[SEEN]:
        watch.counts[EVALUATIONS] += 1
        watched(step.t + x * step.h, step.at, step.par, watch.dy, w)
    else:
        apparent(step.t + x * step.h, step.at, step.par, w)


def peek(index: int, x: float, step: Step, watch: Watch) -> float:
    """One watched number at a share x of the step; the others are then of no moment."""
    lay, at, w = watch.lay, step.at, watch.w
    few = lay[lay[APPARENT] + index]
    if few >= 0:
        for k in range(lay[few]):
            i = lay[few + 1 + k]
            at[i] = within(i, x, step.n, step.y, step.between)
        apparent(step.t + x * step.h, at, step.par, w)
    else:
        look(lay[WATCHED], x, step, watch, w)
    return w[index]


def resolved(step: Step) -> float:
    """Share of a step below which moments are one."""
    return FINE * (1.0 + 8.0 * abs(step.t) / step.h)


def crossing(index: int, above: float, high: float, below: float, low: float, step: Step, watch: Watch) -> float:
    """Place between two others at which a number falls below zero; the number is below zero there.

    Source: Chandrupatla 1997, Advances in Engineering Software 28(3), 145: inverse quadratic where that is
    safe.
    """
    a, fa, b, fb, c, fc = below, low, above, high, above, high
    share = fa / (fa - fb)
    least = resolved(step)
    for _ in range(100):
        x = a + share * (b - a)
        fx = peek(index, x, step, watch)
        if (fx < 0.0) == (fa < 0.0):
            c, fc = a, fa
        else:
            c, fc, b, fb = b, fb, a, fa
        a, fa = x, fx
        limit = least / abs(b - a)
        if limit > 0.5 or fa == 0.0:
            break
        share = 0.5
        if fc != fb and fc != fa:
            way, bend = (a - b) / (c - b), (fa - fb) / (fc - fb)
            if bend * bend < way and (1.0 - bend) * (1.0 - bend) < 1.0 - way:
                share = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        share = min(max(share, limit), 1.0 - limit)
    return a if fa < 0.0 or fa == 0.0 else b


def dips(many: int, check: int, step: Step, watch: Watch) -> float:
    """The first event of the numbers that fall and rise again within the last two quarters."""
    lay, rows = watch.lay, watch.rows
    values, event = lay[VALUES], NEVER
    first, second, third = rows[(check - 2) * values :], rows[(check - 1) * values :], rows[check * values :]
    for k in range(many):
        i = lay[lay[ORDER] + k]
        slope, later = second[i] - first[i], third[i] - second[i]
        bend = 0.5 * (later - slope)
        # By the parabola it falls at the first of the three and rises at the last.
        if slope < bend and later > -bend and first[i] > 0.0 and second[i] > 0.0 and third[i] > 0.0:
            lowest = 0.5 - slope / (2.0 * bend)
            if lowest > 0.0 and lowest < 2.0 and first[i] + lowest * (slope + bend * (lowest - 1.0)) < 0.0:
                x = (check - 2 + lowest) / CHECKS
                if peek(i, x, step, watch) < 0.0:
                    above = (check - 2) / CHECKS if lowest < 1.0 else (check - 1) / CHECKS
                    high = first[i] if lowest < 1.0 else second[i]
                    x = crossing(i, above, high, x, watch.w[i], step, watch)
                    if x < event:
                        event = x
                        watch.counts[FOUND] = i
    return event


def fallen(many: int, check: int, step: Step, watch: Watch) -> float:
    """The first event of the numbers that are below zero at a check.

    Looked for is the one that a straight line says is first, then any that is below zero there: in between others may
    have fallen and risen again, such as what presses balls together shortly before another hits them.
    """
    lay, rows = watch.lay, watch.rows
    values, start, event = lay[VALUES], (check - 1) / CHECKS, check / CHECKS
    before, low = rows[(check - 1) * values :], rows[check * values :]
    which = earliest(many, lay, before, low, -1)
    if which < 0:
        return NEVER
    while which >= 0:
        watch.counts[FOUND] = which
        if before[which] <= 0.0:
            return start
        x = crossing(which, start, before[which], event, low[which], step, watch)
        if x > event - resolved(step):
            return x
        event = x
        look(many, event, step, watch, watch.w)
        low = watch.w
        which = earliest(many, lay, before, low, which)
    return event


def earliest(many: int, lay: Integers, before: Reals, here: Reals, known: int) -> int:
    """Index of the number that falls below zero first by a straight line; −1 if there is none.

    One number is left out. Numbers that cost next to nothing come before all others: few of the others are
    below zero where the first of them is.
    """
    which, least = -1, NEVER
    for k in range(many):
        if k == lay[SEEN] and which >= 0:
            break
        i = lay[lay[ORDER] + k]
        if here[i] < 0.0 and i != known:
            share = before[i] / (before[i] - here[i]) if before[i] > 0.0 else 0.0
            if share < least:
                which, least = i, share
    return which


def located(step: Step, watch: Watch) -> float:
    """The share of the step at which the first event is, and in the counts which number fell."""
    lay, count, rows = watch.lay, watch.counts, watch.rows
    many = moving(lay, rows, rows[CHECKS * lay[VALUES] :])
    for check in range(1, CHECKS + 1):
        if check < CHECKS:
            look(many, check / CHECKS, step, watch, rows[check * lay[VALUES] :])
        event = NEVER
        if check > 1:
            event = dips(many, check, step, watch)
        which = count[FOUND]
        other = fallen(many, check, step, watch)
        if event < other:
            count[FOUND] = which
            return event
        if other < NEVER:
            return other
    return NEVER
