"""Trajectory that an integrator returns, and the samples that are requested from it.

`at_samples` evaluates a function of one state at many samples in the calls of one: NumPy's calls cost the same for one
number as for hundreds.
"""

import operator
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Share

AnyArray = NDArray[Any]
Array = NDArray[np.float64]


NUMBER = (float, int, complex)


class Column:
    """A number that is another one at each sample; arithmetic with columns, numbers and arrays of both."""

    __slots__ = ("values",)

    def __init__(self, values: Any) -> None:
        self.values = values

    def __neg__(self) -> "Column":
        return Column(-self.values)

    def __pos__(self) -> "Column":
        return self

    def sin(self) -> "Column":
        """Sine, under the name by which NumPy calls it."""
        return Column(np.sin(self.values))

    def cos(self) -> "Column":
        """Likewise."""
        return Column(np.cos(self.values))

    def sqrt(self) -> "Column":
        """Likewise."""
        return Column(np.sqrt(self.values))


def _operations(operation: Callable[[Any, Any], Any]) -> tuple[Any, Any]:
    """An operation with what stands on the right, and with what stands on the left."""

    def right(self: Column, other: Any) -> Any:
        """A column and what stands to its right."""
        if isinstance(other, Column):
            return Column(operation(self.values, other.values))
        return Column(operation(self.values, other)) if isinstance(other, NUMBER) else NotImplemented

    def left(self: Column, other: Any) -> Any:
        """A column and what stands to its left."""
        return Column(operation(other, self.values)) if isinstance(other, NUMBER) else NotImplemented

    return right, left


for _name in ("add", "sub", "mul", "truediv", "pow"):
    _right, _left = _operations(getattr(operator, _name))
    setattr(Column, f"__{_name}__", _right)
    setattr(Column, f"__r{_name}__", _left)


def at_samples(function: Callable[..., Any], *numbers: AnyArray, at_once: bool = True) -> AnyArray:
    """The numbers that a function makes of some numbers, whose last axis is that of the samples, likewise.

    It computes by plain arithmetic, sin, cos and sqrt of NumPy alone, unless `at_once` is false.

    >>> at_samples(lambda t, y: [t * y[0], y.dot(y)], np.array((1.0, 2.0)), np.array(((1.0, 3.0), (2.0, 4.0)))).tolist()
    [[1.0, 6.0], [5.0, 25.0]]
    """
    count = numbers[0].shape[-1]
    if not at_once:
        single = [function(*(each[..., k] for each in numbers)) for k in range(count)]
        return np.stack([np.asarray(sample) for sample in single], axis=-1)
    made = function(*map(_column, numbers))
    rows = [part.values if isinstance(part, Column) else part for part in np.atleast_1d(np.asarray(made, dtype=object))]
    matrix = np.array([np.broadcast_to(row, count) for row in rows])
    return matrix[0] if np.ndim(made) == 0 else matrix


def _column(numbers: AnyArray) -> Any:
    """A column, or an array of them."""
    return Column(numbers) if numbers.ndim == 1 else np.array([Column(row) for row in numbers], dtype=object)


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
