"""Shares as bars, and over two keys as a chart of signs."""

from collections.abc import Sequence
from typing import Final

from abu_calc.report.blocks import Block, Heading, Picture
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
Shares = Sequence[Sequence[float | None]]
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
    kind = kind_of(share)
    return " " if kind is None else SIGNS[kind]


def kind_of(share: float | None) -> int | None:
    """0: none, 1 to 3: a third of the members each, 4: all of them."""
    if share is None:
        return None
    return 0 if share <= 0 else 4 if share >= 1 else min(1 + int(3 * share), 3)


def title_of(chart: Chart) -> str:
    """Title of a chart: one key over the other."""
    return f"{chart.y_key} over {chart.x_key}"


def chart_blocks(chart: Chart, *, short: bool = False) -> list[Block]:
    """Each field of the chart; `short`: one of them, where not all cells are alike if there is such a one."""
    panels = fields(chart)
    if short:
        panels = [next((panel for panel in panels if len(_kinds(panel[1])) > 1), panels[0])]
    return [Heading(title_of(chart)), *(_picture(chart, *panel) for panel in panels)]


def _kinds(shares: Shares) -> set[int | None]:
    return {kind_of(share) for row in shares for share in row} - {None}


def fields(chart: Chart) -> list[tuple[str, Shares]]:
    """Fields of a chart: a description and the shares.

    The shares are those that balance, and those that meet all limits if that asks for more.
    """
    panels: list[tuple[str, Shares]] = [(WORDS[chart.of], chart.shares)]
    return panels if chart.meets is None else [*panels, (WORDS["meets_limits"], chart.meets)]


def _picture(chart: Chart, what: str, shares: Shares) -> Picture:
    """The second key upward, and what the signs mean."""
    columns, rows = few(len(chart.x), WIDE), few(len(chart.y), HIGH)
    width = max(1, WIDE // max(len(columns), 1) // 2) if len(columns) <= WIDE // 2 else 1
    labels = [label_of(chart.y[row]) for row in rows]
    margin = max(map(len, labels))
    lines = [
        f"{label:>{margin}} {''.join(sign(shares[row][column]) * width for column in columns)}"
        for label, row in reversed(list(zip(labels, rows, strict=True)))
    ]
    first, last = label_of(chart.x[columns[0]]), label_of(chart.x[columns[-1]])
    gap = max(width * len(columns) - len(first) - len(last), 1)
    lines.append(" " * (margin + 1) + first + " " * gap + last)
    about = f"{what}: {SIGNS[0]} none, ░ to a third, ▒ to two thirds, ▓ more, {FULL} all"
    shown = "" if len(columns) == len(chart.x) and len(rows) == len(chart.y) else "; not every value is shown"
    return Picture(tuple(lines), f"{about[0].upper()}{about[1:]}{shown}.", 2)


def few(count: int, most: int) -> list[int]:
    """Places of at most so many of a list, evenly through it."""
    step = -(-count // most)
    return list(range(0, count, step))


def label_of(value: float | str) -> str:
    """A value on an axis."""
    return value if isinstance(value, str) else number(float(value))
