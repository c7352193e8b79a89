"""Figures of bearing seats: sketches, tolerance zones, interference and clearance."""

import math

import pytest

from abu_calc.features.seats.command import NAMES
from abu_calc.features.seats.figures import _element, check_fit_figures, seat_sheets, zones_drawing
from abu_calc.features.seats.study import check_fit
from abu_calc.inputs.read_machine import machine_of_bearings, read_machine
from abu_calc.reporting.charts.chart import Bars
from abu_calc.reporting.drawings.shapes import Arc, Length, Line, Region, Text
from tests.reporting.drawings.overlaps import check_clear


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


def test_sizes_and_limits_of_the_knife_shaft_s_seats() -> None:
    """Afanasiev 2015: Ø80 k6 is +21/+2, Ø140 K7 is +12/−28; by ISO 286 Ø80 m6 is +30/+11, Ø140 H7 +40/0."""
    drawn = []
    for drawing in seat_sheets(check_fit(read_machine("mmg-3200k-knife-shaft")))[:2]:
        check_clear(drawing)
        drawn.append({each.text: (each.value, each.below) for each in drawing.shapes if isinstance(each, Length)})
    assert drawn[0] == {"Ø80 k6": (80.0, "(+0.021 / +0.002)"), "Ø140 H7": (140.0, "(+0.040 / 0)"), "33": (33.0, "")}
    assert drawn[1] == {
        "Ø80 m6": (80.0, "(+0.030 / +0.011)"),
        "Ø140 K7": (140.0, "(+0.012 / -0.028)"),
        "33": (33.0, ""),
    }


def test_bars_of_interference_start_and_end_at_its_limits() -> None:
    stationary = read_machine("mmg-3200k-knife-shaft").changed({"bearing[0].outer_ring_load": "stationary"})
    result = check_fit(stationary)
    chart = next(figure.shown for figure in check_fit_figures(result) if figure.name == "interference-1")
    assert isinstance(chart, Bars)
    rows = {row.name: row for row in chart.rows}
    shaft, housing = result.seats[:2]
    extreme = rows["shaft: extreme"]
    assert (extreme.start, extreme.value) == shaft.interference_um == (2.0, 36.0)
    assert rows["shaft: permitted"].start == shaft.needed_um
    assert rows["housing: permitted"].start == chart.axis.low  # a ring that needs no interference has no least one
    assert rows["housing: permitted"].value == housing.permitted_interference_um


def drawn(designation: str, **changes: object) -> list[object]:
    bearing = {"designation": designation, "radial_load_kN": 1.0} | changes
    (drawing,) = seat_sheets(check_fit(machine_of_bearings([bearing], NAMES)))
    check_clear(drawing)
    return list(drawing.shapes)


@pytest.mark.parametrize("name", ["6205", "7205B"])
def test_balls_are_drawn_with_balls(name: str) -> None:
    assert sum(isinstance(shape, Arc) for shape in drawn(name)) == 2


@pytest.mark.parametrize("name", ["30205", "22205", "NU205", "NA4905", "HK2512"])
def test_rollers_are_not_drawn_with_balls(name: str) -> None:
    shapes = drawn(name)
    assert not [shape for shape in shapes if isinstance(shape, Arc)]
    inner = [shape for shape in shapes if isinstance(shape, Region) and shape.name == "inner ring"]
    assert len(inner) == (0 if name == "HK2512" else 2)


def test_one_class_stands_on_each_diameter_and_limits_are_in_mm() -> None:
    """6205 on m6 as given, though k5 is advised: the drawing has m6 alone; GOST 3325 is not on it."""
    shapes = drawn("6205", shaft_fit="m6", housing_fit="N7")
    words = " ".join(
        f"{shape.text} {getattr(shape, 'below', '')}" for shape in shapes if isinstance(shape, (Text, Length))
    )
    assert "Ø25 m6 (+0.021 / +0.008)" in words and "Ø52 N7" in words
    assert "k5" not in words and "H7" not in words and "GOST" not in words and "µm" not in words


def rollers(kind: str, side: int) -> list[list[tuple[float, float]]]:
    """Corners of each roller between raceways of radii 20 and 26: (along the axis, away from it)."""
    lines = [each for each in _element(kind, (15.0, side * 20.0, side * 26.0)) if isinstance(each, Line)]
    corners = [(each.start[0], side * each.start[1]) for each in lines]
    return [corners[k : k + 4] for k in range(0, len(corners), 4)]


@pytest.mark.parametrize("side", [1, -1])
def test_the_large_end_of_a_tapered_roller_is_the_farther_one_from_the_axis(side: int) -> None:
    """Cones that roll on one another share their tip, which lies on the axis beyond the small ends (ISO 355)."""
    ((left_top, right_top, right_low, left_low),) = rollers("tapered", side)
    small, large = (math.dist(*ends) for ends in ((left_top, left_low), (right_top, right_low)))
    assert small < large
    assert (left_top[1] + left_low[1]) / 2 < (right_top[1] + right_low[1]) / 2


@pytest.mark.parametrize("side", [1, -1])
def test_spherical_rollers_are_farthest_from_the_axis_in_the_middle(side: int) -> None:
    """The outer raceway is a sphere about a point on the axis; both rows lean against it."""
    for corners in rollers("spherical", side):
        near_first = sorted(corners, key=lambda corner: abs(corner[0] - 7.5))
        assert sum(r for _, r in near_first[:2]) > sum(r for _, r in near_first[2:])


@pytest.mark.parametrize("kind", ["cylindrical", "needle"])
def test_straight_rollers_lie_along_the_axis(kind: str) -> None:
    ((left_top, right_top, right_low, left_low),) = rollers(kind, 1)
    assert left_top[1] == right_top[1] == 26.0 and left_low[1] == right_low[1] == 20.0
