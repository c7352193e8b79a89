"""Where balls can rest so that they balance, however many and however unequal they are."""

import math
from collections.abc import Callable
from itertools import accumulate, pairwise

from abu_calc.dynamics.scene import Scene

TOUCHING = 1e-9
"""Balls that overlap by less than this [rad] touch."""

SLACK = 1e-12
"""A polygon that lacks less than this share of its longest side is closed."""


def resting_angles(scene: Scene, half_angle: float = 0.0) -> tuple[float, ...] | None:
    """Angles θ [rad] in the rotor with m₀e e^{iφ} + Σ m R_p e^{iθ} = 0; None when there are none.

    One ball can only carry its own moment m R_p, two have one arrangement, of more n − 2 angles are free: the one given
    is that of sides of a polygon in a circle, so equal balls are spread evenly about the light side. `half_angle` β
    [rad]: touching neighbours are 2β apart, 0 for balls without size.

    Source: derived; for two balls Kladiev 1996, (4), with ε = 0.
    """
    moments = [mass * scene.race.pitch_radius for mass in scene.race.ball_masses]
    turns = _polygon([scene.imbalance, *moments])
    if turns is None or any(turn < 2 * half_angle - TOUCHING for turn in turns[1:-1]):
        return None
    angles = [scene.imbalance_angle + turn for turn in accumulate(turns[:-1])]
    return tuple(math.remainder(angle, 2 * math.pi) for angle in angles)


def _polygon(sides: list[float]) -> list[float] | None:
    """Exterior angles [rad] of the polygon in a circle with these sides, that after each side; None if it cannot close.

    Sides a are chords of central angles α = 2 asin(a x), x = 1/2R. Either Σα = 2π, or the centre lies beyond the
    longest side and its α is the sum of the others'. The angle between two neighbours is (α + α')/2.
    """
    longest, total = max(sides), sum(sides)
    if longest == 0:
        return [0.0] * len(sides)
    if 2 * longest > total * (1 + SLACK):
        return None
    sides = [side / longest for side in sides]
    top = sides.index(1.0)
    others = sides[:top] + sides[top + 1 :]

    def inside(x: float) -> float:
        return sum(math.asin(side * x) for side in sides) - math.pi

    def outside(x: float) -> float:
        return sum(math.asin(side * x) for side in others) - math.asin(x)

    if inside(1.0) >= 0:
        x = _root(inside, 1.0)
        halves = [math.asin(side * x) for side in sides]
    else:
        x = _root(outside, 1.0)
        halves = [math.asin(side * x) for side in sides]
        # The long way round: the whole turn less what the others take.
        halves[top] = math.pi - halves[top]
    return [one + other for one, other in pairwise([*halves, halves[0]])]


def _root(function: Callable[[float], float], high: float) -> float:
    """The root of a function of one sign change in (0, high]; 0 where it has the same sign throughout."""
    from scipy.optimize import brentq

    low = 1e-8 * high
    if function(low) * function(high) > 0:
        return 0.0
    return float(brentq(function, low, high, xtol=1e-300, rtol=1e-15))
