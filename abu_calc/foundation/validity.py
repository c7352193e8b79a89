"""Range in which a formula holds, as data that the code checks."""

import math

from abu_calc.foundation.errors import Place, RangeError
from abu_calc.foundation.frozen import dataclass


def bounded(value: float) -> str:
    """A bound as a sentence writes it.

    >>> bounded(300_000), bounded(1e9), bounded(1e-8)
    ('300000', '1e9', '1e-8')
    """
    return f"{value:g}".replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


@dataclass(frozen=True)
class Range:
    """An interval of one quantity, in `unit` (SI unless the name says otherwise)."""

    name: str
    low: float
    high: float = math.inf
    unit: str = ""
    open_low: bool = False
    remedy: str | None = None
    key: str | None = None
    """Key path of the entry of a file that the quantity comes from, where there is one."""

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.high):
            return f"{'above' if self.open_low else 'at least'} {bounded(self.low)}{unit}"
        return f"{'above ' if self.open_low else ''}{bounded(self.low)} … {bounded(self.high)}{unit}"

    def check(self, value: float) -> float:
        """The value itself when it is inside; NaN never is.

        >>> Range("cutting coefficient", 0, 1.5).check(0.35)
        0.35
        """
        above = value > self.low if self.open_low else value >= self.low
        if above and value <= self.high:
            return value
        unit = f" {self.unit}" if self.unit else ""
        raise RangeError(
            f"{self.name} is outside its range",
            place=Place(key=self.key),
            found=f"{value:g}{unit}",
            allowed=str(self),
            remedy=self.remedy,
        )
