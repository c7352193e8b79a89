"""Equations of motion of a machine with balls, written without the product: Lagrange's equations, fixed steps.

    q = (place of the machine, φ of the rotor, γ₁ … γ_n of the balls in space)
    ball at  P(q) + Δ e(φ + φ_Δ) + R_p e(γ),    P: the race's centre without its eccentricity
    T = ½ q'ᵀ M q' + U φ' t(φ)·P_w' + Σ ½ m |ball'|² + Σ ½ (J − 1) m ((R_p + r) φ' − R_p γ')²

Drag takes m R_p² h₀ (γ' − φ') between ball and rotor; dry friction at most f = k_r/r of the force that presses a ball.
The product sticks by switching modes at located events and joins touching balls. Here a bristle holds each ball and
slips when bent too far (about 1e-6 rad), and balls that meet get impulses after each step (Newton's law of impact,
projected Gauss–Seidel). Steps are those of Runge and Kutta, order 4, 208 in a revolution, in a run-up 139. The angle of
a ball is that in space, where the product has it in the rotor, and the full mass matrix is reduced onto the machine.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

try:
    from numba import njit as _njit

    COMPILED = True
except ImportError:  # a thousand times slower; pip install numba
    COMPILED = False


def njit(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compiled by numba where it is installed, else as it stands."""
    if not COMPILED:
        return function
    compiled: Callable[..., Any] = _njit(cache=True, error_model="numpy", fastmath=True)(function)
    return compiled


class Machine(NamedTuple):
    """Numbers of one run [SI]. `core`: coordinates that carry the race, 2 in a plane, 4 with tilts, 1 on an arm.

    `mass` (core × core), `stiffness` and `damping` over all nodes, `nodes`: masses of further ones (palms, fingers).
    """

    core: int
    arm: float
    mass: Array
    stiffness: Array
    damping: Array
    nodes: Array
    wheel: float
    """Plane of the imbalance [m] from the middle of the machine; with tilts only."""
    race: float
    felt: float
    """Mass that the balls feel [kg]: it times the eccentricity is what they leave where they balance, about."""
    places: Array
    """Planes where the velocity is wanted [m]."""
    imbalance: float
    carried: float
    """Imbalance that the balls have to make up for [kg m]."""
    balls: int
    ball_mass: float
    pitch: float
    ball_radius: float
    rolling: float
    """J − 1."""
    drag: float
    friction: float
    """k_r/r."""
    gravity: float
    offset: float
    offset_angle: float
    gap: float
    """Angle between touching balls [rad]."""
    restitution: float
    speed: float
    ramp: float
    """Time of an even run-up from rest [s], 0: none, or by the motor."""
    stall: float
    """Torque of the motor at rest [N m]; 0: the speed is given."""
    no_load: float
    inertia: float
    longest: float
    """Longest step [s] that is stable."""
    housing: float = 0.0
    """Mass of the autobalancer without its balls [kg]: the machine without it is lighter by that."""


class Work(NamedTuple):
    """Arrays of one run that are used again."""

    A: Array
    b: Array
    S: Array
    x: Array
    G: Array
    r: Array
    cs: Array
    bx: Array
    by: Array
    anchor: Array
    """Angles in the rotor to which bristles hold the balls [rad], how much these may bend, how far they slipped."""


def workspace(p: Machine) -> Work:
    """Of the sizes of a machine."""
    c, n = p.core + 1, max(p.balls, 1)
    return Work(
        np.zeros((c, c)), np.zeros(c), np.zeros((c, c)), np.zeros(c), np.zeros((n, c)), np.zeros(n), np.zeros((n, 3)),
        np.zeros(c), np.zeros(c), np.zeros((n, 3)),
    )  # fmt: skip


@njit
def _columns(p, y, plane, w):  # type: ignore[no-untyped-def]
    """∂P/∂q of a place in a plane, and what of its acceleration does not need q''."""
    if p.arm > 0.0:
        c, s = math.cos(y[0]), math.sin(y[0])
        w.bx[0], w.by[0] = -p.arm * s, p.arm * c
        rate = y[2 + p.balls]
        return -p.arm * rate * rate * c, -p.arm * rate * rate * s
    w.bx[0], w.bx[1], w.by[0], w.by[1] = 1.0, 0.0, 0.0, 1.0
    if p.core == 4:
        w.bx[2], w.bx[3], w.by[2], w.by[3] = plane, 0.0, 0.0, plane
    return 0.0, 0.0


