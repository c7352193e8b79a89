"""Right-hand side of the equations of motion, composed of a support, races of balls, and the effects of a scene.

A support is felt by the balls as a frame of d accelerations A. Ball k of mass m stands at the angle θ_k in the rotor,
γ_k = θ_k + (turn of the rotor), e_r = (cos γ, sin γ), e_t = (−sin γ, cos γ). With T_k and N_k the acceleration of its
place in the race per unit A along e_t and e_r, and κ_t, κ_r what that place has without A:

    ball     J R_p θ'' = g_t − R_p h₀ θ' − κ_t − T·A − (dry friction) n,    n = R_p γ'² + g_r − κ_r − N·A
    frame    (M_f + Σ m (T Tᵀ + N Nᵀ)) A = f + Σ m N (R_p γ'² − κ_r) − Σ m T (κ_t + R_p θ'')

n is the normal force of ball and race per mass, so dry friction is solved with the motion. Eliminating θ'' leaves d
equations, whose matrix is symmetric and positive definite without friction; the cost grows linearly with the balls.
J = 1 for a point, 7/5 for a rolling ball, 3/2 for a roller.

Source: Kladiev 1996, (1), and Kovalenko 2010, (1)–(3), re-derived by Lagrange's equations. Printed: Kladiev's (1) has
J = 1, so its balls move faster by √(7/5), and no damping of the support, so its free vibration never dies.

Accelerations from kinematics, levers and loads: balls eliminated, the frame solved, the balls put back.

See `right_hand_side` for the equations. Small linear systems are solved by plain arithmetic, so that numbers, complex
numbers and symbols are all solved alike.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from abu_calc.dynamics.motion import Across, AnyArray, Chains, Constraint, Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Acting, Parameters


def solve(matrix: Sequence[Sequence[Any]], right: Sequence[Any]) -> list[Any]:
    """x from matrix · x = right; no pivoting, for matrices that are positive definite or nearly so.

    >>> solve([[2.0, 1.0], [1.0, 3.0]], [3.0, 4.0])
    [1.0, 1.0]
    """
    size = len(right)
    if size == 1:
        return [right[0] / matrix[0][0]]
    if size == 2:
        (a, b), (c, d) = matrix
        e, f = right
        determinant = a * d - b * c
        return [(d * e - b * f) / determinant, (a * f - c * e) / determinant]
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for k in range(size):
        for i in range(k + 1, size):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [0.0 if j <= k else rows[i][j] - factor * rows[k][j] for j in range(size + 1)]
    x: list[Any] = [0.0] * size
    for k in reversed(range(size)):
        x[k] = (rows[k][size] - sum((rows[k][j] * x[j] for j in range(k + 1, size)), 0.0)) / rows[k][k]
    return x


@dataclass(slots=True)
class _Reduced:
    """Equations without the balls: `mass` A = `force`, and how the balls follow from A.

    Along the race, per mass: balls = `give` (`drive` − A `felt`); in a second direction `pushed` − A
    `resisted`. `weights` (d × n): share of the force that a drive of each ball takes.
    """

    mass: AnyArray
    force: AnyArray
    give: AnyArray
    drive: AnyArray
    felt: AnyArray
    weights: AnyArray
    inertias: AnyArray
    pushed: Any
    resisted: Any


def solve_all(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> Solved:
    """All accelerations, by eliminating those of the balls."""
    r, across = _reduced(m, levers, loads, p), loads.across
    A, reaction, second = _frame(r.mass, r.force, loads)
    left = r.drive - A.dot(r.felt)
    tied = loads.free is not None or loads.mates is not None
    balls = r.give * left if loads.mates is None else r.give * loads.mates.sums(p.masses * m.radii * left)
    q = A if p.frame.carry is None else _behind(m, A, p)
    beside: Any = across and r.pushed - A.dot(r.resisted)
    return Solved(
        frame=A,
        balls=balls,
        support=q[: p.size],
        normal=None if loads.grip is None else _pressed(m, levers, loads) - A.dot(levers.outward),
        across=across and _across(beside, balls, across, levers),
        across_left=beside,
        rotor=p.rotor.acceleration(m, A),
        reaction=reaction,
        beside=second,
        left=left - r.inertias * balls if tied else None,
    )


def by_pulls(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> tuple[AnyArray, AnyArray]:
    """n × n: what unit forces per ball mass along the race do to `balls` and `normal`, where no balls are tied."""
    r = _reduced(m, levers, loads, p)
    A = -np.linalg.solve(r.mass, r.weights)
    if loads.bound is not None:
        for bound, pushed, _ in _pushes(r.mass, loads.bound):
            A = A - bound.holds * np.outer(pushed, bound.row.dot(A) / bound.row.dot(pushed))
    return r.give[:, None] * (np.eye(p.balls) - r.felt.T.dot(A)), -levers.outward.T.dot(A)


def _reduced(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> _Reduced:
    """The frame's equations with all balls in them."""
    drive, along = _ball_side(m, levers, loads, p)
    across, inertias, felt = loads.across, _inertia_factors(m, levers, p), along
    pushed: Any = None
    resisted: Any = None
    if across:
        pushed = across.drive if loads.press is None else across.drive + across.outward * loads.press
        resisted = across.along
        if across.grip is not None:
            pushed = pushed - across.grip * _pressed(m, levers, loads)
            resisted = resisted - across.grip * levers.outward
        if levers.axial is not None:  # along the spindle both ways of a ball are one
            shared = levers.axial.slope * across.give
            drive, along, felt = drive - shared * pushed, along - shared * across.along, along - shared * resisted
            inertias = inertias - shared * levers.axial.slope
    felt = felt if loads.grip is None else felt - loads.grip * levers.outward
    force, mass = _frame_side(m, levers, loads, p)
    if loads.mates is None:
        give = p.mobilities if levers.axial is None else 1 / inertias
        give = give if loads.free is None else loads.free * give
        weights = along * (p.reduced_masses if give is p.mobilities else p.masses * give)
    else:
        give = _together(p.masses * inertias, m.radii, loads.mates, loads)
        shared = along * (p.masses * give)
        weights = np.array([loads.mates.sums(row) for row in shared]) * (p.masses * m.radii)
    drive, weights = +drive, +weights  # worked out once for all that takes them
    force, mass = force - weights.dot(drive), mass - weights.dot(felt.T)
    if across:
        beside = across.along * (p.masses * across.give)
        force, mass = force - beside.dot(pushed), mass - beside.dot(resisted.T)
    return _Reduced(mass, force, give, drive, felt, weights, inertias, pushed, resisted)


