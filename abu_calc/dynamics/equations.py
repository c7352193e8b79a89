"""The one set of equations of motion: a linear support and one race of balls.

With q the support's coordinates, r = P q = (x, y) the race centre, θ_k a ball's angle in the rotor, γ_k = θ_k + Ωt:

    M q'' + C q' + K q = Pᵀ [ m₀e Ω² (cos, sin)(Ωt + φ) − Σ m_k (r + R_p (cos γ_k, sin γ_k))'' ]
    J γ_k'' + h₀ θ_k' = (x'' sin γ_k − y'' cos γ_k)/R_p

Eliminating γ'' leaves the balls' force as F₀ − A r'', with s = (sin γ, −cos γ),

    A = Σ m (I − s sᵀ/J)        F₀ = Σ m R_p [ γ'² (cos γ, sin γ) − (h₀/J) θ' s ],

so that r'' solves a 2 × 2 system and the cost grows linearly with the number of balls. A is symmetric and positive
semidefinite for J ≥ 1: the system can always be solved. J = 7/5 for a rolling ball, 3/2 for a roller.

Range: constant speed Ω, balls in the plane of the race that may pass through each other. Source: Kladiev 1996, (1),
re-derived by Lagrange's equations. Printed: (1) has J = 1, so its balls move faster by √(7/5), and no damping of the
support, so its free vibration never dies.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene
from abu_calc.errors import InputError

Array = NDArray[Any]


@dataclass(frozen=True, slots=True)
class Parameters:
    """The numbers `rhs` reads, combined once so that an evaluation needs few operations. SI."""

    size: int
    """N, the support's coordinates."""
    speed: float
    imbalance_force: float
    imbalance_phases: Array
    """φ and φ − π/2: the cosines of phases + Ωt are the imbalance's components."""
    free: Array
    """(N+2) × 2N: the accelerations (q'', r'') of the support alone are `free @ (q, q')`."""
    push: tuple[tuple[float, float], ...]
    """N × 2, M⁻¹Pᵀ: accelerations by a unit force on the race centre."""
    compliance: tuple[float, float, float]
    """xx, xy, yy of W = P M⁻¹ Pᵀ."""
    moments: Array
    """m R_p of each ball."""
    drags: Array
    """m R_p h₀/J of each ball."""
    reduced_masses: Array
    """m/J of each ball."""
    ball_mass: float
    reduced_ball_mass: float
    lever: float
    """1/(J R_p)."""
    drag: float
    """h₀/J."""


Rhs = Callable[[Any, Any, Any, Parameters], Array]


@dataclass(frozen=True)
class Equations:
    """A system to integrate: `rhs(xp, t, y, parameters)` in the order of `states`.

    scales: what counts as a whole unit of each state; an error of tolerance × scale per step is allowed.
    relative: whether a state's own size may loosen that (not for angles: they grow without meaning anything).
    longest_step [s]: no step may be longer, whatever the error estimate says.
    """

    states: tuple[str, ...]
    rhs: Rhs
    parameters: Parameters
    initial: tuple[float, ...]
    scales: tuple[float, ...]
    relative: tuple[bool, ...]
    longest_step: float


def rhs(xp: Any, t: Any, y: Any, p: Parameters) -> Array:
    """Time derivative of (q, q', θ, θ') by array arithmetic and xp.sin, xp.cos alone: real, complex or symbolic."""
    n = p.size
    first_rate = 2 * n + len(p.moments)
    theta, rate = y[2 * n : first_rate], y[first_rate:]
    turn = p.speed * t
    gamma = theta + turn
    sin, cos = xp.sin(gamma), xp.cos(gamma)
    swing = rate + p.speed
    # Sums over the balls by one product; as a list, because plain numbers are faster from here on than array scalars.
    per_ball = np.array((p.moments * swing * swing, p.drags * rate, p.reduced_masses * sin))
    (spun_y, drag_x, axx), (spun_x, drag_y, axy) = np.array((sin, cos)).dot(per_ball.T).tolist()
    drive_x, drive_y = (p.imbalance_force * xp.cos(p.imbalance_phases + turn)).tolist()
    fx, fy = drive_x + spun_x - drag_x, drive_y + spun_y + drag_y
    axx, ayy = p.ball_mass - axx, p.ball_mass - p.reduced_ball_mass + axx
    *alone, gx, gy = p.free.dot(y[: 2 * n]).tolist()
    ax, ay = _centre_acceleration(p.compliance, (axx, axy, ayy), (gx, gy), (fx, fy))
    fx, fy = fx - axx * ax - axy * ay, fy - axy * ax - ayy * ay
    out: Array = np.empty_like(y)
    out[:n] = y[n : 2 * n]
    out[n : 2 * n] = [a + hx * fx + hy * fy for a, (hx, hy) in zip(alone, p.push, strict=True)]
    out[2 * n : first_rate] = rate
    out[first_rate:] = (p.lever * ax) * sin - (p.lever * ay) * cos - p.drag * rate
    return out


