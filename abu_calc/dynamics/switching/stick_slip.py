"""Balls under dry friction: which of them go on sticking, which roll, and to which side of their race.

`f` is the friction per normal force. The normal forces are part of the motion, so directions and sides are tried, from
all slow balls at rest, until they and the accelerations that follow from them agree.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from abu_calc.dynamics.effect import ACROSS_RATE, SwitchPoint
from abu_calc.dynamics.equations.right_hand_side import prepared
from abu_calc.dynamics.motion import AnyArray, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Parameters
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass

AT_REST = 1e-9
"""A ball slower than this, relative to the slow motion of the balls, is at rest: events are located no better."""

HOLD = 1e-7
"""A ball is let go when pulled by this much more, relatively, than friction holds, so that it leaves with certainty."""

SLOW = 1e-6
"""Starting speed of a ball that moves across the race too, relative to R_p Ω.

The ball starts in the direction of the force that overcomes friction, and may stick again at half of
this speed: at rest it has no direction. If drag would stop it, it starts with the speed at which drag
takes what friction leaves over, at least 1e-6 of it.
"""

AT_ALL = 1e-9
"""Least share of f m R_p Ω² that friction holds if the rotor may stand.

With nothing pressed, rounding pulls.
"""

CROSSES = 1e-7
"""A ball changes sides when pulled from one with this much of m R_p Ω², so that it changes with certainty."""


@dataclass(frozen=True, eq=False)
class Rolling:
    """Per ball: `direction` 0 where it sticks, ±1 the way it rolls, where it moves across the race too 1 for any.

    `side`: 1 where it is pressed to the outer side of its race, −1 to the inner one. `begun`: the speed with which it
    started where it moves across too, relative to `SLOW`.
    """

    direction: AnyArray
    side: AnyArray
    begun: AnyArray

    def like(self, other: "Rolling") -> bool:
        """True if both modes are the same."""
        return all(np.array_equal(getattr(self, part), getattr(other, part)) for part in ("direction", "side", "begun"))


def forces(f: Any, m: Motion, mode: Rolling, loads: Loads, solved: Solved, p: Parameters) -> tuple[Any, Any, Any]:
    """Pulls on balls along and across the race, and the most that friction can take of them, times R/R_p.

    Balls that move together get their sums: torques, for their angles are bound.
    """
    masses = m.static_moments / p.radii
    pull, most = masses * solved.left, f * masses * (mode.side * solved.normal)
    if p.rotor.rows:
        most = most + AT_ALL * f * masses * p.radii * p.speed**2
    aside = 0.0 * pull if loads.across is None else masses * solved.across_left
    if loads.mates is None:
        return pull, aside, most
    return loads.mates.sums(pull), loads.mates.sums(aside), loads.mates.sums(most)


def decided(at: SwitchPoint, f: float) -> tuple[AnyArray, Rolling]:
    """State and mode with which the balls can go on; balls that come to rest get the speed 0 exactly.

    The very same objects where nothing changes. Raises NotTrustworthyError when no combination is consistent.
    """
    mode: Rolling = at.mode
    p, first = at.parameters, 2 * at.parameters.size + at.parameters.balls
    motion, _, loads = prepared(np, at.t, at.y, at.acting)
    if loads.across is not None:
        return _decided_across(at, f, motion, loads)
    rates = at.y[first : first + p.balls]
    # One ball of those that move together decides for all.
    leader = np.arange(p.balls) if loads.mates is None else loads.mates.together(p.balls).argmax(axis=1)
    rests = (np.abs(rates) <= AT_REST * at.equations.scales[first])[leader]
    if np.any(rates[rests] != 0):
        y = at.y.copy()
        y[first : first + p.balls][rests] = 0.0
        at = replace(at, y=y)
    start = replace(mode, direction=np.where(rests, 0.0, np.sign(rates[leader])))
    new_mode = _decided_along(at, f, rests, start, leader)
    return at.y, mode if new_mode.like(mode) else new_mode


def _decided_along(at: SwitchPoint, f: float, rests: AnyArray, mode: Rolling, leader: AnyArray) -> Rolling:
    """Sides of all balls and directions, of those at rest by what acts on them.

    From all sticking, every ball whose assumption fails changes it, and after some rounds only the first of them. The
    accelerations of the balls answer forces on them by a symmetric positive definite matrix, of which a small f takes
    nothing, and for such problems this ends (Júdice & Pires 1994, block principal pivoting).
    """
    balls = len(rests)
    for attempt in range(20 + 10 * balls):
        wrong, better, mode = _failing(at, f, mode)
        wrong, better = rests & wrong[leader], better[leader]
        if not wrong.any():
            return mode
        if attempt > 10 + balls:
            wrong &= leader == leader[wrong.argmax()]
        mode = replace(mode, direction=np.where(wrong, better, mode.direction))
    raise _inconsistent(at, f, "no combination of sticking and rolling balls is consistent")


def _failing(at: SwitchPoint, f: float, mode: Rolling) -> tuple[AnyArray, AnyArray, Rolling]:
    """Balls that could not go on in their directions if they were at rest, and better directions for them.

    Returned too is the mode with all balls on the sides to which they are pressed.
    """
    mode, (motion, loads, solved) = _on_sides(at, f, mode)
    pull, _, most = forces(f, motion, mode, loads, solved, at.parameters)
    sigma = mode.direction
    slips, stops = np.abs(pull) > (1 + HOLD / 4) * np.maximum(most, 0.0), sigma * solved.balls < 0
    return np.where(sigma == 0, slips, stops), np.where(sigma == 0, np.sign(pull), 0.0), mode


def _on_sides(at: SwitchPoint, f: float, mode: Rolling) -> tuple[Rolling, tuple[Motion, Loads, Solved]]:
    """The same directions with all balls pressed to their sides, and what then moves and acts.

    A side changes the normal forces by f times as much, so two rounds do but for a few balls near none.
    """
    p = at.parameters
    for _ in range(2 + p.balls):
        solution = at.solved(mode)
        wrong = mode.side * solution[2].normal < -CROSSES / 2 * p.radii * p.speed**2
        if not wrong.any():
            return mode, solution
        mode = replace(mode, side=np.where(wrong, -mode.side, mode.side))
    raise _inconsistent(at, f, "no side of its race presses a ball consistently")


def _inconsistent(at: SwitchPoint, f: float, what: str) -> NotTrustworthyError:
    return NotTrustworthyError(
        f"at t = {at.t:.6g} s {what}\n  friction of {f:g} times the normal force is far from a rolling ball's: check it"
    )


def _decided_across(at: SwitchPoint, f: float, motion: Motion, loads: Loads) -> tuple[AnyArray, Rolling]:
    """The same where balls move across the race too: what friction cannot hold starts in the force's direction.

    Balls are let go one after the other, and none is held again, so this ends.
    """
    p, y = at.parameters, at.y.copy()
    along, across = _rate_places(p)
    slow = SLOW * p.radii * p.speed
    mode: Rolling = at.mode
    least = np.where(mode.direction > 0, 0.6 * mode.begun, 1e-3) * slow
    speeds = np.hypot(motion.radii * motion.rate, motion.rolled)
    if loads.mates is not None:  # one ball decides for all, by the speeds of all
        speeds = np.sqrt(loads.mates.sums(speeds * speeds))
        least = least[(loads.mates.together(p.balls) * loads.leads).argmax(axis=1)]
    held = speeds <= least
    mode = replace(mode, begun=np.where(held, 1.0, mode.begun))
    y[along][held] = y[across][held] = 0.0
    for _ in range(p.balls + 1):
        start = replace(mode, direction=np.where(held, 0.0, 1.0))
        mode, (_, loads, solved) = _on_sides(replace(at, y=y), f, start)
        pull, aside, most = forces(f, motion, mode, loads, solved, p)
        force = np.hypot(pull, aside)
        starts = held & (force > (1 + HOLD / 4) * np.maximum(most, 0.0))
        if not starts.any():
            break
        share = _kept_by_drag(force - most, p) / slow
        mode = replace(mode, begun=np.where(starts, np.clip(share, 1e-6, 1.0), mode.begun))
        speeds = mode.begun * slow / np.where(starts, force, 1.0)
        y[along][starts] = (speeds / motion.radii * pull)[starts]
        y[across][starts] = (speeds * aside)[starts]
        held = held & ~starts
    same = np.array_equal(y, at.y)
    return (at.y if same else y), at.mode if mode.like(at.mode) else mode


def _kept_by_drag(force: AnyArray, p: Parameters) -> AnyArray:
    """Speed [m/s] at which drag takes all of a force [N]; infinite without drag."""
    drags = p.masses * p.drags / p.radii
    speeds: AnyArray = np.divide(force, drags, out=np.full(len(force), math.inf), where=drags > 0)
    return speeds


def _rate_places(p: Parameters) -> tuple[slice, slice]:
    """Places in the state of the speeds of the balls along and across the race."""
    first, place = 2 * p.size + p.balls, 2 * (p.size + p.balls)
    for effect in p.effects:
        if ACROSS_RATE in effect.ball_states:
            place += effect.ball_states.index(ACROSS_RATE) * p.balls
            break
        place += len(effect.ball_states) * p.balls
    return slice(first, first + p.balls), slice(place, place + p.balls)
