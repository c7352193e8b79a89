"""Charts as inline SVG: marks, words and legends stand where the numbers say."""

from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Curve, MarkedPoint, Plot
from abu_calc.reporting.page.chart_svg import LabelBox, Places, Word, bars, plot
from tests.reporting.page.reader import read


def test_spans_begin_where_they_say() -> None:
    rows = [Bar("a", 3.0, "1 … 3", 1, 1.0), Bar("b", -1.0, "-2 … -1", 2, -2.0)]
    page = read(bars("a", Bars("A", "told", Axis("x", -2.0, 4.0), rows, (0.0, "none"))))
    boxes = [(float(str(a["x"])), float(str(a["width"]))) for tag, a in page.tags if tag == "rect"]
    per_unit = boxes[0][1] / 2
    assert boxes[1][1] == pytest.approx(per_unit, abs=0.2)
    assert boxes[0][0] - boxes[1][0] == pytest.approx(3 * per_unit, abs=0.2)


def test_words_keep_clear_of_lines_and_of_one_another() -> None:
    field = LabelBox(0, 0, 400, 200)
    right, left = Word(109, 104, "start", 60), Word(91, 104, "end", 60)
    assert Places(field, [], [(100, 100)]).put([right, left]) == right
    assert Places(field, [[(100, 100), (300, 100)]], [(100, 100)]).put([right, left]) == left
    places = Places(field, [], [])
    assert places.put([right, left]) == right
    assert places.put([right, left]) == left
    # Beside the field is worse than upon a line, and than upon other words.
    outside = Word(395, 104, "start", 60)
    assert Places(field, [[(100, 100), (300, 100)]], []).put([outside, right]) == right


@pytest.mark.slow
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


def test_long_names_lose_their_middle_and_stay_inside() -> None:
    name = "A  " + 30 * "machine " + ", after"
    rows = [Bar(name, 1.0, "1"), Bar("B  short", 2.0, "2")]
    page = read(bars("a", Bars("A", "told", Axis("x", 0.0, 2.0), rows)))
    shown = next(words for tag, words in page.texts if tag == "text" and words.startswith("A  machine"))
    assert shown.endswith("machine , after")
    assert "…" in shown
    assert 6.8 * len(shown) < 420
    assert "B  short" in [words for _, words in page.texts]


def test_points_and_limits_stand_where_the_ticks_say() -> None:
    axes = Axis("speed [rpm]", 0, 100), Axis("level [dB]", 0, 50)
    page = read(plot("a", Plot("A", "told", *axes, (), [MarkedPoint(40, 20)], (20.0, "limit 20 dB"))))
    circle = next(attributes for tag, attributes in page.tags if tag == "circle")
    ticks = [attributes for tag, attributes in page.tags if tag == "text"]
    words = [words for tag, words in page.texts if tag == "text"]
    at = dict(reversed(list(zip(words, ticks, strict=True))))
    up = dict(zip(words, ticks, strict=True))
    assert float(str(circle["cx"])) == pytest.approx(float(str(at["40"]["x"])), abs=0.1)
    assert f"M52.0 {circle['cy']}" in next(str(a["d"]) for tag, a in page.tags if a.get("class") == "limit")
    assert float(str(up["20"]["y"])) - 4 == pytest.approx(float(str(circle["cy"])), abs=0.1)


def test_several_lines_have_a_legend_that_stays_inside_the_chart() -> None:
    names = ["idle", "loaded", "loaded, another place", "with a name that takes most of the width of a chart"]
    lines = [Curve([(0, k), (1, k + 1)], name, k) for k, name in enumerate(names, 1)] + [
        Curve([(0, 0), (1, 1)], "idle", 1)
    ]
    axes = Axis("time [s]", 0, 1), Axis("level [dB]", 0, 5)
    page = read(plot("a", Plot("A", "told", *axes, lines)))
    high = float(str(page.tags[0][1]["viewbox"]).split()[-1])
    places = [attributes for tag, attributes in page.tags if tag == "text"]
    words = [words for tag, words in page.texts if tag == "text"]
    assert [word for word in words if word in names] == names
    at = [(float(str(a["x"])), float(str(a["y"])), w) for a, w in zip(places, words, strict=True) if w in names]
    assert all(x + 5.5 * len(name) < 420 and y < high for x, y, name in at)
    for one, after in pairwise(at):
        assert after[1] > one[1] or after[0] > one[0] + 5.5 * len(one[2]) + 20
    alone = read(plot("a", Plot("A", "told", *axes, lines[:1])))
    assert "idle" not in [words for tag, words in alone.texts if tag == "text"]


def test_lengths_of_bars_are_as_their_values() -> None:
    rows = [Bar("a", 1.0, "1"), Bar("b", 3.0, "3"), Bar("c", -1.0, "-1")]
    page = read(bars("a", Bars("A", "told", Axis("x [dB]", -1.0, 3.0), rows)))
    wide = [(float(str(a["x"])), float(str(a["width"]))) for tag, a in page.tags if tag == "rect"]
    assert wide[1][1] == pytest.approx(3 * wide[0][1], abs=0.3)
    assert wide[2][0] + wide[2][1] == pytest.approx(wide[0][0], abs=0.2)


def test_the_first_series_is_filled_and_the_second_hollow() -> None:
    axes = Axis("x", 0.0, 1.0), Axis("y", 0.0, 1.0)
    page = read(plot("a", Plot("A", "told", *axes, [], [MarkedPoint(0.5, 0.5, "", series) for series in (1, 2)])))
    kinds = {tag: attributes["class"] for tag, attributes in page.tags if tag in ("circle", "rect")}
    assert kinds == {"circle": "f1", "rect": "hollow s2"}


@pytest.mark.parametrize(("at", "anchor"), [(0.0, "start"), (1.0, "start"), (3.0, "end"), (4.0, "end")])
def test_the_words_of_a_bar_chart_s_limit_stay_inside(at: float, anchor: str) -> None:
    """They go to the side of the limit where there is more room."""
    words = "limit of the level 109.0 dB"
    page = read(bars("a", Bars("A", "told", Axis("x", 0.0, 4.0), [Bar("a", 2.0, "2")], (at, words))))
    (named,) = (attributes for _, attributes in page.tags if attributes.get("class") == "limit-name")
    line = next(str(attributes["d"]) for _, attributes in page.tags if attributes.get("class") == "limit")
    assert named["text-anchor"] == anchor and line.startswith(f"M{named['x']} ")
    left = float(str(named["x"])) - (6.8 * len(words) if anchor == "end" else 0.0)
    assert left >= 0 and left + 6.8 * len(words) <= 420
