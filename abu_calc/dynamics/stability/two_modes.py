"""Small motions about balls that balance in one race, reduced to the two modes that the support feels.

    α = Σ δ cos θ,  β = Σ δ sin θ,  counted from the axis of Σ e^{2iθ},  of which  χ = |Σ e^{2iθ}|/n  is all that counts
    support   M D²q + C D q + K q + m Pᵀ D²(B η) = 0,     D = d/dt + Ω × (seen from the rotor),  η = R_p (α, β)
    balls     J η'' + h₀ η' + Bᵀ D² P q = 0,              B = ((0, −g₋), (g₊, 0)),  g± = √(n(1 ± χ)/2)

On an isotropic support that is, with X = J s² + h₀ s, a = s + iΩ, b = s − iΩ, N = n m/M and D(s) = s² + 2ζωs + ω²:

    X² D(a)D(b) − (N/2)(a⁴D(b) + b⁴D(a)) X + (N/2)²(1 − χ²) a⁴b⁴ = 0

The result equals that of `linearised`, which takes any support and any balls, in a fraction of the time. Source:
derived.
"""

import math
from dataclasses import replace
from functools import cached_property
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.stability import floquet
from abu_calc.dynamics.stability.family import likeness
from abu_calc.dynamics.stability.linearised import QUARTER, WIDE_SPAN, BalancedMotion
from abu_calc.dynamics.support import SmallMotion
from abu_calc.foundation.frozen import dataclass

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

ALIKE: Final = 1e-12
"""Relative; what differs by less along x and y is the same."""

PHASES: Final = 64
"""Number of phases over half a turn at which the support's response is evaluated."""

SPEEDS: Final = (0.5, 1.0, 2.0)
"""Shares of the unit at which A is taken: it is a polynomial of the second degree in the speed."""

ONE_LINE: Final = 1e-9
"""1 − χ of balls that stand on one line: the second mode is neutral then."""


