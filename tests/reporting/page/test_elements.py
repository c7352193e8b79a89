"""Blocks and figures as elements of a page."""

import pytest

from abu_calc.reporting.blocks import Facts, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Figure
from abu_calc.reporting.drawings.shapes import Drawing, Line
from abu_calc.reporting.page.document import PIXELS, elements, figure, paragraph
from tests.reporting.page.reader import read


def test_headings_that_are_indented_stand_one_level_deeper() -> None:
    page = read("".join(elements([Heading("Balls"), Heading("  Capacity")], "", 2)))
    assert [tag for tag, _ in page.tags] == ["h2", "h3"] and page.faults == []
    assert [words for _, words in page.texts] == ["Balls", "Capacity"]


def test_a_mark_is_a_class_and_commands_are_code() -> None:
    assert paragraph("Run `abu size`.", "warn") == '<p class="warn">Run <code>abu size</code>.</p>'
    assert paragraph("words", "unknown mark") == "<p>words</p>"
    assert list(elements([Paragraph("")], "")) == []


def test_a_number_is_tied_to_its_unit() -> None:
    assert paragraph("settled in 0.14 s") == "<p>settled in 0.14\u00a0s</p>"


def test_tables_are_called_by_the_heading_above_them() -> None:
    grid = Grid(("check", "value"), (("capacity", "1080"), ("mass", "FAIL")), frozenset({1}))
    page = read("".join(elements([Heading("Checks"), grid], "")))
    assert page.faults == []
    (region,) = (attributes for tag, attributes in page.tags if tag == "div")
    assert region["aria-label"] == "Checks"
    classes = [attributes.get("class") for tag, attributes in page.tags if tag == "td"]
    assert classes == [None, "number", None, "fail"]


def test_facts_without_rows_are_nothing() -> None:
    assert "".join(elements([Facts(())], "Title")) == ""
    page = read("".join(elements([Facts((("mass", "m", "240 g"),))], "Title")))
    assert page.cells == ["mass", "m", "240\u00a0g"]


def test_a_picture_has_its_caption_as_alternative() -> None:
    page = read("".join(elements([Picture(("/\\", "##"), "zones <x>")], "")))
    assert page.faults == [] and ("pre", "/\\\n##") in page.texts
    assert next(attributes["aria-label"] for tag, attributes in page.tags if tag == "pre") == "zones <x>"


def test_a_chart_stands_in_its_figure_with_caption() -> None:
    chart = Bars("Masses", "a 240 g", Axis("mass [g]", 0, 300), [Bar("a", 240.0, "240 g")])
    page = read(figure(Figure("mass", "", chart, "What each adds.")))
    assert page.faults == [] and ("figcaption", "What each adds.") in page.texts
    assert page.tags[0] == ("figure", {"style": "max-width:520px"})


def test_a_drawing_is_as_wide_as_on_paper() -> None:
    drawing = Drawing("a", "A", "told", 2.0, (0.0, 0.0), (50.0, 30.0), (Line("outline", (0.0, 0.0), (50.0, 30.0)),))
    style = read(figure(Figure("a", "", drawing, "Caption."))).tags[0][1]["style"]
    assert style == f"max-width:{PIXELS * 100:.0f}px"
    assert pytest.approx(96 / 25.4, abs=5e-3) == PIXELS  # a pixel of CSS is 1/96 inch
