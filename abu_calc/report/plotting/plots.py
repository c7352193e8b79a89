"""Charts on axes of matplotlib."""

from textwrap import fill
from typing import TYPE_CHECKING, Any, Final, Literal

from abu_calc.escapes import escaped, shortened
from abu_calc.report.figures.chart import Axis, Plot, Point
from abu_calc.report.plotting.style import color_of, colors, dashes_of, marker_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

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


def _point(axes: "Axes", chart: Plot, point: Point) -> None:
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
