"""Values that scripts give, as a TOML file would hold them: numbers of other libraries as Python's own.

`check_nesting` limits the nesting of a TOML text before a parser spends time and memory on it.
"""

import datetime
import re
from collections.abc import Mapping
from numbers import Integral, Number
from typing import Any, Final

from abu_calc.foundation.errors import InputError, Place

DEEPEST: Final = 32
"""Steps of the longest key path, and brackets within brackets; our files go to 5."""

# Strings and comments as wholes; a chain of keys and points; brackets; runs of anything else.
_TOKEN: Final = re.compile(
    r'''"""(?:[^\\"]|\\.|"(?!""))*(?:"{3,5}|\Z)|\'{3}(?:[^']|'(?!''))*(?:'{3,5}|\Z)|"(?:[^"\\\n]|\\[^\n])*"?'''
    r"""|'[^'\n]*'?|\#[^\n]*|[A-Za-z0-9_-]+|\.|[ \t]+|[\[\]{}]|\n|[^A-Za-z0-9_.\-\s\[\]{}"'\#]+|.""",
    re.DOTALL,
)


def check_nesting(text: str, source: str) -> None:
    """Refuse a text nested more than 32 deep, in time that grows with its length alone."""
    if text.count(".") + text.count("[") + text.count("{") < DEEPEST:
        return
    line, depth, points = 1, 0, 0
    for token_match in _TOKEN.finditer(text):
        token = token_match[0]
        first = token[0]
        if first in "[{":
            depth += 1
        elif first in "]}":
            depth = max(depth - 1, 0)
        if first == ".":
            points += 1
        elif not (first in " \t\"'_-" or first.isalnum()):
            points = 0
        if depth > DEEPEST or points >= DEEPEST:
            raise InputError(
                "the file is nested too deeply",
                place=Place(source, line),
                allowed=f"at most {DEEPEST} keys in a path, and brackets within brackets",
            )
        line += token.count("\n")


ALLOWED: Final = "text, numbers, Python's True and False, dates, and lists, tuples or dictionaries of them"
LONGEST_FOUND: Final = 60


def plain_number(value: object) -> int | float | None:
    """An integer or float of Python's own for any real number, Decimal and NumPy's among them; None for all else.

    >>> plain_number(2), plain_number(2.5), plain_number("2"), plain_number(True), plain_number(2j)
    (2, 2.5, None, None, None)
    """
    if isinstance(value, bool) or not isinstance(value, Number):
        return None
    try:
        return int(value) if isinstance(value, Integral) else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):  # complex numbers, signalling NaN, fractions beyond all floats
        return None


def plain_value(value: object, key: str, depth: int = 0) -> Any:
    """A copy with lists for tuples. Raises InputError, naming the key, for what no file can hold, such as None."""
    if depth > DEEPEST:
        raise InputError(
            "nested too deeply", place=Place(key=key), allowed=f"at most {DEEPEST} lists or dictionaries in one another"
        )
    number = plain_number(value)
    if number is not None:
        return number
    if isinstance(value, (bool, datetime.date, datetime.time)):
        return value
    if isinstance(value, str):
        return str.__str__(value)  # of a subclass, such as NumPy's, too
    if isinstance(value, (list, tuple)):
        return [plain_value(each, key, depth + 1) for each in value]
    if isinstance(value, Mapping) and all(isinstance(inner, str) for inner in value):
        return {str.__str__(inner): plain_value(each, f"{key}.{inner}", depth + 1) for inner, each in value.items()}
    remedy = "Leave the entry out; to be without what the file has, read a file that does not have it."
    raise InputError(
        "not a value that a file can hold",
        place=Place(key=key),
        found=found_as(value),
        allowed=ALLOWED,
        remedy=remedy if value is None else None,
    )


def found_as(value: object) -> str:
    """Form in which messages show a value of Python, cut if it is long."""
    try:
        text = repr(value)
    except Exception:  # integers of thousands of digits have none, and whatever a script may define
        text = f"a value of type {type(value).__name__}"
    return text if len(text) <= LONGEST_FOUND else text[: LONGEST_FOUND - 1] + "…"