def _centre_acceleration(w: Any, a: Any, g: Any, f: Any) -> tuple[Any, Any]:
    """r'' from (I + W A) r'' = g + W f by Cramer's rule; w and a hold the xx, xy, yy of symmetric 2 × 2 matrices."""
    wxx, wxy, wyy = w
    axx, axy, ayy = a
    (gx, gy), (fx, fy) = g, f
    mxx, mxy = 1 + wxx * axx + wxy * axy, wxx * axy + wxy * ayy
    myx, myy = wxy * axx + wyy * axy, 1 + wxy * axy + wyy * ayy
    bx, by = gx + wxx * fx + wxy * fy, gy + wxy * fx + wyy * fy
    determinant = mxx * myy - mxy * myx
    return (myy * bx - mxy * by) / determinant, (mxx * by - myx * bx) / determinant


def assemble(scene: Scene) -> Equations:
    """The equations of a scene. Raises InputError when the support's mass matrix is not symmetric positive definite."""
    parameters = _parameters(scene)
    names, balls = scene.support.names, range(1, len(scene.race.ball_masses) + 1)
    support_scales, rate_scale = _scales(scene, parameters)
    return Equations(
        states=(*names, *(f"{name}'" for name in names), *(f"θ{k}" for k in balls), *(f"θ{k}'" for k in balls)),
        rhs=rhs,
        parameters=parameters,
        initial=(
            *scene.start_position,
            *scene.start_velocity,
            *scene.race.start_angles,
            *scene.race.start_speeds,
        ),
        scales=(
            *support_scales,
            *(scale * scene.speed for scale in support_scales),
            *(1.0 for _ in balls),
            *(rate_scale for _ in balls),
        ),
        relative=(*(True for _ in 2 * names), *(False for _ in balls), *(True for _ in balls)),
        # An imbalance goes round once per revolution: a longer step might not see it.
        longest_step=scene.revolution,
    )


def _parameters(scene: Scene) -> Parameters:
    support, race = scene.support, scene.race
    mass, P = np.array(support.mass), np.array(support.race_map)
    if not (np.allclose(mass, mass.T, rtol=1e-9, atol=0) and np.all(np.linalg.eigvalsh(mass) > 0)):
        raise InputError("the support's mass matrix must be symmetric and positive definite", found=str(support.mass))
    free = np.linalg.solve(mass, -np.hstack([support.stiffness, support.damping]))
    push = np.linalg.solve(mass, P.T)
    (wxx, wxy), (_, wyy) = (P @ push).tolist()
    masses = np.array(race.ball_masses, dtype=float)
    J, R = race.inertia_factor, race.pitch_radius
    return Parameters(
        size=len(support.names),
        speed=scene.speed,
        imbalance_force=scene.imbalance * scene.speed**2,
        imbalance_phases=scene.imbalance_angle - np.array((0.0, math.pi / 2)),
        free=np.vstack([free, P @ free]),
        push=tuple((hx, hy) for hx, hy in push.tolist()),
        compliance=(wxx, wxy, wyy),
        moments=masses * R,
        drags=masses * (R * race.drag / J),
        reduced_masses=masses / J,
        ball_mass=float(masses.sum()),
        reduced_ball_mass=float(masses.sum()) / J,
        lever=1 / (J * R),
        drag=race.drag / J,
    )


def _scales(scene: Scene, p: Parameters) -> tuple[list[float], float]:
    """Scales of the support's coordinates and of the balls' speeds.

    The first is the amplitude of the free, unbalanced rotor, m₀e/M, which is what amplitudes are compared with; a
    hundredth of the balls' own moment stands in where there is next to no imbalance. The second is the rate of the
    balls' slow motion, Ω√(Σm/2M), on which they find their places: measured in Ω, that would be lost in the tolerance.
    """
    mass = 2 / (p.compliance[0] + p.compliance[2]) + p.ball_mass
    reach = max(scene.imbalance, 0.01 * scene.race.static_moment, 1e-9 * mass * scene.race.pitch_radius) / mass
    # A coordinate that moves the race by less than its own amount may move more; one that does not, like the race.
    shares = [math.hypot(*column) for column in zip(*scene.support.race_map, strict=True)]
    return [reach / share if share > 0 else reach for share in shares], scene.speed * math.sqrt(
        p.ball_mass / (2 * mass)
    )
