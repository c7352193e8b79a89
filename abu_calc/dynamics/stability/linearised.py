"""Small motions about balls at rest in their races, on any support.

z' = A(Ωt) z, z = (q, q', θ, θ') about balls at rest in the rotor. Derivatives are those of `equations`, without the
effects of the scene. States are measured in the scales of the equations and time in 1/Ω, so that numbers of all
machines are alike.

Linear supports are seen from the rotor: their coordinates are taken in pairs along x and y, in the order in which they
stand, and turned with it. On an isotropic support A is constant then, which is how one is known; on any other it
repeats with every half turn. Pairs that do not belong together cost time, not truth: any such turning is a change of
coordinates. Supports with an odd number of coordinates, and those that turn with the rotor, stay as they are.
"""

import math
from dataclasses import replace
from functools import cached_property
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import Equations, assemble, jacobians
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability import floquet
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def span_of(rows: Array, least: float) -> Array:
    """Orthonormal columns that span the rows of a matrix; less than a share `least` of it is none."""
    if 0 in rows.shape:
        return np.zeros((rows.shape[1], 0))
    _, sizes, directions = np.linalg.svd(rows)
    return np.asarray(directions[: int((sizes > least * np.abs(rows).sum()).sum())].T, dtype=float)


def diagonal(*blocks: Array) -> Array:
    """A matrix of blocks along its diagonal."""
    total = np.zeros((sum(len(block) for block in blocks), sum(block.shape[1] for block in blocks)))
    row = column = 0
    for block in blocks:
        total[row : row + len(block), column : column + block.shape[1]] = block
        row, column = row + len(block), column + block.shape[1]
    return total


QUARTER: Final = np.array([[0.0, -1.0], [1.0, 0.0]])
"""A quarter turn, from x to y."""

NOTHING: Final = 1e-12
"""Relative; a harmonic of A smaller than this is rounding."""

SPAN: Final = 1e-9
"""Relative; balls nearer to one line than this are in one line."""

WIDE_SPAN: Final = 1e-2
"""The same where what brings them back is lost in rounding: it goes with the square."""

FIRST_PHASES, PHASES_ON_ARM, MOST_PHASES = 8, 32, 128
"""Phases of a turn at which A is taken first, on a swing arm, and at most. An arm has some eight harmonics."""

SPEEDS: Final = (0.5, 1.0, 2.0)
"""Shares of the working speed at which A is taken: it is a polynomial of the second degree in the speed."""


