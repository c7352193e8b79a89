"""Charts as inline SVG, told apart by shape and word, not by colour alone.

Words are placed so that they cover the least of lines, points and other words. In fields of cells size and shape give
the meaning, with colour beside.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import ceil, hypot
from typing import Final, NamedTuple

from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Cells, Curve, Plot
from abu_calc.reporting.page.card import text

Place = tuple[float, float]
NEAR: Final = 3.0
"""Distance between places that stand for a line [px]."""
HIGH: Final = 10.0
BELOW: Final = 3.0
"""Height of letters above the line they stand on; `BELOW`: depth below it [px]."""


class LabelBox(NamedTuple):
    """A part of a chart."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: "LabelBox") -> bool:
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
    def box(self) -> LabelBox:
        """Box that the word takes."""
        left = self.x - {"start": 0.0, "middle": 0.5, "end": 1.0}[self.anchor] * self.wide
        return LabelBox(left, self.y - HIGH, left + self.wide, self.y + BELOW)


class Places:
    """Places taken in a field; words are put in one after another."""

    def __init__(self, field: LabelBox, lines: Iterable[Sequence[Place]], points: Iterable[Place]) -> None:
        self.field = field
        self.taken = [point for line in lines for point in _along(line)]
        self.taken += [(x + dx, y + dy) for x, y in points for dx in (-4, 0, 4) for dy in (-4, 0, 4)]
        self.words: list[LabelBox] = []

    def put(self, choices: Sequence[Word]) -> Word:
        """The choice that covers least, of those alike the first; it is taken from now on."""
        chosen = min(choices, key=lambda word: self._covered(word.box))
        self.words.append(chosen.box)
        return chosen

    def _covered(self, box: LabelBox) -> tuple[bool, bool, bool, int]:
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


WIDE: Final = 420.0
CHART_HIGH: Final = 270.0
LEFT, RIGHT, TOP, CHART_BELOW = 52.0, 14.0, 22.0, 44.0
"""Around the field of a chart."""
ROW: Final = 35.0
"""Height of a row in a chart of bars: a name, and the bar below it."""
MARGIN: Final = 8.0
VALUES: Final = 74.0
"""Width that the values beside bars take."""
LETTER: Final = 6.8
"""Approximate width of a letter."""
SAMPLE: Final = 34.0
"""Length that a piece of line takes in a legend."""
FILLED: Final = (1, 6, 7, 8)
"""Series whose points are."""
FORBIDDEN: Final = "not stable"
"""Text in bands that are wide enough."""
LEGEND_ROW: Final = 18.0


def plot(name: str, chart: Plot) -> str:
    """A field between two axes; `name` makes its parts' names single on the page."""
    right, low = WIDE - RIGHT, CHART_HIGH - CHART_BELOW

    def at(x: float, y: float) -> tuple[float, float]:
        return LEFT + chart.across.share(x) * (right - LEFT), low - chart.up.share(y) * (low - TOP)

    lines = [[at(*each) for each in line.points] for line in chart.lines]
    points = [at(each.x, each.y) for each in chart.points]
    bound = [] if chart.limit is None else [at(x, chart.limit[0]) for x in (chart.across.low, chart.across.high)]
    places = Places(LabelBox(LEFT, TOP - 6, WIDE, low), [*lines, bound], points)

    def marks() -> Iterator[str]:
        for first, last in chart.bands:
            start, end = (max(LEFT, min(right, at(x, chart.up.low)[0])) for x in (first, last))
            yield f'<rect class="band" x="{start:.1f}" y="{TOP}" width="{end - start:.1f}" height="{low - TOP}"/>'
            wide = LETTER * len(FORBIDDEN)
            if end - start > wide:
                middle = (start + end) / 2
                choices = [Word(middle, y, "middle", wide) for y in (low - 6, TOP + 14)]
                yield _written(FORBIDDEN, places.put(choices), "soft")
        if chart.limit:
            yield f'<path class="limit" d="M{LEFT} {bound[0][1]:.1f}H{right}"/>'
        for line, course in zip(chart.lines, lines, strict=True):
            path = "L".join(f"{x:.1f} {y:.1f}" for x, y in course)
            yield f'<path class="line s{line.series}" d="M{path}"/>'
        yield from (_mark(each.series, *place) for each, place in zip(chart.points, points, strict=True))
        if chart.limit:
            yield _written(chart.limit[1], places.put(_beside_limit(chart.limit[1], bound[0][1], right)), "limit-name")
        for each, place in zip(chart.points, points, strict=True):
            if each.word:
                yield _written(each.word, places.put(_beside(each.word, *place, right)))

    entries = list(_entries(chart.legend))
    high = max((y for *_, y in entries), default=CHART_HIGH - 8) + 8
    marked = {each.series for each in chart.points if not each.word}
    legend = (part for each in entries for part in _entry(*each, marked=each[0].series in marked))
    return svg(name, chart, high, (*_axes(chart.across, chart.up), *marks(), *legend))


