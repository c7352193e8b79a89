"""Impacts of all pairs that touch, one after the other, the fastest first: the rules of `touching.impacts`.

An impulse is that of the equations themselves: what a push on a pair does to all rates, with all balls free.
"""

from math import sqrt

from abu_calc.dynamics.effects.ball_contact import GRAZING, LIFT
from abu_calc.dynamics.integrators.compiled.arrays import (
    BALLS,
    BEHIND,
    DIRECTION,
    EVALUATIONS,
    FRICTION,
    JOINED,
    KICK,
    PAIRS,
    PUSH,
    REST,
    RESTITUTION,
    SCALES,
    SIDE,
    SLOW,
    STATES,
    Integers,
    Reals,
    rates,
    setup,
)  # fmt: skip
from abu_calc.dynamics.integrators.compiled.contact import opening, touches
from abu_calc.dynamics.switching.touching import MOST_IMPACTS


def approaching(y: Reals, numbers: Reals, lay: Integers, con: Reals) -> bool:
    """Whether any touching pair does."""
    return any(touches(p, y, numbers, lay) and opening(p, lay, y) < -0.1 * con[REST] for p in range(lay[PAIRS]))


def meeting(
    t: float, y: Reals, numbers: Reals, par: Reals, lay: Integers, con: Reals, count: Integers, k: Reals, room: Reals,
) -> bool:  # fmt: skip
    """The state after all impacts. False where that takes too many."""
    pairs, states = lay[PAIRS], lay[STATES]
    met, slow, speed, total = room, room[pairs:], room[2 * pairs :], room[3 * pairs :]
    near, right = room[4 * pairs :], room[5 * pairs :]
    matrix, work = room[6 * pairs :], room[(6 + pairs) * pairs :]
    kicks = room[(6 + 2 * pairs) * pairs :]
    for p in range(pairs):
        met[p] = 1.0 if touches(p, y, numbers, lay) else 0.0
        slow[p] = 0.0
    closing(t, y, numbers, par, lay, count, k, met, near, total)
    responses(t, y, numbers, par, lay, con, count, k, k[states:], met, kicks)
    for p in range(pairs):
        for q in range(pairs):
            matrix[p * pairs + q] = opening(p, lay, kicks[q * states :]) if met[p] > 0.0 and met[q] > 0.0 else 0.0
    # With what torques they would press, so how fast a rebound may be that is none.
    squeezed(pairs, met, near, total, speed, slow, right, matrix, work)
    for p in range(pairs):
        slow[p] = GRAZING * con[SLOW] + sqrt(2.0 * LIFT * matrix[p * pairs + p] * max(slow[p], 0.0))
        total[p], speed[p] = 0.0, opening(p, lay, y)
    if not passed(pairs, 0.1 * con[REST], con[RESTITUTION], met, slow, speed, total, near, right, matrix, work):
        return False
    for q in range(pairs):
        if total[q] != 0.0:
            for i in range(states):
                y[i] += total[q] * kicks[q * states + i]
    return True


def passed(
    pairs: int, rest: float, restitution: float, met: Reals, slow: Reals, speed: Reals, total: Reals, near: Reals,
    right: Reals, matrix: Reals, work: Reals,
) -> bool:  # fmt: skip
    """The impulses of all impacts, in `total`; False where there are too many."""
    for _ in range(MOST_IMPACTS):
        worst, deepest, uneven = -1, 0.0, False
        for p in range(pairs):
            near[p] = 1.0 if met[p] > 0.0 and abs(speed[p]) <= slow[p] else 0.0
            if near[p] > 0.0 and abs(speed[p]) > rest:
                uneven = True
            if met[p] > 0.0 and speed[p] + slow[p] < deepest:
                worst, deepest = p, speed[p] + slow[p]
        if worst >= 0:
            impulse = -(1.0 + restitution) * speed[worst] / matrix[worst * pairs + worst]
            total[worst] += impulse
            for p in range(pairs):
                if met[p] > 0.0:
                    speed[p] += matrix[p * pairs + worst] * impulse
        elif uneven:
            evened(pairs, met, near, speed, total, right, matrix, work)
        else:
            return True
    return False


def squeezed(
    pairs: int, met: Reals, near: Reals, closes: Reals, speed: Reals, torque: Reals, right: Reals, matrix: Reals,
    work: Reals,
) -> None:  # fmt: skip
    """With what torques pairs that touch press, by their relative accelerations without any: never to hold them."""
    for p in range(pairs):
        near[p] = met[p]
    for _ in range(2 * pairs + 4):
        for p in range(pairs):
            speed[p], torque[p] = closes[p], 0.0
        evened(pairs, met, near, speed, torque, right, matrix, work)
        changed = False
        for p in range(pairs):
            if near[p] > 0.0 and torque[p] < 0.0:
                near[p], changed = 0.0, True
            elif met[p] > near[p] and speed[p] < 0.0:
                near[p], changed = 1.0, True
        if not changed:
            return


def evened(
    pairs: int, met: Reals, near: Reals, speed: Reals, total: Reals, right: Reals, matrix: Reals, work: Reals
) -> None:
    """Equal speeds for pairs that are near to it, by elimination."""
    for p in range(pairs):
        right[p] = -speed[p]
        for q in range(pairs):
            work[p * pairs + q] = matrix[p * pairs + q]
    for p in range(pairs):
        if near[p] > 0.0:
            for q in range(p + 1, pairs):
                if near[q] > 0.0:
                    factor = work[q * pairs + p] / work[p * pairs + p]
                    right[q] -= factor * right[p]
                    for r in range(p, pairs):
                        if near[r] > 0.0:
                            work[q * pairs + r] -= factor * work[p * pairs + r]
    for back in range(pairs):
        p = pairs - 1 - back
        if near[p] > 0.0:
            for q in range(p + 1, pairs):
                if near[q] > 0.0:
                    right[p] -= work[p * pairs + q] * right[q]
            right[p] /= work[p * pairs + p]
    for p in range(pairs):
        if near[p] > 0.0:
            total[p] += right[p]
            for q in range(pairs):
                if met[q] > 0.0:
                    speed[q] += matrix[q * pairs + p] * right[p]
    for p in range(pairs):
        if near[p] > 0.0:
            speed[p] = 0.0


def closing(
    t: float, y: Reals, numbers: Reals, par: Reals, lay: Integers, count: Integers, k: Reals, met: Reals, saved: Reals,
    found: Reals,
) -> None:  # fmt: skip
    """Relative accelerations of the pairs that touch, were none held together."""
    joined = numbers[lay[JOINED] :]
    for p in range(lay[PAIRS]):
        saved[p], joined[p] = joined[p], 0.0
    setup(numbers, par)
    rates(t, y, par, k)
    count[EVALUATIONS] += 1
    for p in range(lay[PAIRS]):
        joined[p] = saved[p]
        found[p] = opening(p, lay, k) if met[p] > 0.0 else 0.0


def responses(
    t: float, y: Reals, numbers: Reals, par: Reals, lay: Integers, con: Reals, count: Integers, free: Reals,
    saved: Reals, met: Reals, kicks: Reals,
) -> None:  # fmt: skip
    """What unit torques that part the pairs do to all rates, with all balls free and no friction."""
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
    for p in range(pairs):
        if met[p] > 0.0:
            behind, ahead, pushed = lay[BEHIND + p], lay[BEHIND + pairs + p], kicks[p * states :]
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