@njit
def _machine_terms(p, y, w):  # type: ignore[no-untyped-def]
    """Mass matrix and forces of machine, rotor and imbalance, without the balls."""
    nc, nq = p.core, len(p.stiffness)
    v = nq + 1 + p.balls
    phi, rate = y[nq], y[v + nq]
    for i in range(nc):
        force = 0.0
        for j in range(nq):
            force -= p.stiffness[i, j] * y[j] + p.damping[i, j] * y[v + j]
        w.b[i] = force
        for j in range(nc):
            w.A[i, j] = p.mass[i, j]
    ax, ay = _columns(p, y, p.wheel, w)
    c, s = math.cos(phi), math.sin(phi)
    U = p.imbalance
    for i in range(nc):
        w.A[i, nc] = U * (-s * w.bx[i] + c * w.by[i])
        w.A[nc, i] = w.A[i, nc]
        w.b[i] += U * rate * rate * (c * w.bx[i] + s * w.by[i])
    w.A[nc, nc] = p.inertia
    w.b[nc] = -U * (-s * ax + c * ay) - U * p.gravity * c
    if p.stall > 0.0:
        w.b[nc] += p.stall * (1.0 - rate / p.no_load)


@njit
def _ball_terms(p, y, w):  # type: ignore[no-untyped-def]
    """Balls: their share of the matrix, couplings G, own forces r; G and r are eliminated into S and b."""
    nc, nq, n, m, R = p.core, len(p.stiffness), p.balls, p.ball_mass, p.pitch
    v = nq + 1 + n
    phi, rate = y[nq], y[v + nq]
    ax, ay = _columns(p, y, p.race, w)
    ce, se = math.cos(phi + p.offset_angle), math.sin(phi + p.offset_angle)
    ex, ey = -p.offset * se, p.offset * ce
    ax -= p.offset * rate * rate * ce
    ay -= p.offset * rate * rate * se
    groove, roll = R + p.ball_radius, p.rolling * m
    d = m * R * R + roll * R * R
    for i in range(nc):
        for j in range(nc):
            w.A[i, j] += n * m * (w.bx[i] * w.bx[j] + w.by[i] * w.by[j])
        w.A[i, nc] += n * m * (w.bx[i] * ex + w.by[i] * ey)
        w.A[nc, i] = w.A[i, nc]
        w.b[i] -= n * m * (w.bx[i] * ax + w.by[i] * ay)
    w.A[nc, nc] += n * (m * p.offset * p.offset + roll * groove * groove)
    w.b[nc] -= n * m * (ex * ax + ey * ay + p.gravity * p.offset * ce)
    for k in range(n):
        c, s = math.cos(y[nq + 1 + k]), math.sin(y[nq + 1 + k])
        own = y[v + nq + 1 + k]
        w.cs[k, 0], w.cs[k, 1] = c, s
        swing = m * R * own * own
        brake = m * R * R * p.drag * (own - rate)
        for i in range(nc):
            w.G[k, i] = m * R * (-s * w.bx[i] + c * w.by[i])
            w.b[i] += swing * (c * w.bx[i] + s * w.by[i])
        w.G[k, nc] = m * R * (-s * ex + c * ey) - roll * groove * R
        w.b[nc] += swing * (c * ex + s * ey) + brake
        w.r[k] = -m * R * (-s * ax + c * ay) - m * p.gravity * R * c - brake
    for i in range(nc + 1):
        for j in range(nc + 1):
            w.S[i, j] = w.A[i, j]
            for k in range(n):
                w.S[i, j] -= w.G[k, i] * w.G[k, j] / d
    return d, ax, ay


