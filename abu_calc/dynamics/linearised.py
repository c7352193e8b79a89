"""Small motions about the balanced state of a scene, in the frame that turns with the rotor.

z' = A(Ωt) z, z = (q, q', θ, θ') about balls at rest in the race and a still axis, q and q' seen from the rotor. On an
isotropic support A is constant; on any other it repeats with every half turn. States are measured in the scales of the
equations and time in 1/Ω, so that numbers of all machines are alike. Derivatives are those of `equations`.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations import assemble
from abu_calc.dynamics.integrators.scipy_ import transition
from abu_calc.dynamics.jacobian import jacobian
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import InputError, NotTrustworthyError

Array = NDArray[np.float64]

QUARTER: Final = np.array([[0.0, -1.0], [1.0, 0.0]])
"""A quarter turn, from x to y."""

NOTHING: Final = 1e-12
"""Relative; a harmonic of A smaller than this is rounding."""

MOST_PHASES: Final = 64


@dataclass(frozen=True)
class BalancedMotion:
    """The linear motion about balls at rest at `angles` [rad], at any speed.

    The directions in which balls move without changing their sum are split off: each has the rates 0 (neutral, not
    counted) and −h₀/J.
    """

    scene: Scene
    angles: tuple[float, ...]

    @cached_property
    def basis(self) -> Array:
        """Columns: motions of the balls that change their sum Σ m e^{iθ}."""
        masses, theta = np.array(self.scene.race.ball_masses), np.array(self.angles)
        _, sizes, directions = np.linalg.svd(np.array((-masses * np.sin(theta), masses * np.cos(theta))))
        return np.asarray(directions[: int((sizes > 1e-9 * masses.sum()).sum())].T, dtype=float)

    @cached_property
    def scales(self) -> Array:
        """Units of the states: those of the working speed at every speed, so that A stays a polynomial of it."""
        return np.array(assemble(self.scene).scales)

    @property
    def neutral(self) -> int:
        """How many directions of the balls are neutral: n − 2 of n, unless all balls are in one line."""
        return int(self.basis.shape[0] - self.basis.shape[1])

    def harmonics(self, speed: float) -> NDArray[np.complex128]:
        """c_k of A(φ) = Re Σ c_k e^{2ikφ}, φ = Ωt: c_0 alone on an isotropic support, two on springs in the plane."""
        count = 4
        while True:
            phases = math.pi * np.arange(count) / count
            terms = np.fft.rfft([self._matrix(speed, phase) for phase in phases], axis=0) / count
            terms[1:] *= 2
            sizes = np.abs(terms).max(axis=(1, 2))
            present = np.flatnonzero(sizes > NOTHING * sizes[0])
            if present[-1] < count // 2:
                return np.asarray(terms[: present[-1] + 1], dtype=complex)
            if count == MOST_PHASES:
                raise NotTrustworthyError("the linear motion about the balanced state turns too sharply to be judged")
            count *= 2

    def _matrix(self, speed: float, phase: float) -> Array:
        """A at one phase: B⁻¹ (∂rhs B − B'), y = B z with q = R(φ) q_r; divided by Ω, in units of the scales."""
        scene = replace(self.scene, speed=speed, duration=2 * math.pi / speed)
        size = len(scene.support.names)
        if size % 2:
            raise InputError("stability is known on supports with pairs of coordinates along x and y only")
        pairs = np.eye(size // 2)
        c, s = math.cos(phase), math.sin(phase)
        turn, spin = np.kron(pairs, np.array([[c, -s], [s, c]])), speed * np.kron(pairs, QUARTER)
        still = np.zeros(2 * size)
        balanced = np.concatenate([still, self.angles, np.zeros(len(self.angles))])
        slope = jacobian(assemble(scene), phase / speed, balanced)
        B, spun = np.eye(len(balanced)), np.zeros_like(slope)
        B[:size, :size] = B[size : 2 * size, size : 2 * size] = turn
        B[size : 2 * size, :size] = spin @ turn
        spun[:size, :size] = spun[size : 2 * size, size : 2 * size] = spin
        turned = np.linalg.solve(B, slope @ B - spun @ B)
        scaled = turned * self.scales / self.scales[:, None] / speed
        kept = np.block([[np.eye(2 * size), np.zeros((2 * size, 2 * self.basis.shape[1]))],
                         [np.zeros((2 * len(self.angles), 2 * size)), np.kron(np.eye(2), self.basis)]])  # fmt: skip
        return np.asarray(kept.T @ scaled @ kept, dtype=float)

    def eigenvalues(self, speed: float) -> tuple[complex, ...] | None:
        """Eigenvalues [1/s] on an isotropic support, the largest real part first; None on any other."""
        terms = self.harmonics(speed)
        if len(terms) > 1:
            return None
        own = np.linalg.eigvals(terms[0].real) * speed
        return _sorted([*own.tolist(), *([complex(self._neutral_rate)] * self.neutral)])

    def multipliers(self, speed: float) -> tuple[complex, ...]:
        """Floquet multipliers of one revolution, the largest first, on any support.

        Those of half a turn, squared: A repeats with it. Raises NotTrustworthyError when the integration fails.
        """
        terms, rate = self.harmonics(speed), self._neutral_rate
        orders = 2j * np.arange(len(terms))[:, None, None]
        half = transition(lambda phase: (terms * np.exp(orders * phase)).sum(axis=0).real, math.pi)
        revolution = 2 * math.pi / speed
        own = np.linalg.eigvals(half) ** 2
        found = [*own.tolist(), *([complex(math.exp(rate * revolution))] * self.neutral)]
        return tuple(sorted(found, key=lambda value: (-abs(value), value.real, value.imag)))

    def growth(self, speed: float) -> float:
        """Growth rate of the slowest-dying disturbance [1/s]: the largest Re λ, or ln|μ|/T over a revolution T."""
        values = self.eigenvalues(speed)
        if values is not None:
            return max(value.real for value in values)
        return growth_of(self.multipliers(speed), speed)

    @property
    def _neutral_rate(self) -> float:
        return 0.0 - self.scene.race.drag / self.scene.race.inertia_factor


def growth_of(multipliers: tuple[complex, ...], speed: float) -> float:
    """ln|μ|/T of the largest multiplier over a revolution T [1/s]."""
    largest = max(abs(value) for value in multipliers)
    return math.log(largest) * speed / (2 * math.pi) if largest > 0 else -math.inf


def _sorted(values: list[complex]) -> tuple[complex, ...]:
    return tuple(sorted(values, key=lambda value: (-value.real, value.imag)))
