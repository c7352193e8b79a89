"""Parts of a housing: closed profiles that touch but do not overlap, as heavy as the design.

Profiles: closed, counter-clockwise, with volumes and moments of known bodies.
"""

import math
from functools import cache
from itertools import pairwise

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.parts.housing_parts import (
    Corner,
    HousingParts,
    Point,
    Segment,
    closed,
    housing_parts,
    moments,
    polar_moment,
    volume,
)

DESIGNS = ("one-piece", "light", "bearing-ring")


@cache
def parts_of(design: str) -> tuple[HousingParts, float]:
    """Parts and mass of the straight grinder's autobalancer."""
    machine = read_machine("avtovaz-707-222", (f"autobalancer.design={design}",))
    designed = size(machine.tables)
    return housing_parts(designed.case, designed.autobalancer), designed.autobalancer.mass


@pytest.mark.few(2)
@pytest.mark.parametrize("design", DESIGNS)
def test_profiles_close_and_go_round_counter_clockwise(design: str) -> None:
    for part in parts_of(design)[0].turned:
        for here, there in pairwise((*part.profile, part.profile[0])):
            assert here.end == there.start
        assert part.area > 0
        assert min(segment.start.r for segment in part.profile) > 0


@pytest.mark.parametrize("design", DESIGNS)
@pytest.mark.slow
def test_the_parts_weigh_what_the_design_weighs(design: str) -> None:
    """The design's mass comes from rings and discs, the parts' from their profiles."""
    parts, mass = parts_of(design)
    total = sum(part.mass for part in parts.turned) + parts.balls.count * parts.balls.mass
    assert total == pytest.approx(mass, rel=1e-12)


@pytest.mark.parametrize("design", DESIGNS)
@pytest.mark.slow
def test_the_race_is_the_arc_of_the_groove_and_the_ball_touches_it_in_the_middle(design: str) -> None:
    parts, size_ = parts_of(design)[0], parts_of(design)[0].dimensions
    race = next(segment for segment in parts.race_part.profile if segment.surface == "race")
    assert race.radius == pytest.approx(size_.groove_radius, rel=1e-9)
    assert race.centre.z == pytest.approx(size_.middle, rel=1e-9)
    assert race.centre.r + race.radius == pytest.approx(size_.race_radius, rel=1e-9)
    assert parts.balls.pitch_radius + parts.balls.diameter / 2 == pytest.approx(size_.race_radius, rel=1e-9)
    assert math.dist(race.start, (parts.balls.z, parts.balls.pitch_radius)) > parts.balls.diameter / 2


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
