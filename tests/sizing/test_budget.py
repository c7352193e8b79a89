"""Accuracy budget of a race: what each part leaves, and the displacement that the limit permits.

Places of a body on its spindle whose race lies off the wheel's plane, against the equations of motion in one plane.

Two forces turn a bar of mass M and moment J: x(z) = x_r·G(z,r)/G(r,r) − U·[G(z,w) − G(z,r)·G(r,w)/G(r,r)],
G(p,q) = 1/M + p·q/J. Both terms are added as squares, as their angle is unknown.

Capacity that the balls must have: planes of race and wheel, runout, eccentricity.
"""

import cmath
import math
from dataclasses import replace
from typing import Any

import pytest

from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.units import level_from_velocity
from abu_calc.sizing import size
from abu_calc.sizing.budget import (
    PlaceResponse,
    displacement_level,
    fan,
    permitted_displacement,
    place_response,
    plane_ratio,
    plane_rest,
    required_capacity,
    runout_factor,
)
from abu_calc.sizing.case import read_case
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import worst_residuals
from tests.sizing.machines import PINNED, machine

OMEGA = 5800 * math.pi / 30


def test_levels_of_the_budget() -> None:
    assert displacement_level(math.hypot(10e-6, 7e-6), OMEGA) == pytest.approx(100.4, abs=0.1)
    assert displacement_level(17e-6, OMEGA) == pytest.approx(103.3, abs=0.1)
    assert 1e6 * permitted_displacement(read_case(machine()), 0.2, OMEGA) == pytest.approx(32.81, abs=0.01)


@pytest.mark.parametrize(("count", "resultant"), [(2, 0.5), (3, 1.2), (4, 0.665), (5, 0.0), (6, 2.0)])
def test_fan_adds_up_to_its_resultant(count: int, resultant: float) -> None:
    angles = fan(count, resultant, math.radians(8))
    # Its spacing is one of 512 steps, so the sum is right to a few hundredths.
    assert abs(sum(cmath.exp(1j * a) for a in angles)) == pytest.approx(resultant, abs=0.03)


def test_an_oval_race_counts_in_the_budget() -> None:
    """Two lobes of amplitude a leave 2a, as the square of a part of its own."""
    one = size(machine(**PINNED, wheel__imbalance_g_mm=100.0)).autobalancer
    parts = one.budget.race_eccentricity, one.budget.rolling_friction, 2 * one.roundness.lobes
    assert one.budget.residual == pytest.approx(math.hypot(*parts))
    assert one.budget.race_ovality == pytest.approx(2 * one.roundness.lobes) and one.roundness.lobes > 0


def test_what_the_balls_cannot_carry_stays_in_the_level() -> None:
    """Two 5 mm balls against 250 g·mm: the rest shakes the machine, beside the budget."""
    design = size(machine(autobalancer__ball_diameter_mm=5.0, autobalancer__ball_count=2))
    one = design.autobalancer
    left = (250e-6 - one.capacity) / (6.2 + one.mass)
    resonance = 1 / (1 - (2.5 * 60 / 5800) ** 2)  # damping changes it by 3e-4
    rest = left * resonance + math.hypot(one.budget.race_eccentricity, one.budget.rolling_friction)
    assert one.budget.residual == pytest.approx(rest, rel=1e-3)
    assert design.idle.worst.after == pytest.approx(displacement_level(rest, 5800 * math.pi / 30), abs=0.01)


def test_a_background_as_loud_as_the_limit_permits_nothing() -> None:
    loud = read_case(machine(machine__background_level_db=109.0, limits={"vibration_level_db": 109.0}))
    assert permitted_displacement(loud, 0.2, OMEGA) == 0.0
    # 3.0103 dB below the limit the background has half of the power, and √½ of the displacement is left.
    half = read_case(machine(machine__background_level_db=109.0 - 10 * math.log10(2)))
    quiet = read_case(machine())
    assert permitted_displacement(half, 0.2, OMEGA) == pytest.approx(
        permitted_displacement(quiet, 0.2, OMEGA) / math.sqrt(2)
    )


def test_a_displacement_at_rest_has_the_level_of_the_background() -> None:
    assert displacement_level(0.0, OMEGA, 90.0) == pytest.approx(90.0)
    assert displacement_level(0.0, OMEGA) == 0.0
    assert displacement_level(20e-6, OMEGA) - displacement_level(10e-6, OMEGA) == pytest.approx(20 * math.log10(2))


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


def test_race_30_mm_inboard_costs_11_percent() -> None:
    case = read_case(
        machine(
            machine__mass_kg=5.8,
            machine__transverse_inertia_kg_m2=0.10,
            machine__center_of_mass_to_wheel_mm=200.0,
            autobalancer__plane_offset_mm=-30.0,
        )
    )
    assert plane_ratio(case) == pytest.approx(1.11, abs=0.006)


M, WX, WY, EPS = 5.6, 80.0, 120.0, 0.04e-3


D = (complex(M * (WX**2 - OMEGA**2)), complex(M * (WY**2 - OMEGA**2)))


def test_exact_need_against_the_printed_limit() -> None:
    """320.1 against 324.0 g·mm at f = 0."""
    assert 100 + 224 * runout_factor(OMEGA, (WX, WY), 0.0) == pytest.approx(320.1, abs=0.05)


def test_exact_need_is_the_worst_angle_of_the_runout() -> None:
    f = 0.35
    contact = SteadyContact(OMEGA, D, 0.0, -f)
    worst = max(abs(contact.balancing_imbalance(EPS * cmath.exp(1j * math.radians(a))) - 100e-6) for a in range(0, 360))
    assert 100e-6 + M * EPS * runout_factor(OMEGA, (WX, WY), f) == pytest.approx(worst, rel=1e-4)


def test_need_of_a_machine_by_hand() -> None:
    """m₀e + Mε√{…} + MΔ with M = 5.6 + 0.6 + 0.25 kg; the springs' stiffness was fixed at 6.2 kg."""
    case = read_case(
        machine(
            wheel__runout_mm=0.09,
            autobalancer__race_eccentricity_mm=0.01,
            grinding={"contact": "rigid", "cutting_coefficient": 0.4, "press_force_N": 45.0},
        )
    )
    need = required_capacity(case, 250e-6, 0.25)
    share = 1 - 6.2 / 6.45 * (2.5 / (5800 / 60)) ** 2
    assert need.required == pytest.approx(250e-6 + 6.45 * 0.09e-3 * share + 6.45 * 0.01e-3, rel=1e-9)
    assert need.published_limit == pytest.approx(250e-6 + 6.45 * 0.09e-3, rel=1e-9)
    assert need.compliant is None


def test_a_rigid_contact_far_above_resonance_asks_for_the_whole_runout() -> None:
    assert runout_factor(1e6, (80.0, 120.0), 0.35) == pytest.approx(1.0, abs=1e-7)
    assert runout_factor(607.37, (607.37, 607.37), 0.35) == 0.0


def test_a_friction_beyond_its_range_is_refused_by_its_key() -> None:
    with pytest.raises(InputError) as caught:
        runout_factor(600.0, (80.0, 120.0), 2.1)
    assert caught.value.place.key == "grinding.cutting_coefficient"


def test_a_face_contact_asks_for_no_runout() -> None:
    face = {"contact": "face", "cutting_coefficient": 0.4, "press_force_N": 45.0}
    case = read_case(machine(wheel__runout_mm=0.09, grinding=face, autobalancer__race_eccentricity_mm=0.0))
    need = required_capacity(case, 250e-6, 0.25)
    assert need.required == pytest.approx(250e-6) and need.runout_part == 0.0
