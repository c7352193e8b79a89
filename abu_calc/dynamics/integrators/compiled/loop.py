"""Loop of steps, located events and decisions, until the end or until the general decision is needed.

The names of a method are those of `dopri5`; if the loop is built for another method, they are that one's.

The factor on the next step follows from the error of the last and the order of the method. Source: Hairer, Nørsett &
Wanner 1993, Solving Ordinary Differential Equations I, II.4.
"""

from abu_calc.dynamics.integrators.compiled.arrays import (
    BEGUN,
    DONE,
    END,
    EVALUATIONS,
    EVENTS,
    FOUND,
    LONGEST,
    MOST,
    NOT_FINITE,
    PAUSE,
    PAUSED,
    REACHED,
    SAMPLES,
    SCALES,
    STALL,
    STALLED,
    STALLS,
    START,
    STATES,
    STEP,
    STEPS,
    TIME,
    TOO_MUCH,
    TOO_SMALL,
    UNDECIDED,
    VALUES,
    WATCHED,
    Reals,
    Run,
    Step,
    Watch,
    setup,
    watched,
)
from abu_calc.dynamics.integrators.compiled.dopri5 import (
    BETWEEN,
    EXPONENT,
    EXTRA,
    KEPT,
    LAST,
    STAGES,
    dense,
    error,
    prepared,
    stages,
)
from abu_calc.dynamics.integrators.compiled.locate import NEVER, located
from abu_calc.dynamics.integrators.compiled.mode_transitions import decided
from abu_calc.dynamics.integrators.run import LOOP_EVENT, MOST_STALLED

LEAST_FACTOR, MOST_FACTOR, SAFETY = 0.2, 10.0, 0.9


def shorter(off: float) -> float:
    """Factor on a step whose error is too large, or no number."""
    if off < 1e10:
        factor: float = SAFETY * off**EXPONENT
        return max(LEAST_FACTOR, factor)
    return LEAST_FACTOR


def longer(off: float) -> float:
    """Factor on the next step."""
    if off > 1e-10:
        factor: float = SAFETY * off**EXPONENT
        return min(MOST_FACTOR, factor)
    return MOST_FACTOR


SMALLEST = 4e-15
"""Steps below this share of the time are lost in rounding."""
CLOSER = 1e-4
"""Share of the longest step below which a number that does not rise was switched wrongly.

It applies to a number that does not rise from the start of the step.
"""


def go(run: Run, samples: Reals, states: Reals, room: Reals) -> int:
    """Integrate a run from its present time toward its end; return how it comes back."""
    y, par, lay, con, clock, count = run.y, run.par, run.lay, run.con, run.clock, run.counts
    n, values = lay[STATES], lay[VALUES]
    end, at, dy = room[KEPT * n :], room[(KEPT + 1) * n :], room[(KEPT + 2) * n :]
    between, rows = room[(KEPT + 3) * n :], room[(KEPT + 3 + BETWEEN) * n :]
    w, last, deciding = rows[5 * values :], rows[4 * values :], rows[6 * values :]
    t, h, bound = clock[TIME], clock[STEP], con[END]
    absolute, relative = con[SCALES:], con[SCALES + n :]
    watch = Watch(lay, count, dy, w, rows)
    setup(run.numbers, par)
    watched(t, y, par, room, rows)
    count[EVALUATIONS] += 1
    if count[START] > 0:
        count[START], count[FOUND] = 0, -1
        if not decided(t, run, room, rows, deciding):
            return UNDECIDED
    if count[DONE] == 0 and count[SAMPLES] > 0 and samples[0] <= t:
        for i in range(n):
            states[i] = y[i]
        count[DONE] = 1
    most = MOST_FACTOR
    while t < bound:
        clock[TIME], clock[STEP] = t, h
        if count[EVALUATIONS] + LOOP_EVENT * count[EVENTS] > count[MOST]:
            return TOO_MUCH
        if count[EVALUATIONS] > count[PAUSE]:
            return PAUSED
        h = min(h, con[LONGEST])
        reached, size = t + h, h
        if reached >= bound:
            reached, size = bound, bound - t
        step = Step(t, size, n, y, par, end, room, between, at)
        stages(step, last)
        count[EVALUATIONS] += STAGES
        off = error(step, absolute, relative)
        if not off <= 1.0:
            h, most = size * shorter(off), 1.0
            if h < SMALLEST * abs(t) or h < 1e-300:
                return TOO_SMALL if off - off == 0.0 else NOT_FINITE
            continue
        if not finite(n, end):
            return NOT_FINITE
        count[STEPS] += 1
        further = size * min(most, longer(off))
        most = MOST_FACTOR
        x = NEVER
        if lay[WATCHED] > 0 or (count[DONE] < count[SAMPLES] and samples[count[DONE]] <= reached):
            prepared(step)
            count[EVALUATIONS] += EXTRA
        if lay[WATCHED] > 0:
            x = located(step, watch)
        came = reached if x == NEVER else t + x * size
        while count[DONE] < count[SAMPLES] and samples[count[DONE]] <= came:
            dense((samples[count[DONE]] - t) / size, n, y, between, states[count[DONE] * n :])
            count[DONE] += 1
        if x == NEVER:
            t = reached
            for i in range(n):
                y[i], room[i] = end[i], room[LAST * n + i]
            for i in range(values):
                rows[i] = last[i]
            h = max(further, h) if size < h else further
            clock[TIME], clock[STEP] = t, h
            continue
        if x == 0.0 and t == clock[BEGUN] and size > CLOSER * con[LONGEST]:
            h = size / 10  # it may have risen and fallen again before the first look
            continue
        count[EVENTS] += 1
        count[STALLS] = count[STALLS] + 1 if came - clock[BEGUN] < con[STALLED] else 0
        clock[TIME], clock[STEP] = came, h
        if count[STALLS] > MOST_STALLED:
            return STALL
        if x == 0.0 and t == clock[BEGUN]:
            clock[STEP] = h / 10
            return UNDECIDED
        dense(x, n, y, between, at)
        t = came
        for i in range(n):
            y[i] = at[i]
        if t < bound and not decided(t, run, room, rows, deciding):
            return UNDECIDED
        clock[BEGUN] = t
    return REACHED


def finite(n: int, y: Reals) -> bool:
    """True if all states are numbers."""
    return all(y[i] - y[i] == 0.0 for i in range(n))
