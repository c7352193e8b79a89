"""A number before and after a change, as actions on checks tell it."""

import math
from typing import Final

from abu_calc.foundation.frozen import dataclass

DECIMALS: Final = range(1, 5)
"""Decimals of levels, the fewest first."""
DIGITS: Final = range(3, 9)
"""Significant digits of other numbers, the fewest first."""


@dataclass(frozen=True)
class Moved:
    """A quantity before and after a change, in `unit` as printed; `limit`: what it is held against."""

    quantity: str
    before: float
    after: float
    unit: str
    limit: float | None = None

    @property
    def text(self) -> str:
        """The change as a clause.

        >>> Moved("the worst friction case", 113.49, 107.96, "dB", 109.0).text
        'the worst friction case falls from 113.5 to 108.0 dB'
        """
        before, after = figures(self.before, self.after, self.limit, self.unit)
        if before == after:
            return f"{self.quantity} stays at {after} {self.unit}".rstrip()
        verb = "falls" if self.after < self.before else "rises"
        return f"{self.quantity} {verb} from {before} to {after} {self.unit}".rstrip()


def figures(before: float, after: float, limit: float | None, unit: str) -> tuple[str, str]:
    """Two numbers as text, with so many digits that they differ, and that none is shown across the limit.

    >>> figures(109.03, 108.98, 109.0, "dB"), figures(1.0229, 0.65, 1.0, "s"), figures(math.inf, 0.5, 1.0, "s")
    (('109.03', '108.98'), ('1.02', '0.650'), ('never', '0.500'))
    """
    for digits in DECIMALS if unit == "dB" else DIGITS:
        texts = [_text(value, digits, unit) for value in (before, after)]
        shown = [math.inf if text == "never" else float(text) for text in texts]
        kept = limit is None or [x <= limit for x in shown] == [x <= limit for x in (before, after)]
        if shown[0] != shown[1] and kept:
            break
    return texts[0], texts[1]


def _text(value: float, digits: int, unit: str) -> str:
    if math.isinf(value):
        return "never"
    if value == 0 or not unit:
        return f"{value:g}"
    if unit == "dB":
        return f"{value:.{digits}f}"
    whole = f"{value:#.{digits}g}"
    return f"{float(whole):.0f}" if "e" in whole and abs(value) >= 1 else whole.rstrip(".")