@njit
def _solved(p, S, b, given, x):  # type: ignore[no-untyped-def]
    """Accelerations x of the core and the rotor from S x = b, the rotor's own one given unless a motor drives it."""
    nc = p.core
    if p.arm > 0.0 and p.stall == 0.0:
        x[0] = (b[0] + b[1] - (S[0, 1] + S[1, 1]) * given) / (S[0, 0] + 2.0 * S[0, 1] + S[1, 1])
        x[1] = given + x[0]
        return
    size = nc if p.stall == 0.0 else nc + 1
    if size == 2 and nc == 2:
        u, v = b[0] - S[0, 2] * given, b[1] - S[1, 2] * given
        determinant = S[0, 0] * S[1, 1] - S[0, 1] * S[1, 0]
        x[0], x[1] = (u * S[1, 1] - v * S[0, 1]) / determinant, (v * S[0, 0] - u * S[1, 0]) / determinant
        x[2] = given
        return
    T = np.empty((size, size + 1))
    for i in range(size):
        for j in range(size):
            T[i, j] = S[i, j]
        T[i, size] = b[i] - (S[i, nc] * given if size == nc else 0.0)
    for i in range(size):
        for j in range(i + 1, size):
            q = T[j, i] / T[i, i]
            for k in range(i, size + 1):
                T[j, k] -= q * T[i, k]
    for i in range(size - 1, -1, -1):
        total = T[i, size]
        for j in range(i + 1, size):
            total -= T[i, j] * x[j]
        x[i] = total / T[i, i]
    if size == nc:
        x[nc] = given


@njit
def _plane(p, y, given, pace, w, out):  # type: ignore[no-untyped-def]
    """`rates` of a machine that moves in a plane at a given speed: the same equations in closed form, in scalars."""
    nq, n, m, R = len(p.stiffness), p.balls, p.ball_mass, p.pitch
    v = nq + 1 + n
    phi, rate = y[nq], y[v + nq]
    for i in range(v):
        out[i] = y[v + i]
    for i in range(nq):
        force = 0.0
        for j in range(nq):
            force -= p.stiffness[i, j] * y[j] + p.damping[i, j] * y[v + j]
        out[v + i] = force if i < 2 else force / p.nodes[i - 2]
    c, s = math.cos(phi), math.sin(phi)
    co, so = math.cos(p.offset_angle) * p.offset, math.sin(p.offset_angle) * p.offset
    square = rate * rate
    # Acceleration of the race's centre against the machine.
    gx = -square * (co * c - so * s) - given * (co * s + so * c)
    gy = -square * (co * s + so * c) + given * (co * c - so * s)
    roll, one = p.rolling * m, 1.0 / (m * R * R * (1.0 + p.rolling))
    x = out[v] + p.imbalance * (square * c + s * given) - n * m * gx
    z = out[v + 1] + p.imbalance * (square * s - c * given) - n * m * gy
    a, b, e = p.mass[0, 0] + n * m, p.mass[0, 1], p.mass[1, 1] + n * m
    mr, roller = m * R, roll * (R + p.ball_radius) * R * given
    for k in range(n):
        c, s, own = math.cos(y[nq + 1 + k]), math.sin(y[nq + 1 + k]), y[v + nq + 1 + k]
        r = mr * (s * gx - c * (gy + p.gravity)) - mr * R * p.drag * (own - rate) + roller
        swing, share = mr * own * own, mr * r * one
        x += swing * c + share * s
        z += swing * s - share * c
        a -= mr * mr * one * s * s
        b += mr * mr * one * s * c
        e -= mr * mr * one * c * c
        w.cs[k, 0], w.cs[k, 1], w.cs[k, 2] = c, s, r
    over = 1.0 / (a * e - b * b)
    X, Z = (x * e - z * b) * over, (z * a - x * b) * over
    if p.friction > 0.0:
        fx, fy = gx + X, gy + Z + p.gravity
        for k in range(n):
            c, s, own = w.cs[k, 0], w.cs[k, 1], y[v + nq + 1 + k]
            most = mr * p.friction * abs(R * own * own - c * fx - s * fy)
            w.anchor[k, 1] = most * one / (pace * pace)
            bent = y[nq + 1 + k] - phi - w.anchor[k, 0]
            moment = min(max(pace * (pace * bent + own - rate) / one, -most), most)
            w.cs[k, 2] -= moment
            x -= mr * s * moment * one
            z += mr * c * moment * one
        X, Z = (x * e - z * b) * over, (z * a - x * b) * over
    out[v], out[v + 1], out[v + nq] = X, Z, given
    for k in range(n):
        out[v + nq + 1 + k] = (w.cs[k, 2] + mr * (w.cs[k, 1] * X - w.cs[k, 0] * Z)) * one


