"""Charts on axes of matplotlib: lines, points, bars, fields of cells, in one look for all figures.

Colours and dashes are those of the page, given once in its style sheet.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from textwrap import fill
from typing import TYPE_CHECKING, Any, Final, Literal

from abu_calc.foundation.errors import escaped, shortened
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Cells, MarkedPoint, Plot
from abu_calc.reporting.page.card import beside

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SERIES: Final = 4
"""Colors of series; those beyond begin again."""
MARKERS: Final = ("o", "s", "D", "^")
FONT: Final = "DejaVu Sans"
"""Font of the figures; it comes with matplotlib."""
LIKE_IT: Final = f"'{FONT}', Verdana, sans-serif"
"""Texts of SVG files are texts, in the first of these that is there: the second is as wide."""
STYLE: Final[dict[str, Any]] = {
    "font.family": FONT, "font.size": 9.0, "text.parse_math": False, "axes.titlesize": 10.5,
    "axes.titlelocation": "left", "axes.unicode_minus": True, "axes.spines.top": False, "axes.spines.right": False,
    "axes.axisbelow": True, "lines.linewidth": 1.6, "legend.frameon": False, "legend.handlelength": 3.2,
    "savefig.dpi": 200, "svg.fonttype": "none", "svg.hashsalt": "abu-calc", "pdf.fonttype": 42,
}  # fmt: skip


@cache
def colors() -> dict[str, str]:
    """Colours of the page on white, by their names there."""
    first = beside("page.css").split("}", 1)[0]
    return dict(re.findall(r"--(\w+): (#[0-9a-f]{3,8})", first))


@cache
def _dashes() -> dict[int, tuple[float, ...]]:
    """Dashes of lines by series, in widths of a line, which is 2 px wide on the page."""
    rules = re.findall(r"\.line\.s(\d) \{ stroke-dasharray: ([\d ]+);", beside("page.css"))
    return {int(series): tuple(float(part) / 2 for part in parts.split()) for series, parts in rules}


def color_of(series: int) -> str:
    """Colour of a series."""
    return colors()[f"c{(series - 1) % SERIES + 1}"]


def marker_of(series: int) -> str:
    """Marker of a series: round, square, lozenge, triangle."""
    return MARKERS[(series - 1) % len(MARKERS)]


def dashes_of(series: int) -> Any:
    """A style of line."""
    parts = _dashes().get(series)
    return "solid" if parts is None else (0, parts)


@contextmanager
def styled() -> Iterator[None]:
    """Everything as here, nothing as somebody's own settings have it."""
    from matplotlib import style

    with style.context(["default", STYLE]):
        yield


SIZE: Final = (6.2, 4.0)
"""Inches."""
HIGH: Final = 46
"""Signs of a line beside the field."""
LONGEST: Final = 84
TITLE: Final = 66
"""Signs of a text that has a line of its own, and of one in larger letters."""
FILLED: Final = (1, 6, 7, 8)
"""Series whose points are."""
LETTER: Final = 0.0135
"""Approximate width of a letter, as a share of the field's width."""


def words(text: str, most: int = LONGEST) -> str:
    """A text as figures may hold it."""
    return shortened(escaped(text), most)


def plotted(chart: Plot) -> "Figure":
    """A field between two axes."""
    from matplotlib.figure import Figure

    figure = Figure(SIZE, layout="constrained")
    axes = figure.add_subplot()
    axes.set_title(words(chart.title, TITLE))
    _along(axes, chart.across, "x")
    _along(axes, chart.up, "y")
    axes.grid(color=colors()["line"], linewidth=0.6)
    for first, last in chart.bands:
        _band(axes, chart.across, first, last)
    if chart.limit:
        limit(axes, *chart.limit)
    named = {line.name: line.series for line in chart.legend}
    marked = {point.series for point in chart.points if not point.word}
    for line in chart.lines:
        x, y = zip(*line.points, strict=True)
        axes.plot(x, y, color=color_of(line.series), linestyle=dashes_of(line.series))
    for point in chart.points:
        _point(axes, chart, point)
    if named:
        _legend(figure, named, marked)
    return figure


def limit(axes: "Axes", value: float, name: str) -> None:
    """A dashed line right across, its name above its end."""
    color = colors()["fail"]
    axes.axhline(value, color=color, linewidth=1.4, linestyle=(0, (4, 2)), zorder=1.5)
    place = axes.get_yaxis_transform()
    axes.annotate(
        words(name), (1, value), (0, 3), xycoords=place, textcoords="offset points", ha="right", va="bottom",
        color=color, bbox=paper(), zorder=4,
    )  # fmt: skip


