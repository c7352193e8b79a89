"""Growth rates of small motions: which of several is the worst, and what is taken for no growth."""

import math
from typing import Final, Protocol, Self, TypeVar

from abu_calc.dynamics.balanced.linearised import BalancedMotion

MARGIN: Final = 1e-9
"""Growth per radian of rotation that is taken for none: below, rounding decides."""

UNDECIDED: Final = 10 * MARGIN
"""Growth per radian below which balls that stand almost on one line count as standing on it."""


class Linear(Protocol):
    """Interface of a linear motion: see `BalancedMotion` and `TwoModes`."""

    @property
    def on_one_line(self) -> Self:
        """Motion with balls that are almost on one line treated as if they were."""
        ...

    def growth(self, speed: float) -> float:
        """Growth rate of the slowest-dying disturbance [1/s]."""
        ...


Motion = TypeVar("Motion", bound=Linear)


def worst(motions: tuple[BalancedMotion, ...], speed: float) -> BalancedMotion:
    """The one that dies out most slowly; of those alike the first."""
    if len(motions) == 1:
        return decided(motions[0], speed)[0]
    best, most = motions[0], -math.inf
    for motion in motions:
        looked_at, growth = decided(motion, speed)
        if growth > most + MARGIN * speed:
            best, most = looked_at, growth
    return best


def decided(motion: Motion, speed: float) -> tuple[Motion, float]:
    """The motion itself, or where rounding would decide that of balls on one line; and its growth rate [1/s].

    Balls that stand all but on one line come back along it next to not at all, by the square of what they lack: less
    than rounding. As the support pushes them back exactly where it pushes back those on the line, these decide.
    """
    growth = motion.growth(speed)
    if abs(growth) > UNDECIDED * speed or motion.on_one_line is motion:
        return motion, growth
    return motion.on_one_line, motion.on_one_line.growth(speed)
