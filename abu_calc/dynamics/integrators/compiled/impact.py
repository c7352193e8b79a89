"""Ball contact in the compiled loop: impacts of touching pairs, and which pairs stay together afterwards.

All pairs that approach meet one after the other, the fastest first: the rules of `ball_impacts.impacts`. An impulse is
that of the equations themselves: the change of all rates by a push on a pair, with all balls free.

The natural next mode says which touching pairs stay together and how far gaps may close again. The rules are those of
`BallContactEffect.settle`, asked of numbers that the equations give in the mode that is tried.
"""

from math import sqrt

from abu_calc.dynamics.effects.ball_contact import DEEPEST, DIP, GRAZING
from abu_calc.dynamics.effects.ball_contact import TOUCHING as CLOSED
from abu_calc.dynamics.integrators.compiled.arrays import (
    BALLS,
    BEHIND,
    COUNTS,
    DIRECTION,
    EVALUATIONS,
    FRICTION,
    GAPS,
    JOINED,
    KICK,
    LEAST,
    LIFTED,
    MODES,
    PAIRS,
    PUSH,
    RATES,
    REST,
    RESTITUTION,
    SCALES,
    SIDE,
    SLOW,
    STATES,
    TOUCHING,
    TURNS,
    UNIT,
    Integers,
    Pairs,
    Reals,
    Run,
    rates,
    setup,
)
from abu_calc.dynamics.switching.ball_impacts import MOST_IMPACTS


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


def approaching(y: Reals, numbers: Reals, lay: Integers, con: Reals) -> bool:
    """True if any touching pair approaches."""
    return any(touches(p, y, numbers, lay) and opening(p, lay, y) < -0.1 * con[REST] for p in range(lay[PAIRS]))


def meeting(t: float, run: Run, k: Reals, room: Reals) -> bool:
    """The state after all impacts. False where that takes too many."""
    y, lay, con = run.y, run.lay, run.con
    pairs, states = lay[PAIRS], lay[STATES]
    slow, speed, total = room, room[pairs:], room[2 * pairs :]
    near, right = room[3 * pairs :], room[4 * pairs :]
    matrix, work = room[6 * pairs :], room[(6 + pairs) * pairs :]
    kicks = room[(6 + 2 * pairs) * pairs :]
    met, chosen = run.counts[COUNTS:], run.counts[COUNTS + pairs :]
    many = 0
    for p in range(pairs):
        if touches(p, y, run.numbers, lay):
            met[many] = p
            many += 1
    closing(t, run, k, many, met, near, total)
    responses(t, run, k, k[states:], many, met, kicks)
    for a in range(many):
        for b in range(many):
            matrix[a * many + b] = opening(met[a], lay, kicks[b * states :])
    # With what torques they would press, so how fast a rebound may be that is none.
    touching = Pairs(many, matrix, near, speed, right, work, chosen)
    squeezed(touching, total, slow)
    for a in range(many):
        slow[a] = GRAZING * con[SLOW] + sqrt(2.0 * con[LIFTED] * matrix[a * many + a] * max(slow[a], 0.0))
        total[a], speed[a] = 0.0, opening(met[a], lay, y)
    if not passed(touching, 0.1 * con[REST], con[RESTITUTION], slow, total):
        return False
    for b in range(many):
        if total[b] != 0.0:
            for i in range(states):
                y[i] += total[b] * kicks[b * states + i]
    return True


def passed(pairs: Pairs, rest: float, restitution: float, slow: Reals, total: Reals) -> bool:
    """The impulses of all impacts, in `total`; False where there are too many."""
    many, matrix, near, speed = pairs.many, pairs.matrix, pairs.near, pairs.speed
    for _ in range(MOST_IMPACTS):
        worst, deepest, uneven = -1, 0.0, False
        for a in range(many):
            near[a] = 1.0 if abs(speed[a]) <= slow[a] else 0.0
            if near[a] > 0.0 and abs(speed[a]) > rest:
                uneven = True
            if speed[a] + slow[a] < deepest:
                worst, deepest = a, speed[a] + slow[a]
        if worst >= 0:
            impulse = -(1.0 + restitution) * speed[worst] / matrix[worst * many + worst]
            total[worst] += impulse
            for a in range(many):
                speed[a] += matrix[a * many + worst] * impulse
        elif uneven:
            evened(pairs, total)
        else:
            return True
    return False


