"""Bounds on stalling in a scene: the closed bounds of `formulas.slow_motion` on any linear support.

Closed speeds at which the balls of a race can stay stuck below the rotor's speed (Sommerfeld effect).
"""

import math
from typing import Annotated, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.resting import needed_gap
from abu_calc.dynamics.support import SmallMotion
from abu_calc.dynamics.trajectory import merged
from abu_calc.formulas.slow_motion import damped_drag, gravity_drag, resonance_drag, side_by_side
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.roots import root

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

HEAVY: Final = 0.3
"""Damping ratio from which balls were seen to run above a resonance."""

UNDAMPED: Final = 1e-9
"""Damping ratio that is none."""

SPEEDS: Final = 5
"""Number of speeds of a range that are examined."""

GRID, ZOOM, TIMES = 160, 33, 4
"""Frequencies looked at first, again between the neighbours of the best one, and how often."""


@dataclass(frozen=True)
class HangingBounds:
    """Drags [1/s] above which no balls hang: at a resonance, above a heavily damped one, at rest under gravity; 0 where
    there is no such state, infinite where no drag is enough. Of the race whose own drag comes nearest to them.

    `frequency` [rad/s]: at which balls would hang at a resonance, 0 for none; `drag` [1/s]: that race's own.
    """

    resonance: float
    damped: float
    gravity: float
    frequency: float
    drag: float

    @property
    def largest(self) -> float:
        """Largest of the bounds [1/s]: at a higher drag rate no balls stall."""
        return max(self.resonance, self.damped, self.gravity)

    def doubt(self, drag: float | None = None) -> bool:
        """True if balls may stall at a drag rate, by default the race's own: then a slow run-up must decide."""
        return (self.drag if drag is None else drag) <= self.largest

    def margin(self, bound: float) -> float:
        """The drag over a bound."""
        return self.drag / bound if bound else math.inf


def hanging_bounds(
    scene: Scene, half_angle: float = 0.0, speeds: tuple[float, float] | None = None, *, horizontal: bool = False
) -> HangingBounds:
    """Bounds on stalling in a scene, at the worst of the speeds [rad/s], by default at its own.

    `half_angle` β of touching balls, 0 without size; `horizontal`: True if weight acts in the plane. Range:
    balls that go round alike in all races, small motions of the support.
    """
    low, high = speeds or (scene.speed, scene.speed)
    races = [race for race in scene.races if race.ball_masses]
    grid = dict.fromkeys(np.geomspace(low, high, SPEEDS).tolist() if high > low else (low,))
    bounds = [_bounds(scene, race, half_angle, speed, weight=horizontal) for race in races for speed in grid]
    none = HangingBounds(0.0, 0.0, 0.0, 0.0, 0.0)
    return max(bounds, key=lambda bound: bound.largest / max(bound.drag, 1e-300), default=none)


def _bounds(scene: Scene, race: Race, half_angle: float, speed: float, *, weight: bool) -> HangingBounds:
    """Bounds at one speed of the rotor, for one race."""
    support = scene.support.small_motion(speed).carrying(scene.balls)
    rates = np.asarray(np.linalg.eigvals(support.motion), dtype=complex)
    natural = _natural(support, rates, speed)
    resonance = _at_a_resonance(driven(scene, race, half_angle), support, rates, natural, speed)
    sizes = np.abs(rates)
    heavy = sizes[(sizes > 0) & (sizes < speed) & (-rates.real >= HEAVY * sizes)]
    damped = _above_one(scene, race, support, (float(heavy.min()), speed)) if len(heavy) else 0.0
    gravity = gravity_drag(race.pitch_radius, speed) if weight else 0.0
    return HangingBounds(resonance[0], damped, gravity, resonance[1], race.drag)


def _natural(support: SmallMotion, rates: Complex, speed: float) -> list[float]:
    """Natural frequencies below the speed, with and without what damps and turns, ascending."""
    squares = np.linalg.eigvals(np.linalg.solve(support.mass, support.stiffness)).real
    swinging = np.abs(rates[rates.imag > UNDAMPED * np.abs(rates)])
    frequencies = np.concatenate([np.sqrt(np.maximum(squares, 0.0)), swinging])
    return sorted(float(frequency) for frequency in frequencies if 0 < frequency < speed)