def _entries(lines: Sequence[Curve]) -> Iterator[tuple[Curve, float, float]]:
    """Lines of a legend, and where each stands: beside one another below the chart, as far as there is room."""
    x, y = MARGIN, CHART_HIGH + 10
    for line in lines:
        wide = SAMPLE + LETTER * len(line.name) + 14
        if x > MARGIN and x + wide > WIDE:
            x, y = MARGIN, y + LEGEND_ROW
        yield line, x, y
        x += wide


def _entry(line: Curve, x: float, y: float, *, marked: bool) -> Iterator[str]:
    yield f'<path class="line s{line.series}" d="M{x:.1f} {y - 4:.1f}h{SAMPLE - 6:.1f}"/>'
    if marked:
        yield _mark(line.series, x + (SAMPLE - 6) / 2, y - 4)
    yield f'<text x="{x + SAMPLE:.1f}" y="{y:.1f}">{text(line.name)}</text>'


def bars(name: str, chart: Bars) -> str:
    """Lengths or points below one another."""
    axis, limit = chart.axis, chart.limit
    low, right = TOP + ROW * len(chart.rows), WIDE - VALUES

    def at(value: float) -> float:
        return MARGIN + axis.share(value) * (right - MARGIN)

    def marks() -> Iterator[str]:
        for tick in axis.ticks:
            yield f'<path class="grid" d="M{at(tick):.1f} {TOP}V{low}"/>'
            yield f'<text class="soft" x="{at(tick):.1f}" y="{low + 17}" text-anchor="middle">{_tick(tick)}</text>'
        yield f'<text x="{MARGIN}" y="{low + 33}">{text(axis.name)}</text>'
        if limit:
            x = at(limit[0])
            anchor = "end" if axis.share(limit[0]) > 0.5 else "start"
            yield f'<path class="limit" d="M{x:.1f} {TOP}V{low}"/>'
            yield f'<text class="limit-name" x="{x:.1f}" y="{TOP - 6}" text-anchor="{anchor}">{text(limit[1])}</text>'
        for index, bar in enumerate(chart.rows):
            y = TOP + ROW * index
            yield f'<text x="{MARGIN}" y="{y + 13}">{text(_short(bar.name))}</text>'
            yield (
                _length(bar, at(bar.start), at(bar.value), y + 19)
                if axis.low <= 0
                else _mark(bar.series, at(bar.value), y + 25)
            )
            if bar.span:
                yield _span(at(bar.span[0]), at(bar.span[1]), y + 24.5)
            yield f'<text x="{WIDE}" y="{y + 29}" text-anchor="end">{text(bar.text)}</text>'

    return svg(name, chart, low + CHART_BELOW - 4, marks())


def _short(name: str) -> str:
    """One that has no room without its middle; the text alternative has it whole."""
    most = int((WIDE - MARGIN) / LETTER)
    return name if len(name) <= most else f"{name[: most // 2]}…{name[len(name) - most // 2 + 1 :]}"


def _length(bar: Bar, start: float, end: float, y: float) -> str:
    left, wide = min(start, end), max(abs(end - start), 1.0)
    return f'<rect class="f{bar.series}" x="{left:.1f}" y="{y:.1f}" width="{wide:.1f}" height="11"/>'


def _span(low: float, high: float, y: float) -> str:
    """A line with an end at either side."""
    return f'<path class="span" d="M{low:.1f} {y - 4:.1f}v8m0 -4H{high:.1f}m0 -4v8"/>'


def svg(name: str, chart: Plot | Bars | Cells, high: float, parts: Iterable[str]) -> str:
    """The element, with its title and text alternative."""
    named = f"chart-{name}"
    return "\n".join((
        f'<svg class="chart" viewBox="0 0 {WIDE:g} {high:g}" role="img" aria-labelledby="{named}-t {named}-d">',
        f'<title id="{named}-t">{text(chart.title)}</title><desc id="{named}-d">{text(chart.summary)}</desc>',
        *parts,
        "</svg>",
    ))  # fmt: skip


def _axes(across: Axis, up: Axis) -> Iterator[str]:
    right, low = WIDE - RIGHT, CHART_HIGH - CHART_BELOW
    for tick in across.ticks:
        x = LEFT + across.share(tick) * (right - LEFT)
        yield f'<path class="grid" d="M{x:.1f} {TOP}V{low}"/>'
        label = _tick(tick, log=across.log)
        x = min(x, WIDE - 2 - LETTER * len(label) / 2)
        yield f'<text class="soft" x="{x:.1f}" y="{low + 17}" text-anchor="middle">{label}</text>'
    for tick in up.ticks:
        y = low - up.share(tick) * (low - TOP)
        yield f'<path class="grid" d="M{LEFT} {y:.1f}H{right}"/>'
        yield f'<text class="soft" x="{LEFT - 5}" y="{y + 4:.1f}" text-anchor="end">{_tick(tick, log=up.log)}</text>'
    yield f'<path class="axis" d="M{LEFT} {TOP}V{low}H{right}"/>'
    yield f'<text x="{right}" y="{low + 33}" text-anchor="end">{text(across.name)}</text>'
    yield f'<text x="2" y="13">{text(up.name)}</text>'