def squeezed(pairs: Pairs, closes: Reals, torque: Reals) -> None:
    """Compute the torques with which touching pairs press, from their relative accelerations without any.

    The torques never hold pairs together.
    """
    many, near, speed = pairs.many, pairs.near, pairs.speed
    for a in range(many):
        near[a] = 1.0
    for _ in range(2 * many + 4):
        for a in range(many):
            speed[a], torque[a] = closes[a], 0.0
        evened(pairs, torque)
        changed = False
        for a in range(many):
            if near[a] > 0.0 and torque[a] < 0.0:
                near[a], changed = 0.0, True
            elif near[a] == 0.0 and speed[a] < 0.0:
                near[a], changed = 1.0, True
        if not changed:
            return


def evened(pairs: Pairs, total: Reals) -> None:
    """Equal speeds for pairs that are near to it, by elimination; the impulses are added to `total`."""
    many, matrix, near, speed = pairs.many, pairs.matrix, pairs.near, pairs.speed
    right, work, chosen = pairs.right, pairs.work, pairs.chosen
    m = 0
    for a in range(many):
        if near[a] > 0.0:
            chosen[m] = a
            m += 1
    for i in range(m):
        right[i], row = -speed[chosen[i]], matrix[chosen[i] * many :]
        for j in range(m):
            work[i * m + j] = row[chosen[j]]
    for i in range(m):
        pivot = work[i * m :]
        for j in range(i + 1, m):
            lower = work[j * m :]
            factor = lower[i] / pivot[i]
            right[j] -= factor * right[i]
            for r in range(i, m):
                lower[r] -= factor * pivot[r]
    for back in range(m):
        i = m - 1 - back
        for j in range(i + 1, m):
            right[i] -= work[i * m + j] * right[j]
        right[i] /= work[i * m + i]
    for i in range(m):
        total[chosen[i]] += right[i]
        for b in range(many):
            speed[b] += matrix[b * many + chosen[i]] * right[i]
    for i in range(m):
        speed[chosen[i]] = 0.0


def closing(t: float, run: Run, k: Reals, many: int, met: Integers, saved: Reals, answers: Reals) -> None:
    """Relative accelerations of the pairs that touch, were none held together."""
    lay = run.lay
    joined = run.numbers[lay[JOINED] :]
    for p in range(lay[PAIRS]):
        saved[p], joined[p] = joined[p], 0.0
    setup(run.numbers, run.par)
    rates(t, run.y, run.par, k)
    run.counts[EVALUATIONS] += 1
    for p in range(lay[PAIRS]):
        joined[p] = saved[p]
    for a in range(many):
        answers[a] = opening(met[a], lay, k)


def responses(t: float, run: Run, free: Reals, saved: Reals, many: int, met: Integers, kicks: Reals) -> None:
    """Compute the changes of all rates by unit torques that separate the pairs.

    All balls are free, and there is no friction.
    """
    y, numbers, par, lay, con, count = run.y, run.numbers, run.par, run.lay, run.con, run.counts
    n, pairs, states, modes = lay[BALLS], lay[PAIRS], lay[STATES], lay[DIRECTION]
    push, levered, joined = numbers[lay[PUSH] :], con[SCALES + 2 * states :], numbers[lay[JOINED] :]
    for p in range(pairs):
        saved[2 * n + p], joined[p] = joined[p], 0.0
    if lay[FRICTION] >= 0:
        for i in range(n):
            saved[i], saved[n + i] = numbers[modes + i], numbers[lay[SIDE] + i]
            numbers[modes + i], numbers[lay[SIDE] + i] = 1.0, 0.0
    setup(numbers, par)
    rates(t, y, par, free)
    for a in range(many):
        behind, ahead, pushed = lay[BEHIND + met[a]], lay[BEHIND + pairs + met[a]], kicks[a * states :]
        push[ahead], push[behind] = con[KICK] / levered[ahead], -con[KICK] / levered[behind]
        setup(numbers, par)
        rates(t, y, par, pushed)
        count[EVALUATIONS] += 1
        for i in range(states):
            pushed[i] = (pushed[i] - free[i]) / con[KICK]
        push[ahead], push[behind] = 0.0, 0.0
    count[EVALUATIONS] += 1
    for p in range(pairs):
        joined[p] = saved[2 * n + p]
    if lay[FRICTION] >= 0:
        for i in range(n):
            numbers[modes + i], numbers[lay[SIDE] + i] = saved[i], saved[n + i]
