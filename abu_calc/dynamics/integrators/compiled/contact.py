"""Ball contact's natural next mode: which touching pairs stay together, and how far gaps may close again.

The same rules as `BallContact.settle`, asked of numbers that the equations give in the mode that is tried.
"""

from abu_calc.dynamics.effects.ball_contact import DEEPEST, DIP
from abu_calc.dynamics.effects.ball_contact import TOUCHING as CLOSED
from abu_calc.dynamics.integrators.compiled.arrays import (
    BALLS,
    BEHIND,
    GAPS,
    JOINED,
    LEAST,
    MODES,
    PAIRS,
    RATES,
    REST,
    SCALES,
    STATES,
    TOUCHING,
    TURNS,
    UNIT,
    Integers,
    Reals,
    setup,
)  # fmt: skip


def gap(p: int, y: Reals, numbers: Reals, lay: Integers) -> float:
    """A gap [rad]."""
    first, pairs = lay[RATES] - lay[BALLS], lay[PAIRS]
    return y[first + lay[BEHIND + pairs + p]] - y[first + lay[BEHIND + p]] + numbers[lay[TURNS] + p]


def touches(p: int, y: Reals, numbers: Reals, lay: Integers) -> bool:
    """True if a gap is closed."""
    return numbers[lay[JOINED] + p] > 0.0 or gap(p, y, numbers, lay) - numbers[lay[TOUCHING] + p] <= CLOSED


def opening(p: int, lay: Integers, row: Reals) -> float:
    """Difference across a gap, ball ahead less ball behind, in the balls' part of states or rates."""
    return row[lay[RATES] + lay[BEHIND + lay[PAIRS] + p]] - row[lay[RATES] + lay[BEHIND + p]]


def pressed(y: Reals, numbers: Reals, lay: Integers, con: Reals, k: Reals, w: Reals, still: Reals) -> bool:
    """True if pairs had to be joined or opened, among those that touch with equal speeds (`still`)."""
    joined, fell, pairs = numbers[lay[JOINED] :], lay[GAPS], lay[PAIRS]
    levered = con[SCALES + 2 * lay[STATES] :]
    changed = False
    for p in range(pairs):
        if joined[p] > 0.0:
            if w[fell + pairs + p] < 0.5 or w[fell + 2 * pairs + p] < 0.5:
                joined[p] = 0.0
                changed = True
        elif still[p] > 0.0:
            own = 1.0 / levered[lay[BEHIND + p]] + 1.0 / levered[lay[BEHIND + pairs + p]]
            if opening(p, lay, k) < -0.5 * con[UNIT] * own:
                joined[p] = 1.0
                changed = True
    return changed


def stilled(y: Reals, numbers: Reals, lay: Integers, con: Reals, still: Reals) -> None:
    """Mark the gaps that are closed and neither open nor close.

    Joined gaps that open or close are joined no more.
    """
    for p in range(lay[PAIRS]):
        still[p] = 0.0
        if touches(p, y, numbers, lay):
            if abs(opening(p, lay, y)) <= con[REST]:
                still[p] = 1.0
            else:
                numbers[lay[JOINED] + p] = 0.0


def bounded(y: Reals, numbers: Reals, par: Reals, lay: Integers, before: Reals, w: Reals) -> None:
    """The bounds of all gaps, as `Neighbours.joining` sets them; `before`: the modes that have been left."""
    largest, first, fell = 0.0, lay[RATES] - lay[BALLS], lay[GAPS]
    least, closed, joined = numbers[lay[LEAST] :], numbers[lay[TOUCHING] :], numbers[lay[JOINED] :]
    were = before[lay[JOINED] - lay[MODES] :]
    for i in range(lay[BALLS]):
        largest = max(largest, abs(y[first + i]))
    rounding = 1e-13 + 1.8e-15 * largest
    changed = False
    for p in range(lay[PAIRS]):
        if joined[p] != were[p] or (joined[p] == 0.0 and gap(p, y, numbers, lay) < least[p] + rounding / 2):
            changed = True
    if not changed:
        return
    for p in range(lay[PAIRS]):
        now, deeper = gap(p, y, numbers, lay), 0.0
        if joined[p] == 0.0 and were[p] == 0.0 and now < least[p] + rounding / 2 and least[p] < closed[p]:
            deeper = min(DIP * (closed[p] - least[p]), DEEPEST)
        least[p] = min(closed[p] - deeper, now - rounding)
        if joined[p] == 0.0:
            w[fell + p] = now - least[p]
    setup(numbers, par)
