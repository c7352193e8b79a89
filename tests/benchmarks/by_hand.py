"""The planar rotor with balls, gravity and an offset race, written by hand for the peers, apart from the library.

Ball k at γ = θ + Ωt, race centre at (x, y) + Δ (cos, sin)(Ωt + φ), whose own acceleration is (eₓ, e_y):

    J R θ'' = p + x'' sin γ − y'' cos γ,    p = −R h₀ θ' − g cos γ + eₓ sin γ − e_y cos γ
    (M + Σm) x'' = −k x − b x' + U Ω² cos(Ωt + ψ) + Σ m (R γ'² cos γ + R θ'' sin γ − eₓ),    y likewise

Range: a mass on springs and dampers along x and y, balls all alike in one race.
"""

import importlib
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import LinearSupport
from tests.benchmarks.measuring import Array

STEADY_INERTIA = 1e6
"""Of the rotor about its axis in MuJoCo [kg m²], in place of a drive that keeps the speed: it then changes by some
1e-14 of itself."""


@dataclass(frozen=True)
class Planar:
    """The numbers of such a rotor, SI; M without balls."""

    M: float
    k: tuple[float, float]
    b: tuple[float, float]
    speed: float
    U: float
    psi: float
    n: int
    m: float
    R: float
    h0: float
    J: float
    g: float
    delta: float
    phi: float


def planar(scene: Scene) -> Planar | None:
    """The numbers of a scene; None where the equations above are not for it."""
    support = scene.support
    if not (isinstance(support, LinearSupport) and support.names == ("x", "y") and len(scene.races) == 1):
        return None
    race, gravity, eccentricity = scene.races[0], scene.effect("gravity"), scene.effect("race_eccentricity")
    M, K, B = (np.array(matrix) for matrix in (support.mass, support.stiffness, support.damping))
    known = {effect.name for effect in scene.effects} <= {"gravity", "race_eccentricity"}
    diagonal = all(np.array_equal(A, np.diag(np.diag(A))) for A in (M, K, B)) and M[0, 0] == M[1, 1]
    if not (known and diagonal and len(set(race.ball_masses)) == 1):
        return None
    off = eccentricity if isinstance(eccentricity, RaceEccentricityEffect) else None
    return Planar(
        M=float(M[0, 0]),
        k=(float(K[0, 0]), float(K[1, 1])),
        b=(float(B[0, 0]), float(B[1, 1])),
        speed=scene.speed,
        U=scene.imbalance,
        psi=scene.imbalance_angle,
        n=len(race.ball_masses),
        m=race.ball_masses[0],
        R=race.pitch_radius,
        h0=race.drag,
        J=race.inertia_factor,
        g=gravity.acceleration if isinstance(gravity, GravityEffect) else 0.0,
        delta=off.magnitude if off else 0.0,
        phi=off.angle if off else 0.0,
    )


def in_units(r: Planar, length: float, time: float) -> Planar:
    """The same rotor in other units of length [m] and time [s]."""
    return replace(
        r,
        k=(r.k[0] * time**2, r.k[1] * time**2),
        b=(r.b[0] * time, r.b[1] * time),
        speed=r.speed * time,
        U=r.U / length,
        R=r.R / length,
        h0=r.h0 * time,
        g=r.g * time**2 / length,
        delta=r.delta / length,
    )


def with_arrays(r: Planar, xp: Any = np) -> Callable[[Any, Any], Any]:
    """y' of (x, y, x', y', θ…, θ'…) by arrays over the balls, for NumPy or jax.numpy."""
    n, W, m, R = r.n, r.speed, r.m, r.R
    M, mJ, mR = r.M + n * m, m / r.J, m * R

    def rhs(t: Any, y: Any) -> Any:
        turn = W * t
        theta_, rate = y[4 : 4 + n], y[4 + n :]
        gamma = theta_ + turn
        s, c, swing = xp.sin(gamma), xp.cos(gamma), rate + W
        ex, ey = -W * W * r.delta * xp.cos(turn + r.phi), -W * W * r.delta * xp.sin(turn + r.phi)
        p = -R * r.h0 * rate - r.g * c + ex * s - ey * c
        centrifugal = mR * swing * swing
        fx = r.U * W * W * xp.cos(turn + r.psi) - r.k[0] * y[0] - r.b[0] * y[2] - n * m * ex
        fy = r.U * W * W * xp.sin(turn + r.psi) - r.k[1] * y[1] - r.b[1] * y[3] - n * m * ey
        fx = fx + (centrifugal * c).sum() + mJ * (p * s).sum()
        fy = fy + (centrifugal * s).sum() - mJ * (p * c).sum()
        ss, sc = (s * s).sum(), (s * c).sum()
        a, b, d = M - mJ * ss, mJ * sc, M - mJ * (n - ss)
        determinant = a * d - b * b
        ax, ay = (d * fx - b * fy) / determinant, (a * fy - b * fx) / determinant
        balls = (p + ax * s - ay * c) / (r.J * R)
        return xp.concatenate([y[2:4], xp.stack([ax, ay]), rate, balls])

    return rhs


