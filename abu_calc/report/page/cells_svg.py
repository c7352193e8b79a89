"""Fields of cells as inline SVG: what a cell means is told by its size and shape, by color beside."""

from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.report.figures.chart import Cells
from abu_calc.report.page.chart_svg import LEGEND_ROW, LETTER, MARGIN, WIDE, svg
from abu_calc.report.page.words import text

TOP: Final = 22.0
LABELS: Final = 8
"""The most values that are written along an axis."""
LARGEST: Final = 26.0
"""Side of a cell."""
PARTS: Final = (0.3, 0.4, 0.62, 0.82, 1.0)
"""Size of the mark in a filled cell, as a share of the cell, by class; class 0 is a ring."""
SAMPLE: Final = 13.0
HIGH: Final = 300.0


def cells(name: str, chart: Cells) -> str:
    """The field, the values along both axes, and what the cells mean."""
    left = MARGIN + LETTER * max(map(len, chart.rows)) + 8
    wide = min((WIDE - left - 6) / len(chart.columns), LARGEST)
    high = min(HIGH / len(chart.rows), LARGEST)
    low = TOP + high * len(chart.rows)

    def marks() -> Iterator[str]:
        yield f'<text x="2" y="13">{text(chart.up)}</text>'
        for index, row in enumerate(chart.classes):
            y = low - high * (index + 1)
            yield from (_cell(each, left + wide * k, y, wide, high) for k, each in enumerate(row))
        yield f'<path class="axis" d="M{left} {TOP}V{low:.1f}H{left + wide * len(chart.columns):.1f}"/>'
        for k in _some(chart.rows, 14 / high):
            yield _word(chart.rows[k], left - 5, low - high * (k + 0.5) + 4, "end")
        for k in _some(chart.columns, LETTER * (max(map(len, chart.columns)) + 2) / wide):
            yield _word(chart.columns[k], left + wide * (k + 0.5), low + 15, "middle")
        right = max(left + wide * len(chart.columns), left + LETTER * len(chart.across))
        yield f'<text x="{right:.1f}" y="{low + 33:.1f}" text-anchor="end">{text(chart.across)}</text>'
        yield from legend

    entries = list(_entries(chart.words, low + 54))
    legend = [part for each in entries for part in _entry(*each)]
    return svg(name, chart, entries[-1][-1] + 8, marks())


def _some(words: Sequence[str], room: float) -> range:
    """Places of words that have room beside one another."""
    return range(0, len(words), max(1, -(-len(words) // LABELS), int(room) + 1))


def _word(word: str, x: float, y: float, anchor: str) -> str:
    return f'<text class="soft" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text(word)}</text>'


def _cell(kind: int | None, x: float, y: float, wide: float, high: float) -> str:
    across, up = x + wide / 2, y + high / 2
    if kind is None:
        return f'<path class="unknown" d="M{across - 2:.1f} {up - 2:.1f}l4 4m0 -4l-4 4"/>'
    if kind == 0:
        return f'<circle class="cell k0" cx="{across:.1f}" cy="{up:.1f}" r="{PARTS[0] * min(wide, high) / 2:.1f}"/>'
    w, h = PARTS[kind] * wide, PARTS[kind] * high
    return (
        f'<rect class="cell k{kind}" x="{across - w / 2:.1f}" y="{up - h / 2:.1f}" width="{w:.1f}" height="{h:.1f}"/>'
    )


def _entries(words: Sequence[tuple[int | None, str]], y: float) -> Iterator[tuple[int | None, str, float, float]]:
    """Legend entries beside one another, as far as there is room."""
    x = MARGIN
    for kind, word in words:
        wide = SAMPLE + 6 + LETTER * len(word) + 14
        if x > MARGIN and x + wide > WIDE:
            x, y = MARGIN, y + LEGEND_ROW
        yield kind, word, x, y
        x += wide


def _entry(kind: int | None, word: str, x: float, y: float) -> Iterator[str]:
    yield _cell(kind, x, y - 11, SAMPLE, SAMPLE)
    yield f'<text x="{x + SAMPLE + 6:.1f}" y="{y:.1f}">{text(word)}</text>'
