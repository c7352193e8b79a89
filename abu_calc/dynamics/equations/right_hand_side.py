"""The one set of equations of motion, composed of a support, races of balls, and the effects of a scene.

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
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from abu_calc.dynamics.equations.elimination import solve
from abu_calc.dynamics.equations.parameters import Array, Parameters
from abu_calc.dynamics.motion import Across, Levers, Loads, Motion, Solved, motion_of


def rhs(xp: Any, t: Any, y: Any, p: Parameters) -> Array:
    """Time derivative of the state by array arithmetic and xp.sin, xp.cos alone: real, complex or symbolic."""
    motion, levers, loads = loaded(xp, t, y, p)
    return derivative(motion, solve_loaded(motion, levers, loads, p), y, p)


def derivative(motion: Motion, solved: Solved, y: Any, p: Parameters) -> Array:
    """y' from the accelerations, in the order of the state."""
    parts = [motion.support[p.size :], solved.support, motion.rate, solved.balls / motion.radii]
    if p.effects:
        parts += [effect.rates(motion, own, solved) for effect, _, own in owned(y, p) if own is not None]
    if p.rotor != "steady":
        parts.append(np.array((y[-1], solved.rotor)))
    return np.concatenate(parts)


def owned(y: Any, p: Parameters) -> list[tuple[Any, Any, Any]]:
    """Each effect with its mode and its own states (None where it has none), in order."""
    place, found = 2 * (p.size + p.balls), []
    for effect, mode in zip(p.effects, p.modes, strict=True):
        count = len(effect.ball_states) * p.balls
        found.append((effect, mode, y[place : place + count] if count else None))
        place += count
    return found


def accelerations(xp: Any, t: Any, y: Any, p: Parameters) -> tuple[Motion, Loads, Solved]:
    """Kinematics, loads and all accelerations at one moment."""
    motion, levers, loads = loaded(xp, t, y, p)
    return motion, loads, solve_loaded(motion, levers, loads, p)


def loaded(xp: Any, t: Any, y: Any, p: Parameters) -> tuple[Motion, Levers, Loads]:
    """Kinematics, levers and loads at one moment, before anything is solved."""
    motion, loads = motion_of(xp, t, y, p), Loads()
    parts = owned(y, p) if p.effects else ()
    for effect, mode, own in parts:
        effect.move(motion, mode, own)
    levers = p.geometry(motion, p)
    for effect, mode, own in parts:
        effect.act(motion, mode, own, levers, loads, p)
    return motion, levers, loads


@dataclass(slots=True)
class _Reduced:
    """What is left when the balls are eliminated: `mass` A = `force`, and how they follow from A.

    Along the race, per mass: balls = `give` (`drive` − A `felt`); in a second direction `pushed` − A `resisted`.
    `weights` (d × n): what a drive of each ball takes from the force.
    """

    mass: Array
    force: Array
    give: Array
    drive: Array
    felt: Array
    weights: Array
    inertias: Array
    pushed: Any
    resisted: Any