def _beside_limit(words: str, y: float, right: float) -> list[Word]:
    """Places for a word above or below a limit, at its right or left end."""
    wide = LETTER * len(words)
    ends = ((right, "end"), (LEFT + 4, "start"))
    return [Word(x, y + down, anchor, wide) for down in (-5.0, 14.0) for x, anchor in ends]


def _beside(words: str, x: float, y: float, right: float) -> list[Word]:
    """Around a point; farther off where it is beside nothing else."""
    wide = LETTER * len(words)
    sides = [Word(x + 9, y + 4, "start", wide), Word(x - 9, y + 4, "end", wide)]
    sides = sides if x + 9 + wide <= right else sides[::-1]
    corners = [
        Word(x + dx, y + dy, anchor, wide)
        for dy in (-9.0, 17.0, -23.0, 31.0)
        for dx, anchor in ((5, "start"), (-5, "end"))
    ]
    return [*sides, *corners, Word(x, y - 10, "middle", wide), Word(x, y + 19, "middle", wide)]


def _written(words: str, at: Word, kind: str = "") -> str:
    named = f' class="{kind}"' if kind else ""
    return f'<text{named} x="{at.x:.1f}" y="{at.y:.1f}" text-anchor="{at.anchor}">{text(words)}</text>'


def _mark(series: int, x: float, y: float) -> str:
    """Mark of a series: round, square, lozenge, triangle.

    The first round one and the last three are filled, the others hollow.
    """
    kind = f"f{series}" if series in FILLED else f"hollow s{series}"
    match (series - 1) % 4:
        case 0:
            return f'<circle class="{kind}" cx="{x:.1f}" cy="{y:.1f}" r="5"/>'
        case 1:
            return f'<rect class="{kind}" x="{x - 4.5:.1f}" y="{y - 4.5:.1f}" width="9" height="9"/>'
        case 2:
            return f'<path class="{kind}" d="M{x - 6:.1f} {y:.1f}l6 -6 6 6 -6 6z"/>'
        case _:
            return f'<path class="{kind}" d="M{x - 5.5:.1f} {y + 4:.1f}h11l-5.5 -10z"/>'


def _tick(value: float, *, log: bool = False) -> str:
    return f"{value:.6g}" if log or abs(value) > 1e-9 else "0"


CELLS_TOP: Final = 22.0
LABELS: Final = 8
"""The most values that are written along an axis."""
LARGEST: Final = 26.0
"""Side of a cell."""
PARTS: Final = (0.3, 0.4, 0.62, 0.82, 1.0)
"""Size of the mark in a filled cell, as a share of the cell, by class; class 0 is a ring."""
CELLS_SAMPLE: Final = 13.0
CELLS_HIGH: Final = 300.0


def cells(name: str, chart: Cells) -> str:
    """The field, the values along both axes, and what the cells mean."""
    left = MARGIN + LETTER * max(map(len, chart.rows)) + 8
    wide = min((WIDE - left - 6) / len(chart.columns), LARGEST)
    high = min(CELLS_HIGH / len(chart.rows), LARGEST)
    low = CELLS_TOP + high * len(chart.rows)

    def marks() -> Iterator[str]:
        yield f'<text x="2" y="13">{text(chart.up)}</text>'
        for index, row in enumerate(chart.classes):
            y = low - high * (index + 1)
            yield from (_cell(each, left + wide * k, y, wide, high) for k, each in enumerate(row))
        yield f'<path class="axis" d="M{left} {CELLS_TOP}V{low:.1f}H{left + wide * len(chart.columns):.1f}"/>'
        for k in _some(chart.rows, 14 / high):
            yield _word(chart.rows[k], left - 5, low - high * (k + 0.5) + 4, "end")
        for k in _some(chart.columns, LETTER * (max(map(len, chart.columns)) + 2) / wide):
            yield _word(chart.columns[k], left + wide * (k + 0.5), low + 15, "middle")
        right = max(left + wide * len(chart.columns), left + LETTER * len(chart.across))
        yield f'<text x="{right:.1f}" y="{low + 33:.1f}" text-anchor="end">{text(chart.across)}</text>'
        yield from legend

    entries = list(_cell_entries(chart.words, low + 54))
    legend = [part for each in entries for part in _cell_entry(*each)]
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


def _cell_entries(words: Sequence[tuple[int | None, str]], y: float) -> Iterator[tuple[int | None, str, float, float]]:
    """Legend entries beside one another, as far as there is room."""
    x = MARGIN
    for kind, word in words:
        wide = CELLS_SAMPLE + 6 + LETTER * len(word) + 14
        if x > MARGIN and x + wide > WIDE:
            x, y = MARGIN, y + LEGEND_ROW
        yield kind, word, x, y
        x += wide


def _cell_entry(kind: int | None, word: str, x: float, y: float) -> Iterator[str]:
    yield _cell(kind, x, y - 11, CELLS_SAMPLE, CELLS_SAMPLE)
    yield _named(word, y, x)


def _named(word: str, y: float, x: float = MARGIN) -> str:
    return f'<text x="{x + CELLS_SAMPLE + 6:.1f}" y="{y:.1f}">{text(word)}</text>'
