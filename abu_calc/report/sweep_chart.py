"""Shares as bars, and over two keys as a chart of signs."""

from typing import Final

from abu_calc.report.blocks import Block, Heading, Paragraph
from abu_calc.report.numbers import number
from abu_calc.studies.sweeping.records import Chart

BAR: Final = 24
"""Signs of a bar that is full."""
FULL: Final = "█"
SIGNS: Final = "·░▒▓█"
"""No member, up to a quarter and so on, and every member."""
WIDE: Final = 60
HIGH: Final = 24
"""The most columns and rows of a chart."""
WORDS: Final = {"balances": "the share that balances", "meets_limits": "the share that meets the limits"}


def bar(share: float) -> str:
    """A share as a bar.

    >>> bar(0.25)
    '██████'
    """
    return FULL * round(BAR * min(max(share, 0.0), 1.0))


def sign(share: float | None) -> str:
    """A share as one sign.

    >>> "".join(sign(share) for share in (None, 0.0, 0.1, 0.5, 0.9, 1.0))
    ' ·░▒▓█'
    """
    if share is None:
        return " "
    return SIGNS[0] if share <= 0 else SIGNS[-1] if share >= 1 else SIGNS[min(1 + int(3 * share), 3)]


def chart_blocks(chart: Chart) -> list[Block]:
    """The chart, the second key upward, with what its signs mean."""
    columns, rows = _few(len(chart.x), WIDE), _few(len(chart.y), HIGH)
    width = max(1, WIDE // max(len(columns), 1) // 2) if len(columns) <= WIDE // 2 else 1
    labels = [_label(chart.y[row]) for row in rows]
    margin = max(map(len, labels))
    lines = [
        f"{label:>{margin}} {''.join(sign(chart.shares[row][column]) * width for column in columns)}"
        for label, row in reversed(list(zip(labels, rows, strict=True)))
    ]
    first, last = _label(chart.x[columns[0]]), _label(chart.x[columns[-1]])
    gap = max(width * len(columns) - len(first) - len(last), 1)
    lines.append(" " * (margin + 1) + first + " " * gap + last)
    about = f"{WORDS.get(chart.of, chart.of)}: {SIGNS[0]} none, ░ to a third, ▒ to two thirds, ▓ more, {FULL} all"
    shown = "" if len(columns) == len(chart.x) and len(rows) == len(chart.y) else "; not every value is shown"
    return [
        Heading(f"{chart.y_key} over {chart.x_key}"),
        Paragraph(f"{about}{shown}."),
        *(Paragraph(line.replace(" ", "\u00a0")) for line in lines),
    ]


def _few(count: int, most: int) -> list[int]:
    """Places of at most so many of a list, evenly through it."""
    step = -(-count // most)
    return list(range(0, count, step))


def _label(value: float | str) -> str:
    return value if isinstance(value, str) else number(float(value))
