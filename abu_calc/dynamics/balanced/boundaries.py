"""Speeds at which the balanced state of a scene gains or loses its stability."""

from collections.abc import Callable, Sequence
from typing import Final

from abu_calc.dynamics.balanced.arrangements import Arrangement
from abu_calc.dynamics.balanced.crossings import between, crossings, solvable
from abu_calc.dynamics.balanced.growth import MARGIN, decided
from abu_calc.dynamics.balanced.linearised import BalancedMotion
from abu_calc.dynamics.balanced.search import Search, at_speed, searched
from abu_calc.dynamics.balanced.speeds import COARSE, FEW, GRID, MANY, ROUGH, changes, check_range, grid_of, refined
from abu_calc.dynamics.balanced.stability import judged
from abu_calc.dynamics.balanced.stationary import still_axis
from abu_calc.dynamics.balanced.two_modes import Motion, two_modes
from abu_calc.dynamics.scene import Scene
from abu_calc.frozen import dataclass

ROUNDS: Final = 6
"""Most rounds in which arrangements that are worse at a boundary are added."""


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
) -> tuple[Callable[[float], float] | None, tuple[Motion, ...], Search | None]:
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
            there = judged(at_speed(scene, speed), half_angle, arrangement)[1]
            return excess_of(there, speed) if there else 1.0

        return excess, (), None
    still, search = quick(motions), searched(motions, half_angle)
    if search and not search.in_plane:
        still = search.added(still, (scene.speed,))
    return lambda speed: excess_of(still, speed), still, search


def limits_of_all(
    motions: tuple[Motion, ...], search: Search | None, scene: Scene, low: float, high: float, *, coarse: bool = False
) -> tuple[tuple[Motion, ...], tuple[Boundary, ...]]:
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
    motions: Sequence[Motion], scene: Scene, low: float, high: float, *, coarse: bool = False
) -> tuple[Boundary, ...]:
    """The same of motions about a still axis that must all be stable."""

    def excess(speed: float) -> float:
        return excess_of(motions, speed)

    if all(solvable(motion) for motion in motions):
        speeds = sorted(speed for motion in motions for speed in crossings(motion))
        return _found(changes(excess, [(speed, excess(speed)) for speed in between(speeds, low, high)]))
    return _on_grid(excess, scene, low, high, coarse=coarse)


def _on_grid(
    excess: Callable[[float], float], scene: Scene, low: float, high: float, *, coarse: bool
) -> tuple[Boundary, ...]:
    if coarse:
        points = [(speed, excess(speed)) for speed in grid_of(scene, low, high, COARSE, FEW)]
        return _found(changes(excess, points, ROUGH))
    return _found(changes(excess, refined(excess, grid_of(scene, low, high, GRID, MANY))))


def _found(zeros: Sequence[tuple[float, bool]]) -> tuple[Boundary, ...]:
    return tuple(Boundary(speed, stable_above=below_zero) for speed, below_zero in zeros)


def quick(motions: Sequence[BalancedMotion]) -> tuple[Motion, ...]:
    """The same motions by their two modes where these are all; of many on an anisotropic support, the first, the most
    even and the least even ones."""
    reduced = tuple(two_modes(motion) or motion for motion in motions)
    isotropic = all(motion.isotropic for motion in reduced)
    return reduced if isotropic or len(reduced) <= 3 else (reduced[0], reduced[1], reduced[-1])


def excess_of(motions: Sequence[Motion], speed: float) -> float:
    """The largest growth rate per radian, beyond what is taken for none."""
    return max(decided(motion, speed)[1] for motion in motions) / speed + MARGIN
