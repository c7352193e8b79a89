"""Profiles: closed, counter-clockwise, with volumes and moments of known bodies."""

import math

import pytest

from abu_calc.sizing.parts.housing_parts import Corner, Point, Segment, closed, moments, polar_moment, volume


def test_a_sphere_and_a_torus_by_their_profiles() -> None:
    """4/3·π·r³ and 2/5·V·r²; 2π²·R·r² and V·(R² + 3/4·r²)."""
    half = closed([Corner(0, 0, "axis"), Corner(2, 0, "sphere", 1.0)])
    assert volume(half) == pytest.approx(4 / 3 * math.pi, rel=1e-12)
    assert polar_moment(half) == pytest.approx(0.4 * 4 / 3 * math.pi, rel=1e-12)
    ring = closed([Corner(-1, 5, "torus", 1.0), Corner(1, 5, "torus", 1.0)])
    assert volume(ring) == pytest.approx(2 * math.pi**2 * 5, rel=1e-12)
    assert polar_moment(ring) == pytest.approx(2 * math.pi**2 * 5 * (25 + 0.75), rel=1e-12)


def test_a_tube_and_a_cone() -> None:
    tube = closed([Corner(0, 2, "bore"), Corner(5, 2, "face"), Corner(5, 3, "rim"), Corner(0, 3, "face")])
    assert moments(tube).area == pytest.approx(5)
    assert volume(tube) == pytest.approx(math.pi * 5 * 5)
    assert polar_moment(tube) == pytest.approx(math.pi * 5 * (3**4 - 2**4) / 2)
    cone = closed([Corner(0, 0, "axis"), Corner(3, 0, "slope"), Corner(0, 2, "base")])
    assert volume(cone) == pytest.approx(math.pi * 4 * 3 / 3)


@pytest.mark.parametrize("bulge", [-0.9, -0.2, 0.05, 0.4, 1.0])
def test_centre_and_radius_of_an_arc(bulge: float) -> None:
    """Both ends and the middle, which lies bulge·chord/2 to the right of the chord, are on the circle."""
    arc = Segment(Point(1.0, 2.0), Point(4.0, 6.0), "race", bulge)
    middle = 2.5 + bulge * 4 / 2, 4.0 - bulge * 3 / 2
    for point in (arc.start, arc.end, middle):
        assert math.dist(point, arc.centre) == pytest.approx(arc.radius, rel=1e-12)


def test_a_straight_segment_has_no_centre() -> None:
    line = Segment(Point(0.0, 0.0), Point(1.0, 0.0), "axis")
    assert line.straight and math.isinf(line.radius)
    with pytest.raises(ValueError, match="no centre"):
        _ = line.centre
