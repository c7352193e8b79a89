"""Limit on the nesting of a TOML text, checked before a parser spends time and memory on it."""

import re
from typing import Final

from abu_calc.errors import InputError, Place

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
    if text.count(".") + text.count("[") + text.count("{") <= DEEPEST:
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
