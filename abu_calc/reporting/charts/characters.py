"""Charts as small pictures in characters that every console has: lines, points and limits differ by their signs."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Final

from abu_calc.reporting.blocks import Block, Picture
from abu_calc.reporting.charts.chart import Axis, Curve, Figure, MarkedPoint, Plot
from abu_calc.reporting.screen import section_id, sections

WIDE: Final = 60
HIGH: Final = 12
"""Columns and rows of the field."""
LEVELS: Final = ".-'"
"""Signs of a line in a row, by its height there."""
STEEP: Final = "|"
OTHERS: Final = "+x%"
"""Signs of a second line, and so on."""
POINTS: Final = "O#%"
"""Signs of points, by series."""
LIMIT: Final = "="
BAND: Final = ":"

Field = list[list[str]]


def pictured(blocks: Iterable[Block], figures: Sequence[Figure]) -> tuple[Block, ...]:
    """Blocks, each chart of the figures below those of its section."""
    output: list[Block] = []
    for part in sections(blocks):
        output += part
        output += (
            Picture(tuple(characters(figure.shown)), f"{figure.shown.title}.{_signs(figure.shown)}", 2)
            for figure in figures
            if figure.section and figure.section == section_id(part) and isinstance(figure.shown, Plot)
        )
    return tuple(output)


def characters(plot: Plot) -> list[str]:
    """The chart in lines of at most 76 columns."""
    field = [[" "] * WIDE for _ in range(HIGH)]
    for first, last in plot.bands:
        for column in range(max(_column(plot.across, first), 0), min(_column(plot.across, last) + 1, WIDE)):
            for row in field:
                row[column] = BAND
    if plot.limit:
        place = _row(plot.up, plot.limit[0])[0]
        field[place][::2] = [LIMIT] * len(field[place][::2])
        # The word in the middle, where neither axis nor the ends of lines are.
        _say(field, place, (WIDE - len(plot.limit[1])) // 2, f" {plot.limit[1]} ")
    names = [entry.series for entry in plot.legend]
    for line in plot.lines:
        _draw(field, plot, line, names.index(line.series) if line.series in names else 0)
    for point in plot.points:
        _mark(field, plot, point)
    return list(_framed(field, plot))


def _signs(plot: Plot) -> str:
    """Legend of the characters that do not explain themselves."""
    words = [f"{OTHERS[k - 1] if k else LEVELS} {line.name}" for k, line in enumerate(plot.legend)]
    words += [f"{BAND} not stable"] if plot.bands else []
    return f" {'; '.join(words)}." if words else ""


def _column(axis: Axis, value: float) -> int:
    return min(max(round(axis.share(value) * (WIDE - 1)), 0), WIDE - 1)


def _row(axis: Axis, value: float) -> tuple[int, int]:
    """The row, from above, and how high in it: 0 to 2."""
    fine = len(LEVELS) * HIGH
    place = min(max(int(axis.share(value) * fine), 0), fine - 1)
    return HIGH - 1 - place // len(LEVELS), place % len(LEVELS)


def _draw(field: Field, plot: Plot, line: Curve, kind: int) -> None:
    """Column by column, from the lowest to the highest value there."""
    reach: dict[int, list[float]] = {}
    for (x, y), (after, then) in pairwise([*line.points, line.points[-1]]):
        first, last = _column(plot.across, x), _column(plot.across, after)
        reach.setdefault(first, []).append(y)
        for column in range(first, last + 1 if last > first else first):
            # To the edges of each column, so that steep lines have no gaps.
            shares = ((column - first + edge) / (last - first) for edge in (-0.49, 0.49))
            reach.setdefault(column, []).extend(y + min(max(share, 0.0), 1.0) * (then - y) for share in shares)
    for column, values in reach.items():
        (low, below), (high, above) = _row(plot.up, min(values)), _row(plot.up, max(values))
        for row in range(high, low + 1):
            sign = STEEP if low - high > 1 and high < row < low else LEVELS[above if row == high else below]
            field[row][column] = OTHERS[kind - 1] if kind else sign


def _mark(field: Field, plot: Plot, point: MarkedPoint) -> None:
    """A sign, and its word on the side where there is room."""
    column, row = _column(plot.across, point.x), _row(plot.up, point.y)[0]
    word = f" {point.word}" if point.word else ""
    _say(field, row, column + 1 if column + 1 + len(word) <= WIDE else column - len(word) - 1, word and f"{word} ")
    field[row][column] = POINTS[min(point.series, len(POINTS)) - 1]


def _say(field: Field, row: int, start: int, words: str) -> None:
    for place, sign in enumerate(words, start):
        if 0 <= place < WIDE:
            field[row][place] = sign


def _framed(field: Field, plot: Plot) -> Iterator[str]:
    """The field with its axes: their names, some round numbers."""
    labels = {_row(plot.up, tick)[0]: _number(tick) for tick in plot.up.ticks}
    margin = max(map(len, labels.values()), default=0)
    yield f"{'':{margin}} {plot.up.name}"
    for index, row in enumerate(field):
        edge = "+" if index in labels else "|"
        yield f"{labels.get(index, ''):>{margin}} {edge}{''.join(row)}".rstrip()
    ticks = [(_column(plot.across, tick), _number(tick)) for tick in plot.across.ticks]
    base, below = ["-"] * WIDE, [" "] * (WIDE + margin + 8)
    for column, word in ticks:
        base[column] = "+"
        start = margin + 2 + column - len(word) // 2
        below[start : start + len(word)] = word
    yield f"{'':{margin}} +{''.join(base)}"
    yield "".join(below).rstrip()
    yield f"{plot.across.name:>{margin + 2 + WIDE}}"


def _number(value: float) -> str:
    return "0" if math.isclose(value, 0.0, abs_tol=1e-9) else f"{value:.6g}"