@njit
def rates(p, y, given, pace, w, out):  # type: ignore[no-untyped-def]
    """y' of y = (q, q'); `given`: Ω' of a rotor that no motor drives; `pace` [1/s]: frequency of the bristles."""
    if p.core == 2 and p.stall == 0.0:
        _plane(p, y, given, pace, w, out)
        return
    nc, nq, n, m, R = p.core, len(p.stiffness), p.balls, p.ball_mass, p.pitch
    v = nq + 1 + n
    for i in range(v):
        out[i] = y[v + i]
    _machine_terms(p, y, w)
    d, ax, ay = _ball_terms(p, y, w)
    for k in range(n):
        for i in range(nc + 1):
            w.b[i] -= w.G[k, i] * w.r[k] / d
    _solved(p, w.S, w.b, given, w.x)
    if p.friction > 0.0:
        # The force that presses a ball, friction left out: with it the machine's acceleration is another by f m/M.
        fx, fy = ax, ay
        for i in range(nc):
            fx += w.bx[i] * w.x[i]
            fy += w.by[i] * w.x[i]
        ce, se = math.cos(y[nq] + p.offset_angle), math.sin(y[nq] + p.offset_angle)
        fx -= p.offset * se * w.x[nc]
        fy += p.offset * ce * w.x[nc]
        for k in range(n):
            c, s, own = w.cs[k, 0], w.cs[k, 1], y[v + nq + 1 + k]
            pressed = abs(R * own * own - c * fx - s * fy - p.gravity * s)
            most = m * R * p.friction * pressed
            w.anchor[k, 1] = most / (d * pace * pace)
            bent = y[nq + 1 + k] - y[nq] - w.anchor[k, 0]
            moment = min(max(d * pace * (pace * bent + own - y[v + nq]), -most), most)
            w.r[k] -= moment
            w.b[nc] += moment
            for i in range(nc + 1):
                w.b[i] += w.G[k, i] * moment / d
        _solved(p, w.S, w.b, given, w.x)
    for i in range(nc):
        out[v + i] = w.x[i]
    for i in range(nc, nq):
        force = 0.0
        for j in range(nq):
            force -= p.stiffness[i, j] * y[j] + p.damping[i, j] * y[v + j]
        out[v + i] = force / p.nodes[i - nc]
    out[v + nq] = w.x[nc]
    for k in range(n):
        total = w.r[k]
        for i in range(nc + 1):
            total -= w.G[k, i] * w.x[i]
        out[v + nq + 1 + k] = total / d


@njit
def _gap(p, y, order, k, v, nq):  # type: ignore[no-untyped-def]
    """Gap [rad] from the k-th ball of the ring to the next, and the rate at which it opens [rad/s]."""
    n = p.balls
    a, b = order[k], order[(k + 1) % n]
    turn = 2.0 * math.pi if k == n - 1 else 0.0
    return y[nq + 1 + b] + turn - y[nq + 1 + a] - p.gap, y[v + nq + 1 + b] - y[v + nq + 1 + a]


@njit
def collide(p, y, order, w):  # type: ignore[no-untyped-def]
    """Impulses between neighbours that overlap and approach, on all that moves; then the overlaps are parted."""
    nc, nq, n = p.core, len(p.stiffness), p.balls
    v = nq + 1 + n
    hits = np.empty(n, dtype=np.int64)
    count, apart = 0, True
    for k in range(n):
        gap, opening = _gap(p, y, order, k, v, nq)
        apart = apart and gap > 0.0
        if gap <= 0.0 and opening < 0.0:
            hits[count] = k
            count += 1
    if apart:
        return
    if count:
        _machine_terms(p, y, w)
        d, _, _ = _ball_terms(p, y, w)
        move = np.zeros((count, v))
        for c in range(count):
            a, b = order[hits[c]], order[(hits[c] + 1) % n]
            for i in range(nc + 1):
                w.b[i] = -(w.G[b, i] - w.G[a, i]) / d
            _solved(p, w.S, w.b, 0.0, w.x)
            for i in range(nc):
                move[c, i] = w.x[i]
            move[c, nq] = w.x[nc]
            for k in range(n):
                total = (1.0 if k == b else 0.0) - (1.0 if k == a else 0.0)
                for i in range(nc + 1):
                    total -= w.G[k, i] * w.x[i]
                move[c, nq + 1 + k] = total / d
        wanted, impulse = np.empty(count), np.zeros(count)
        for c in range(count):
            _, opening = _gap(p, y, order, hits[c], v, nq)
            bounce = p.restitution if -opening > 2e-4 * p.speed else 0.0
            wanted[c] = -bounce * opening
        for _ in range(40):
            for c in range(count):
                a, b = order[hits[c]], order[(hits[c] + 1) % n]
                opening = y[v + nq + 1 + b] - y[v + nq + 1 + a]
                more = (wanted[c] - opening) / (move[c, nq + 1 + b] - move[c, nq + 1 + a])
                more = max(more, -impulse[c])
                impulse[c] += more
                for i in range(v):
                    y[v + i] += more * move[c, i]
    for _ in range(4):
        for k in range(n):
            gap, _ = _gap(p, y, order, k, v, nq)
            if gap < 0.0:
                y[nq + 1 + order[k]] += gap / 2
                y[nq + 1 + order[(k + 1) % n]] -= gap / 2


