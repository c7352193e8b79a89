"""Parts of a housing: closed profiles that touch but do not overlap, as heavy as the design."""

import math
from functools import cache
from itertools import pairwise

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.parts.housing_parts import HousingParts, housing_parts

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
