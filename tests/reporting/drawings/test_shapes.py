"""Elements of a drawing: boxes of texts, dimensions, and texts that fit a width."""

import math

import pytest

from abu_calc.reporting.drawings.shapes import (
    SMALL,
    Drawing,
    Length,
    Radius,
    Text,
    digits,
    fitted,
    fitting_height,
    plain,
    text_width,
)


def test_a_text_stands_left_right_or_about_its_place() -> None:
    wide = text_width("abc", 3.5) / 2  # at a scale of 2 it is half as wide in mm of the object
    boxes = {align: Text((10.0, 5.0), "abc", 3.5, align).box(2.0) for align in ("left", "centre", "right")}  # type: ignore[arg-type]
    assert boxes["left"] == ((10.0, 5.0), pytest.approx((10.0 + wide, 6.75)))
    assert boxes["right"] == (pytest.approx((10.0 - wide, 5.0)), (10.0, 6.75))
    assert boxes["centre"][0][0] + boxes["centre"][1][0] == pytest.approx(20.0)


def test_an_upright_text_runs_upwards_left_of_its_line() -> None:
    (left, low), (right, high) = Text((10.0, 5.0), "abc", 3.5, "left", 90.0).box(1.0)
    assert (left, right, low) == (6.5, 10.0, 5.0) and high - low == pytest.approx(text_width("abc", 3.5))


def test_a_dimension_measures_along_its_axis_alone() -> None:
    ends = ((1.0, 7.0), (4.0, 2.0))
    assert Length(*ends, 0.0, "3").value == 3.0 and Length(*ends, 0.0, "5", True).value == 5.0


def test_the_arrow_of_a_radius_touches_its_circle() -> None:
    radius = Radius((1.0, 2.0), 5.0, 30.0, (9.0, 9.0), "R 5")
    assert math.dist(radius.touch, (1.0, 2.0)) == pytest.approx(5.0)
    assert radius.touch[1] == pytest.approx(2.0 + 2.5)


def test_a_drawing_is_as_large_on_paper_as_its_scale_says() -> None:
    assert Drawing("a", "A", "told", 2.0, (-5.0, 0.0), (15.0, 30.0), ()).size == (40.0, 60.0)


@pytest.mark.parametrize("width", [6.0, 20.0, 60.0, 400.0])
def test_a_fitted_text_takes_no_more_than_its_width(width: float) -> None:
    name = "machine " * 10
    text, height = fitted(name, width, 3.5)
    assert 0.8 * SMALL <= height <= 3.5
    assert text_width(text, height) <= width + 1e-9 or len(text) == 5
    assert (text == name) is ("…" not in text)


def test_signs_that_no_drawing_shows_are_blanks() -> None:
    assert plain("a\x00\n b\t") == "a b"
    assert digits(2.5000) == "2.5" and digits(1 / 3, 2) == "0.33"


def test_a_text_that_must_be_whole_is_written_smaller() -> None:
    size = "ball Ø10.319 (13/32 in)"
    height = fitting_height(size, 20.0, 3.5)
    assert text_width(size, height) == pytest.approx(20.0) and fitting_height("Ø5", 20.0, 3.5) == 3.5
