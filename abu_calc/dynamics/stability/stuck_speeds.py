"""Closed speeds at which the balls of a race can stay stuck below the rotor's speed (Sommerfeld effect)."""

from typing import Annotated, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.stability.stall import driven, lost_by
from abu_calc.formulas.slow_motion import resonance_drag
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.roots import root

Array = NDArray[np.float64]

GRID: Final = 2000
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
    even = speed * np.linspace(0, 1, GRID + 2)[1:-1]
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