Driven = tuple[float, list[tuple[float, float]]]
"""Place z [m] of a race, and those of all races, each with the n·m·σ² [kg] that brakes the balls of the first."""


def driven(scene: Scene, race: Race, half_angle: float) -> Driven:
    """Balls of other radii R brake by R over the race's own."""
    each = []
    for scene_race in scene.races:
        count, alike = len(scene_race.ball_masses), len(set(scene_race.ball_masses)) == 1
        share = side_by_side(count, needed_gap(scene, scene_race, half_angle) / 2 if alike else 0.0)
        each.append((scene_race.plane_offset, share**2 * scene_race.static_moment / race.pitch_radius))
    return race.plane_offset, each


def _at_a_resonance(
    driven: Driven, support: SmallMotion, rates: Complex, natural: list[float], speed: float
) -> tuple[float, float]:
    """The largest `resonance_drag` up to the highest natural frequency below the speed, and where it is."""
    if not natural:
        return 0.0, 0.0
    near = rates[(rates.imag > 0) & (np.abs(rates) < speed)]
    bare = near[-near.real <= UNDAMPED * np.abs(near)]
    if len(bare):
        return math.inf, float(bare.imag.max())
    top = natural[-1]
    peaks = (near.imag[:, None] + near.real[:, None] * np.linspace(-4, 4, ZOOM)).ravel()
    grid = np.concatenate([np.geomspace(natural[0] / 4, top, GRID), peaks, natural])
    grid, best, place = merged(grid[(grid > 0) & (grid <= top)]), 0.0, 0.0
    for _ in range(TIMES):
        values = resonance_drag(lost_by(driven, support, grid), grid, speed)
        k = int(values.argmax())
        best, place = float(values[k]), float(grid[k])
        grid = np.linspace(grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)], ZOOM)
    return best, place


def lost_by(driven: Driven, support: SmallMotion, frequencies: Array) -> Array:
    """Σ n·m·σ²·(−Im[h_xx + h_yy]) [kg m/N] by forces that go round with the rotor at these frequencies.

    Where x and y are coupled, as by gyroscopic moments, −Im[h_xx + h_yy + i(h_yx − h_xy)].
    """
    h, (place, races) = _receptances(support, frequencies), driven
    ways = {z: np.concatenate([(1, -1j), (z, -1j * z)])[: h.shape[1]] for z in (place, *(z for z, _ in races))}
    return np.asarray(sum(mass * np.abs((ways[place].conj() @ h @ ways[z]).imag) for z, mass in races), dtype=float)


def _above_one(scene: Scene, race: Race, support: SmallMotion, span: tuple[float, float]) -> float:
    """`damped_drag` by the axis that is damped most, c = Im(1/h)/ν, from the lowest heavily damped motion upward."""
    frequencies = np.geomspace(*span, ZOOM)
    ways = np.kron((1.0, race.plane_offset), np.eye(2))[:, : len(support.frame)]
    h = np.einsum("ai,tij,aj->ta", ways, _receptances(support, frequencies), ways)
    free = np.einsum("ai,ij,aj->a", ways, support.frame @ np.linalg.solve(support.mass, support.frame.T), ways)
    balls = sum(scene_race.static_moment for scene_race in scene.races) / race.pitch_radius
    drags = [0.0]
    for axis in np.flatnonzero(free > 0):
        rate = float((free[axis] * (1 / h[:, axis]).imag / frequencies).max())
        drags.append(damped_drag(rate, balls * float(free[axis]), race.inertia_factor))
    return max(drags)


def _receptances(support: SmallMotion, frequencies: Array) -> Complex:
    """P D⁻¹ Pᵀ at many frequencies, stacked."""
    nu = frequencies[:, None, None]
    D = support.stiffness - nu**2 * support.mass + 1j * nu * support.damping
    right = np.broadcast_to(support.frame.T.astype(complex), (len(frequencies), *support.frame.T.shape))
    return np.asarray(support.frame @ np.linalg.solve(D, right), dtype=complex)


