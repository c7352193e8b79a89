"""Machines 2020, 8(4), 74: dry friction scatters the imbalance left; a temporary speed reduction is a countermeasure.

Its numbers could not be had; these are numbers of ours. Two balls on a grid of start angles, run-up in 5 units of time.
"""

from typing import Final, NamedTuple

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from tests.benchmarks.published.runs import left_over, pairs, rotor

GRID: Final = 6
NUMBERS: Final = (4.0, 0.02, 0.02, 0.1, 0.1)
"""Speed, ball mass, imbalance, damping ratio and drag rate."""

FRICTIONS: Final = (0.0, 0.002, 0.005)
"""f = k_r/r."""

PLATEAUS: Final = (None, 2.0, 1.6, 1.3)
"""Speed to which the rotor is slowed for 150 units of time; None: it goes on at full speed."""

DURATION: Final = 400.0
RADIUS: Final = 0.1


class Ends(NamedTuple):
    """Imbalance left of all starts, over that of the rotor, ascending."""

    friction: float
    plateau: float | None
    left: tuple[float, ...]


def ends(friction: float, plateau: float | None) -> Ends:
    """All starts with one friction and one profile of speed."""
    profile = RunUpEffect(5.0) if plateau is None else RunUpEffect(5.0, 0.0, 0.0, plateau, 10.0, 150.0, 5.0)
    effects: tuple[Effect, ...] = (profile,)
    if friction:
        effects += (DryRollingFrictionEffect(friction * RADIUS, RADIUS),)
    scenes = (rotor(*NUMBERS, start, DURATION, effects, RADIUS) for start in pairs(GRID))
    return Ends(friction, plateau, tuple(sorted(left_over(scene)[0] for scene in scenes)))


def scatter() -> list[Ends]:
    """All frictions and profiles; without friction full speed alone."""
    return [
        ends(friction, plateau)
        for friction in FRICTIONS
        for plateau in (PLATEAUS if friction else (None,))
    ]  # fmt: skip