@dataclass(frozen=True)
class BalancedMotion:
    """The linear motion about balls at rest at `angles` [rad]; `motion`: of the support, as in `resting.Rest`.

    At any speed where the axis is still, else at that of the scene. Directions in which balls move without changing the
    sums that hold them are split off: neutral, they do not count.
    """

    scene: Scene
    angles: tuple[float, ...]
    motion: tuple[complex, ...] = ()
    span: float = SPAN

    @property
    def on_one_line(self) -> Self:
        """Motion with balls that are almost in one line treated as if they were; itself if there are none.

        The same motion is returned if the balls are all in one place: along the line they then leave the
        balance, and nothing of the first order brings them back.
        """
        wider = replace(self, span=WIDE_SPAN)
        return self if self.in_one_place or wider.states == self.states else wider

    @property
    def in_one_place(self) -> bool:
        """True if the balls of a race with several balls carry all they can."""
        for race, own in self.scene.by_race(self.angles):
            masses = np.array(race.ball_masses)
            if len(masses) > 1 and abs(masses @ np.exp(1j * np.array(own))) > (1 - WIDE_SPAN**2) * masses.sum():
                return True
        return False

    @cached_property
    def coupled(self) -> tuple[Array, ...]:
        """Columns for each race: motions of its balls that are coupled to the support.

        Motions are free if they leave Σ m e^{iθ} as it is, and Σ m too if the support turns: each has the rates
        0 and −h₀/J. If the axis moves, no motion counts as free: balls then also move along the spindle, each
        from its own place.
        """
        bases = []
        for race, own in self.scene.by_race(self.angles):
            masses, theta = np.array(race.ball_masses), np.array(own)
            rows = [-masses * np.sin(theta), masses * np.cos(theta), *([masses] if self.on_arm else [])]
            bases.append(np.eye(len(masses)) if self.motion else span_of(np.array(rows), self.span))
        return tuple(bases)

    @cached_property
    def basis(self) -> Array:
        """Coupled motions of all races."""
        return diagonal(*self.coupled)

    @cached_property
    def held(self) -> Array:
        """Columns in terms of the basis: places of the balls that the support feels. The others are neutral."""
        static_moments, theta = np.array(self.scene.static_moments), np.array(self.angles)
        places = np.array([race.plane_offset for race in self.scene.races for _ in race.ball_masses])
        shares = places / (np.abs(places).max(initial=0.0) or 1.0)
        x, y = -static_moments * np.sin(theta), static_moments * np.cos(theta)
        return span_of(np.array((x, y, shares * x, shares * y)) @ self.basis, self.span)

    @cached_property
    def scales(self) -> Array:
        """Units of the states: those of the working speed at every speed, so that A stays a polynomial of it."""
        return np.array(assemble(self._plain).scales)

    @property
    def neutral(self) -> int:
        """Number of neutral directions of the balls: n − 2 of the n of a race, unless they are in one line."""
        return len(self.angles) - int(self.held.shape[1])

    @property
    def states(self) -> int:
        """Number of states of A."""
        return 2 * self._size + int(self.held.shape[1]) + int(self.basis.shape[1])

    @property
    def isotropic(self) -> bool:
        """True if A is constant, seen from the rotor."""
        return len(self._own) == 1

    def polynomial(self) -> Array:
        """L₀, L₁, L₂ of A = (L₀ + L₁x + L₂x²)/x on an isotropic support, x the speed over that of the scene."""
        return np.asarray(self._parts[:, 0].real, dtype=float)

    def harmonics(self, speed: float) -> Complex:
        """c_k of A(φ) = Re Σ c_k e^{ikφ}, φ = Ωt: c_0 alone on an isotropic support."""
        if self.motion or speed == self.scene.speed:
            return self._own
        x = speed / self.scene.speed
        return np.asarray(np.tensordot((1 / x, 1.0, x), self._parts, axes=1), dtype=complex)

    def eigenvalues(self, speed: float) -> tuple[complex, ...] | None:
        """Eigenvalues [1/s] on an isotropic support, the largest real part first; None on any other."""
        if not self.isotropic:
            return None
        own = np.linalg.eigvals(self.harmonics(speed)[0].real) * speed
        return tuple(sorted([*own.tolist(), *map(complex, self._free)], key=lambda value: (-value.real, value.imag)))

    def multipliers(self, speed: float) -> tuple[complex, ...]:
        """Floquet multipliers of one revolution, the largest first, on any support.

        On a linear support those of half a turn, squared: seen half a turn later, it is the same upside down. Raises
        NotTrustworthyError when they do not settle.
        """
        terms = self.harmonics(speed)
        parts, orders = np.concatenate([terms.real, -terms.imag[1:]]), np.arange(len(terms))

        def matrices(phases: Array) -> Array:
            """A of z' = A z [1/rad] at phases of the turn [rad], stacked."""
            turned = phases[:, None] * orders
            waves = np.concatenate([np.cos(turned), np.sin(turned[:, 1:])], axis=1)
            return np.asarray(np.einsum("tk,kij->tij", waves, parts), dtype=float)

        turns = 1 if self.on_arm else 2
        own = floquet.multipliers(matrices, 2 * math.pi / turns, self._half_turn) ** turns
        free = [complex(math.exp(rate * 2 * math.pi / speed)) for rate in self._free]
        return tuple(sorted([*own.tolist(), *free], key=lambda value: (-abs(value), value.real, value.imag)))

    def growth(self, speed: float) -> float:
        """Growth rate of the slowest-dying disturbance [1/s]: the largest Re λ, or ln|μ|/T over a revolution T."""
        values = self.eigenvalues(speed)
        if values is not None:
            return max((value.real for value in values), default=-math.inf)
        return growth_of(self.multipliers(speed), speed)

    def growing(self, speed: float, least: float) -> int:
        """Number of eigenvalues or multipliers that grow by more than `least` [1/s]."""
        values = self.eigenvalues(speed)
        if values is not None:
            return sum(value.real > least for value in values)
        return sum(growth_of((value,), speed) > least for value in self.multipliers(speed))

    @property
    def unit(self) -> float:
        """The speed [rad/s] that those of `polynomial` are measured in."""
        return self.scene.speed

    @property
    def _free(self) -> list[float]:
        """−h₀/J [1/s] of each motion of balls that is free of the support."""
        return [
            0.0 - race.drag / race.inertia_factor
            for race, columns in zip(self.scene.races, self.coupled, strict=True)
            for _ in range(columns.shape[0] - columns.shape[1])
        ]

    @property
    def _size(self) -> int:
        return len(self.scene.support.names)

    @property
    def on_arm(self) -> bool:
        """True if the support turns with the rotor's axis, as a swing arm does."""
        return self.scene.support.turns

    @property
    def _turned(self) -> bool:
        """True if the support is seen from the rotor."""
        return not self.on_arm and self._size % 2 == 0

    @property
    def _half_turn(self) -> Array:
        """Signs of the states after half a turn, as a diagonal matrix.

        States of the support stand upside down (−1), unless it turns with the rotor.
        """
        signs = np.ones(self.states)
        if not self.on_arm and not self._turned:
            signs[: 2 * self._size] = -1
        return np.diag(signs)

    @cached_property
    def _plain(self) -> Scene:
        """The scene without effects, and without a constant force of the support, which only moves where it stands."""
        return replace(self.scene, effects=(), support=self.scene.support.without_steady_force())

    @cached_property
    def _own(self) -> Complex:
        """[harmonic, row, column] of A times the speed at the scene's own."""
        (harmonics,) = self._resolved((1.0,))
        return np.asarray(harmonics, dtype=complex)

    @cached_property
    def _parts(self) -> Complex:
        """[degree, harmonic, row, column] of A times the speed; where the axis moves, of A at its one speed."""
        if self.motion:
            return self._own[None]
        return np.asarray(np.tensordot(_inverse_powers(), self._resolved(SPEEDS), axes=1), dtype=complex)

    def _resolved(self, speeds: tuple[float, ...]) -> Complex:
        """[speed, harmonic, row, column], of as many phases as its harmonics need."""
        count = PHASES_ON_ARM if self.on_arm else FIRST_PHASES
        while True:
            terms = np.array([self._terms(x, count) for x in speeds])
            sizes = np.abs(terms).max(axis=(0, 2, 3), initial=0.0)
            present = np.flatnonzero(sizes > NOTHING * sizes[0])
            last = int(present[-1]) if len(present) else 0
            if last < count // 2 - 1:
                return np.asarray(terms[:, : last + 1], dtype=complex)
            if count == MOST_PHASES:
                raise NotTrustworthyError("the linear motion about the balanced state turns too sharply to be judged")
            count *= 2

    def _terms(self, x: float, count: int) -> Complex:
        """Harmonics of A at one speed from so many phases, found once."""
        if (x, count) not in self._known:
            terms = np.fft.rfft(self._sampled(x, count), axis=0) / count
            terms[1:] *= 2
            self._known[x, count] = np.asarray(terms, dtype=complex)
        return self._known[x, count]

    @cached_property
    def _known(self) -> dict[tuple[float, int], Complex]:
        return {}

    def _sampled(self, x: float, count: int) -> Array:
        """A at equally spaced phases of a turn, at x times the working speed; times x where A is a polynomial."""
        speed = x * self.scene.speed
        scene = replace(self._plain, speed=speed, duration=4 * math.pi / speed)
        equations, phases = assemble(scene), 2 * math.pi * np.arange(count) / count
        return x * self._matrices(equations, phases)

    def _matrices(self, equations: Equations, phases: Array) -> Array:
        """A at these phases: B⁻¹ (∂rhs B − B'), y = B z with q = R(φ) q_r; divided by Ω, in units of the scales."""
        speed, size = equations.scene.speed, self._size
        amplitudes = np.array(self.motion or (0.0,) * size) * np.exp(1j * phases)[:, None]
        moving = np.concatenate([amplitudes, 1j * speed * amplitudes], axis=1).real
        resting = np.tile([*self.angles, *(0.0 for _ in self.angles)], (len(phases), 1))
        matrices = jacobians(equations, phases / speed, np.concatenate([moving, resting], axis=1))
        if self._turned:
            pairs, c, s = np.eye(size // 2), np.cos(phases), np.sin(phases)
            turn = np.kron(pairs, np.array([[c, -s], [s, c]]).transpose(2, 0, 1))
            spin = speed * np.kron(pairs, QUARTER)
            B, spun = np.tile(np.eye(matrices.shape[1]), (len(phases), 1, 1)), np.zeros(matrices.shape[1:])
            B[:, :size, :size] = B[:, size : 2 * size, size : 2 * size] = turn
            B[:, size : 2 * size, :size] = spin @ turn
            spun[:size, :size] = spun[size : 2 * size, size : 2 * size] = spin
            matrices = np.asarray(np.linalg.solve(B, matrices @ B - spun @ B), dtype=float)
        scaled = matrices * self.scales / self.scales[:, None] / speed
        counted = diagonal(np.eye(2 * size), self.basis @ self.held, self.basis)
        return np.asarray(counted.T @ scaled @ counted, dtype=float)


def growth_of(multipliers: tuple[complex, ...], speed: float) -> float:
    """ln|μ|/T of the largest multiplier over a revolution T [1/s]."""
    largest = max((abs(value) for value in multipliers), default=0.0)
    return math.log(largest) * speed / (2 * math.pi) if largest > 0 else -math.inf


def _inverse_powers() -> Array:
    """Matrix from values at SPEEDS to the coefficients of 1, x, x²."""
    return np.asarray(np.linalg.inv(np.vander(SPEEDS, increasing=True)), dtype=float)
