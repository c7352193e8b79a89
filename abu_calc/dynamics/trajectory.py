"""Trajectory that an integrator returns, and the samples that are requested from it."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.frozen import dataclass
from abu_calc.progress import Share

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Samples:
    """States over time: y[state, time] at times [s] in ascending order."""

    t: Array
    y: Array

    def at(self, times: Sequence[float] | Array) -> Array:
        """y at some of these times; raises ValueError for any other."""
        wanted = np.asarray(times, dtype=float)
        index = np.minimum(np.searchsorted(self.t, wanted), len(self.t) - 1)
        if not np.array_equal(self.t[index], wanted):
            raise ValueError("the trajectory was not sampled at these times")
        first = int(index[0]) if len(index) else 0
        together = slice(first, first + len(index))
        # What stands together needs no copy: the amplitude window of a long run is large.
        return self.y[:, together if np.array_equal(self.t[together], wanted) else index]


@dataclass(frozen=True)
class Trajectory(Samples):
    """A whole run, at the times asked for; one that fails raises.

    `evaluations` counts calls of the right-hand side and of what is watched.
    """

    integrator: str
    tolerance: float
    evaluations: int
    steps: int
    events: int = 0
    """Switches of modes."""


def merged(*numbers: NDArray[Any]) -> NDArray[Any]:
    """All of these, each once, in ascending order: `np.unique` without the import of masked arrays.

    >>> merged(np.array((3, 1)), np.array((2, 3))).tolist()
    [1, 2, 3]
    """
    ordered = np.sort(np.concatenate(numbers))
    first = np.ones(len(ordered), dtype=bool)
    first[1:] = ordered[1:] != ordered[:-1]
    return ordered[first]


Reader = Callable[[Samples], None]
"""Takes what it needs of some samples; their arrays are used again afterwards."""


@dataclass(frozen=True)
class Until:
    """Times [s] at which a run may end before its last: where all its samples so far are enough."""

    times: tuple[float, ...]
    enough: Callable[[Samples], bool]


@dataclass(frozen=True)
class Sampling:
    """Times [s] at which a run is sampled, ascending; `readers` are shown all samples, block by block, in their order.

    `held`: those of the times that stay in the trajectory; None: all of them. `told` gets the share that is done.
    `until`: when all are held, where the run may end early.
    """

    times: Array
    held: Array | None = None
    readers: tuple[Reader, ...] = ()
    told: Share | None = None
    until: Until | None = None

    @classmethod
    def of(cls, times: "Times") -> "Sampling":
        """Sampling at times that are all held, if they are no sampling yet."""
        return times if isinstance(times, Sampling) else cls(np.asarray(times, dtype=float))

    def read_by(self, *readers: Reader) -> "Sampling":
        """The same times for others to read."""
        return replace(self, readers=readers)

    def telling(self, report: Share | None) -> "Sampling":
        """The same times, with somebody who watches."""
        return replace(self, told=report)


Times = Sequence[float] | Array | Sampling
"""Times that are requested from an integrator."""
