"""Equations at many samples in the calls of one: NumPy's calls cost the same for one number as for hundreds."""

import operator
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

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
        if isinstance(other, Column):
            return Column(operation(self.values, other.values))
        return Column(operation(self.values, other)) if isinstance(other, NUMBER) else NotImplemented

    def left(self: Column, other: Any) -> Any:
        return Column(operation(other, self.values)) if isinstance(other, NUMBER) else NotImplemented

    return right, left


for _name in ("add", "sub", "mul", "truediv", "pow"):
    _right, _left = _operations(getattr(operator, _name))
    setattr(Column, f"__{_name}__", _right)
    setattr(Column, f"__r{_name}__", _left)


def at_samples(function: Callable[..., Any], *numbers: Array, at_once: bool = True) -> Array:
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


def _column(numbers: Array) -> Any:
    """A column, or an array of them."""
    return Column(numbers) if numbers.ndim == 1 else np.array([Column(row) for row in numbers], dtype=object)