Push = Callable[[float, float], tuple[float, float]]
"""(turn, y) → force on the rotor along x and y [N]."""


def pressed_to_work(contact: GrindingContactEffect) -> Push:
    """A spring that only presses, max(0, N₀ − c h) with h = y + ε sin(turn + φ₀), as scripts write it: no events."""
    c, N0, s = contact.contact_stiffness, contact.press_force, contact.drag
    runout, place = contact.runout, contact.runout_angle

    def push(turn: float, y: float) -> tuple[float, float]:
        N = max(0.0, N0 - c * (y + runout * math.sin(turn + place)))
        return s * N, N - N0

    return push


def with_floats(r: Planar, push: Push | None = None) -> Callable[[float, Any], list[float]]:
    """The same by plain numbers, ball by ball: quicker than arrays for a few balls. `push`: one more force."""
    n, W, m, R, h0, g, J = r.n, r.speed, r.m, r.R, r.h0, r.g, r.J
    (kx, ky), (bx, by) = r.k, r.b
    M, mJ, mR, whole, lever = r.M + n * m, m / J, m * R, n * m, 1 / (J * R)
    force, off, psi, phi, drag = r.U * W * W, -W * W * r.delta, r.psi, r.phi, -R * h0
    sin, cos = math.sin, math.cos

    def rhs(t: float, y: Any) -> list[float]:
        x, y_, u, v, *rest = y.tolist()
        turn = W * t
        ex, ey = off * cos(turn + phi), off * sin(turn + phi)
        fx = force * cos(turn + psi) - kx * x - bx * u - whole * ex
        fy = force * sin(turn + psi) - ky * y_ - by * v - whole * ey
        if push:
            more = push(turn, y_)
            fx, fy = fx + more[0], fy + more[1]
        ss = sc = 0.0
        balls = []
        rates = rest[n:]
        for k in range(n):
            gamma, rate = rest[k] + turn, rates[k]
            s, c, swing = sin(gamma), cos(gamma), rate + W
            p = drag * rate + (ex * s) - (g + ey) * c
            pulled, spun = mJ * p, mR * swing * swing
            fx += spun * c + pulled * s
            fy += spun * s - pulled * c
            ss += s * s
            sc += s * c
            balls.append((p, s, c))
        a, b, d = M - mJ * ss, mJ * sc, M - mJ * (n - ss)
        determinant = a * d - b * b
        ax, ay = (d * fx - b * fy) / determinant, (a * fy - b * fx) / determinant
        return [u, v, ax, ay, *rates, *[lever * (p + ax * s - ay * c) for p, s, c in balls]]

    return rhs


def diffrax_solver(r: Planar, solver: str, moments: Array) -> Callable[[Array, float, Array], tuple[Array, int]]:
    """(initial state, relative tolerance, absolute tolerances) → states at the moments, evaluations; compiled once."""
    jax, diffrax = importlib.import_module("jax"), importlib.import_module("diffrax")
    jax.config.update("jax_enable_x64", True)
    jnp = importlib.import_module("jax.numpy")
    # Stages in a plain loop: an eighth quicker than what diffrax takes by itself, for it can be differentiated.
    rhs, method = with_arrays(r, jnp), getattr(diffrax, solver)(scan_kind="lax")

    @jax.jit  # type: ignore[untyped-decorator, unused-ignore]
    def solve(y0: Any, rtol: Any, atol: Any) -> Any:
        done = diffrax.diffeqsolve(
            diffrax.ODETerm(lambda t, y, _: rhs(t, y)),
            method,
            t0=0.0,
            t1=float(moments[-1]),
            dt0=None,
            y0=y0,
            saveat=diffrax.SaveAt(ts=jnp.asarray(moments)),
            stepsize_controller=diffrax.PIDController(rtol=rtol, atol=atol),
            max_steps=10**6,
        )
        return done.ys, done.stats["num_steps"]

    stages = {"Dopri8": 13, "Tsit5": 6}[solver]

    def go(y0: Array, rtol: float, atol: Array) -> tuple[Array, int]:
        ys, steps = solve(jnp.asarray(y0), jnp.asarray(rtol), jnp.asarray(atol))
        return np.asarray(ys).T, int(steps) * stages

    return go


