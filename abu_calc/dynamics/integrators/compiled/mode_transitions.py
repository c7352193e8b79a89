"""Natural next mode of the effect whose watched number fell, checked by the numbers of the equations in it.

From the mode before, everything that fails changes, round by round (block principal pivoting, Júdice & Pires 1994):
balls at rest, sides, touching pairs. If the rounds do not end, or if the outcome is inconsistent, the general decision
is asked.

Dry friction: a ball that comes to rest sticks unless it is pulled harder than friction holds. The rules are those of
`stick_slip.decided`, asked of numbers that the equations give in the mode that is tried.
"""

from abu_calc.dynamics.integrators.compiled.arrays import (
    BALLS,
    BEHIND,
    DIRECTION,
    EVALUATIONS,
    FOUND,
    FRICTION,
    GAPS,
    GENERAL,
    JOINED,
    MODES,
    NUMBERS,
    ONE_SIDED,
    PAIRS,
    PULLS,
    RATES,
    REST,
    SIDE,
    STATES,
    TOUCHES,
    WATCHED,
    Integers,
    Reals,
    Run,
    setup,
    watched,
)
from abu_calc.dynamics.integrators.compiled.impact import approaching, bounded, meeting, pressed, stilled
from abu_calc.dynamics.switching.stick_slip import CROSSES, HOLD


def rested(y: Reals, numbers: Reals, lay: Integers, con: Reals) -> None:
    """Balls that move roll their way; those that have come to rest stick, to begin with."""
    first, turn = lay[RATES], numbers[lay[DIRECTION] :]
    for i in range(lay[BALLS]):
        rate = y[first + i]
        if abs(rate) > con[REST]:
            turn[i] = 1.0 if rate > 0.0 else -1.0
        elif rate != 0.0:
            y[first + i], turn[i] = 0.0, 0.0


def together(y: Reals, numbers: Reals, lay: Integers) -> None:
    """Balls of a chain go the same way as the last of it."""
    if lay[GAPS] < 0:
        return
    pairs, turn, joined = lay[PAIRS], numbers[lay[DIRECTION] :], numbers[lay[JOINED] :]
    for _ in range(2):
        for p in range(pairs):
            if joined[p] > 0.0:
                behind, ahead = lay[BEHIND + p], lay[BEHIND + pairs + p]
                turn[ahead] = turn[behind]
                if y[lay[RATES] + behind] == 0.0:
                    y[lay[RATES] + ahead] = 0.0


def rubbed(y: Reals, numbers: Reals, lay: Integers, k: Reals, w: Reals) -> bool:
    """True if balls had to be given another side or, being at rest, another direction."""
    n, first, fell, pulls = lay[BALLS], lay[RATES], lay[FRICTION], lay[PULLS]
    turn, side = numbers[lay[DIRECTION] :], numbers[lay[SIDE] :]
    changed = False
    for i in range(n):
        if w[fell + 2 * n + i] < CROSSES / 2:
            side[i] = -side[i]
            changed = True
        if y[first + i] == 0.0:
            pull, most = w[pulls + i], max(w[pulls + n + i], 0.0)
            if turn[i] == 0.0:
                if abs(pull) > (1.0 + HOLD / 4) * most:
                    turn[i] = 1.0 if pull > 0.0 else -1.0
                    changed = True
            elif turn[i] * k[first + i] < 0.0:
                turn[i] = 0.0
                changed = True
    return changed


ROUNDS = 16

CLEAR = 1e-9
"""Depth or gap of wheel and workpiece, relative to the usual one, below which it counts as nothing."""


def decided(t: float, run: Run, k: Reals, w: Reals, room: Reals) -> bool:
    """True if a next mode was found; `k`, `w` are then rates and watched numbers to go on with.

    Otherwise state and modes are as before.
    """
    y, numbers, lay = run.y, run.numbers, run.lay
    n, many = lay[STATES], lay[NUMBERS] - lay[MODES]
    states, modes = room, room[n:]
    for i in range(n):
        states[i] = y[i]
    for i in range(many):
        modes[i] = numbers[lay[MODES] + i]
    if switched(t, run, k, room[n + many :]) and settled(t, run, k, w, modes, room[n + many :]):
        return True
    run.counts[GENERAL] += 1
    for i in range(n):
        y[i] = states[i]
    for i in range(many):
        numbers[lay[MODES] + i] = modes[i]
    return False


def switched(t: float, run: Run, k: Reals, room: Reals) -> bool:
    """Apply the mode that follows directly from the number that fell, or from a start.

    False for effects whose modes are not known here.
    """
    y, numbers, lay, con = run.y, run.numbers, run.lay, run.con
    fell, pairs = run.counts[FOUND], lay[PAIRS]
    if fell < 0:
        if lay[GAPS] >= 0 and approaching(y, numbers, lay, con):
            return meeting(t, run, k, room)
        return True
    if fell == lay[ONE_SIDED]:
        numbers[lay[TOUCHES]] = 1.0 - numbers[lay[TOUCHES]]
        return True
    if lay[GAPS] >= 0 and fell >= lay[GAPS] and fell < lay[GAPS] + 3 * pairs:
        if fell >= lay[GAPS] + pairs:
            p = fell - lay[GAPS] - pairs
            numbers[lay[JOINED] + (p if p < pairs else p - pairs)] = 0.0
            return True
        if approaching(y, numbers, lay, con):
            return meeting(t, run, k, room)
        return True
    if lay[FRICTION] >= 0 and fell >= lay[FRICTION] and fell < lay[FRICTION] + 3 * lay[BALLS]:
        if fell < lay[FRICTION] + lay[BALLS]:
            # It has come to rest; most turn back at once, and what follows says whether this one does.
            y[lay[RATES] + fell - lay[FRICTION]] = 0.0
            numbers[lay[DIRECTION] + fell - lay[FRICTION]] *= -1.0
        return True
    return False


def settled(t: float, run: Run, k: Reals, w: Reals, before: Reals, still: Reals) -> bool:
    """Modes that agree with what follows from them; False where none was found."""
    y, numbers, par, lay, con = run.y, run.numbers, run.par, run.lay, run.con
    if lay[FRICTION] >= 0:
        rested(y, numbers, lay, con)
    if lay[GAPS] >= 0:
        stilled(y, numbers, lay, con, still)
    for _ in range(ROUNDS):
        if lay[FRICTION] >= 0:
            together(y, numbers, lay)
        setup(numbers, par)
        watched(t, y, par, k, w)
        run.counts[EVALUATIONS] += 1
        changed = False
        if lay[GAPS] >= 0:
            changed = pressed(y, numbers, lay, con, k, w, still)
        if lay[FRICTION] >= 0:
            changed = rubbed(y, numbers, lay, k, w) or changed
        if not changed:
            if lay[GAPS] >= 0:
                bounded(y, numbers, par, lay, before, w)
            # Where wheel and work part or meet, their number is nothing; at a start it must say clearly which it is.
            if lay[ONE_SIDED] >= 0 and run.counts[FOUND] != lay[ONE_SIDED] and w[lay[ONE_SIDED]] < CLEAR:
                return False
            return all(not (w[i] < 0.0 and i != lay[ONE_SIDED]) for i in range(lay[WATCHED]))
    return False
