"""Stability of the balanced state: balls at rest in the race, opposite the imbalance, the axis still.

Sources: Green, Champneys & Lieven 2006 and Rodrigues, Champneys, Friswell & Wilson 2008, for two balls on an isotropic
support. Printed: Kladiev 1996, (7), asks only for a speed above the natural frequency; that does not suffice.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from abu_calc.dynamics.linearised import Array, BalancedMotion, growth_of
from abu_calc.dynamics.resting import resting_angles
from abu_calc.dynamics.scene import Scene
from abu_calc.validity import Range

MARGIN: Final = 1e-9
"""Growth per radian of rotation that is taken for none: below, rounding decides."""

GRID, DEEPEST, BEND = 64, 6, 0.1
"""Intervals of the first grid of speeds on an anisotropic support, how often one may be halved, and the share of its
distance from zero by which the growth rate may leave a straight line."""

REAL: Final = 1e-4
"""A solution for the speed whose imaginary part is a smaller share than this may be one of a close pair."""

Points = list[tuple[float, float]]


@dataclass(frozen=True)
class Stability:
    """The balanced state at one speed; rates in 1/s, angles in rad.

    `angles` None: the balls cannot balance, and nothing else is known. `eigenvalues` on an isotropic support,
    `multipliers` of one revolution on any other. Directions in which balls move without changing their sum (n − 2 of
    n) are neutral and do not count.
    """

    speed: float
    angles: tuple[float, ...] | None
    eigenvalues: tuple[complex, ...] | None
    multipliers: tuple[complex, ...] | None
    growth_rate: float | None
    stable: bool


@dataclass(frozen=True)
class Boundary:
    """A speed [rad/s] at which the balanced state gains or loses its stability."""

    speed: float
    stable_above: bool


def stability(scene: Scene, half_angle: float = 0.0) -> Stability:
    """Whether every disturbance of the balanced state of a scene dies out, at its speed.

    Growth rate: the largest Re λ, or ln|μ|/T over a revolution T [1/s]; stable below −1e-9·Ω. `half_angle` [rad] of
    touching balls, 0 for balls without size.
    Range: constant speed, linear support, no dry friction. Raises NotTrustworthyError when multipliers do not settle.
    """
    angles = resting_angles(scene, half_angle)
    if angles is None:
        return Stability(scene.speed, None, None, None, None, False)
    motion = BalancedMotion(scene, angles)
    eigenvalues = motion.eigenvalues(scene.speed)
    multipliers = motion.multipliers(scene.speed) if eigenvalues is None else None
    growth = growth_of(multipliers, scene.speed) if multipliers else motion.growth(scene.speed)
    return Stability(scene.speed, angles, eigenvalues, multipliers, growth, growth < -MARGIN * scene.speed)


def boundaries(scene: Scene, low: float, high: float, half_angle: float = 0.0) -> tuple[Boundary, ...]:
    """Every speed from `low` to `high` [rad/s] at which the balanced state of a scene gains or loses its stability.

    Isotropic support: all of them, see `crossings`. Anisotropic support: the changes of sign of the growth rate on a
    grid that is refined where the rate bends, comes near zero or turns back before it.
    """
    Range("lowest speed", 0.0, unit="rad/s", open_low=True).check(low)
    Range("highest speed", low, 1e9, "rad/s", open_low=True).check(high)
    angles = resting_angles(scene, half_angle)
    if angles is None:
        return ()
    motion = BalancedMotion(scene, angles)

    def excess(speed: float) -> float:
        """The growth rate per radian, beyond what is taken for none."""
        return motion.growth(speed) / speed + MARGIN

    if motion.eigenvalues(scene.speed) is None:
        points = _refined(excess, _first_grid(motion, low, high))
    else:
        points = [(speed, excess(speed)) for speed in _between(crossings(motion), low, high)]
    return tuple(_changes(excess, points))


def crossings(motion: BalancedMotion) -> list[float]:
    """Speeds [rad/s] at which an eigenvalue may cross the imaginary axis, on an isotropic support; ascending.

    Two eigenvalues then add up to zero, or one is zero: the bialternate product 2A ⊙ I, whose eigenvalues are λ_i + λ_j
    (Fuller 1968), or A is singular. A = L₀ + L₁Ω + L₂Ω², so each is an eigenvalue problem for Ω. Between its solutions
    stability cannot change; most of them change nothing.
    """
    reference = motion.scene.speed
    at = (0.5, 1.0, 2.0)
    matrices = np.array([motion.harmonics(x * reference)[0].real * x for x in at])
    parts = np.tensordot(np.linalg.inv(np.vander(at, increasing=True)), matrices, axes=1)
    found = [*_singular(parts), *_singular(np.array([_bialternate(part) for part in parts]))]
    return sorted(x * reference for x in found)


def _bialternate(A: Array) -> Array:
    """2A ⊙ I: A ⊗ I + I ⊗ A on the antisymmetric products of two states."""
    size = len(A)
    rows, columns = np.triu_indices(size, 1)
    unit = np.eye(size)
    product = np.kron(A, unit) + np.kron(unit, A)
    picked = product[rows * size + columns]
    return np.asarray(picked[:, rows * size + columns] - picked[:, columns * size + rows], dtype=float)


def _singular(parts: Array) -> list[float]:
    """Positive x at which P₀ + P₁x + P₂x² is singular, or all but."""
    from scipy.linalg import eigvals

    zero, unit = np.zeros_like(parts[0]), np.eye(len(parts[0]))
    values = eigvals(np.block([[zero, unit], [-parts[0], -parts[1]]]), np.block([[unit, zero], [zero, parts[2]]]))
    finite = values[np.isfinite(values)]
    return [float(x.real) for x in finite if x.real > 0 and abs(x.imag) <= REAL * x.real]


def _between(speeds: Sequence[float], low: float, high: float) -> list[float]:
    """The ends, and a speed between any two neighbours of `speeds` inside."""
    inside = [low, *(speed for speed in speeds if low < speed < high), high]
    return [low, *((a + b) / 2 for a, b in pairwise(inside)), high]


def _first_grid(motion: BalancedMotion, low: float, high: float) -> list[float]:
    """Evenly spaced in ratio, with the natural frequencies and the speeds half-way between them among them."""
    support, race = motion.scene.support, motion.scene.race
    P = np.array(support.race_map)
    mass = np.array(support.mass) + sum(race.ball_masses) * P.T @ P
    squares = np.linalg.eigvals(np.linalg.solve(mass, np.array(support.stiffness))).real
    natural = np.sqrt(np.maximum(squares, 0.0))
    means = [f(pair) for pair in ((a, b) for a in natural for b in natural) for f in (_mean, _root_mean_square)]
    places = [place * factor for place in means for factor in (0.99, 1.0, 1.01) if low < place * factor < high]
    return sorted({*np.geomspace(low, high, GRID + 1).tolist(), low, high, *map(float, places)})


def _mean(pair: tuple[float, float]) -> float:
    return sum(pair) / 2


def _root_mean_square(pair: tuple[float, float]) -> float:
    return math.hypot(*pair) / math.sqrt(2)


def _refined(function: Callable[[float], float], grid: Sequence[float]) -> Points:
    """The function on the grid, halved where it bends or comes near zero, and at extremes towards zero."""
    points = [(x, function(x)) for x in grid]
    for a, b in pairwise(list(points)):
        points += _halved(function, a, b, DEEPEST)
    points.sort()
    return sorted([*points, *_extremes(function, points)])


def _halved(function: Callable[[float], float], a: tuple[float, float], b: tuple[float, float], depth: int) -> Points:
    """Points between two: none where the function is straight, seen from its distance to zero."""
    x = (a[0] + b[0]) / 2
    middle = (x, function(x))
    nearest = min(abs(a[1]), abs(b[1]), abs(middle[1]))
    if depth == 0 or abs(middle[1] - (a[1] + b[1]) / 2) <= BEND * nearest:
        return [middle]
    return [*_halved(function, a, middle, depth - 1), middle, *_halved(function, middle, b, depth - 1)]


def _extremes(function: Callable[[float], float], points: Points) -> Points:
    """Where the function turns back before zero, it is followed to the turning point."""
    from scipy.optimize import minimize_scalar

    found = []
    for (low, before), (_, value), (high, after) in zip(points, points[1:], points[2:], strict=False):
        sign = math.copysign(1.0, value)
        if 0 < sign * value <= min(sign * before, sign * after):
            done = minimize_scalar(
                lambda x, sign=sign: sign * function(x), bounds=(low, high), method="bounded", options={"maxiter": 25}
            )
            found.append((float(done.x), function(float(done.x))))
    return found


def _changes(function: Callable[[float], float], points: Points) -> list[Boundary]:
    """Zeros of the function between points of opposite sign."""
    from scipy.optimize import brentq

    return [
        Boundary(float(brentq(function, low, high, xtol=1e-13 * high, rtol=1e-13)), stable_above=after < 0)
        for (low, before), (high, after) in pairwise(points)
        if (before < 0) != (after < 0)
    ]
