"""Dry friction's natural next mode: what comes to rest sticks unless it is pulled harder than friction holds.

The same rules as `sticking.decided`, asked of numbers that the equations give in the mode that is tried.
"""

from abu_calc.dynamics.integrators.compiled.arrays import (
    BALLS,
    BEHIND,
    DIRECTION,
    FRICTION,
    GAPS,
    JOINED,
    PAIRS,
    PULLS,
    RATES,
    REST,
    SIDE,
    Integers,
    Reals,
)  # fmt: skip
from abu_calc.dynamics.switching.sticking import CROSSES, HOLD


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
