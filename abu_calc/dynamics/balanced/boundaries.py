"""Speeds at which the balanced state of a scene gains or loses its stability, and eigenvalues that cross on the way."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from typing import Final

import numpy as np

from abu_calc.dynamics.balanced.arrangements import Arrangement
from abu_calc.dynamics.balanced.linearised import Array, BalancedMotion
from abu_calc.dynamics.balanced.stability import MARGIN, decided, judged, worst
from abu_calc.dynamics.balanced.stationary import still_axis
from abu_calc.dynamics.balanced.two_modes import TwoModes, two_modes
from abu_calc.dynamics.scene import Scene
from abu_calc.validity import Range

GRID, COARSE = 64, 16
"""Intervals of the first grid of speeds where a grid is needed, and where that must not take long."""

FEW, MANY = 2, 12
"""Natural frequencies up to which the speeds between any two of them are looked at, likewise."""

DEEPEST, BEND = 6, 0.1
"""How often an interval may be halved, and the share of its distance from zero by which the growth rate may leave a
straight line."""

MOST_SPEEDS: Final = 500
"""Speeds at which the growth rate is looked at before no interval is halved any more."""

MOST_STATES: Final = 16
"""States for which all crossings can be solved for in a moment."""

REAL: Final = 1e-4
"""A solution for the speed whose imaginary part is a smaller share than this may be one of a close pair."""

FINE, ROUGH = 1e-13, 1e-6
"""How near zeros are found, and where that must not take long; relative."""

NARROW: Final = 1e-9
"""Relative; speeds as near as this are one."""

Points = list[tuple[float, float]]
Motion = BalancedMotion | TwoModes


@dataclass(frozen=True)
class Boundary:
    """A speed [rad/s] at which the balanced state gains or loses its stability."""

    speed: float
    stable_above: bool


def boundaries(
    scene: Scene, low: float, high: float, half_angle: float = 0.0, arrangement: Arrangement = "worst",
    *, coarse: bool = False,
) -> tuple[Boundary, ...]:  # fmt: skip
    """Every speed from `low` to `high` [rad/s] at which the balanced state of a scene gains or loses its stability.

    Isotropic support, axis still, up to 16 states: all of them, see `crossings`. Elsewhere the changes of sign of the
    growth rate on a grid that is refined where the rate bends, comes near zero or turns back before it, at up to some
    five hundred speeds; `coarse`: at some twenty, not refined. Without a state of rest at a speed nothing is stable
    there. `arrangement`: "worst" asks for all of them to be stable, see `arrangements.rests`. Raises NotKnownError
    where `stability` knows no answer.
    """
    _check_range(low, high)
    state, found = judged(scene, half_angle, arrangement)
    if state == "arm alone" and scene.ball_masses:
        return ()
    moves = bool(found[0].motion) if found else bool(scene.ball_masses) and not still_axis(scene)
    if not found and not moves:
        return ()
    if moves:

        def excess(speed: float) -> float:
            there = judged(at_speed(scene, speed), half_angle, arrangement)[1]
            return excess_of(there, speed) if there else 1.0

        return _on_grid(excess, scene, low, high, coarse=coarse)
    return limits_of(quick(found), scene, low, high, coarse=coarse)


def limits_of(
    motions: Sequence[Motion], scene: Scene, low: float, high: float, *, coarse: bool = False
) -> tuple[Boundary, ...]:
    """The same of motions about a still axis that must all be stable."""

    def excess(speed: float) -> float:
        return excess_of(motions, speed)

    if all(motion.isotropic and motion.states <= MOST_STATES for motion in motions):
        speeds = sorted(speed for motion in motions for speed in crossings(motion))
        return tuple(_changes(excess, [(speed, excess(speed)) for speed in _between(speeds, low, high)]))
    return _on_grid(excess, scene, low, high, coarse=coarse)


def _on_grid(
    excess: Callable[[float], float], scene: Scene, low: float, high: float, *, coarse: bool
) -> tuple[Boundary, ...]:
    if coarse:
        points = [(speed, excess(speed)) for speed in grid_of(scene, low, high, COARSE, FEW)]
        return tuple(_changes(excess, points, ROUGH))
    return tuple(_changes(excess, _refined(excess, grid_of(scene, low, high, GRID, MANY))))


def quick(motions: Sequence[BalancedMotion]) -> tuple[Motion, ...]:
    """The same motions by their two modes where these are all; of many on an anisotropic support, the first, the most
    even and the least even ones."""
    found = tuple(two_modes(motion) or motion for motion in motions)
    isotropic = all(motion.isotropic for motion in found)
    return found if isotropic or len(found) <= 3 else (found[0], found[1], found[-1])


def excess_of(motions: Sequence[Motion], speed: float) -> float:
    """The largest growth rate per radian, beyond what is taken for none."""
    return max(decided(motion, speed)[1] for motion in motions) / speed + MARGIN


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
    _check_range(low, high)
    found = judged(scene, half_angle, arrangement)[1]
    if not found or found[0].motion:
        return ()
    one = worst(found, scene.speed)
    motion: Motion = two_modes(one) or one

    def growing(speed: float) -> int:
        return motion.growing(speed, MARGIN * speed)

    if motion.isotropic and motion.states <= MOST_STATES:
        candidates = _between(crossings(motion), low, high)
    else:
        candidates = grid_of(scene, low, high, GRID, MANY)
    points = [(speed, growing(speed)) for speed in candidates]
    return tuple(one for a, b in pairwise(points) for one in _halved(growing, a, b))


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


def _check_range(low: float, high: float) -> None:
    Range("lowest speed", 0.0, unit="rad/s", open_low=True).check(low)
    Range("highest speed", low, 1e9, "rad/s", open_low=True).check(high)


def at_speed(scene: Scene, speed: float) -> Scene:
    """The scene at another speed, without effects."""
    return replace(scene, speed=speed, duration=4 * math.pi / speed, effects=())


def crossings(motion: Motion) -> list[float]:
    """Speeds [rad/s] at which an eigenvalue may cross the imaginary axis, on an isotropic support; ascending.

    Two eigenvalues then add up to zero, or one is zero: the bialternate product 2A ⊙ I, whose eigenvalues are λ_i + λ_j
    (Fuller 1968), or A is singular. A = L₀ + L₁Ω + L₂Ω², so each is an eigenvalue problem for Ω. Between its solutions
    stability cannot change; most of them change nothing.
    """
    parts = motion.polynomial()
    found = [*_singular(parts), *_singular(np.array([_bialternate(part) for part in parts]))]
    return sorted(x * motion.unit for x in found)


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


def grid_of(scene: Scene, low: float, high: float, intervals: int, most: int) -> list[float]:
    """Evenly spaced in ratio, and at resonances; of up to `most` of them beside and half-way between too."""
    natural = scene.support.resonances(scene.balls)
    places = natural
    if len(natural) <= most:
        places = [place * factor for place in natural for factor in (0.99, 1.0, 1.01)]
        places += [f(a, b) for a, b in combinations(natural, 2) for f in (_mean, _root_mean_square)]
    inside = (float(place) for place in places if low < place < high)
    return sorted({*np.geomspace(low, high, intervals + 1).tolist(), low, high, *inside})


def _mean(a: float, b: float) -> float:
    return (a + b) / 2


def _root_mean_square(a: float, b: float) -> float:
    return math.hypot(a, b) / math.sqrt(2)


def _refined(function: Callable[[float], float], grid: Sequence[float]) -> Points:
    """The function on the grid, halved where it bends or comes near zero, and at extremes towards zero."""
    points = [(x, function(x)) for x in grid]
    intervals = list(pairwise(points))
    for _ in range(DEEPEST + 1):
        bent = []
        for a, b in intervals[: max(0, MOST_SPEEDS - len(points))]:
            x = (a[0] + b[0]) / 2
            middle = (x, function(x))
            points.append(middle)
            nearest = min(abs(a[1]), abs(b[1]), abs(middle[1]))
            if abs(middle[1] - (a[1] + b[1]) / 2) > BEND * nearest:
                bent += [(a, middle), (middle, b)]
        intervals = bent
    points.sort()
    return sorted([*points, *_extremes(function, points)])


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


def _changes(function: Callable[[float], float], points: Points, near: float = FINE) -> list[Boundary]:
    """Zeros of the function between points of opposite sign, as near as that (relative)."""
    from scipy.optimize import brentq

    return [
        Boundary(float(brentq(function, low, high, xtol=near * high, rtol=near)), stable_above=after < 0)
        for (low, before), (high, after) in pairwise(points)
        if (before < 0) != (after < 0)
    ]
