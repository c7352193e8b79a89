"""Capacity that the balls must have: planes of race and wheel, runout, eccentricity."""

import cmath
import math

import pytest

from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.foundation.errors import InputError
from abu_calc.sizing.budget import plane_ratio, required_capacity, runout_factor
from abu_calc.sizing.case import read_case
from tests.sizing.machines import machine


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


OMEGA = 5800 * math.pi / 30


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
