"""The outlines of the parts: closed, inside each other, as heavy as the design."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from abu_calc.features.design.section_drawing import flattened
from abu_calc.sizing.housing import Design, groove_radius, housing
from tests.reporting.drawings.samples import MACHINES, result

DENSITY = {"steel": 7.8e-3, "aluminium": 2.7e-3}
"""g/mm³."""


def _green(points: list[tuple[float, float]]) -> tuple[float, float]:
    """Area and volume of revolution of a polygon, by the trapezoids under its edges."""
    area = sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in pairwise([*points, points[0]]))
    volume = sum(
        math.pi * (b[0] - a[0]) * (a[1] ** 2 + a[1] * b[1] + b[1] ** 2) / 3 for a, b in pairwise([*points, points[0]])
    )
    return -area, -volume


@pytest.mark.few(3)
@pytest.mark.parametrize("name", MACHINES)
def test_parts_and_balls_weigh_what_the_design_weighs(name: str) -> None:
    """Cut into chords and cones, which knows nothing of segments; 200 chords leave 1e-5 of an arc."""
    one, section = result(name).autobalancer, result(name).section
    total = one.ball_count * one.ball_mass_g
    for part in section.parts:
        area, volume = _green(list(flattened(part.outline_mm, 200)))
        assert area == pytest.approx(part.section_area_mm2, rel=1e-4)
        assert DENSITY[part.material] * volume == pytest.approx(part.mass_g, rel=1e-4)
        total += part.mass_g
    assert total == pytest.approx(one.mass_g, rel=1e-9)


@pytest.mark.parametrize("name", MACHINES)
def test_the_race_lies_on_its_circle_and_holds_the_ball(name: str) -> None:
    one, section = result(name).autobalancer, result(name).section
    holder = next(part for part in section.parts if part.name == ("race ring" if len(section.parts) > 2 else "body"))
    left, right = section.web_mm + 1e-6, one.width_mm - section.web_mm - 1e-6
    found = flattened(holder.outline_mm, 40)
    race = [(x, r) for x, r in found if left < x < right and r > section.hub_diameter_mm / 2]
    if one.groove_radius_mm is None:
        assert section.shoulder_diameter_mm == section.race_diameter_mm
        return
    centre = one.width_mm / 2, one.race_radius_mm - one.groove_radius_mm
    inner = [(x, r) for x, r in race if r < section.race_diameter_mm / 2 + 1e-9]
    assert len(inner) >= 35
    for point in inner:
        assert math.dist(point, centre) == pytest.approx(one.groove_radius_mm, rel=1e-9)
        ball = one.width_mm / 2, one.pitch_radius_mm
        assert math.dist(point, ball) >= one.ball_diameter_mm / 2 - 1e-9


@given(
    st.sampled_from(["one-piece", "bearing-ring", "light"]), st.floats(2e-3, 60e-3), st.floats(1e-3, 0.3),
    st.floats(0.0, 0.2), st.floats(1e-3, 0.02), st.booleans(),
)  # fmt: skip
@pytest.mark.slow
def test_the_housing_is_the_sum_of_slices(
    design: Design, ball: float, bore: float, more: float, wall: float, grooved: bool
) -> None:
    """Mass by 4000 slices across the axis, each a ring; the arc's slices leave 1e-5."""
    web, hub_wall, body_wall, density = {
        "one-piece": (1.5e-3, 2.5e-3, 0.0, 7800.0), "bearing-ring": (1.5e-3, 2.5e-3, 2e-3, 7800.0),
        "light": (2e-3, 3e-3, 2e-3, 2700.0),
    }[design]  # fmt: skip
    race, inner = bore / 2 + hub_wall + 0.5e-3 + ball + more, ball + 0.6e-3
    rho = groove_radius(race, ball / 2)
    x = (np.arange(4000) + 0.5) / 4000 * inner - inner / 2
    edge = race - rho + np.sqrt(rho**2 - x**2) if grooved else np.full_like(x, race)
    outer = race + wall
    hub = bore / 2 + hub_wall
    cavity = math.pi * np.mean(outer**2 - edge**2) * inner * 7800
    lid = math.pi * ((outer**2 - race**2) * web * 7800 + (race**2 - hub**2) * web * density)
    base = math.pi * (outer**2 - hub**2) * web * density
    rest = math.pi * (hub**2 - bore**2 / 4 + (outer + body_wall) ** 2 - outer**2) * (inner + 2 * web) * density
    found = housing(design, race, ball, bore, wall, grooved)
    assert found.mass == pytest.approx(cavity + lid + base + rest, rel=1e-5)
    assert found.outer_diameter == pytest.approx(2 * (outer + body_wall))
