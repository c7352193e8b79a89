"""Bodies in space with known numbers, and six degrees of freedom with balls integrated from Newton and Euler.

The integration shares nothing with the package: matrices, forces and equations of motion are written here anew.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from abu_calc.formulas.body_motion import BodySprings, BodySuspension, HandsOnHandles
from abu_calc.formulas.rigid_body import Inertia, RigidBody, Vector
from abu_calc.standards.vibration import hand

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SpaceCase:
    """A body with wheel, race, balls and handles [SI]."""

    body: RigidBody
    rpm: float
    wheel: Vector
    race: Vector
    imbalance: float
    ball_mass: float
    pitch_radius: float
    handles: dict[str, Vector]
    eccentricity: float = 0.0
    drag: float = 15.0
    count: int = 4
    frequency: float = 2.5
    damping: float = 0.5
    in_hands: bool = False
    start: tuple[float, ...] = field(default=(0.3, 0.9, 1.6, 2.4))

    @property
    def speed(self) -> float:
        return self.rpm * math.pi / 30

    @property
    def suspension(self) -> BodySuspension:
        if self.in_hands:
            return HandsOnHandles(tuple(self.handles.values())[:2], (hand("x"), hand("y"), hand("z")))
        return BodySprings((2 * math.pi * self.frequency,) * 2, (self.damping,) * 2)


G125 = SpaceCase(
    RigidBody(2.4, Inertia(0.0040, 0.0200, 0.0190, -0.0015)), 11000, (0.095, 0, 0.048), (0.095, 0, 0.048), 38e-6,
    1.0e-3, 0.018, {"rear": (-0.110, 0, -0.005), "side": (0.062, 0.120, -0.008)},
)  # fmt: skip
G230 = SpaceCase(
    RigidBody(6.0, Inertia(0.022, 0.130, 0.125, -0.010), 0.0032), 6500, (0.135, 0, 0.075), (0.135, 0, 0.050), 152e-6,
    4.084e-3, 0.027, {"rear": (-0.190, 0, -0.010), "side": (0.095, 0.160, -0.015)},
)  # fmt: skip
V305 = SpaceCase(
    RigidBody(4.6, Inertia(0.012, 0.055, 0.052, -0.004), 0.0015), 1750, (0.110, 0, 0.085), (0.110, 0, 0.085), 600e-6,
    16.728e-3, 0.030, {"rear": (-0.130, 0, 0), "side": (0.080, 0.130, 0.010)}, eccentricity=10e-6, in_hands=True,
)  # fmt: skip


def _way(place: Vector) -> Array:
    x, y, z = place
    return np.array([[1, 0, 0, 0, z, -y], [0, 1, 0, -z, 0, x], [0, 0, 1, y, -x, 0]], float)


def settled_amplitudes(case: SpaceCase, places: dict[str, Vector], *, balls: bool, turns: int) -> dict[str, Array]:
    """Velocity rms along x, y, z [m/s] at places over the last 20 turns of an integration by Runge-Kutta.

    The body is held by springs of one frequency in all six degrees of freedom. Balls are points on a circle about the
    race's centre, which the eccentricity carries round; they roll with J = 7/5 and do not move along the spindle of
    the tilting race.
    """
    body = case.body
    assert body.inertia is not None
    Ω, J = case.speed, 7 / 5
    i = body.inertia
    J_body = np.array([[i.xx, 0, i.xz], [0, i.yy, 0], [i.xz, 0, i.zz]])
    M = np.zeros((6, 6))
    M[:3, :3], M[3:, 3:] = body.mass * np.eye(3), J_body
    w0 = 2 * math.pi * case.frequency
    K, C = w0**2 * M, 2 * case.damping * w0 * M
    C[3, 4] += body.rotor_polar_inertia * Ω
    C[4, 3] -= body.rotor_polar_inertia * Ω
    Tw, Tr = _way(case.wheel), _way(case.race)
    n, m, R = (case.count if balls else 0), case.ball_mass, case.pitch_radius
    tangent, forces, held = np.zeros((2, n)), np.zeros(6 + n), np.hstack([K, C])
    wheel, arm = case.imbalance * Ω**2 * Tw.T[:, :2], m * Tr.T[:, :2]
    total = np.diag(np.full(6 + n, m * R**2 * J))
    total[:6, :6] = M + n * m * Tr.T @ Tr

    def accelerations(t: float, moved: Array, γ: Array, dγ: Array) -> Array:
        """M q̈ = forces of the imbalance and of each ball, −m times the acceleration of its place; J γ̈ likewise."""
        turned = np.array([math.cos(Ω * t), math.sin(Ω * t)])
        centre, outwards = -case.eccentricity * Ω**2 * turned, R * dγ**2
        tangent[0], tangent[1] = -np.sin(γ), np.cos(γ)
        total[:6, 6:] = R * arm @ tangent
        total[6:, :6] = total[:6, 6:].T
        places = n * centre - np.array([tangent[1] @ outwards, -tangent[0] @ outwards])
        forces[:6] = wheel @ turned - held @ moved - arm @ places
        forces[6:] = -m * R**2 * case.drag * (dγ - Ω) - m * R * centre @ tangent
        return np.linalg.solve(total, forces)

    def rate(t: float, state: Array) -> Array:
        found = accelerations(t, state[:12], state[12 : 12 + n], state[12 + n :])
        return np.concatenate([state[6:12], found[:6], state[12 + n :], found[6:]])

    steps = 40
    h = 2 * math.pi / Ω / steps
    state = np.concatenate([np.zeros(12), np.array(case.start[:n]), np.full(n, Ω)])
    samples: dict[str, list[Array]] = {name: [] for name in places}
    for step in range(turns * steps):
        t = step * h
        k1 = rate(t, state)
        k2 = rate(t + h / 2, state + h / 2 * k1)
        k3 = rate(t + h / 2, state + h / 2 * k2)
        k4 = rate(t + h, state + h * k3)
        state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if step >= (turns - 20) * steps:
            for name, place in places.items():
                samples[name].append(_way(place) @ state[6:12])
    answer = {}
    angles = 2 * math.pi * np.arange(20 * steps) / steps
    for name, rows in samples.items():
        motion = np.array(rows)
        harmonic = np.exp(-1j * angles) @ motion * 2 / len(motion)  # the harmonic of the rotation alone
        answer[name] = np.abs(harmonic) / math.sqrt(2)
    return answer
