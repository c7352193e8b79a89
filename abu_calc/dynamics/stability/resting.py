"""Resting places at which balls balance, however many and however unequal they are.

The resultants that balls at rest in the rotor need: Kladiev 1996, eq. (4), in the right quadrant. Imbalances are
complex numbers U e^{iφ} [kg m], φ from the zero mark. The rotor is idle and freely suspended.
"""

import cmath
import math
from collections.abc import Callable
from dataclasses import replace
from itertools import accumulate, islice, pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import assemble, jacobian
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.stability.linearised import QUARTER
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.steady_motion import receptance
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.roots import root

Complex = NDArray[np.complex128]


SAME: Final = 1e-12
"""Relative; what differs by less is the same but for rounding."""


class NotKnownError(NotTrustworthyError):
    """The balls may have a state of rest, but no formula here gives it."""


def needed_resultants(scene: Scene) -> dict[float, complex]:
    """V [kg m] by the place z [m] of each plane with balls: what the balls of its races must add up to.

    In one plane V = −m₀e e^{iφ}. On a support that tilts, force and couple must vanish: Σ V = −U, Σ zV = −W, U and W
    the imbalance at the centre of mass and the couple χ(J_t − J_p); of more than two planes the split is that with the
    least Σ |V|²/Σm R_p. One plane elsewhere than the imbalance balances nothing, but its balls can hold their race
    still, V = −h(z; U, W)/h(z; 1, z), h its motion by forces and couples: known on isotropic supports. Range: small
    tilts. Raises NotKnownError on others. Source: derived.
    """
    own = -cmath.rect(scene.imbalance, scene.imbalance_angle)
    planes = {race.plane_offset: 0.0 for race in scene.races if race.ball_masses}
    if not planes:
        return {}
    couple = -cmath.rect(scene.couple, scene.couple_angle)
    for race in scene.races:
        if race.ball_masses:
            planes[race.plane_offset] += race.static_moment
    if len(planes) == 1:
        (place,) = planes
        if still_axis(scene):
            return {place: own}
        lever = np.array((1, place)) @ _forward(scene.support, scene.speed)
        return {place: complex(lever @ (own, couple) / (lever @ (1, place)))}
    places, capacities = np.array(list(planes)), np.array(list(planes.values()))
    unit = float(np.abs(places).max(initial=0.0)) or 1.0
    rows = np.array((np.ones_like(places), places / unit))
    # Weighed by capacity, the smallest solution of two equations.
    shares = capacities[:, None] * rows.T @ np.linalg.pinv(rows * capacities @ rows.T)
    return dict(zip(planes, (shares @ (own, couple / unit)).tolist(), strict=True))


def still_axis(scene: Scene) -> bool:
    """True if balls can leave no imbalance and no couple at all: force and couple vanish together."""
    planes = {race.plane_offset for race in scene.races if race.ball_masses}
    if len(planes) > 1:
        return True
    U = cmath.rect(scene.imbalance, scene.imbalance_angle)
    W = cmath.rect(scene.couple, scene.couple_angle)
    if not planes:
        return not (U or W)
    couple = U * next(iter(planes))
    return abs(W - couple) <= SAME * (abs(W) + abs(couple))


def _forward(support: Support, speed: float) -> Complex:
    """x + iy and θ_y − iθ_x, rotating with the rotor, by a force and a couple that rotate with it: 2 × 2."""
    h = receptance(support, speed)
    straight, crossed = h[::2, ::2], h[::2, 1::2]
    mirrored = np.abs(h[1::2, 1::2] - straight).max() + np.abs(h[1::2, ::2] + crossed).max()
    if mirrored > 1e-9 * np.abs(h).max():
        raise NotKnownError(
            "one race elsewhere than the imbalance, on a support that differs along x and y: its balls cannot come "
            "to rest, they swing twice per turn about a place that is not computed"
        )
    return np.asarray(straight - 1j * crossed, dtype=complex)


TOUCHING = 1e-9
"""Balls that overlap by less than this [rad] touch."""

MOST_STEPS = 20
"""Most steps of Newton's method, which doubles the digits with each."""

SLACK = 1e-12
"""A polygon that lacks less than this share of its longest side is closed."""


@dataclass(frozen=True)
class Rest:
    """Balls at rest in the rotor: their angles θ [rad], race by race, and how the support then moves.

    `motion`: amplitudes Q of the support's coordinates, Re(Q e^{iΩt}); empty where the axis is still.
    """

    angles: tuple[float, ...]
    motion: tuple[complex, ...] = ()


def resting_state(scene: Scene, half_angle: float = 0.0) -> Rest | None:
    """State of rest of a scene's balls about races whose centres are still; None if there is none.

    Everywhere Σ m R_p e^{iθ} of a plane is what `needed_resultants` gives. One ball can only carry its own
    moment m R_p, two have one arrangement, of more n − 2 angles are free: the one given is that of sides of
    a polygon in a circle, so equal balls are spread evenly about the light side. `half_angle` β [rad]:
    touching neighbours are 2β apart, 0 for balls without size. Raises NotKnownError if no formula gives it.

    Source: derived; for two balls Kladiev 1996, (4), with ε = 0.
    """
    needed = needed_resultants(scene)
    if not needed and (scene.imbalance or scene.couple):
        return None
    ball_angles: dict[int, tuple[float, ...]] = dict.fromkeys(range(len(scene.races)), ())
    for place, resultant in needed.items():
        races = {k: race for k, race in enumerate(scene.races) if race.plane_offset == place}
        sides = [mass * race.pitch_radius for race in races.values() for mass in race.ball_masses]
        turns = _polygon([abs(resultant), *sides])
        if turns is None:
            _refuse_other_splits(needed)
            return None
        ahead = iter(accumulate(turns[:-1], initial=cmath.phase(-resultant)))
        next(ahead)
        for k, race in races.items():
            ball_angles[k] = tuple(math.remainder(angle, 2 * math.pi) for angle in islice(ahead, len(race.ball_masses)))
            if narrowest_gap(ball_angles[k]) < needed_gap(scene, race, half_angle) - TOUCHING:
                _refuse_other_splits(needed)
                return None
    angles = tuple(angle for own in ball_angles.values() for angle in own)
    return Rest(angles) if still_axis(scene) else _settled(scene, angles, _motion(scene, needed))


