"""Origin of each value of a machine file, as the comment behind it says: published, assumed, or fitted to a result."""

import re
from typing import Annotated, Final, Literal

from abu_calc.foundation.quantity import Quantity, Record, record

Status = Literal["published", "assumed", "fitted"]
TABLE: Final = re.compile(r"\[{1,2}([\w.]+)\]{1,2}\s*(#.*)?")
VALUE: Final = re.compile(r"(\w+)\s*=\s*(.*?)\s+#\s*(published|assumed|fitted): (.+)")
ENTRY: Final = re.compile(r"(\w+)\s*=")
OUTSIDE: Final = ("measured", "expected")
"""Tables whose values are no assumptions of the model."""


@record
class ValueSource(Record):
    """One value of a machine file and its origin; a fitted one was chosen to reach a published result."""

    key: Annotated[str, Quantity("key")]
    status: Annotated[str | None, Quantity("origin", "", 4, "published, assumed or fitted; null: not said")]
    why: Annotated[str, Quantity("why")]


def value_sources(text: str) -> tuple[ValueSource, ...]:
    """Origin of every value of a machine file, in the order of the file.

    A comment behind the value begins with "published:", "assumed:" or "fitted:".

    >>> [value] = value_sources('[wheel]\\nrunout_mm = 0.09  # fitted: so that the load needs four balls')
    >>> value.key, value.status, value.why
    ('wheel.runout_mm', 'fitted', 'so that the load needs four balls')
    """
    values, table = [], ""
    for line in map(str.strip, text.splitlines()):
        if heading := TABLE.fullmatch(line):
            table = heading[1]
        elif table.split(".")[0] not in OUTSIDE and (entry := ENTRY.match(line)):
            origin = VALUE.fullmatch(line)
            values.append(
                ValueSource(key=f"{table}.{entry[1]}", status=origin and origin[3], why=origin[4] if origin else "")
            )
    return tuple(values)


def degrees_of_freedom(sources: tuple[ValueSource, ...]) -> int | None:
    """Number of fitted values; None if the file does not say the origin of every value."""
    if not sources or any(source.status is None for source in sources):
        return None
    return sum(source.status == "fitted" for source in sources)
