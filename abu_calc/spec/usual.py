"""The usual range of a key, as data beside its field: narrower than what is allowed, wide where practice is wide.

A number outside is read and warned of: most such numbers are in the wrong unit. Zero is not, it says "none" (of
levels it does not); of a negative number the size counts.
"""

from typing import Final, NamedTuple, cast

from pydantic.config import JsonDict
from pydantic.fields import FieldInfo

from abu_calc.validity import bounded

WORD: Final = "x-usual"
"""The word of the schema: [lowest, highest]."""


class Usual(NamedTuple):
    """A usual range, in the unit of its key."""

    low: float
    high: float

    def holds(self, value: float) -> bool:
        """True if a number is zero or within the usual range, so that no question arises.

        >>> usual = Usual(1, 1000)
        >>> [usual.holds(value) for value in (0, 0.1, -200, 2000)]
        [True, False, True, False]
        """
        return value == 0 or self.low <= abs(value) <= self.high

    def __str__(self) -> str:
        return f"{bounded(self.low)} … {bounded(self.high)}"


def usual(low: float, high: float) -> JsonDict:
    """A field's usual range, for its `json_schema_extra`."""
    return {WORD: [low, high]}


def usual_of(field: FieldInfo) -> Usual | None:
    """The usual range of a field, where it has one."""
    extra = field.json_schema_extra
    if not isinstance(extra, dict) or WORD not in extra:
        return None
    return Usual(*cast("list[float]", extra[WORD]))
