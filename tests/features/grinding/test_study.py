"""The study of a machine at its work: power, regions, formula as published, and files that it refuses."""

import math

import pytest

import abu_calc
from abu_calc.features.grinding.steady_contact import bare, runout_of
from abu_calc.features.grinding.study import _cutting_power, _regions, refuse_idle
from abu_calc.foundation.errors import InputError
from abu_calc.sizing import size
from tests.features.grinding.test_command import STRAIGHT, worked
from tests.sizing.machines import machine


@pytest.mark.slow
def test_cutting_power_is_friction_times_rim_speed() -> None:
    """f·N₀·Ω·R: 0.4 · 50 N · 5800 rpm · 75 mm = 911 W, whatever the kind of contact."""
    for contact in ("rigid", "face"):
        grinding = {"contact": contact, "press_force_N": 50.0, "cutting_coefficient": 0.4}
        power = _cutting_power(size(machine(grinding=grinding)))
        assert power == pytest.approx(0.4 * 50 * 5800 * math.pi / 30 * 0.075)
    assert _cutting_power(size(machine())) == 0.0


@pytest.mark.slow
def test_a_face_has_no_regions_of_stiffness() -> None:
    face = size(machine(grinding={"contact": "face"}))
    assert _regions(face, bare(face, runout_of(face.case))) is None
    rigid = size(machine(grinding={"contact": "rigid", "press_force_N": 50.0}))
    steady = bare(rigid, runout_of(rigid.case))
    low, high = _regions(rigid, steady) or (0.0, 0.0)
    dx, dy = (-each.real for each in steady.contact.dynamic_stiffness)
    assert (low, high) == pytest.approx((dy, dx + dy))


def test_an_idle_machine_is_refused_with_the_table_it_lacks() -> None:
    with pytest.raises(InputError) as refused:
        refuse_idle(machine().grinding)
    assert refused.value.place.key == "grinding" and "press_force_N" in str(refused.value.remedy)
    with pytest.raises(InputError, match="accuracy"):
        abu_calc.grinding(abu_calc.read(STRAIGHT), accuracy=2.0)


@pytest.mark.slow
def test_parts_of_a_result_agree_with_one_another() -> None:
    """Two balls of m·R_p each open to an angle whose cosine is |V|/(2·m·R_p); the printed ones likewise."""
    result = worked(STRAIGHT, "golden")
    model, printed = result.model, result.printed
    assert printed is not None and printed.ball_angles_deg is not None and result.ball_angles_deg is not None
    moment = 1e6 * model.ball_mass_kg * model.pitch_radius_m
    first, second = printed.ball_angles_deg
    opened = math.radians(second - first) / 2  # wrapped, so that the sign is left open
    assert abs(2 * moment * math.cos(opened)) == pytest.approx(printed.resultant_g_mm)
    apart = math.radians(result.ball_angles_deg[1] - result.ball_angles_deg[0]) / 2
    assert abs(2 * moment * math.cos(apart)) == pytest.approx(result.ball_resultant_g_mm)
    names = [(orbit.name, orbit.simulated) for orbit in result.orbits]
    assert ("with", False) in names and ("balls fixed", False) in names and len(set(names)) == len(names)