def heyoka_solver(r: Planar, tolerance: float, moments: Array) -> Callable[[Array], tuple[Array, int]]:
    """(initial state) → states at the moments, steps times the order; compiled for this tolerance.

    heyoka bounds errors relative to the largest state, or to 1: lengths and times have to be in units that suit them.
    """
    hy = importlib.import_module("heyoka")
    hy.set_logger_level_error()
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    angles, rates = ([hy.expression(f"{name}{k}") for k in range(r.n)] for name in ("theta", "rate"))
    turn, lever = r.speed * hy.time, 1 / (r.J * r.R)
    sin, cos = ([f(angle + turn) for angle in angles] for f in (hy.sin, hy.cos))
    off = -r.delta * r.speed**2
    ex, ey = off * hy.cos(turn + r.phi), off * hy.sin(turn + r.phi)
    # R θ'' of a ball but for what the axis adds, and the balls' forces on the axis with that.
    own = [(ex * s - (ey + r.g) * c - r.R * r.h0 * rate) / r.J for s, c, rate in zip(sin, cos, rates, strict=True)]
    spun = [r.R * (rate + r.speed) * (rate + r.speed) for rate in rates]
    rows = list(zip(sin, cos, own, spun, strict=True))
    force, phase = r.U * r.speed**2, turn + r.psi
    pull_x, pull_y = hy.sum([w * c + a * s for s, c, a, w in rows]), hy.sum([w * s - a * c for s, c, a, w in rows])
    fx = force * hy.cos(phase) - r.k[0] * x - r.b[0] * u + r.m * pull_x - r.n * r.m * ex
    fy = force * hy.sin(phase) - r.k[1] * y - r.b[1] * v + r.m * pull_y - r.n * r.m * ey
    shared, whole = r.m / r.J, r.M + r.n * r.m
    sxx, sxy = hy.sum([shared * s * s for s in sin]), hy.sum([shared * s * c for s, c in zip(sin, cos, strict=True)])
    mxx, myy = whole - sxx, whole - r.n * shared + sxx
    determinant = mxx * myy - sxy * sxy
    ax, ay = (myy * fx - sxy * fy) / determinant, (mxx * fy - sxy * fx) / determinant
    balls = [lever * (ax * s - ay * c) + a / r.R for s, c, a, _ in rows]
    system = [(x, u), (y, v), (u, ax), (v, ay), *zip(angles, rates, strict=True), *zip(rates, balls, strict=True)]
    solver = hy.taylor_adaptive(system, [0.0] * (4 + 2 * r.n), tol=tolerance, compact_mode=False)

    def go(start: Array) -> tuple[Array, int]:
        solver.time, solver.state[:] = 0.0, start
        *_, steps, _, states = solver.propagate_grid(moments)
        return np.asarray(states).T, int(steps) * solver.order

    return go


def mujoco_model(r: Planar, integrator: str, step: float) -> Any:
    """The rotor on two slides and a hinge that turns at Ω, the balls on hinges of the rotor.

    So ball coordinates are θ itself, the drag is a joint's damping, the offset race is where the hinges sit, and the
    imbalance is where the rotor's mass is: nothing has to be applied from outside, and all steps are done in C.
    The rotor's weight is compensated; the springs of the support hold that of the balls.
    """
    mujoco = importlib.import_module("mujoco")
    place = r.delta * math.cos(r.phi), r.delta * math.sin(r.phi)
    rolling, drag = (r.J - 1) * r.m * r.R**2, r.m * r.R**2 * r.h0
    heavy = r.U / r.M * math.cos(r.psi), r.U / r.M * math.sin(r.psi)
    sag = r.n * r.m * r.g / r.k[1]
    ball = f"""<body pos="{place[0]!r} {place[1]!r} 0"><joint type="hinge" axis="0 0 1" damping="{drag!r}"/>
      <inertial pos="{r.R!r} 0 0" mass="{r.m!r}" diaginertia="{rolling!r} {rolling!r} {rolling!r}"/></body>"""
    text = f"""<mujoco>
  <compiler angle="radian" inertiafromgeom="false" autolimits="false" boundmass="0" boundinertia="0"/>
  <option timestep="{step!r}" integrator="{integrator}" gravity="0 {-r.g!r} 0">
    <flag constraint="disable" contact="disable"/></option>
  <worldbody><body gravcomp="1">
      <joint type="slide" axis="1 0 0" stiffness="{r.k[0]!r}" damping="{r.b[0]!r}"/>
      <joint type="slide" axis="0 1 0" stiffness="{r.k[1]!r}" damping="{r.b[1]!r}" springref="{sag!r}"/>
      <joint type="hinge" axis="0 0 1"/>
      <inertial pos="{heavy[0]!r} {heavy[1]!r} 0" mass="{r.M!r}"
        diaginertia="{STEADY_INERTIA!r} {STEADY_INERTIA!r} {STEADY_INERTIA!r}"/>
      {ball * r.n}
  </body></worldbody></mujoco>"""
    return mujoco.MjModel.from_xml_string(text)


def mujoco_runner(
    r: Planar, integrator: str, per_interval: int, moments: Array, initial: Sequence[float]
) -> Callable[[], tuple[Array, int]]:
    """Runs with so many equal steps between two moments, which are equally spaced."""
    mujoco = importlib.import_module("mujoco")
    model = mujoco_model(r, integrator, float(moments[1]) / per_interval)
    data, n = mujoco.MjData(model), r.n
    start = np.array(initial)
    stages = 4 if integrator == "RK4" else 1

    def go() -> tuple[Array, int]:
        mujoco.mj_resetData(model, data)
        data.qpos[:2], data.qpos[3:] = start[:2], start[4 : 4 + n]
        data.qvel[:2], data.qvel[2], data.qvel[3:] = start[2:4], r.speed, start[4 + n :]
        columns = [np.delete(data.qpos, 2)]
        for _ in moments[1:]:
            mujoco.mj_step(model, data, per_interval)
            columns.append(np.delete(data.qpos, 2))
        return np.array(columns).T, stages * per_interval * (len(moments) - 1)

    return go