@njit
def _step(p, y, h, given, w, k1, k2, k3, k4, z):  # type: ignore[no-untyped-def]
    """One step of Runge and Kutta, order 4."""
    size, pace = len(y), 0.5 / h
    rates(p, y, given, pace, w, k1)
    for i in range(size):
        z[i] = y[i] + h / 2 * k1[i]
    rates(p, z, given, pace, w, k2)
    for i in range(size):
        z[i] = y[i] + h / 2 * k2[i]
    rates(p, z, given, pace, w, k3)
    for i in range(size):
        z[i] = y[i] + h * k3[i]
    rates(p, z, given, pace, w, k4)
    for i in range(size):
        y[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i])
    nq = len(p.stiffness)
    for k in range(p.balls):
        theta = y[nq + 1 + k] - y[nq]
        bent = min(max(theta - w.anchor[k, 0], -w.anchor[k, 1]), w.anchor[k, 1])
        w.anchor[k, 2] += abs(theta - bent - w.anchor[k, 0])
        w.anchor[k, 0] = theta - bent


@njit
def _look(p, y, rev, place, n_places, squares, sums):  # type: ignore[no-untyped-def]
    """Imbalance left, in the rotor, and the squares of the velocities of the places added up for this revolution, these
    velocities themselves, and times the `place` of the sample from the middle of the revolution.
    """
    nq = len(p.stiffness)
    v = nq + 1 + p.balls
    re, im = p.carried, 0.0
    for k in range(p.balls):
        theta = y[nq + 1 + k] - y[nq]
        re += p.ball_mass * p.pitch * math.cos(theta)
        im += p.ball_mass * p.pitch * math.sin(theta)
    for j in range(n_places):
        if p.arm > 0.0:
            vx, vy = p.arm * y[v], 0.0
        else:
            vx = y[v] + (p.places[j] * y[v + 2] if p.core == 4 else 0.0)
            vy = y[v + 1] + (p.places[j] * y[v + 3] if p.core == 4 else 0.0)
        squares[rev, j, 0] += vx**2
        squares[rev, j, 1] += vy**2
        sums[0, rev, j, 0] += vx
        sums[0, rev, j, 1] += vy
        sums[1, rev, j, 0] += vx * place
        sums[1, rev, j, 1] += vy * place
    return re, im


