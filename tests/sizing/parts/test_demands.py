"""Demands on the surfaces of the parts: what the drawing permits follows from radii and eccentricities."""

import pytest

from abu_calc.sizing.housing import STEEL, dimensions
from abu_calc.sizing.manufacture.cover import Cover
from abu_calc.sizing.manufacture.eccentricity import EccentricitySplit
from abu_calc.sizing.manufacture.ring_seat import RaceQuality
from abu_calc.sizing.parts.demands import GROOVE_TOLERANCE, RACE_TOLERANCE, with_surfaces
from abu_calc.sizing.parts.housing_parts import BallSet, HousingParts, TurnedPart, body_profile, cover_profile


@pytest.mark.parametrize("grooved", [True, False])
def test_the_diameter_of_the_race_varies_by_twice_as_much_as_its_radius(grooved: bool) -> None:
    """Its run-out is twice its eccentricity; only a groove has a radius of its own."""
    size = dimensions("one-piece", 30e-3, 8e-3, 20e-3, 2e-3, grooved)
    parts = HousingParts(
        design="one-piece", closure="screwed", fastening="clamped", dimensions=size,
        body=TurnedPart("body", STEEL, body_profile(size)), cover=TurnedPart("cover", STEEL, cover_profile(size)),
        ring=None, balls=BallSet("ball", 4, 8e-3, 2.1e-3, 26e-3, size.middle),
    )  # fmt: skip
    split = EccentricitySplit(40e-6, "worst-case", 9e-6, 5e-6, 4e-6, 3e-6, None, "G6.3", 10e-6)
    quality = RaceQuality(3e-6, 1e-6, 1e-6, 0.2e-6, 1e-3, (58.0, 62.0), 20)
    demanded = with_surfaces(parts, split, quality, Cover(None, 1e-3, 1e3, 1e2, 1e6, 1e8), None)
    (race,) = (surface for surface in demanded.body.surfaces if surface.name == "race")
    largest, smallest = (2 * (30e-3 + way * RACE_TOLERANCE) for way in (1, -1))
    assert race.size == pytest.approx(60e-3)
    assert race.plus_minus == pytest.approx((largest - smallest) / 2)
    assert race.groove_plus_minus == (GROOVE_TOLERANCE if grooved else None)
    assert {each.kind: each.value for each in race.geometrical} == {"circularity": 3e-6, "run-out": 18e-6}
