"""Dimensions, leaders and signs as lines, arrows and texts, and the extent of all shapes."""

import math

import pytest

from abu_calc.reporting.drawings.dimensions import (
    ARROW,
    box,
    datum,
    extent,
    fits,
    leader,
    moved,
    primitives,
    scale_for,
    tolerance_frame,
)
from abu_calc.reporting.drawings.shapes import SCALES, Arc, Length, Line, Primitive, Radius, Region, Shape, Solid, Text

SHAPES: tuple[Shape, ...] = (
    Line("outline", (0.0, 0.0), (3.0, 4.0)),
    Arc("outline", (1.0, 1.0), 2.0, 30.0, 100.0),
    Region(((0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 1.0, 0.0)), "part"),
    Solid(((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))),
    Text((2.0, 2.0), "text"),
    Length((0.0, 0.0), (40.0, 0.0), 10.0, "40"),
    Length((0.0, 0.0), (0.0, 40.0), -10.0, "40", True),
    Radius((0.0, 0.0), 5.0, 45.0, (12.0, 12.0), "R 5"),
)


def test_an_arc_reaches_to_the_quarters_it_passes() -> None:
    low, high = box(Arc("outline", (1.0, 1.0), 2.0, 30.0, 100.0), 1.0)
    assert high == pytest.approx((1 + 2 * math.cos(math.radians(30)), 3.0))  # its top at 90°
    assert low == pytest.approx((1 + 2 * math.cos(math.radians(100)), 2.0))
    assert box(Arc("outline", (0.0, 0.0), 2.0), 1.0) == (pytest.approx((-2.0, -2.0)), pytest.approx((2.0, 2.0)))


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_a_moved_shape_has_its_extent_elsewhere(shape: Shape) -> None:
    low, high = extent([shape], 2.0)
    moved_low, moved_high = extent([moved(shape, (7.0, -3.0))], 2.0)
    assert moved_low == pytest.approx((low[0] + 7, low[1] - 3)) and moved_high == pytest.approx(
        (high[0] + 7, high[1] - 3)
    )


def arrows(shapes: tuple[Primitive, ...]) -> list[Solid]:
    return [shape for shape in shapes if isinstance(shape, Solid)]


def test_arrows_of_a_dimension_point_at_its_ends() -> None:
    drawn = tuple(primitives([Length((0.0, 0.0), (40.0, 0.0), 10.0, "40")], 1.0))
    assert sorted(arrow.corners[0] for arrow in arrows(drawn)) == [(0.0, 10.0), (40.0, 10.0)]
    (text,) = (shape for shape in drawn if isinstance(shape, Text))
    assert text.at[0] == 20.0 and text.at[1] > 10.0 and text.align == "centre"


def test_a_short_dimension_has_strokes_and_its_text_beside() -> None:
    short = Length((0.0, 0.0), (2.0, 0.0), 10.0, "2")
    drawn = tuple(primitives([short], 1.0))
    assert not arrows(drawn) and not fits(2.0, "2", 1.0) and fits(3 * ARROW, "2", 1.0)
    (text,) = (shape for shape in drawn if isinstance(shape, Text))
    assert text.at[0] > 2.0
    (other,) = (shape for shape in primitives([Length((0.0, 0.0), (2.0, 0.0), 10.0, "2", beyond="start")], 1.0)
                if isinstance(shape, Text))  # fmt: skip
    assert other.box(1.0)[1][0] < 0.0


def test_a_leader_runs_away_from_what_it_tells_about() -> None:
    for shelf in ((10.0, 5.0), (-10.0, 5.0)):
        _, line, head, text = leader((0.0, 0.0), shelf, "text", 1.0)
        assert isinstance(line, Line) and abs(line.end[0]) > 10.0 and isinstance(head, Solid) and isinstance(text, Text)
        assert head.corners[0] == (0.0, 0.0)
        assert text.at[0] == min(line.start[0], line.end[0])


def test_a_frame_has_one_line_more_than_cells() -> None:
    drawn = tolerance_frame((0.0, 0.0), ("circularity", "0.003", "A"), 1.0)
    upright = [shape for shape in drawn if isinstance(shape, Line) and shape.start[0] == shape.end[0]]
    assert len(upright) == 4
    assert [shape.text for shape in drawn if isinstance(shape, Text)] == ["0.003", "A"]


def test_a_datum_hangs_below_its_point_or_stands_above() -> None:
    below, above = (extent(datum((0.0, 0.0), "A", 1.0, upwards=upwards), 1.0) for upwards in (False, True))
    assert below[1][1] == 0.0 and above[0][1] == 0.0
    assert below[0][1] == pytest.approx(-above[1][1])


def test_the_largest_scale_with_room_is_taken() -> None:
    assert scale_for(220.0, SCALES) == 1.0 and scale_for(221.0, SCALES) == 0.5
    assert scale_for(1e9, SCALES) == SCALES[-1]