def solve_loaded(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> Solved:
    """All accelerations, by eliminating those of the balls."""
    r, across = _reduced(m, levers, loads, p), loads.across
    A, reaction = _frame(r.mass, r.force, loads)
    left = r.drive - A.dot(r.felt)
    tied = loads.free is not None or loads.mates is not None
    balls = r.give * left if loads.mates is None else r.give.dot(left)
    q = A if p.carry is None else _behind(m, A, p)
    beside: Any = across and r.pushed - A.dot(r.resisted)
    return Solved(
        frame=A,
        balls=balls,
        support=q[: p.size],
        normal=None if loads.grip is None else _pressed(m, levers, loads) - A.dot(levers.outward),
        across=across and _across(beside, balls, across, levers),
        across_left=beside,
        rotor=A[-1] if p.rotor == "driven" else m.acceleration,
        reaction=reaction,
        left=left - r.inertias * balls if tied else None,
    )


def by_pulls(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> tuple[Array, Array]:
    """n × n: what unit forces per ball mass along the race do to `balls` and `normal`, where no balls are tied."""
    r = _reduced(m, levers, loads, p)
    A = -np.linalg.solve(r.mass, r.weights)
    if loads.bound is not None:
        row, pushed = loads.bound.row, np.linalg.solve(r.mass, loads.bound.force)
        A = A - np.outer(pushed, row.dot(A) / row.dot(pushed))
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
            shared = levers.axial[2] * across.give
            drive, along, felt = drive - shared * pushed, along - shared * across.along, along - shared * resisted
            inertias = inertias - shared * levers.axial[2]
    felt = felt if loads.grip is None else felt - loads.grip * levers.outward
    force, mass = _frame_side(m, levers, loads, p)
    if loads.mates is None:
        give = p.mobilities if levers.axial is None else 1 / inertias
        give = give if loads.free is None else loads.free * give
        weights = along * (p.reduced_masses if give is p.mobilities else p.masses * give)
    else:
        give = _together(p.masses * inertias, m.radii, loads) * p.masses
        weights = (along * p.masses).dot(give)
    force, mass = force - weights.dot(drive), mass - weights.dot(felt.T)
    if across:
        beside = across.along * (p.masses * across.give)
        force, mass = force - beside.dot(pushed), mass - beside.dot(resisted.T)
    return _Reduced(mass, force, give, drive, felt, weights, inertias, pushed, resisted)


def _inertia_factors(m: Motion, levers: Levers, p: Parameters) -> Array:
    """Inertia of each ball along its race, per mass."""
    if levers.axial is None:
        return p.inertia_factors
    leaning: Array = p.inertia_factors + levers.axial[2] ** 2 - levers.sunk / (m.radii * m.radii)
    return leaning


def _ball_side(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> tuple[Array, Array]:
    """What drives the balls along the race, per mass, without the frame's acceleration; and the levers of that."""
    drive, along = p.braking * m.rate, levers.along
    if loads.pull is not None:
        drive = drive + loads.pull
    if loads.grip is not None:
        drive = drive - loads.grip * _pressed(m, levers, loads)
    if levers.carried_along is not None:
        drive = drive - levers.carried_along
    if p.rotor == "guided":  # a rolling ball is turned by the race, and wants to keep its spin
        drive = drive + p.spins * m.acceleration
    if p.rotor == "driven":
        along = _rows(along, -1, -p.spins)
    if p.arm_length is not None:
        along = _rows(along, 0, -p.spins)
    if levers.axial is not None:
        lever, carried, slope = levers.axial
        drive, along = drive - slope * carried + levers.sinking / m.radii, along + slope * lever
        if p.rotor == "guided":
            drive = drive + levers.sunk / m.radii * m.acceleration
        if p.rotor == "driven":
            along = _rows(along, -1, -levers.sunk / m.radii)
    return drive, along


def _rows(matrix: Array, row: int, more: Array) -> Array:
    """The matrix with something added to one row."""
    changed = matrix.copy()
    changed[row] = changed[row] + more
    return changed


def _pressed(m: Motion, levers: Levers, loads: Loads) -> Array:
    """Normal force of ball and race per mass, without the frame's acceleration."""
    press = m.radii * m.swing * m.swing
    press = press if loads.press is None else press + loads.press
    return press if levers.carried_outward is None else press - levers.carried_outward


def _frame_side(m: Motion, levers: Levers, loads: Loads, p: Parameters) -> tuple[Array, Array]:
    """Force on the frame, and what it weighs, with balls held in their races."""
    swung = m.moments * m.swing * m.swing
    if levers.carried_outward is not None:
        swung = swung - p.masses * levers.carried_outward
    force = p.held.dot(m.support) + levers.outward.dot(swung)
    mass = p.frame_mass + _summed(levers, p) if levers.mass is None else levers.mass
    if levers.carried_along is not None:
        force = force - levers.along.dot(p.masses * levers.carried_along)
    if p.rotor == "guided" and p.spin_inertia is not None:
        force = force - p.spin_inertia[0] * m.acceleration
    if levers.axial is not None:
        lever, carried, _ = levers.axial
        force, mass = force - lever.dot(p.masses * carried), mass + (lever * p.masses).dot(lever.T)
        if p.rotor == "driven":
            turning = np.eye(len(p.frame_mass))[-1]
            force = force + turning * p.masses.dot(levers.sinking)
            mass = mass - np.outer(turning, turning) * p.masses.dot(levers.sunk)
    if p.held_spinning is not None:
        force = force + m.speed * p.held_spinning.dot(m.support)
    if p.steady_force is not None:
        force = force + p.steady_force
    if loads.frame is not None:
        force = force + loads.frame
    more, heavier = p.imbalance_of(m, p)
    return force + more, mass if heavier is None else mass + heavier


def _summed(levers: Levers, p: Parameters) -> Array:
    """Σ m (T Tᵀ + N Nᵀ): what balls held in their races weigh."""
    along, outward = levers.along, levers.outward
    weighed: Array = (along * p.masses).dot(along.T) + (outward * p.masses).dot(outward.T)
    if p.spin_inertia is not None:
        weighed = weighed + p.spin_inertia
    return weighed


def _across(left: Array, balls: Array, across: Across, levers: Levers) -> Array:
    """Accelerations in the second direction, by what is left to drive it."""
    given = left if levers.axial is None else left - levers.axial[2] * balls
    found: Array = given * across.give
    return found


def _together(inertias: Array, radii: Array, loads: Loads) -> Array:
    """n × n: accelerations along the race of balls that turn together, by forces on each."""
    shares = radii / loads.mates.dot(inertias * radii * radii)
    shares = shares if loads.free is None else loads.free * shares
    give: Array = shares[:, None] * loads.mates * radii
    return give


def _frame(mass: Array, force: Array, loads: Loads) -> tuple[Array, Any]:
    """The frame's accelerations, and the reaction of a constraint."""
    if loads.bound is None:
        return np.array(solve(mass.tolist(), force.tolist())), None
    row, value, direction = loads.bound.row, loads.bound.value, loads.bound.force
    free = np.array(solve(mass.tolist(), force.tolist()))
    pushed = np.array(solve(mass.tolist(), direction.tolist()))
    reaction = (value - row.dot(free)) / row.dot(pushed)
    return free + pushed * reaction, reaction


def _behind(m: Motion, A: Array, p: Parameters) -> Array:
    """q'' of a support that has more coordinates than the frame."""
    carry, rest = p.carry, p.rest
    q: Array = rest.dot(m.support) + carry.dot(A)  # type: ignore[union-attr]
    return q if p.rest_spinning is None else q + m.speed * p.rest_spinning.dot(m.support)
