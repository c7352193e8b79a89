"""Stability boundaries: speeds at which the balanced state of a scene gains or loses its stability.

Growth rates are computed over a range of speeds. A boundary is a speed at which the rate changes sign, or at which an
eigenvalue or multiplier crosses the edge of stability.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, pairwise
from typing import Annotated, Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.family import Arrangement
from abu_calc.dynamics.stability.linearised import Array, BalancedMotion
from abu_calc.dynamics.stability.resting import still_axis
from abu_calc.dynamics.stability.two_modes import LinearMotion, two_modes
from abu_calc.dynamics.stability.verdict import MARGIN, Search, at_speed, decided, judged, searched, worst
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.roots import root
from abu_calc.foundation.validity import Range

GRID, COARSE = 64, 16
"""Intervals of the first grid of speeds where a grid is needed, and where that must not take long."""

FEW, MANY = 2, 12
"""Natural frequencies up to which the speeds between any two of them are looked at, likewise."""

DEEPEST, BEND = 6, 0.1
"""Most halvings of an interval, and the permitted bend of the growth rate.

The bend is its distance from a straight line, as a share of its distance from zero.
"""

MOST_SPEEDS: Final = 500
"""Speeds at which the growth rate is looked at before no interval is halved any more."""

FINE, ROUGH = 1e-13, 1e-6
"""Relative precision of zeros, and that of a quick search."""

Points = list[tuple[float, float]]


def check_range(low: float, high: float) -> None:
    """Raises RangeError for one that is none."""
    Range("lowest speed", 0.0, unit="rad/s", open_low=True).check(low)
    Range("highest speed", low, 1e9, "rad/s", open_low=True).check(high)


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


def refined(function: Callable[[float], float], grid: Sequence[float]) -> Points:
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
    """Turning points of a function that turns back before zero."""
    from scipy.optimize import minimize_scalar

    extremes = []
    for (low, before), (_, value), (high, after) in zip(points, points[1:], points[2:], strict=False):
        sign = math.copysign(1.0, value)
        if 0 < sign * value <= min(sign * before, sign * after):
            done = minimize_scalar(
                lambda x, sign=sign: sign * function(x), bounds=(low, high), method="bounded", options={"maxiter": 25}
            )
            extremes.append((float(done.x), function(float(done.x))))
    return extremes


def changes(function: Callable[[float], float], points: Points, near: float = FINE) -> list[tuple[float, bool]]:
    """Zeros of the function between points of opposite sign, to `near` (relative), and whether it is negative after."""
    return [
        (root(function, low, high, xtol=near * high, rtol=near), after < 0)
        for (low, before), (high, after) in pairwise(points)
        if (before < 0) != (after < 0)
    ]


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


@record
class Crossing(Record):
    """A speed at which eigenvalues or multipliers cross the edge of stability."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    growing_below: Annotated[int, Quantity("growing below it")]
    growing_above: Annotated[int, Quantity("growing above it")]


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
    motion: LinearMotion = two_modes(least_stable) or least_stable

    def growing(speed: float) -> int:
        """Number of disturbances that grow by more than a margin at a speed [rad/s]."""
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
        yield Crossing(speed=high[0], growing_below=low[1], growing_above=high[1])
        return
    speed = (low[0] + high[0]) / 2
    middle = speed, growing(speed)
    yield from _halved(growing, low, middle)
    yield from _halved(growing, middle, high)


def solvable(motion: LinearMotion) -> bool:
    """True if all crossings can be solved for in a moment."""
    return motion.isotropic and motion.states <= MOST_STATES


def crossings(motion: LinearMotion) -> list[float]:
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


ROUNDS: Final = 6
"""Most rounds in which arrangements that are worse at a boundary are added."""