@dataclass(frozen=True)
class TwoModes:
    """`support` with the balls' mass on it, its coordinates pairs along x and y; m [kg], drag h₀ [1/s], J, n, χ.

    `unit` [rad/s]: what speeds and rates are measured in; `in_one_place`: whether all balls are.

    """

    support: SmallMotion
    ball_mass: float
    drag: float
    inertia_factor: float
    count: int
    likeness: float
    unit: float
    in_one_place: bool

    @property
    def shares(self) -> tuple[float, ...]:
        """g₊ and g₋; the latter is left out where all balls stand on one line."""
        pair = (
            math.sqrt(self.count * (1 + self.likeness) / 2),
            math.sqrt(self.count * max(0.0, 1 - self.likeness) / 2),
        )
        return pair if self.likeness < 1 - ONE_LINE else pair[:1]

    @property
    def on_one_line(self) -> Self:
        """Motion with balls that are almost on one line treated as if they were; itself if they are not."""
        near = 1 - self.likeness < WIDE_SPAN**2 and not self.in_one_place
        return replace(self, likeness=1.0) if near else self

    @property
    def states(self) -> int:
        """Twice the coordinates."""
        return 2 * (len(self.support.mass) + len(self.shares))

    @cached_property
    def isotropic(self) -> bool:
        """True if everything is constant, seen from the rotor."""
        spin = self._spin
        matrices = (self.support.mass, self.support.damping, self.support.stiffness)
        return all(np.abs(A @ spin - spin @ A).max() <= ALIKE * np.abs(A).max() for A in matrices)

    def polynomial(self) -> Array:
        """L₀, L₁, L₂ of A = (L₀ + L₁x + L₂x²)/x on an isotropic support, x the speed over `unit`, time in 1/Ω."""
        return np.asarray(self._parts[:, 0].real, dtype=float)

    @cached_property
    def _parts(self) -> Complex:
        """[degree, harmonic, row, column] of A with time in 1/unit: that of e^{2ikφ}, φ the turn, as Re Σ."""
        phases = np.zeros(1) if self.isotropic else math.pi * np.arange(PHASES) / PHASES
        values = np.array([self._scaled(phases, x * self.unit) for x in SPEEDS])
        terms = np.fft.rfft(values, axis=1) / len(phases)
        terms[:, 1:] *= 2
        sizes = np.abs(terms).max(axis=(0, 2, 3))
        last = int(np.flatnonzero(sizes > ALIKE * sizes[0])[-1])
        inverse = np.linalg.inv(np.vander(SPEEDS, increasing=True))
        return np.asarray(np.tensordot(inverse, terms[:, : last + 1], axes=1), dtype=complex)

    def growth(self, speed: float) -> float:
        """Growth rate of the slowest-dying disturbance at Ω [1/s]: the largest Re λ, or ln|μ|/T over a revolution T."""
        if speed not in self._growths:
            self._growths[speed] = float(self._rates(speed).max())
        return self._growths[speed]

    @cached_property
    def _growths(self) -> dict[float, float]:
        """Growth rates that are known, by speed."""
        return {}

    def growing(self, speed: float, least: float) -> int:
        """Number of eigenvalues or multipliers that grow by more than `least` [1/s]."""
        return int((self._rates(speed) > least).sum())

    def _rates(self, speed: float) -> Array:
        """Growth rates of all eigenvalues or multipliers."""
        x = speed / self.unit
        terms = np.tensordot((1.0, x, x * x), self._parts, axes=1)
        if self.isotropic:
            return np.asarray(np.linalg.eigvals(terms[0].real).real * self.unit, dtype=float)
        orders = 2j * np.arange(len(terms))

        def matrices(phases: Array) -> Array:
            """A of z' = A z [1/rad] at phases of the turn [rad], stacked."""
            return np.asarray(np.einsum("tk,kij->tij", np.exp(phases[:, None] * orders), terms).real / x, dtype=float)

        # Seen from the rotor, half a turn later all is the same.
        moduli = np.abs(floquet.multipliers(matrices, math.pi, np.eye(self.states)))
        return np.asarray(np.log(np.maximum(moduli, np.finfo(float).tiny)) * speed / math.pi, dtype=float)

    def _scaled(self, phases: Array, speed: float) -> Array:
        """A with time in 1/unit."""
        scale = np.repeat((1.0, self.unit), self.states // 2)
        return np.asarray(self._matrices(phases, speed) * scale / scale[:, None] / self.unit, dtype=float)

    @property
    def _spin(self) -> Array:
        return np.kron(np.eye(len(self.support.mass) // 2), QUARTER)

    def _matrices(self, phases: Array, speed: float) -> Array:
        """A of z' = A z [1/s], z = (q, η, q', η') seen from the rotor, at phases of its turn, stacked."""
        support, m, W = self.support, self.ball_mass, speed
        spin, P, Q = self._spin, support.frame, QUARTER
        M, C, K = (_turned(A, spin, phases) for A in (support.mass, support.damping, support.stiffness))
        B = np.array(((0.0, -1.0), (1.0, 0.0)))[:, : len(self.shares)] * self.shares
        size, balls = len(spin), len(self.shares)
        first, second, third = (np.zeros((len(phases), size + balls, size + balls)) for _ in range(3))
        first[:, :size, :size], first[:, size:, size:] = M, self.inertia_factor * np.eye(balls)
        second[:, :size, :size], second[:, size:, size:] = 2 * W * M @ spin + C, self.drag * np.eye(balls)
        third[:, :size, :size] = -(W**2) * M + W * C @ spin + K
        for into, turn in ((first, np.eye(2)), (second, 2 * W * Q), (third, -(W**2) * np.eye(2))):
            into[:, :size, size:] = m * P.T @ turn @ B
            into[:, size:, :size] = B.T @ turn @ P
        lower = -np.linalg.solve(first, np.concatenate([third, second], axis=2))
        upper = np.broadcast_to(np.eye(size + balls, 2 * (size + balls), size + balls), lower.shape)
        return np.asarray(np.concatenate([upper, lower], axis=1), dtype=float)


LinearMotion = BalancedMotion | TwoModes


def _turned(matrix: Array, spin: Array, phases: Array) -> Array:
    """RᵀAR of a matrix of pairs along x and y, R = cos φ + spin · sin φ."""
    c, s = np.cos(phases)[:, None, None], np.sin(phases)[:, None, None]
    return np.asarray(
        c * c * matrix - s * s * spin @ matrix @ spin + c * s * (matrix @ spin - spin @ matrix), dtype=float
    )


def two_modes(motion: BalancedMotion) -> TwoModes | None:
    """Two-mode form of a motion of any scene; None if the motion has no such form.

    The form exists only for balls of one race, whose support moves it in its plane by pairs of coordinates
    along x and y, the axis still.
    """
    scene, angles = motion.scene, motion.angles
    if motion.motion:
        return None
    support = scene.support.small_motion(scene.speed).carrying(scene.balls)
    masses, size = scene.ball_masses, len(support.mass)
    if len(scene.races) != 1 or not masses or not scene.support.straight:
        return None
    spin = np.kron(np.eye(size // 2), QUARTER)
    if size % 2 or np.any(support.frame @ spin != QUARTER @ support.frame):
        return None
    (race,) = scene.races
    return TwoModes(
        support=support,
        ball_mass=sum(masses) / len(masses),
        drag=race.drag,
        inertia_factor=race.inertia_factor,
        count=len(angles),
        likeness=likeness(masses, angles),
        unit=scene.speed,
        in_one_place=motion.in_one_place,
    )