def _inertia_factors(m: Motion, levers: Levers, p: Parameters) -> AnyArray:
    """Inertia of each ball along its race, per mass."""
    if levers.axial is None:
        return p.inertia_factors
    leaning: AnyArray = p.inertia_factors + levers.axial.slope**2 - levers.sunk / (m.radii * m.radii)
    return leaning


def _ball_side(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> tuple[AnyArray, AnyArray]:
    """Drive of the balls along the race, per mass, without the frame's acceleration; and its levers."""
    drive, along = p.braking * m.rate, levers.along
    if loads.pull is not None:
        drive = drive + loads.pull
    if loads.grip is not None:
        drive = drive - loads.grip * _pressed(m, levers, loads)
    if levers.carried_along is not None:
        drive = drive - levers.carried_along
    # A rolling ball is turned by the race, and wants to keep its spin.
    drive, along = _turned(drive, along, p.spins, m, p)
    if levers.axial is not None:
        a = levers.axial
        drive, along = drive - a.slope * a.carried + levers.sinking / m.radii, along + a.slope * a.lever
        drive, along = _turned(drive, along, levers.sunk / m.radii, m, p)
    return drive, along


def _turned(drive: AnyArray, along: AnyArray, way: AnyArray, m: Motion, p: Parameters) -> tuple[AnyArray, AnyArray]:
    """Add the drive of the balls by the rotor's change of speed, `way` [m] of acceleration per turn of it."""
    if p.rotor.given:
        drive = drive + way * m.acceleration
    if p.frame.turning:
        along = along.copy()
        for row in p.frame.turning:
            along[row] = along[row] - way
    return drive, along


def _pressed(m: Motion, levers: Levers, loads: Loads) -> AnyArray:
    """Normal force of ball and race per mass, without the frame's acceleration."""
    press = m.radii * m.swing * m.swing
    press = press if loads.press is None else press + loads.press
    return press if levers.carried_outward is None else press - levers.carried_outward


def _frame_side(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> tuple[AnyArray, AnyArray]:
    """Force on the frame, and what it weighs, with balls held in their races."""
    swung = m.static_moments * m.swing * m.swing
    if levers.carried_outward is not None:
        swung = swung - p.masses * levers.carried_outward
    frame = p.frame
    force = frame.held.dot(m.support) + levers.outward.dot(swung)
    mass = frame.mass + _summed(levers, p) if levers.mass is None else levers.mass
    if levers.carried_along is not None:
        force = force - levers.along.dot(+(p.masses * levers.carried_along))
    if p.rotor.given and p.spin_inertia is not None:
        force = force - p.spin_inertia[frame.turning[0]] * m.acceleration
    if levers.axial is not None:
        lever, carried = levers.axial.lever, levers.axial.carried
        force, mass = force - lever.dot(p.masses * carried), mass + (lever * p.masses).dot(lever.T)
        if p.rotor.rows:
            turning = np.eye(len(frame.mass))[-1]
            force = force + turning * p.masses.dot(levers.sinking)
            mass = mass - np.outer(turning, turning) * p.masses.dot(levers.sunk)
    if frame.held_spinning is not None:
        force = force + m.speed * frame.held_spinning.dot(m.support)
    if frame.steady_force is not None:
        force = force + frame.steady_force
    if loads.frame is not None:
        force = force + loads.frame
    more, heavier = p.geometry.imbalance(m, p)
    return force + more, mass if heavier is None else mass + heavier


def _summed(levers: Levers, p: Parameters) -> AnyArray:
    """Σ m (T Tᵀ + N Nᵀ): what balls held in their races weigh."""
    along, outward = levers.along, levers.outward
    weighed: AnyArray = (along * p.masses).dot(along.T) + (outward * p.masses).dot(outward.T)
    if p.spin_inertia is not None:
        weighed = weighed + p.spin_inertia
    return weighed


def _across(left: AnyArray, balls: AnyArray, across: Across, levers: Levers) -> AnyArray:
    """Accelerations in the second direction, by what is left to drive it."""
    given = left if levers.axial is None else left - levers.axial.slope * balls
    accelerations: AnyArray = given * across.give
    return accelerations


def _together(inertias: AnyArray, radii: AnyArray, mates: Chains, loads: Loads) -> AnyArray:
    """Accelerations along the race of balls that turn together, by the sums of torques on them."""
    shares: AnyArray = radii / mates.sums(inertias * radii * radii)
    return shares if loads.free is None else loads.free * shares


def _frame(mass: AnyArray, force: AnyArray, loads: Loads) -> tuple[AnyArray, Any, Any]:
    """The frame's accelerations, and the reactions of constraints."""
    A = np.array(solve(mass.tolist(), force.tolist()))
    if loads.bound is None:
        return A, None, None
    reactions: list[Any] = []
    for bound, pushed, back in _pushes(mass, loads.bound):
        reaction = bound.holds * (bound.value - bound.row.dot(A)) / bound.row.dot(pushed)
        reactions = [*(earlier - back * reaction for earlier in reactions), reaction]
        A = A + pushed * reaction
    return A, reactions[0], reactions[1] if len(reactions) > 1 else None


def _pushes(mass: AnyArray, bound: Constraint) -> list[tuple[Constraint, AnyArray, Any]]:
    """Constraints, what a unit of each one's reaction does to the frame, and what that takes from the one before.

    The second acts through the first, which goes on holding.
    """
    pushed = np.array(solve(mass.tolist(), bound.force.tolist()))
    if bound.beside is None:
        return [(bound, pushed, None)]
    aside = np.array(solve(mass.tolist(), bound.beside.force.tolist()))
    back = bound.row.dot(aside) / bound.row.dot(pushed)
    return [(bound, pushed, None), (bound.beside, aside - pushed * back, back)]


def _behind(m: Motion, A: AnyArray, p: Parameters) -> AnyArray:
    """q'' of a support that has more coordinates than the frame."""
    frame = p.frame
    q: AnyArray = frame.rest.dot(m.support) + frame.carry.dot(A)  # type: ignore[union-attr]
    return q if frame.rest_spinning is None else q + m.speed * frame.rest_spinning.dot(m.support)


def rhs(xp: Any, t: Any, y: Any, acting: Acting) -> AnyArray:
    """Time derivative of the state by array arithmetic and xp.sin, xp.cos alone: real, complex or symbolic."""
    motion, levers, loads = prepared(xp, t, y, acting)
    return derivative(motion, solve_all(motion, levers, loads, acting.parameters), y, acting)


def derivative(motion: Motion, solved: Solved, y: Any, acting: Acting) -> AnyArray:
    """y' from the accelerations, in the order of the state."""
    p = acting.parameters
    parts = [motion.support[p.size :], solved.support, motion.rate, solved.balls / motion.radii]
    if p.effects:
        parts += [effect.rates(motion, own, solved) for effect, _, own in with_states(y, acting) if own is not None]
    return np.concatenate([*parts, *p.rotor.rates(y, solved.rotor)])


def with_states(y: Any, acting: Acting) -> list[tuple[Any, Any, Any]]:
    """Each effect with its mode and its own states (None where it has none), in order."""
    p = acting.parameters
    place, rows = 2 * (p.size + p.balls), []
    for effect, mode in zip(p.effects, acting.modes, strict=True):
        count = len(effect.ball_states) * p.balls
        rows.append((effect, mode, y[place : place + count] if count else None))
        place += count
    return rows


def accelerations(xp: Any, t: Any, y: Any, acting: Acting) -> tuple[Motion, Loads, Solved]:
    """Kinematics, loads and all accelerations at one time."""
    motion, levers, loads = prepared(xp, t, y, acting)
    return motion, loads, solve_all(motion, levers, loads, acting.parameters)


def prepared(xp: Any, t: Any, y: Any, acting: Acting) -> tuple[Motion, Levers, Loads]:
    """Kinematics, levers and loads at one time, before anything is solved."""
    p = acting.parameters
    motion, loads = motion_of(xp, t, y, p), Loads()
    parts = with_states(y, acting) if p.effects else ()
    for effect, mode, own in parts:
        effect.move(motion, mode, own)
    levers = p.geometry.levers(motion, p)
    for effect, mode, own in parts:
        effect.act(motion, mode, own, levers, loads, p)
    return motion, levers, loads


def motion_of(xp: Any, t: Any, y: Any, p: Parameters) -> Motion:
    """The kinematics of the state y = (q, q', θ, θ', states of effects, rotor's turn and speed) at time t."""
    n, first = 2 * p.size, 2 * p.size + p.balls
    theta, rate, support = y[n:first], y[first : first + p.balls], y[:n]
    turn, own_speed = p.rotor.turning(t, y, p.speed)
    speed, carried = own_speed, p.geometry.turning(support)
    if carried is not None:
        turn, speed = turn + carried[0], speed + carried[1]
    gamma = theta + turn
    return Motion(
        xp=xp,
        t=t,
        support=support,
        theta=theta,
        rate=rate,
        turn=turn,
        speed=speed,
        own_speed=own_speed,
        acceleration=0.0,
        sin=xp.sin(gamma),
        cos=xp.cos(gamma),
        swing=rate + speed,
        radii=p.radii,
        static_moments=p.static_moments,
    )