def paper() -> dict[str, Any]:
    """Ground of a text that lies over lines."""
    return {"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}


def mark(series: int) -> dict[str, Any]:
    """Style of a series's points."""
    color = color_of(series)
    return {
        "marker": marker_of(series), "markersize": 6.0, "markeredgecolor": color, "markeredgewidth": 1.5,
        "markerfacecolor": color if series in FILLED else "white", "linestyle": "none",
    }  # fmt: skip


def tick(value: float, *, log: bool = False) -> str:
    """A number beside an axis."""
    return f"{value:.6g}" if log or abs(value) > 1e-9 else "0"


def _along(axes: "Axes", axis: Axis, which: Literal["x", "y"]) -> None:
    """Limits, ticks and name, as the data say."""
    if axis.log:
        getattr(axes, f"set_{which}scale")("log")
        getattr(axes, f"{which}axis").set_minor_locator(_none())
    getattr(axes, f"set_{which}lim")(axis.low, axis.high)
    getattr(axes, f"set_{which}ticks")(axis.ticks, [tick(value, log=axis.log) for value in axis.ticks])
    getattr(axes, f"set_{which}label")(words(axis.name) if which == "x" else fill(words(axis.name), HIGH))
    axes.tick_params(axis=which, labelcolor=colors()["soft"])


def _none() -> Any:
    from matplotlib.ticker import NullLocator

    return NullLocator()


def _band(axes: "Axes", across: Axis, first: float, last: float) -> None:
    low, high = max(across.low, first), min(across.high, last)
    if low < high:
        axes.axvspan(low, high, facecolor=colors()["band"], edgecolor="none")
        axes.annotate(
            "not stable", ((low + high) / 2, 0), (0, 4), xycoords=axes.get_xaxis_transform(),
            textcoords="offset points", ha="center", va="bottom", color=colors()["soft"],
        )  # fmt: skip


def _point(axes: "Axes", chart: Plot, point: MarkedPoint) -> None:
    """The word stands on the side where there is room."""
    axes.plot([point.x], [point.y], clip_on=False, zorder=3, **mark(point.series))
    if point.word:
        left = chart.across.share(point.x) + LETTER * (len(point.word) + 2) > 1
        axes.annotate(
            words(point.word), (point.x, point.y), (-7 if left else 7, 0), textcoords="offset points",
            ha="right" if left else "left", va="center", bbox=paper(), zorder=4,
        )  # fmt: skip


def _legend(figure: "Figure", named: dict[str, int], marked: set[int]) -> None:
    """Legend below the field, in as many columns as have room."""
    from matplotlib.lines import Line2D

    lines = [
        Line2D([], [], **((mark(series) if series in marked else {}) | {
            "color": color_of(series), "linestyle": dashes_of(series)}))
        for series in named.values()
    ]  # fmt: skip
    columns = max(1, min(4, int(90 / (8 + max(map(len, named))))))
    figure.legend(lines, [words(name) for name in named], loc="outside lower left", ncols=columns)


WIDE: Final = 6.2
ROW: Final = 0.4
AROUND: Final = 1.0
"""Inches: of a row, and of what is above and below all of them."""
LABELS: Final = 10
"""The most values that are written along an axis of cells."""
CELLS: Final = 0.28, 0.55
"""Side of a cell, at least and at most; all of them beside one another take FIELD where they may."""
FIELD: Final = 4.5
PARTS: Final = (0.3, 0.4, 0.6, 0.78, 0.96)
"""Size of the mark in a filled cell, as a share of the cell, by class; class 0 is a ring."""


def barred(chart: Bars) -> "Figure":
    """Lengths or points below one another, each under its name, its value beside the field."""
    from matplotlib.figure import Figure

    figure = Figure((WIDE, AROUND + ROW * max(len(chart.rows), 2)), layout="constrained")
    axes, color = figure.add_subplot(), colors()
    axes.set_title(words(chart.title, TITLE), pad=16 if chart.limit else 6)
    axes.set_xlim(chart.axis.low, chart.axis.high)
    axes.set_ylim(len(chart.rows) - 0.35, -0.75)
    axes.set_xticks(chart.axis.ticks, [tick(value) for value in chart.axis.ticks])
    axes.set_yticks([])
    axes.set_xlabel(words(chart.axis.name))
    axes.tick_params(axis="x", labelcolor=color["soft"])
    axes.grid(axis="x", color=color["line"], linewidth=0.6)
    axes.spines["left"].set_visible(chart.axis.low <= 0)
    axes.spines["left"].set_position(("data", 0.0) if chart.axis.low <= 0 else ("axes", 0))
    for index, row in enumerate(chart.rows):
        _row(axes, chart, index, row)
    if chart.limit:
        value, name = chart.limit
        axes.axvline(value, color=color["fail"], linewidth=1.4, linestyle=(0, (4, 2)), zorder=1.5)
        axes.annotate(
            words(name), (value, 1), (0, 3), xycoords=axes.get_xaxis_transform(), textcoords="offset points",
            ha="right" if chart.axis.share(value) > 0.5 else "left", va="bottom", color=color["fail"],
        )  # fmt: skip
    return figure


def _row(axes: "Axes", chart: Bars, index: int, row: Bar) -> None:
    beside = axes.get_yaxis_transform()
    axes.annotate(
        words(row.name), (0, index - 0.3), (4, 0), xycoords=beside, textcoords="offset points", va="center", zorder=4,
        bbox=paper(),
    )  # fmt: skip
    axes.text(1.015, index + 0.08, words(row.text), transform=beside, va="center")
    if chart.axis.low > 0:
        axes.plot([row.value], [index + 0.12], zorder=3, **mark(row.series))
        return
    axes.barh(index + 0.12, row.value - row.start, 0.34, row.start, color=color_of(row.series), zorder=2)
    if row.span:
        low, high = row.span
        middle, apart = (low + high) / 2, (high - low) / 2
        axes.errorbar(
            [middle], [index + 0.12], xerr=[apart], fmt="none", ecolor=colors()["ink"], elinewidth=1.0, capsize=3,
            zorder=3,
        )  # fmt: skip


def celled(chart: Cells) -> "Figure":
    """A field of cells, which grow with their class."""
    from matplotlib.figure import Figure

    columns, rows = len(chart.columns), len(chart.rows)
    side = max(CELLS[0], min(CELLS[1], FIELD / columns))
    size = max(WIDE, min(side * columns + 1.2, 10.0)), max(2.4, min(side * rows, 8.0) + 1.7)
    figure = Figure(size, layout="constrained")
    axes = figure.add_subplot()
    axes.set_title(words(chart.title, TITLE), pad=20)
    axes.annotate(
        words(chart.up), (0, 1), (0, 5), xycoords="axes fraction", textcoords="offset points", ha="left", va="bottom"
    )
    axes.set_xlim(-0.5, columns - 0.5)
    axes.set_ylim(-0.5, rows - 0.5)
    axes.set_aspect("equal", anchor="W")
    for which, names in (("x", chart.columns), ("y", chart.rows)):
        some = range(0, len(names), -(-len(names) // LABELS))
        getattr(axes, f"set_{which}ticks")(some, [words(names[k]) for k in some])
    axes.set_xlabel(words(chart.across), loc="left")
    axes.tick_params(labelcolor=colors()["soft"], length=2)
    for row, classes in enumerate(chart.classes):
        for column, kind in enumerate(classes):
            axes.add_artist(_cell(kind, column, row))
    samples, names = [_sample(kind) for kind, _ in chart.words], [words(word) for _, word in chart.words]
    figure.legend(samples, names, loc="outside lower left", ncols=3, handlelength=1.2)
    return figure


def _cell(kind: int | None, x: float, y: float) -> Any:
    """A cross where nothing is known, a ring, a square."""
    from matplotlib.patches import Circle, PathPatch, Rectangle
    from matplotlib.path import Path

    if kind is None:
        cross = Path([(x - 0.1, y - 0.1), (x + 0.1, y + 0.1), (x - 0.1, y + 0.1), (x + 0.1, y - 0.1)], [1, 2, 1, 2])
        return PathPatch(cross, edgecolor=colors()["soft"], fill=False, linewidth=0.8)
    side = PARTS[kind]
    if kind == 0:
        return Circle((x, y), side / 2, fill=False, edgecolor=color_of(2), linewidth=1.0)
    return Rectangle((x - side / 2, y - side / 2), side, side, facecolor=color_of(1), edgecolor="none")


def _sample(kind: int | None) -> Any:
    """The same in a legend."""
    from matplotlib.lines import Line2D

    none: dict[str, Any] = {"linestyle": "none"}
    if kind is None:
        return Line2D([], [], marker="x", color=colors()["soft"], markersize=4.0, **none)
    if kind == 0:
        return Line2D([], [], marker="o", markerfacecolor="none", markeredgecolor=color_of(2), markersize=4.0, **none)
    return Line2D([], [], marker="s", color=color_of(1), markersize=9.0 * PARTS[kind], **none)
