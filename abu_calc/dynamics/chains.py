"""Chains of balls that move together: joined gaps round each race, and sums over chains.

Sums take as many steps as there are balls. A gap is joined, 1, or open, 0. These are numbers, so one way of summing
serves all modes. The gaps of a race are never all joined, since its balls cannot fill it.
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.frozen import dataclass

AnyArray = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Chains:
    """`rings`: the balls of each race that has gaps, in order round it; `joined`: of each gap, ring by ring.

    The gap of the same index lies ahead of a ring's ball, the last one between its last ball and its first.
    """

    rings: tuple[tuple[int, ...], ...]
    joined: AnyArray

    def sums(self, x: AnyArray) -> AnyArray:
        """Sum over the chain of each ball.

        >>> Chains(((0, 1, 2, 3),), np.array((1.0, 0.0, 0.0, 1.0))).sums(np.array((1.0, 2.0, 4.0, 8.0))).tolist()
        [11.0, 11.0, 4.0, 11.0]
        """
        return x + self._gathered(x, self._gaps) + self._gathered(x, self._turned)

    def behind(self, x: AnyArray) -> AnyArray:
        """Sum over each ball and all of its chain behind it."""
        return x + self._gathered(x, self._gaps)

    def ahead(self, x: AnyArray) -> AnyArray:
        """Sum over each ball and all of its chain ahead of it."""
        return x + self._gathered(x, self._turned)

    @cached_property
    def _gaps(self) -> list[tuple[tuple[int, ...], list[Any]]]:
        """Each ring with its gaps."""
        ring_gaps, first = [], 0
        for ring in self.rings:
            ring_gaps.append((ring, list(self.joined[first : first + len(ring)])))
            first += len(ring)
        return ring_gaps

    @property
    def _turned(self) -> list[tuple[tuple[int, ...], list[Any]]]:
        """The same, the other way round."""
        return [(ring[::-1], [*gaps[-2::-1], gaps[-1]]) for ring, gaps in self._gaps]

    def leads(self, balls: int) -> AnyArray:
        """1 for the last ball of each chain, 0 for those that have a joined gap behind them."""
        flags: list[Any] = [1.0] * balls
        for ring, gaps in self._gaps:
            for place, ball in enumerate(ring):
                flags[ball] = 1.0 - gaps[place - 1]
        return np.array(flags)

    def together(self, balls: int) -> AnyArray:
        """n × n: 1 for balls of one chain; for numbers alone."""
        unity = np.eye(balls)
        return np.array([self.sums(row) for row in unity])

    def _gathered(self, x: AnyArray, rings: list[tuple[tuple[int, ...], list[Any]]]) -> AnyArray:
        """Sum over the chain before each ball in its ring; zero if that gap is open."""
        sums: list[Any] = [0.0] * len(x)
        for ring, gaps in rings:
            for before, ball, gap in zip(ring, ring[1:], gaps, strict=False):
                sums[ball] = gap * (x[before] + sums[before])
            wrapped, share = x[ring[-1]] + sums[ring[-1]], gaps[-1]
            for ball, gap in zip(ring[:-1], gaps, strict=False):
                sums[ball] = sums[ball] + share * wrapped
                share = share * gap
        return np.array(sums)
