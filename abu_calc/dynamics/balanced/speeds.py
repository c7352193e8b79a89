"""Growth rates over a range of speeds, and the speeds at which they change sign."""

import math
from collections.abc import Callable, Sequence
from itertools import combinations, pairwise
from typing import Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.roots import root
from abu_calc.validity import Range

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
