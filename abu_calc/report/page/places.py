"""Placement of words in a chart: they cover the least of lines, points and other words."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import ceil, hypot
from typing import Final, NamedTuple

Place = tuple[float, float]
NEAR: Final = 3.0
"""Distance between places that stand for a line [px]."""
HIGH: Final = 10.0
BELOW: Final = 3.0
"""Height of letters above the line they stand on; `BELOW`: depth below it [px]."""


class Box(NamedTuple):
    """A part of a chart."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: "Box") -> bool:
        """True if both boxes have anything in common."""
        across = self.left < other.right and other.left < self.right
        return across and self.top < other.bottom and other.top < self.bottom


class Word(NamedTuple):
    """Words that begin, end or have their middle (`anchor` start, end, middle) at x, standing on y."""

    x: float
    y: float
    anchor: str
    wide: float

    @property
    def box(self) -> Box:
        """Box that the word takes."""
        left = self.x - {"start": 0.0, "middle": 0.5, "end": 1.0}[self.anchor] * self.wide
        return Box(left, self.y - HIGH, left + self.wide, self.y + BELOW)


class Places:
    """Places taken in a field; words are put in one after another."""

    def __init__(self, field: Box, lines: Iterable[Sequence[Place]], points: Iterable[Place]) -> None:
        self.field = field
        self.taken = [point for line in lines for point in _along(line)]
        self.taken += [(x + dx, y + dy) for x, y in points for dx in (-4, 0, 4) for dy in (-4, 0, 4)]
        self.words: list[Box] = []

    def put(self, choices: Sequence[Word]) -> Word:
        """The choice that covers least, of those alike the first; it is taken from now on."""
        chosen = min(choices, key=lambda word: self._covered(word.box))
        self.words.append(chosen.box)
        return chosen

    def _covered(self, box: Box) -> tuple[bool, bool, bool, int]:
        """The worst first: beside the field, upon other words, above or below the field, upon so much of the rest."""
        field = self.field
        beside = box.left < field.left or box.right > field.right
        outside = box.top < field.top or box.bottom > field.bottom
        inside = sum(box.left <= x <= box.right and box.top <= y <= box.bottom for x, y in self.taken)
        return beside, any(box.meets(other) for other in self.words), outside, inside


def _along(line: Sequence[Place]) -> Iterator[Place]:
    yield from line[:1]
    for (x, y), (to_x, to_y) in pairwise(line):
        steps = max(1, ceil(hypot(to_x - x, to_y - y) / NEAR))
        yield from ((x + (to_x - x) * k / steps, y + (to_y - y) * k / steps) for k in range(1, steps + 1))
