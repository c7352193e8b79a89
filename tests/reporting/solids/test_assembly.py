"""Volumes of solids of revolution by closed forms and by slices; profiles that bound nothing are refused."""

import itertools
import math

import pytest
from hypothesis import given

from abu_calc.reporting.solids.assembly import RevolvedSolid, arc_of, ball_profile, cylinder_profile
from tests.reporting.solids.profiles import turned_solids


def solid(*profile: tuple[float, float, float]) -> RevolvedSolid:
    return RevolvedSolid("part", profile, "steel", 7800.0)


@pytest.mark.parametrize(
    ("profile", "volume"),
    [
        (ball_profile(30.0), math.pi * 30**3 / 6),
        (cylinder_profile(10.0, 7.0), math.pi * 25 * 7),
        (((0, 0, 0), (6, 0, 0), (0, 4, 0)), math.pi * 16 * 6 / 3),  # cone
        (((-1, 5, 1.0), (1, 5, 1.0)), 2 * math.pi**2 * 5),  # torus
        (((0, 3, 0), (8, 3, 0), (8, 5, 0), (0, 5, 0)), math.pi * (25 - 9) * 8),  # ring
        (((-4, 3, 0), (4, 3, 1 / 2)), math.pi * 8**3 / 6),  # napkin ring: a ball of radius 5, drilled 6, is 8 high
    ],
)
def test_volumes_of_known_solids(profile: tuple[tuple[float, float, float], ...], volume: float) -> None:
    assert solid(*profile).volume_mm3 == pytest.approx(volume, rel=1e-12)
    assert solid(*profile).mass_g == pytest.approx(volume * 7.8e-3, rel=1e-12)


@pytest.mark.slow
@given(turned_solids())
def test_the_volume_is_the_sum_of_frusta(part: RevolvedSolid) -> None:
    """Arcs as 400 chords: knows nothing of their integral."""
    total = 0.0
    for here, there in part.edges:
        points = [here[:2], there[:2]]
        if here[2]:
            (x, r), radius, start, turn = arc_of(here, there)
            points = [(x + radius * math.cos(start + turn * k / 400), r + radius * math.sin(start + turn * k / 400))
                      for k in range(401)]  # fmt: skip
        for (x, r), (x2, r2) in itertools.pairwise(points):
            total -= math.pi * (x2 - x) * (r * r + r * r2 + r2 * r2) / 3
    assert part.volume_mm3 == pytest.approx(total, rel=2e-5)


@pytest.mark.parametrize(
    "profile",
    [
        ((0, 0, 0),),
        ((0, 1, 0), (0, 2, 0), (1, 2, 0)),  # clockwise
        ((0, -1, 0), (1, 0, 0), (0, 2, 0)),  # across the axis
        ((0, 1, 0), (0, 1, 0), (1, 1, 0), (0, 2, 0)),  # a corner twice
        ((0, math.nan, 0), (1, 1, 0), (0, 2, 0)),
        ((0, 1, 0), (math.inf, 1, 0), (0, 2, 0)),
    ],
)
def test_profiles_that_bound_no_solid_are_refused(profile: tuple[tuple[float, float, float], ...]) -> None:
    with pytest.raises(ValueError, match="part: "):
        solid(*profile)
