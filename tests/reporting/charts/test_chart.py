"""What figures are made of, against numbers and places computed anew."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.dynamics.stability.boundaries import boundaries, growth_over
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.features.balancing.figures import RADIUS, planes_drawing
from abu_calc.features.balancing.study import balance
from abu_calc.features.seats.figures import check_fit_figures, zones_drawing
from abu_calc.features.seats.study import check_fit
from abu_calc.inputs.read_machine import read_machine
from abu_calc.reporting.blocks import Grid
from abu_calc.reporting.charts.chart import FIELD, Axis, Bar, Bars, Curve, MarkedPoint, Plot, alike
from abu_calc.reporting.drawings.shapes import Arc, Region, Text
from abu_calc.reporting.page.chart_svg import Box, Places, Word, bars, plot
from tests.dynamics.scenes import dimensionless
from tests.reporting.page.reader import read


def test_decades_are_even_along_a_logarithmic_axis() -> None:
    axis = Axis.decades("time [s]", [0.003, 40.0])
    assert (axis.low, axis.high) == pytest.approx((1e-3, 1e2))
    assert axis.ticks == pytest.approx([1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0])
    shares = [axis.share(tick) for tick in axis.ticks]
    assert np.diff(shares) == pytest.approx([0.2] * 5)
    many = Axis.decades("error", [3e-16, 0.5]).ticks
    assert len(many) <= 8
    page = read(plot("a", Plot("A", "told", axis, Axis.decades("error", [1e-12, 1.0]))))
    words = [words for tag, words in page.texts if tag == "text"]
    assert {"1e-12", "1", "0.001", "100"} <= set(words)
    assert "0" not in words


def test_axes_alike_have_one_scale() -> None:
    across, up = alike("x", "y", [(3.0, 0.0), (0.0, -2.0)])
    assert (across.high - across.low) / (up.high - up.low) == pytest.approx(FIELD)
    assert across.low <= -3.0 < 3.0 <= across.high
    assert up.low <= -2.0


def test_spans_begin_where_they_say() -> None:
    rows = [Bar("a", 3.0, "1 … 3", 1, 1.0), Bar("b", -1.0, "-2 … -1", 2, -2.0)]
    page = read(bars("a", Bars("A", "told", Axis("x", -2.0, 4.0), rows, (0.0, "none"))))
    boxes = [(float(str(a["x"])), float(str(a["width"]))) for tag, a in page.tags if tag == "rect"]
    per_unit = boxes[0][1] / 2
    assert boxes[1][1] == pytest.approx(per_unit, abs=0.2)
    assert boxes[0][0] - boxes[1][0] == pytest.approx(3 * per_unit, abs=0.2)


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.text("ab1.", max_size=14), min_size=3, max_size=7).flatmap(
        lambda header: st.tuples(
            st.just(tuple(header)),
            st.lists(st.tuples(*(st.text("xyz9", max_size=25) for _ in header)), min_size=1, max_size=4),
        )
    ),
    st.integers(20, 120),
)
def test_parted_tables_have_every_column_once_and_the_first_each_time(
    table: tuple[tuple[str, ...], list[tuple[str, ...]]], width: int
) -> None:
    header, rows = table
    parts = Grid(header, tuple(rows), frozenset({1, 2}), kept=2).within(width)
    assert all(part.header[:2] == header[:2] for part in parts)
    assert tuple(name for part in parts for name in part.header[2:]) == header[2:]
    for k, row in enumerate(rows):
        assert tuple(cell for part in parts for cell in part.rows[k][2:]) == row[2:]
    for part in parts:
        wide = sum(max(map(len, column)) + 2 for column in zip(part.header, *part.rows, strict=True))
        assert wide <= width or len(part.header) == 3
    assert Grid(header, tuple(rows)).within(1) == [Grid(header, tuple(rows))]


def test_words_keep_clear_of_lines_and_of_one_another() -> None:
    field = Box(0, 0, 400, 200)
    right, left = Word(109, 104, "start", 60), Word(91, 104, "end", 60)
    assert Places(field, [], [(100, 100)]).put([right, left]) == right
    assert Places(field, [[(100, 100), (300, 100)]], [(100, 100)]).put([right, left]) == left
    places = Places(field, [], [])
    assert places.put([right, left]) == right
    assert places.put([right, left]) == left
    # Beside the field is worse than upon a line, and than upon other words.
    outside = Word(395, 104, "start", 60)
    assert Places(field, [[(100, 100), (300, 100)]], []).put([outside, right]) == right


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.floats(0, 1), st.floats(0, 1)), min_size=2, max_size=5, unique=True))
def test_a_words_box_stays_inside_the_chart(places: list[tuple[float, float]]) -> None:
    axes = Axis("x", 0.0, 1.0), Axis("y", 0.0, 1.0)
    points = [MarkedPoint(x, y, "a word", k % 8 + 1) for k, (x, y) in enumerate(places)]
    page = read(plot("a", Plot("A", "told", *axes, [Curve(places)], points, (0.5, "limit"))))
    words = [one for one in page.tags if one[0] == "text"]
    texts = [text for tag, text in page.texts if tag == "text"]
    for (_, attributes), text in zip(words, texts, strict=True):
        if text == "a word":
            x, wide = float(str(attributes["x"])), 6.8 * 6
            left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[str(attributes["text-anchor"])] * wide
            assert left >= 0 and left + wide <= 420


def test_zones_stand_at_their_limits_and_say_them() -> None:
    result = check_fit(read_machine("mmg-3200k-knife-shaft"))
    shaft, housing = result.seats[:2]
    drawing = zones_drawing("zones-1", shaft, housing)
    regions = [one for one in drawing.shapes if isinstance(one, Region)]
    heights = [(min(y for _, y, _ in one.corners), max(y for _, y, _ in one.corners)) for one in regions]
    assert heights == [shaft.ring_limits_um, shaft.part_limits_um, housing.ring_limits_um, housing.part_limits_um]
    words = [one.text for one in drawing.shapes if isinstance(one, Text)]
    assert {"+21", "+2", "-15", "0", "+40", "-18", "k6", "H7"} <= set(words)
    assert any("2 … 36" in word for word in words)
    assert any(word.startswith("clearance 0 … 58") for word in words)
    named = [one.name for one in check_fit_figures(result)]
    assert len(named) == len(set(named)) == 9


def test_planes_show_what_to_do_where_it_is_done() -> None:
    """Seen from the left end the roll turns counterclockwise: degrees run clockwise, from the right the other way."""
    result = balance("sapropel-screw-rig")
    assert result.turns_from_left == "counterclockwise"
    drawing = planes_drawing(result.left, result.right, result.turns_from_left)
    rims = [one for one in drawing.shapes if isinstance(one, Arc) and one.radius == RADIUS]
    heavy = [one for one in drawing.shapes if isinstance(one, Arc) and one.radius < 2]
    for rim, spot, plane, clockwise in zip(rims, heavy, (result.left, result.right), (1, -1), strict=True):
        angle = math.radians(plane.angle_deg)
        away = spot.centre[0] - rim.centre[0], spot.centre[1] - rim.centre[1]
        assert away == pytest.approx((clockwise * RADIUS * math.sin(angle), RADIUS * math.cos(angle)))
    words = [one.text for one in drawing.shapes if isinstance(one, Text)]
    assert "− 12.00 g at 205.0°" in words
    assert "take off 12.00 g at 205.0°" in drawing.description


def test_growth_over_speeds_is_that_of_each_speed() -> None:
    scene = dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 100.0)
    speeds = [0.5, 0.9, 1.7, 2.6, 3.0]
    found = growth_over(scene, speeds)
    assert [speed for speed, _ in found] == speeds
    for speed, rate in found:
        alone = stability(replace(scene, speed=speed)).growth_rate
        assert rate == pytest.approx(alone, abs=1e-9)
    edges = boundaries(scene, 0.5, 3.0)
    at_edges = growth_over(scene, [one.speed for one in edges])
    assert edges
    assert [rate for _, rate in at_edges] == pytest.approx([0.0] * len(edges), abs=1e-6)


@pytest.mark.slow
def test_orbits_reach_as_far_as_the_amplitudes_say() -> None:
    from abu_calc.features.grinding.study import grinding

    result = grinding(read_machine("avtovaz-707-222"))
    amplitudes = {"without": result.axis_without, "balls fixed": result.axis_fixed, "with": result.axis}
    for one in result.orbits:
        x, y = (max(map(abs, each)) / 1e3 for each in zip(*one.points_um, strict=True))
        told = result.simulation if one.simulated else amplitudes[one.name]
        assert told is not None
        assert (x, y) == pytest.approx((told.x_amplitude_mm, told.y_amplitude_mm), rel=0.05 if one.simulated else 2e-3)


def test_long_names_lose_their_middle_and_stay_inside() -> None:
    name = "A  " + 30 * "machine " + ", after"
    rows = [Bar(name, 1.0, "1"), Bar("B  short", 2.0, "2")]
    page = read(bars("a", Bars("A", "told", Axis("x", 0.0, 2.0), rows)))
    shown = next(words for tag, words in page.texts if tag == "text" and words.startswith("A  machine"))
    assert shown.endswith("machine , after")
    assert "…" in shown
    assert 6.8 * len(shown) < 420
    assert "B  short" in [words for _, words in page.texts]
