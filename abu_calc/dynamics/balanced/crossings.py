"""Eigenvalues that cross the edge of stability with the speed."""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Final

import numpy as np

from abu_calc.dynamics.balanced.arrangements import Arrangement
from abu_calc.dynamics.balanced.growth import MARGIN, worst
from abu_calc.dynamics.balanced.linearised import Array
from abu_calc.dynamics.balanced.search import searched
from abu_calc.dynamics.balanced.speeds import GRID, MANY, check_range, grid_of
from abu_calc.dynamics.balanced.stability import judged
from abu_calc.dynamics.balanced.two_modes import Motion, two_modes
from abu_calc.dynamics.scene import Scene
from abu_calc.frozen import dataclass

MOST_STATES: Final = 16
"""States for which all crossings can be solved for in a moment."""

REAL: Final = 1e-4
"""A solution for the speed whose imaginary part is a smaller share than this may be one of a close pair."""

SHIFT: Final = -math.sqrt(0.5)
"""s, in units of the speed at which the machine is looked at: no speed that is asked for, nor likely a solution."""

REGULAR: Final = 1e12
"""Condition of a polynomial's matrix at s, below which it can be inverted."""

NARROW: Final = 1e-9
"""Relative; speeds as near as this are one."""


@dataclass(frozen=True)
class Crossing:
    """A speed [rad/s] at which eigenvalues or multipliers cross the edge of stability; how many grow on either side."""

    speed: float
    growing_below: int
    growing_above: int


def crossings_of(
    scene: Scene, low: float, high: float, half_angle: float = 0.0, arrangement: Arrangement = "worst"
) -> tuple[Crossing, ...]:
    """Every speed between at which the number of growing ones changes, of the arrangement that is worst at the scene's.

    Isotropic support: all of them; elsewhere those between neighbours of a grid that differ. None where the axis
    moves or nothing rests. Raises as `boundaries`.
    """
    check_range(low, high)
    motions = judged(scene, half_angle, arrangement)[1]
    if not motions or motions[0].motion:
        return ()
    least_stable, search = worst(motions, scene.speed), searched(motions, half_angle)
    if search:
        least_stable = worst((least_stable, search.worst(scene.speed)), scene.speed)
    motion: Motion = two_modes(least_stable) or least_stable

    def growing(speed: float) -> int:
        return motion.growing(speed, MARGIN * speed)

    exact = solvable(motion)
    candidates = between(crossings(motion), low, high) if exact else grid_of(scene, low, high, GRID, MANY)
    points = [(speed, growing(speed)) for speed in candidates]
    return tuple(crossing for a, b in pairwise(points) for crossing in _halved(growing, a, b))


def _halved(growing: Callable[[float], int], low: tuple[float, int], high: tuple[float, int]) -> Iterator[Crossing]:
    """Every change of a number between two speeds where it differs."""
    if low[1] == high[1]:
        return
    if high[0] - low[0] <= NARROW * high[0]:
        yield Crossing(high[0], low[1], high[1])
        return
    speed = (low[0] + high[0]) / 2
    middle = speed, growing(speed)
    yield from _halved(growing, low, middle)
    yield from _halved(growing, middle, high)


def solvable(motion: Motion) -> bool:
    """True if all crossings can be solved for in a moment."""
    return motion.isotropic and motion.states <= MOST_STATES


def crossings(motion: Motion) -> list[float]:
    """Speeds [rad/s] at which an eigenvalue may cross the imaginary axis, on an isotropic support; ascending.

    Two eigenvalues then add up to zero, or one is zero: the bialternate product 2A ⊙ I, whose eigenvalues are λ_i + λ_j
    (Fuller 1968), or A is singular. A = L₀ + L₁Ω + L₂Ω², so each is an eigenvalue problem for Ω. Between its solutions
    stability cannot change; most of them change nothing.
    """
    parts = motion.polynomial()
    roots = [*_singular(parts), *_singular(np.array([_bialternate(part) for part in parts]))]
    return sorted(x * motion.unit for x in roots)


def _bialternate(A: Array) -> Array:
    """2A ⊙ I: A ⊗ I + I ⊗ A on the antisymmetric products of two states."""
    size = len(A)
    rows, columns = np.triu_indices(size, 1)
    unit = np.eye(size)
    product = np.kron(A, unit) + np.kron(unit, A)
    picked = product[rows * size + columns]
    return np.asarray(picked[:, rows * size + columns] - picked[:, columns * size + rows], dtype=float)


def _singular(parts: Array) -> list[float]:
    """Positive x at which P₀ + P₁x + P₂x² is singular, or all but.

    With x = s + 1/z they are eigenvalues z of a single matrix, 0 for an infinite x. A pair of matrices, as SciPy takes
    it, is for polynomials that are singular everywhere.
    """
    first, second, third = parts
    zero, unit = np.zeros_like(first), np.eye(len(first))
    there = first + second * SHIFT + third * SHIFT**2
    if np.linalg.cond(there) < REGULAR:
        lower = -np.linalg.solve(there, np.hstack([third, second + 2 * SHIFT * third]))
        inverse = np.linalg.eigvals(np.vstack([np.hstack([zero, unit]), lower]))
        values = SHIFT + 1 / inverse[inverse != 0]
    else:
        from scipy.linalg import eigvals  # here, since its import takes longer than most answers

        values = eigvals(np.block([[zero, unit], [-first, -second]]), np.block([[unit, zero], [zero, third]]))
    finite = values[np.isfinite(values)]
    return [float(x.real) for x in finite if x.real > 0 and abs(x.imag) <= REAL * x.real]


def between(speeds: Sequence[float], low: float, high: float) -> list[float]:
    """The ends, and a speed between any two neighbours of `speeds` inside."""
    inside = [low, *(speed for speed in speeds if low < speed < high), high]
    return [low, *((a + b) / 2 for a, b in pairwise(inside)), high]