EVEN: Final = 2000
"""Frequencies of the coarse search between standstill and the rotor's speed."""

NEAR: Final = 401
"""Frequencies looked at within ten half-widths of each resonance."""

ALIKE: Final = 1e-6
"""Relative difference below which two natural frequencies are one."""


@record
class ClosedStuckSpeed(Record):
    """A speed at which drag and dissipation balance, of balls of a race that go round together.

    It holds if a small change of their common speed dies out. Races count from 1.
    """

    race: Annotated[int, Quantity("race")]
    speed: Annotated[float, Quantity("balls can turn at", "ν", 5, unit="rpm")]
    holds: Annotated[bool, Quantity("holds its speed")]


def stuck_speeds(scene: Scene, half_angle: float = 0.0) -> tuple[ClosedStuckSpeed, ...]:
    """All speeds ν in 0 < ν < Ω with h₀(Ω − ν) = n·m·σ²·ν⁴·(−Im[h_xx(ν) + h_yy(ν)])/2, ascending in each race.

    h: receptance [m/N] at the race with the balls' mass on it; σ: side by side, of touching balls with the half-angle
    β [rad]. On one natural frequency there are one or three of them: as the speed grows 1, 3, 3, 1 (all sets of small
    drag). The first and third hold their speed, the second does not. The last, near Ω, is that of balls which turn with
    the race: they may spread and balance. Range: balls of a race together, small motions, mean torque over a turn; no
    dry friction, no gravity. Source: balance of drag and dissipation; counts by Filimonikhin, Yatsun and others 2018
    (EEJET, 128265), simulated there for a platform that moves along one axis.
    """
    return tuple(stuck for index, race in enumerate(scene.races) for stuck in _of_race(scene, index, race, half_angle))


def natural_frequencies(scene: Scene) -> tuple[float, ...]:
    """Natural frequencies |λ| [rad/s] of the support with the balls' mass, at the scene's speed, ascending."""
    support = scene.support.small_motion(scene.speed).carrying(scene.balls)
    rates = np.asarray(np.linalg.eigvals(support.motion), dtype=complex)
    swinging = sorted(np.abs(rates[rates.imag > ALIKE * np.abs(rates)]).tolist())
    if not swinging:
        squares = np.linalg.eigvals(np.linalg.solve(support.mass, support.stiffness)).real
        swinging = sorted(np.sqrt(squares[squares > 0]).tolist())
    kept: list[float] = []
    for frequency in swinging:
        if not kept or frequency > kept[-1] * (1 + ALIKE):
            kept.append(frequency)
    return tuple(kept)


def _of_race(scene: Scene, index: int, race: Race, half_angle: float) -> tuple[ClosedStuckSpeed, ...]:
    if not race.ball_masses or not race.drag:
        return ()
    speed = scene.speed
    support = scene.support.small_motion(speed).carrying(scene.balls)
    balls = driven(scene, race, half_angle)

    def pull(frequencies: Array) -> Array:
        """(Ω − ν)·(h₀ − drag needed there) [1/s²]: above zero the balls speed up."""
        need = resonance_drag(lost_by(balls, support, frequencies), frequencies, speed)
        return np.asarray((speed - frequencies) * (race.drag - need))

    def pull_at(frequency: float) -> float:
        """The same at one frequency."""
        return float(pull(np.array([frequency]))[0])

    rates = np.asarray(np.linalg.eigvals(support.motion), dtype=complex)
    near = rates[rates.imag > 0]
    peaks = (near.imag[:, None] + near.real[:, None] * np.linspace(-10, 10, NEAR)).ravel()
    even = speed * np.linspace(0, 1, EVEN + 2)[1:-1]
    grid = np.unique(np.concatenate([even, speed * (1 - np.geomspace(1e-12, 0.1, 200)), peaks]))
    grid = grid[(grid > 0) & (grid < speed)]
    values = pull(grid)
    changes = np.flatnonzero((values[:-1] > 0) != (values[1:] > 0))
    return tuple(
        ClosedStuckSpeed(
            race=index + 1, speed=root(pull_at, float(grid[k]), float(grid[k + 1])), holds=bool(values[k] > 0)
        )
        for k in changes
    )
