"""Tables laid out in lines: how wide each column is, and the lines of its cells side by side."""

import re
import unicodedata
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import zip_longest
from typing import TypeAlias

Piece: TypeAlias = tuple[str, str]
"""Text on one line and its style."""
Line: TypeAlias = tuple[Piece, ...]

_BETWEEN_WORDS = re.compile(r"(?<=\s)(?=\S)")


@lru_cache(maxsize=4096)
def columns(text: str) -> int:
    """How many columns of a terminal a text takes.

    >>> columns("µm"), columns("轴"), columns("e\u0301")
    (2, 2, 1)
    """
    if text.isascii():
        return len(text)
    return sum(0 if unicodedata.combining(one) else 1 + (unicodedata.east_asian_width(one) in "WF") for one in text)


def widths_within(rows: Sequence[Sequence[Piece]], room: int) -> list[int]:
    """The widest cell of each column; where that is too much the widest columns give way, as evenly as they can.

    >>> widths_within([[("a", ""), ("a sentence", "")]], 6)
    [1, 5]
    """
    widths = [max(columns(text) for text, _ in column) for column in zip(*rows, strict=True)]
    room = max(room, len(widths))
    while sum(widths) > room:
        widest = max(widths)
        most = [index for index, width in enumerate(widths) if width == widest]
        next_widest = max((width for width in widths if width < widest), default=0)
        give = min(sum(widths) - room, (widest - next_widest) * len(most))
        for rank, index in enumerate(most):
            widths[index] -= give // len(most) + (rank < give % len(most))
    return widths


def table_lines(
    rows: Sequence[Sequence[Piece]], widths: Sequence[int], margin: int, right: frozenset[int] = frozenset()
) -> Iterator[Line]:
    """Rows with `margin` blanks before each column; a cell that is too long goes on in the lines below."""
    gap = " " * margin
    for row in rows:
        parts = [_wrapped(text, width) for (text, _), width in zip(row, widths, strict=True)]
        for texts in zip_longest(*parts, fillvalue=""):
            yield tuple(
                (gap + (_blanks(text, width) + text if index in right else text + _blanks(text, width)), style)
                for index, (text, width, (_, style)) in enumerate(zip(texts, widths, row, strict=True))
            )


def _blanks(text: str, width: int) -> str:
    return " " * (width - columns(text))


def _wrapped(text: str, width: int) -> list[str]:
    """A cell in lines; a word that is longer than one is cut."""
    if columns(text) <= width:
        return [text]
    lines = [""]
    for word in _BETWEEN_WORDS.split(text):
        if columns(lines[-1] + word.rstrip()) <= width:
            lines[-1] += word
            continue
        *cut, rest = _cut(word, width)
        lines += [*cut, rest]
    return [line.rstrip() for line in lines if line.strip()]


def _cut(word: str, width: int) -> list[str]:
    pieces = [""]
    for one in word.rstrip():
        if pieces[-1] and columns(pieces[-1]) + columns(one) > width:
            pieces.append("")
        pieces[-1] += one
    pieces[-1] += word[len(word.rstrip()) :]
    return pieces