@njit
def _rests(p, rev, wide, quiet, means, squares, angles, slipped):  # type: ignore[no-untyped-def]
    """Whether what is left has hardly a way to go, no ball goes round, and the velocity is steady.

    Or its mean square falls and is below `quiet` already. The way to go is that of a geometric series with the ways in
    the halves of the window as its last terms, and of little way in all. Balls that friction does not hold rest
    where they balance only: elsewhere they linger.
    """
    held = p.friction > 0.0
    for k in range(p.balls):
        held = held and slipped[rev, k] - slipped[rev - wide // 2, k] < 1e-6
    unit = max(p.carried, 0.01 * p.balls * p.ball_mass * p.pitch)
    away = math.hypot(means[rev, 0] - p.felt * p.offset * math.cos(p.offset_angle), means[rev, 1])
    if not held and away > 0.1 * unit:
        return False
    half, turn = wide // 2, 2.0 * math.pi * wide
    middle = rev - half
    before = after = 0.0
    for back in range(half):
        here = math.hypot(means[rev, 0] - means[rev - back, 0], means[rev, 1] - means[rev - back, 1])
        after = max(after, here)
        here = math.hypot(means[rev, 0] - means[middle - back, 0], means[rev, 1] - means[middle - back, 1])
        before = max(before, here)
    ratio = min(after / max(before, 1e-300), 0.98)
    if after > 2e-4 * unit and (before > 0.05 * unit or after * ratio / (1.0 - ratio) > 4e-3 * unit):
        return False
    for k in range(p.balls):
        if abs(angles[rev, k] - angles[rev - wide, k]) > 5e-4 * turn:
            return False
    for j in range(len(p.places)):
        for axis in range(2):
            first = second = 0.0
            for back in range(half):
                second += squares[rev - back, j, axis]
                first += squares[middle - back, j, axis]
            if abs(second - first) > 0.01 * second and not (second <= first and second < quiet * 16 * half):
                return False
    return True


@njit
def _calm(p, rev, wide, calm, squares, angles):  # type: ignore[no-untyped-def]
    """True if each mean square of velocity stays below `calm` and does not grow, and no ball moves by 0.3 rad."""
    for k in range(p.balls):
        if abs(angles[rev, k] - angles[rev - wide, k]) > 0.3:
            return False
    for j in range(len(p.places)):
        for axis in range(2):
            first = second = 0.0
            for back in range(wide):
                square = squares[rev - back, j, axis]
                if square > 16 * calm:
                    return False
                if back < wide // 2:
                    second += square
                else:
                    first += square
            if second > 1.01 * first:
                return False
    return True


@njit
def run(p, y, order, span, quiet, steps, w, moduli, times, means, squares, sums, angles, slipped):  # type: ignore[no-untyped-def]
    """Integrate y from t = 0 until all rests; `span` [s]: full speed, least time at it, latest end, window of looking.

    `quiet` [m²/s²]: a mean square that falls below the first number need not be steady; a run that stays below the
    second and grows no louder is calm and ends, though its balls still creep.

    From `full` [s] on, 16 times a revolution: |imbalance left| and its time. For each revolution its mean, the sums of
    the squares of velocity, of the velocities and of their moments, the ball angles at its end. Returns samples and
    revolutions that were written, and t.
    """
    full, least, most, window = span
    nq, n = len(p.stiffness), p.balls
    v = nq + 1 + n
    size = 2 * v
    k1, k2, k3, k4, z = np.empty(size), np.empty(size), np.empty(size), np.empty(size), np.empty(size)
    every = steps // 16
    angle = 2.0 * math.pi / steps
    for k in range(n):
        w.anchor[k, 0] = y[nq + 1 + k] - y[nq]
    wide = 2 * math.ceil(window * p.speed / (4.0 * math.pi))
    t, sample, rev, since = 0.0, 0, 0, 0
    re = im = 0.0
    while t < most and sample < len(times) - 1 and rev < len(means) - 1:
        now = y[v + nq] - (y[v] if p.arm > 0.0 else 0.0)
        h = min((1.5 if t < full else 1.0) * angle / max(now, p.speed / 4), p.longest)
        given = 0.0
        if p.ramp > 0.0 and t < p.ramp * (1 - 1e-12):
            given = p.speed / p.ramp
            h = min(h, p.ramp - t)
        _step(p, y, h, given, w, k1, k2, k3, k4, z)
        t += h
        if n > 1:
            collide(p, y, order, w)
        if t < full:
            continue
        since += 1
        if since % every == 0:
            a, b = _look(p, y, rev, sample % 16 - 7.5, len(p.places), squares, sums)
            moduli[sample], times[sample] = math.hypot(a, b), t
            sample += 1
            re += a / 16
            im += b / 16
        if since % steps == 0:
            means[rev, 0], means[rev, 1] = re, im
            re = im = 0.0
            for k in range(n):
                angles[rev, k] = y[nq + 1 + k] - y[nq]
                slipped[rev, k] = w.anchor[k, 2]
            late = rev >= wide and t - full > least and rev % 5 == 0
            if late and (
                _calm(p, rev, wide, quiet[1], squares, angles)
                or _rests(p, rev, wide, quiet[0], means, squares, angles, slipped)
            ):
                rev += 1
                break
            rev += 1
    return sample, rev, t
