"""Stability of the balanced state: balls at rest in their races, opposite the imbalance, the axis still.

Sources: Green, Champneys & Lieven 2006 and Rodrigues, Champneys, Friswell & Wilson 2008, for two balls on an isotropic
support; Kovalenko 2010, (17)–(24), for a swing arm. Printed: Kladiev 1996, (7), asks only for a speed above the natural
frequency; that does not suffice.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from typing import Final, Literal

import numpy as np

from abu_calc.dynamics.balanced.linearised import Array, BalancedMotion, growth_of
from abu_calc.dynamics.balanced.resting import resting_state
from abu_calc.dynamics.balanced.stationary import NotKnownError, still_axis
from abu_calc.dynamics.scene import Scene
from abu_calc.validity import Range

MARGIN: Final = 1e-9
"""Growth per radian of rotation that is taken for none: below, rounding decides."""

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

Points = list[tuple[float, float]]
State = Literal["balanced", "race still", "arm alone"]


@dataclass(frozen=True)
class Stability:
    """One state at one speed; rates in 1/s, angles in rad.

    `state` judged: balanced; the races' centres still while the axis moves elsewhere ("race still"); or a swing arm
    without balls ("arm alone"). `angles` None: the balls cannot balance. `eigenvalues` on an isotropic support,
    `multipliers` of one revolution on any other. `stable` None where it is not known, `reason` says why. Directions in
    which balls move without changing what they carry (n − 2 of the n of a race) are neutral and do not count.
    `left_out`: effects of the scene that are no part of the linear motion.
    """

    speed: float
    state: State | None
    angles: tuple[float, ...] | None
    eigenvalues: tuple[complex, ...] | None
    multipliers: tuple[complex, ...] | None
    growth_rate: float | None
    stable: bool | None
    reason: str | None
    left_out: tuple[str, ...]


@dataclass(frozen=True)
class Boundary:
    """A speed [rad/s] at which the balanced state gains or loses its stability."""

    speed: float
    stable_above: bool


def stability(scene: Scene, half_angle: float = 0.0) -> Stability:
    """Whether every disturbance of the balanced state of a scene dies out, at its speed.

    Growth rate: the largest Re λ, or ln|μ|/T over a revolution T [1/s]; stable below −1e-9·Ω. `half_angle` [rad] of
    touching balls, 0 for balls without size. A swing arm whose balls are none, or cannot balance, is judged alone; with
    balls that cannot balance it is not called stable. Range: constant speed, small motions, no effects.
    Raises NotTrustworthyError when multipliers do not settle.
    """
    left_out = tuple(effect.name for effect in scene.effects)
    try:
        state, motion = _judged(scene, half_angle)
    except NotKnownError as error:
        return Stability(scene.speed, None, None, None, None, None, None, str(error), left_out)
    if motion is None:
        return Stability(scene.speed, None, None, None, None, None, False, None, left_out)
    eigenvalues = motion.eigenvalues(scene.speed)
    multipliers = motion.multipliers(scene.speed) if eigenvalues is None else None
    growth = growth_of(multipliers, scene.speed) if multipliers else motion.growth(scene.speed)
    carried = state != "arm alone" or not scene.ball_masses
    stable = carried and growth < -MARGIN * scene.speed
    angles = motion.angles if carried else None
    return Stability(scene.speed, state, angles, eigenvalues, multipliers, growth, stable, None, left_out)


def critical_damping(scene: Scene) -> float | None:
    """Damping of the support [N·s/m] that parametric resonance cannot overcome as long as nothing is balanced.

    None where there is none: see `SwingArm.critical_damping`.
    """
    return scene.support.critical_damping(scene.imbalance, scene.balls)


def boundaries(
    scene: Scene, low: float, high: float, half_angle: float = 0.0, *, coarse: bool = False
) -> tuple[Boundary, ...]:
    """Every speed from `low` to `high` [rad/s] at which the balanced state of a scene gains or loses its stability.

    Isotropic support, axis still, up to 16 states: all of them, see `crossings`. Elsewhere the changes of sign of the
    growth rate on a grid that is refined where the rate bends, comes near zero or turns back before it, at up to some
    five hundred speeds; `coarse`: at some twenty, not refined. Without a state of rest at a speed nothing is stable
    there. Raises NotKnownError where `stability` knows no answer.
    """
    Range("lowest speed", 0.0, unit="rad/s", open_low=True).check(low)
    Range("highest speed", low, 1e9, "rad/s", open_low=True).check(high)
    state, motion = _judged(scene, half_angle)
    if state == "arm alone" and scene.ball_masses:
        return ()
    moves = motion.motion if motion else scene.ball_masses and not still_axis(scene)
    if motion is None and not moves:
        return ()

    def excess(speed: float) -> float:
        """The growth rate per radian, beyond what is taken for none."""
        there = _judged(_at(scene, speed), half_angle)[1] if moves else motion
        return 1.0 if there is None else there.growth(speed) / speed + MARGIN

    if motion and not moves and motion.isotropic and motion.states <= MOST_STATES:
        points = [(speed, excess(speed)) for speed in _between(crossings(motion), low, high)]
    elif coarse:
        points = [(speed, excess(speed)) for speed in _first_grid(scene, low, high, COARSE, FEW)]
    else:
        points = _refined(excess, _first_grid(scene, low, high, GRID, MANY))
    return tuple(_changes(excess, points))


def _judged(scene: Scene, half_angle: float) -> tuple[State | None, BalancedMotion | None]:
    """What is judged of a scene, if there is anything."""
    rest = resting_state(scene, half_angle)
    support = scene.support
    if rest is not None and (scene.ball_masses or not support.turns):
        return "race still" if rest.motion else "balanced", BalancedMotion(scene, rest.angles, rest.motion)
    if not support.turns:
        return None, None
    races = tuple(replace(race, ball_masses=(), start_angles=(), start_speeds=()) for race in scene.races)
    return "arm alone", BalancedMotion(replace(scene, support=support.holding(scene.balls), races=races), ())


def _at(scene: Scene, speed: float) -> Scene:
    return replace(scene, speed=speed, duration=4 * math.pi / speed, effects=())


def crossings(motion: BalancedMotion) -> list[float]:
    """Speeds [rad/s] at which an eigenvalue may cross the imaginary axis, on an isotropic support; ascending.

    Two eigenvalues then add up to zero, or one is zero: the bialternate product 2A ⊙ I, whose eigenvalues are λ_i + λ_j
    (Fuller 1968), or A is singular. A = L₀ + L₁Ω + L₂Ω², so each is an eigenvalue problem for Ω. Between its solutions
    stability cannot change; most of them change nothing.
    """
    parts = motion.polynomial()
    found = [*_singular(parts), *_singular(np.array([_bialternate(part) for part in parts]))]
    return sorted(x * motion.scene.speed for x in found)


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


def _first_grid(scene: Scene, low: float, high: float, intervals: int, most: int) -> list[float]:
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


def _changes(function: Callable[[float], float], points: Points) -> list[Boundary]:
    """Zeros of the function between points of opposite sign."""
    from scipy.optimize import brentq

    return [
        Boundary(float(brentq(function, low, high, xtol=1e-13 * high, rtol=1e-13)), stable_above=after < 0)
        for (low, before), (high, after) in pairwise(points)
        if (before < 0) != (after < 0)
    ]