@record
class StabilityBoundary(Record):
    """A speed at which the balanced state gains or loses its stability."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    stable_above: Annotated[bool, Quantity("stable above it")]


def boundaries(
    scene: Scene, low: float, high: float, half_angle: float = 0.0, arrangement: Arrangement = "worst",
    *, coarse: bool = False,
) -> tuple[StabilityBoundary, ...]:  # fmt: skip
    """Every speed from `low` to `high` [rad/s] at which the balanced state of a scene gains or loses its stability.

    Isotropic support, axis still, up to 16 states: all of them, see `crossings`. Elsewhere the changes of sign of the
    growth rate on a grid that is refined where the rate bends, comes near zero or turns back before it, at up to some
    five hundred speeds; `coarse`: at some twenty, not refined. Without a state of rest at a speed nothing is stable
    there. `arrangement`: "worst" asks for all of them to be stable, see `arrangements.rests`; on an anisotropic
    support and a swing arm those that `Search` finds worse at some twenty speeds and at each boundary are added.
    Raises NotKnownError where `stability` knows no answer.
    """
    check_range(low, high)
    excess, still, search = _excess_of_scene(scene, half_angle, arrangement)
    if still:
        return limits_of_all(still, search, scene, low, high, coarse=coarse)[1]
    return () if excess is None else _on_grid(excess, scene, low, high, coarse=coarse)


def growth_over(
    scene: Scene, speeds: Sequence[float], half_angle: float = 0.0, arrangement: Arrangement = "worst"
) -> tuple[tuple[float, float], ...]:
    """The growth rate [1/s] of the slowest-dying disturbance at each of these speeds [rad/s] at which there is a state
    of rest, of the arrangement that is worst there; none where `boundaries` looks for none. Raises as that does.

    Several races, or a support that tilts: of those listed and of the one that is worst at the scene's speed.
    """
    excess, still, search = _excess_of_scene(scene, half_angle, arrangement)
    if excess is None:
        return ()
    if search and search.in_plane:
        return tuple((speed, search.growth(speed)) for speed in speeds)
    rates = ((speed, (excess(speed) - MARGIN) * speed) for speed in speeds)
    nowhere = 1.0 - MARGIN
    return tuple(point for point in rates if still or point[1] != nowhere * point[0])


def _excess_of_scene(
    scene: Scene, half_angle: float, arrangement: Arrangement
) -> tuple[Callable[[float], float] | None, tuple[LinearMotion, ...], Search | None]:
    """Function of a speed: the largest growth rate per radian beyond the margin that counts as none.

    Returned with it: the motions about a still axis, and a search for worse ones. At a speed without a
    state of rest the function is 1. None, without motions, if there is nothing to search for.
    """
    state, motions = judged(scene, half_angle, arrangement)
    if state == "arm alone" and scene.ball_masses:
        return None, (), None
    moves = bool(motions[0].motion) if motions else bool(scene.ball_masses) and not still_axis(scene)
    if not motions and not moves:
        return None, (), None
    if moves:

        def excess(speed: float) -> float:
            """The same about the rest that belongs to this speed."""
            there = judged(at_speed(scene, speed), half_angle, arrangement)[1]
            return excess_of(there, speed) if there else 1.0

        return excess, (), None
    still, search = quick(motions), searched(motions, half_angle)
    if search and not search.in_plane:
        still = search.added(still, (scene.speed,))
    return lambda speed: excess_of(still, speed), still, search


def limits_of_all(
    motions: tuple[LinearMotion, ...],
    search: Search | None,
    scene: Scene,
    low: float,
    high: float,
    *,
    coarse: bool = False,
) -> tuple[tuple[LinearMotion, ...], tuple[StabilityBoundary, ...]]:
    """Motions that decide where all arrangements are stable, and every speed at which that changes.

    Added to those given: some that grow where these do not, by a grid of speeds unless `coarse`, then the worst at each
    boundary until none is worse. Range: an arrangement that grows only between these speeds is missed.
    """
    if search is None:
        return motions, limits_of(motions, scene, low, high, coarse=coarse)
    if not coarse:
        motions = search.screened(motions, grid_of(scene, low, high, COARSE, FEW))
    for _ in range(ROUNDS):
        limits = limits_of(motions, scene, low, high, coarse=coarse)
        worse = search.added(motions, (limit.speed for limit in limits))
        if worse == motions:
            break
        motions = worse
    return motions, limits


def limits_of(
    motions: Sequence[LinearMotion], scene: Scene, low: float, high: float, *, coarse: bool = False
) -> tuple[StabilityBoundary, ...]:
    """The same of motions about a still axis that must all be stable."""

    def excess(speed: float) -> float:
        """The largest growth rate per radian beyond the margin, at a speed [rad/s]."""
        return excess_of(motions, speed)

    if all(solvable(motion) for motion in motions):
        speeds = sorted(speed for motion in motions for speed in crossings(motion))
        return _found(changes(excess, [(speed, excess(speed)) for speed in between(speeds, low, high)]))
    return _on_grid(excess, scene, low, high, coarse=coarse)


def _on_grid(
    excess: Callable[[float], float], scene: Scene, low: float, high: float, *, coarse: bool
) -> tuple[StabilityBoundary, ...]:
    if coarse:
        points = [(speed, excess(speed)) for speed in grid_of(scene, low, high, COARSE, FEW)]
        return _found(changes(excess, points, ROUGH))
    return _found(changes(excess, refined(excess, grid_of(scene, low, high, GRID, MANY))))


def _found(zeros: Sequence[tuple[float, bool]]) -> tuple[StabilityBoundary, ...]:
    return tuple(StabilityBoundary(speed=speed, stable_above=below_zero) for speed, below_zero in zeros)


def quick(motions: Sequence[BalancedMotion]) -> tuple[LinearMotion, ...]:
    """The same motions by their two modes where these are all; of many on an anisotropic support, the first, the most
    even and the least even ones."""
    reduced = tuple(two_modes(motion) or motion for motion in motions)
    isotropic = all(motion.isotropic for motion in reduced)
    return reduced if isotropic or len(reduced) <= 3 else (reduced[0], reduced[1], reduced[-1])


def excess_of(motions: Sequence[LinearMotion], speed: float) -> float:
    """The largest growth rate per radian, beyond what is taken for none."""
    return max(decided(motion, speed)[1] for motion in motions) / speed + MARGIN
