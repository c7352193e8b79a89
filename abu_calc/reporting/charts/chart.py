"""Charts as data: axes with units, lines, points, bars, limits, forbidden bands."""

import math
from collections.abc import Iterable, Sequence
from typing import Final, NamedTuple

from abu_calc.reporting.blocks import number

FIELD: Final = 354 / 204
"""Width over height of a plot's field."""


class Axis(NamedTuple):
    """Axis of a chart: its quantity with the unit, and its range; `log`: in decades."""

    name: str
    low: float
    high: float
    log: bool = False

    @classmethod
    def around(cls, name: str, values: Iterable[float], *, zero: bool = False) -> "Axis":
        """An axis with room beside all values; `zero`: from zero."""
        numbers = list(values)
        low, high = min(numbers), max(numbers)
        margin = 0.08 * ((high - low) or abs(high) or 1.0)
        return cls(name, 0.0 if zero else low - margin, high + margin)

    @classmethod
    def decades(cls, name: str, values: Iterable[float]) -> "Axis":
        """A logarithmic axis over whole decades that hold all values, which are above zero."""
        numbers = list(values)
        low, high = math.floor(math.log10(min(numbers))), math.ceil(math.log10(max(numbers)))
        return cls(name, 10.0**low, 10.0 ** max(high, low + 1), log=True)

    @property
    def ticks(self) -> list[float]:
        """Some five round numbers; decades, of many every second or third."""
        if self.log:
            first, last = round(math.log10(self.low)), round(math.log10(self.high))
            return [10.0**power for power in range(first, last + 1, -(-(last - first) // 7))]
        rough = (self.high - self.low) / 5
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(power * part for part in (1, 2, 5, 10) if power * part >= rough)
        return [step * k for k in range(math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9) + 1)]

    def share(self, value: float) -> float:
        """Share of the axis at which a value lies."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


def alike(across: str, up: str, values: Iterable[tuple[float, float]]) -> tuple[Axis, Axis]:
    """Two axes of one scale, the origin in their middle."""
    reach = 1.1 * max(max(abs(x) / FIELD, abs(y)) for x, y in values) or 1.0
    return Axis(across, -FIELD * reach, FIELD * reach), Axis(up, -reach, reach)


class MarkedPoint(NamedTuple):
    """A point with a word beside it; `series` (1 to 8) chooses color and shape: 1 round, 2 hollow square, 3 hollow
    lozenge, 4 hollow triangle, 5 to 8 the same shapes and colors, filled where those are hollow.
    """

    x: float
    y: float
    word: str = ""
    series: int = 1


class Curve(NamedTuple):
    """A course; `name` stands in the legend where there are several, `series` (1 to 8) chooses color and dashes."""

    points: Sequence[tuple[float, float]]
    name: str = ""
    series: int = 1


class Bar(NamedTuple):
    """A length from `start`, its name and its value as text; `series` as of points, `span`: where its end may lie."""

    name: str
    value: float
    text: str
    series: int = 1
    start: float = 0.0
    span: tuple[float, float] | None = None


class Plot(NamedTuple):
    """Contents of a field between two axes.

    `summary`: its text alternative, `limit`: of y, `bands`: forbidden x.
    """

    title: str
    summary: str
    across: Axis
    up: Axis
    lines: Sequence[Curve] = ()
    points: Sequence[MarkedPoint] = ()
    limit: tuple[float, str] | None = None
    bands: Sequence[tuple[float, float]] = ()

    @property
    def legend(self) -> Sequence[Curve]:
        """Lines that need their names told, one for each name: there is more than one name."""
        named = {line.name: line for line in self.lines if line.name}
        return tuple(named.values()) if len(named) > 1 else ()


class Bars(NamedTuple):
    """Lengths below one another, each under its name, with the limit across them all.

    On an axis that does not begin at zero, as levels have it, points stand instead of lengths.
    """

    title: str
    summary: str
    axis: Axis
    rows: Sequence[Bar]
    limit: tuple[float, str] | None = None


class Cells(NamedTuple):
    """A field of cells over two lists of values, the first row lowest; a cell grows with its class, 0 to 4.

    `classes[row][column]`: None where nothing is known; `words`: what each class means.
    """

    title: str
    summary: str
    across: str
    up: str
    columns: Sequence[str]
    rows: Sequence[str]
    classes: Sequence[Sequence[int | None]]
    words: Sequence[tuple[int | None, str]]


def db(value: float) -> str:
    """A level as tables show it."""
    return f"{value:.1f} dB"


def micrometres(value: float) -> str:
    """A displacement as tables show it."""
    return f"{number(value, 3)} µm"
