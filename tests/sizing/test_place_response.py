"""Places of a body on its spindle whose race lies off the wheel's plane, against the equations of motion in one plane.

Two forces turn a bar of mass M and moment J: x(z) = x_r·G(z,r)/G(r,r) − U·[G(z,w) − G(z,r)·G(r,w)/G(r,r)],
G(p,q) = 1/M + p·q/J. Both terms are added as squares, as their angle is unknown.
"""

import math
from dataclasses import replace
from typing import Any

import pytest

from abu_calc.foundation.units import level_from_velocity
from abu_calc.sizing import size
from abu_calc.sizing.budget import PlaceResponse, place_response, plane_rest
from abu_calc.sizing.case import read_case
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import worst_residuals
from tests.sizing.machines import machine

J, WHEEL = 0.1, 0.2
PLACES = {"front": 0.1, "rear": -0.2}
BODY: dict[str, Any] = {
    "machine__transverse_inertia_kg_m2": J, "machine__center_of_mass_to_wheel_mm": 1e3 * WHEEL,
    "machine__handle": [{"name": name, "from_center_of_mass_mm": 1e3 * z} for name, z in PLACES.items()],
}  # fmt: skip
OFFSETS = (-30.0, 30.0, 60.0)


def design(offset: float, **changes: Any) -> Design:
    return size(machine(**BODY, autobalancer__plane_offset_mm=offset, **changes))


def two_motions(of: Design, z: float, at_race: float) -> tuple[float, float]:
    """Displacements [m] of a place by the race's displacement and by the couple that stays."""
    mass = of.case.body.mass + of.autobalancer.mass
    r = of.case.race_place[2]

    def moved(p: float, q: float) -> float:
        return 1 / mass + p * q / J

    rest = of.imbalance.value * (moved(z, WHEEL) - moved(z, r) * moved(r, WHEEL) / moved(r, r))
    return abs(at_race * moved(z, r) / moved(r, r)), abs(rest)


def level(of: Design, displacement: float) -> float:
    return level_from_velocity(of.case.speed * displacement / math.sqrt(2))


@pytest.mark.few(1)
@pytest.mark.parametrize("offset", OFFSETS)
@pytest.mark.parametrize("eccentricity", [0.0, 0.010])
def test_levels_of_handles(offset: float, eccentricity: float) -> None:
    """Expected levels of both handles, and the highest of them as the level that is judged."""
    found = design(offset, autobalancer__race_eccentricity_mm=eccentricity)
    at_race = found.autobalancer.budget.at_race
    expected = {name: level(found, math.hypot(*two_motions(found, z, at_race))) for name, z in PLACES.items()}
    assert {place.name: place.levels.after for place in found.idle.places} == pytest.approx(expected, abs=1e-6)
    assert found.idle.worst.after == pytest.approx(max(expected.values()), abs=1e-6)
    assert found.speed_levels is not None
    assert found.speed_levels.highest.level_after_db == pytest.approx(max(expected.values()), abs=1e-6)


@pytest.mark.parametrize("offset", OFFSETS)
def test_worst_friction_case_adds_both_motions(offset: float) -> None:
    found = design(offset)
    worst = worst_residuals(found.case, found.imbalance.value, found.autobalancer)[-1]
    expected = max(sum(two_motions(found, z, worst.at_race)) for z in PLACES.values())
    transmission = max(two_motions(found, z, 1.0)[0] for z in PLACES.values())
    assert worst.residual * transmission == pytest.approx(expected, rel=1e-9)


def test_a_race_in_the_wheel_plane_leaves_no_couple() -> None:
    case = read_case(machine(**BODY))
    response = place_response(case, (0.0, 0.0, -0.2), 0.2)
    assert response.rest == (0.0, 0.0, 0.0)
    assert response.transmission == pytest.approx(case.body.transmission((0.0, 0.0, -0.2), 0.2), rel=1e-12)


@pytest.mark.parametrize("offset", OFFSETS)
def test_the_couple_turns_the_body_about_its_race(offset: float) -> None:
    case = read_case(machine(**BODY, autobalancer__plane_offset_mm=offset))
    assert plane_rest(case, case.race_place, 0.2) == pytest.approx((0.0, 0.0, 0.0), abs=1e-15)


@pytest.mark.parametrize("offset", [0.0, 30.0])
def test_the_wheel_is_judged_across_its_axis_and_a_handle_by_all_three_axes(offset: float) -> None:
    case = read_case(machine(**BODY, autobalancer__plane_offset_mm=offset))
    assert place_response(case, case.body.wheel, 0.2).judged == 2
    assert place_response(case, (0.0, 0.0, PLACES["rear"]), 0.2).judged == 3


def test_the_loudest_axis_is_one_of_those_that_are_judged() -> None:
    """Motions of 3 and 4 add as squares to 5; along z of 6 and 8 to 10."""
    handle = PlaceResponse((1.0, 3.0, 6.0), (0.0, 4.0, 8.0))
    assert handle.loudest(1.0, 1.0) == pytest.approx(10.0)
    assert replace(handle, judged=2).loudest(1.0, 1.0) == pytest.approx(5.0)
    assert replace(handle, judged=2).loudest(1.0, 1.0, in_line=True) == pytest.approx(7.0)