def resting_angles(scene: Scene, half_angle: float = 0.0) -> tuple[float, ...] | None:
    """The angles θ [rad] of `resting_state`, if there is one."""
    rest = resting_state(scene, half_angle)
    return None if rest is None else rest.angles


def _refuse_other_splits(needed: dict[float, complex]) -> None:
    """Refuse a case of more than two planes: if this split has no state of rest, another might have one."""
    if len(needed) > 2:
        raise NotKnownError(
            "races in more than two planes share the load in proportion to what they carry; one of them cannot take "
            "its share, and other splits are not tried"
        )


def needed_gap(scene: Scene, race: Race, half_angle: float) -> float:
    """The angle between touching balls [rad], by what is given or by their radius where the scene lets them meet."""
    return 2 * max(half_angle, math.asin(race.ball_radius / race.pitch_radius) if scene.balls_meet else 0.0)


def narrowest_gap(angles: tuple[float, ...]) -> float:
    """The smallest gap between neighbours on the circle [rad]."""
    places = sorted(angle % (2 * math.pi) for angle in angles)
    return min((b - a for a, b in pairwise([*places, *(a + 2 * math.pi for a in places[:1])])), default=math.inf)


def _motion(scene: Scene, needed: dict[float, complex]) -> Complex:
    """Q of the support under the imbalance, the couple and balls whose races do not move."""
    U = cmath.rect(scene.imbalance, scene.imbalance_angle) + sum(needed.values())
    W = cmath.rect(scene.couple, scene.couple_angle) + sum(place * V for place, V in needed.items())
    support = scene.support.small_motion(scene.speed)
    force = scene.speed**2 * np.array((U, -1j * U, W, -1j * W))
    moved = np.linalg.solve(support.dynamic_stiffness(scene.speed), support.frame.T @ force)
    return np.asarray(moved, dtype=complex)


def _settled(scene: Scene, angles: tuple[float, ...], motion: Complex) -> Rest:
    """The state of rest near a first guess, which knows nothing of what balls do to a race that leans.

    Newton's method on the equations themselves, seen from the rotor: the support and the sum of the balls have no
    acceleration there. What is left of the balls' own is of the second order in the tilt. Range: isotropic supports.
    """
    equations, N, W = assemble(replace(scene, effects=())), len(motion), scene.speed
    theta = np.array(angles)
    sums = np.linalg.qr(np.array((-np.sin(theta), np.cos(theta))).T)[0]
    # The state by the support's place q, seen from the rotor, and what moves the sum of the balls.
    state = np.zeros((2 * N + 2 * len(theta), N + sums.shape[1]))
    state[:N, :N], state[N : 2 * N, :N] = np.eye(N), W * np.kron(np.eye(N // 2), QUARTER)
    state[2 * N : 2 * N + len(theta), N:] = sums
    at_rest = np.concatenate([np.zeros(2 * N), theta, np.zeros(len(theta))])
    unknown = np.concatenate([motion.real, np.zeros(sums.shape[1])])
    inward = np.diag([W**2] * N + [0.0] * sums.shape[1])
    for _ in range(MOST_STEPS):
        y = at_rest + state @ unknown
        slope, matrix = equations.rhs(np, 0.0, y, equations.acting), jacobian(equations, 0.0, y)
        picked = [
            np.vstack([part[N : 2 * N], sums.T @ part[2 * N + len(theta) :]]) for part in (slope[:, None], matrix)
        ]
        step = np.linalg.solve(picked[1] @ state + inward, picked[0][:, 0] + inward @ unknown)
        unknown = unknown - step
        if np.abs(step[:N]).max() <= SLACK * np.abs(unknown[:N]).max() and np.abs(step[N:]).max() <= TOUCHING:
            x, y = unknown[:N:2], unknown[1:N:2]
            settled_motion = np.stack([x + 1j * y, y - 1j * x], axis=1).ravel()
            return Rest(tuple((theta + sums @ unknown[N:]).tolist()), tuple(settled_motion.tolist()))
    raise NotKnownError("one race elsewhere than the imbalance: where its balls come to rest is not found")


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
        """Σ asin(aᵢx) − π: zero if the polygon holds the centre of its circle of diameter 1/x."""
        return sum(math.asin(side * x) for side in sides) - math.pi

    def outside(x: float) -> float:
        """Σ asin(aᵢx) − asin x over the other sides: zero if the centre lies beyond the longest side."""
        return sum(math.asin(side * x) for side in others) - math.asin(x)

    if inside(1.0) >= 0:
        x = _root(inside, 1.0)
        halves = [math.asin(side * x) for side in sides]
    else:
        x = _root(outside, 1.0)
        halves = [math.asin(side * x) for side in sides]
        # The long way round: the whole turn less what the others take.
        halves[top] = math.pi - halves[top]
    return [half + other for half, other in pairwise([*halves, halves[0]])]


def _root(function: Callable[[float], float], high: float) -> float:
    """The root of a function of one sign change in (0, high]; 0 where it has the same sign throughout."""
    low = 1e-8 * high
    if function(low) * function(high) > 0:
        return 0.0
    return root(function, low, high, xtol=1e-300, rtol=1e-15)
