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
"""

from typing import Any

import numpy as np

from abu_calc.dynamics.equations.elimination import solve_all
from abu_calc.dynamics.motion import AnyArray, Levers, Loads, Motion, Solved
from abu_calc.dynamics.parameters import Acting, Parameters


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
