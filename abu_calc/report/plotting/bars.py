"""Bars and fields of cells on axes of matplotlib."""

from typing import TYPE_CHECKING, Any, Final

from abu_calc.report.figures.chart import Bar, Bars, Cells
from abu_calc.report.plotting.plots import TITLE, mark, paper, tick, words
from abu_calc.report.plotting.style import color_of, colors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

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
    axes.text(1.015, index + 0.08, words(row.told), transform=beside, va="center")
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
    figure.legend(
        [_sample(kind) for kind, _ in chart.words], [words(word) for _, word in chart.words], loc="outside lower left",
        ncols=3, handlelength=1.2,
    )  # fmt: skip
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
