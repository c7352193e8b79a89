"""Charts on axes of matplotlib: places, limits and colours are those of the chart and of the page."""

import re

import pytest

from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Cells, Curve, MarkedPoint, Plot
from abu_calc.reporting.page.card import beside

pytest.importorskip("matplotlib")

from abu_calc.reporting.charts.matplotlib_charts import (
    barred,
    celled,
    color_of,
    colors,
    dashes_of,
    marker_of,
    plotted,
    tick,
    words,
)


def test_colours_are_those_of_the_page_and_begin_again() -> None:
    assert colors()["c1"] in beside("page.css")
    assert [color_of(series) for series in (5, 6)] == [color_of(1), color_of(2)]
    assert len({color_of(series) for series in (1, 2, 3, 4)}) == 4
    assert marker_of(5) == marker_of(1) != marker_of(2)


def test_dashes_are_half_the_pixels_of_the_page() -> None:
    series, pixels = re.findall(r"\.line\.s(\d) \{ stroke-dasharray: ([\d ]+);", beside("page.css"))[0]
    assert dashes_of(int(series)) == (0, tuple(float(part) / 2 for part in pixels.split()))
    assert dashes_of(1) == "solid"


def test_a_zero_of_rounding_is_written_as_zero() -> None:
    assert tick(1e-12) == "0" and tick(1e-12, log=True) == "1e-12" and tick(0.25) == "0.25"
    assert words("a\x1b") == "a\\x1b" and len(words("x" * 200, 60)) <= 60


@pytest.mark.slow
def test_lines_points_and_limit_stand_at_their_values() -> None:
    chart = Plot(
        "Title", "told", Axis("time [s]", 0, 2), Axis("level [dB]", 90, 110), [Curve([(0, 100), (2, 95)], "a", 1)],
        [MarkedPoint(1, 105, "measured", 2)], (109.0, "limit"), [(-1, 0.5)],
    )  # fmt: skip
    axes = plotted(chart).axes[0]
    assert (axes.get_xlim(), axes.get_ylim()) == ((0, 2), (90, 110))
    drawn = [(list(line.get_xdata()), list(line.get_ydata())) for line in axes.lines]  # type: ignore[arg-type]
    assert ([0, 2], [100, 95]) in drawn and ([1], [105]) in drawn and any(y == [109.0, 109.0] for _, y in drawn)
    (band,) = axes.patches
    assert band.get_window_extent().width == pytest.approx(axes.get_window_extent().width / 4)  # from 0, not from −1


def test_bars_reach_from_start_to_value() -> None:
    rows = [Bar("a", 3.0, "3 µm", 1, 1.0), Bar("b", -2.0, "-2 µm", 2)]
    axes = barred(Bars("Title", "told", Axis("x [µm]", -5, 5), rows)).axes[0]
    ends = [tuple(sorted((bar.get_x(), bar.get_x() + bar.get_width()))) for bar in axes.patches]  # type: ignore[attr-defined]
    assert ends == [(1.0, 3.0), (-2.0, 0.0)]
    above = barred(Bars("Title", "told", Axis("level [dB]", 90, 110), [Bar("a", 100.0, "100 dB")])).axes[0]
    assert not above.patches, "a bar that does not begin at zero would lie about its length"


def test_cells_grow_with_their_class() -> None:
    kinds = [(0, "none"), (1, "few"), (4, "all"), (None, "not computed")]
    axes = celled(Cells("Field", "told", "speed", "mass", ["1", "2", "3"], ["a"], [[1, 4, None]], kinds)).axes[0]
    widths = [mark.get_width() for mark in axes.patches + axes.artists if hasattr(mark, "get_width")]
    assert len(widths) == 2 and widths[0] < widths[1] < 1
