"""Growth of the wall round a pressed cover, by a second derivation from the displacements of two thick rings.

Filling, overspeed, burst, cover and fastening against derivations of their own.

Standard fits of bore and spindle.
"""

import math
from functools import cache

import numpy as np
import pytest

from abu_calc.formulas.press_fit import SMOOTHING
from abu_calc.foundation.checks import Check
from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.balls import candidates
from abu_calc.sizing.design import Design
from abu_calc.sizing.manufacture.cover import axial_load, burst_ratio, cover_rings, seat_growth, standard_fits
from tests.reporting.drawings.samples import result


def displaced(young: float, poisson: float, inner: float, outer: float, p_in: float, p_out: float, r: float) -> float:
    """Radial displacement A·r + B/r of a ring in plane stress, A and B from the pressures at its edges."""
    a, b = young / (1 - poisson), young / (1 + poisson)
    constants = np.linalg.solve([[a, -b / inner**2], [a, -b / outer**2]], [-p_in, -p_out])
    return float(constants[0] * r + constants[1] / r)


@pytest.mark.parametrize("name", ["one-piece", "tiny", "thick wall"])
@pytest.mark.parametrize("interference", [10e-6, 37e-6, 80e-6])
def test_the_wall_grows_by_its_share_of_the_interference(name: str, interference: float) -> None:
    parts = result(name).parts
    inside, outside = cover_rings(parts)
    r, left = outside.inner, (interference - SMOOTHING) / 2
    unit = 1e6
    out = displaced(outside.material.modulus, outside.material.poisson, r, outside.outer, unit, 0.0, r)
    back = displaced(inside.material.modulus, inside.material.poisson, inside.inner, r, 0.0, unit, r)
    wanted = 2 * out * left / (out - back)
    assert seat_growth(parts, interference) == pytest.approx(wanted, rel=1e-9)
    assert 0 < seat_growth(parts, interference) < interference


def test_clearance_widens_nothing() -> None:
    assert seat_growth(result("one-piece").parts, 0.0) == 0.0


def test_a_cover_is_pushed_by_all_balls_together_or_by_the_shock_of_handling() -> None:
    """Four balls of 100 N at a slope of one half are 200 N; 50 g on 1 kg are 490 N."""
    assert axial_load(4, 100.0, 0.5, 0.1) == pytest.approx(200.0)
    assert axial_load(8, 100.0, 0.5, 0.1) == pytest.approx(400.0)
    assert axial_load(4, 100.0, 0.5, 1.0) == pytest.approx(50 * 9.80665)


@cache
def sized(*overrides: str) -> Design:
    return size(read_machine("avtovaz-707-222", tuple(f"autobalancer.{each}" for each in overrides)).tables)


def check(design: Design, code: str) -> Check:
    return next(each for each in design.checks if each.code == code)


def test_a_race_that_its_balls_cannot_enter_fails() -> None:
    """R 29.4, Ø15.875, groove R 23.26: the edge lies 1.50 mm deeper, so 29.4 − 1.50 − 15.875 − 12.5 = −0.48 mm."""
    pins = "ball_count=4", "ball_diameter_mm=15.875", "race_radius_mm=29.4"
    found = check(sized(*pins), "ABU305")
    groove = 15.875 / 2 + 5 / 7 * (29.4 - 15.875 / 2)
    depth = groove - math.sqrt(groove**2 - (15.875 / 2 + 0.3) ** 2)
    assert found.status == "fail" and found.value == pytest.approx(29.4 - depth - 15.875 - 12.5, abs=1e-6)


@pytest.mark.slow
def test_the_search_takes_no_race_that_balls_cannot_enter_if_another_one_suffices() -> None:
    for bore in (10, 16, 20, 24):
        design = sized(f"bore_diameter_mm={bore}")
        found = candidates(design.case, design.imbalance.value)
        other = any(each.fillable and each.capacity_ratio >= 1.2 and each.strength.enough and each.stays_round
                    for each in found)  # fmt: skip
        assert (check(design, "ABU305").status == "pass") == other, bore


def test_burst_ratio_by_slices() -> None:
    """Σ σ·A over Σ ρΩ²∫r²dA + nF/2, by a grid of points inside the polygons of the parts."""
    design = sized()
    parts, omega = design.construction.parts, design.case.speed_range[1]
    held = pull = 0.0
    dimensions = parts.dimensions
    step = 2e-5
    for z in (step * (k + 0.5) for k in range(int(dimensions.width / step))):
        inner = [(dimensions.bore_radius, dimensions.hub_radius)]
        x = z - dimensions.middle
        assert dimensions.groove_radius is not None
        if z < dimensions.web:
            inner = [(dimensions.bore_radius, dimensions.outer_radius)]
        elif z < dimensions.cover_start:
            race = dimensions.race_radius - dimensions.groove_radius + math.sqrt(dimensions.groove_radius**2 - x**2)
            inner.append((race, dimensions.outer_radius))
        else:
            inner.append((dimensions.race_radius, dimensions.outer_radius))
            pull += 7800 * omega**2 * (dimensions.race_radius**3 - dimensions.hub_radius**3) / 3 * step
        held += sum(600e6 * (high - low) * step for low, high in inner)
        pull += sum(7800 * omega**2 * (high**3 - low**3) / 3 * step for low, high in inner)
    force = design.autobalancer.strength.ball_force
    expected = math.sqrt(held / (pull + 4 * force / 2))
    assert burst_ratio(parts, force, omega) == pytest.approx(expected, rel=2e-3)


@pytest.mark.slow
def test_the_pressed_cover_holds_less_cold_in_aluminium_and_a_thread_holds_more() -> None:
    steel, light = sized().construction.cover, sized("design=light").construction.cover
    assert steel.held >= steel.needed and light.held >= light.needed
    assert light.fit is not None and steel.fit is not None
    assert light.fit.loosest > steel.fit.loosest
    assert sized("closure=screwed").construction.cover.held > 100 * steel.held


def test_slip_torque_of_a_clamp_and_what_is_missing() -> None:
    """2·0.12·8000·(2/3)(12.5³ − 10³)/(12.5² − 10²) mm = 21.7 N·m."""
    assert "ABU308" not in {each.code for each in sized().checks}
    assert check(sized("clamp_force_N=8000"), "ABU308").value == pytest.approx(21.69, abs=0.01)
    assert check(sized("clamp_force_N=5"), "ABU308").status == "fail"
    assert check(sized("clamp_force_N=1000000"), "ABU308").status == "fail"


@pytest.mark.slow
def test_a_shrunk_steel_housing_carries_its_torque_and_an_aluminium_one_slips_when_warm() -> None:
    assert check(sized("fastening=shrunk"), "ABU308").status == "pass"
    light = sized("fastening=shrunk", "design=light", "temperature_range_C=[0, 80]")
    assert check(light, "ABU308").status == "fail"


def test_the_guard_is_judged_if_it_is_given() -> None:
    assert "ABU310" not in {each.code for each in sized().checks}
    assert check(sized("guard_thickness_mm=2"), "ABU310").status == "pass"
    assert check(sized("guard_thickness_mm=0.01"), "ABU310").status == "fail"


@pytest.mark.few(1)
@pytest.mark.parametrize("hot", [20.0, 60.0, 80.0, 120.0])
@pytest.mark.slow
def test_the_ring_stays_tight_in_aluminium_at_every_temperature(hot: float) -> None:
    """Smallest interference of the limits, less 2.5 µm of smoothing and 11.5e-6/K over the diameter and the warming."""
    design = sized("design=light", f"temperature_range_C=[0, {hot:g}]")
    seat, size_ = design.construction.seat, design.construction.parts.dimensions
    assert seat is not None
    least = seat.ring.lower - seat.seat.upper - 2.5e-6 - 11.5e-6 * 2 * size_.ring_radius * (hot - 20)
    assert 0 < seat.left <= least + 1e-12
    assert check(design, "ABU311").status == "pass"


@pytest.mark.slow
def test_too_wide_a_range_of_temperature_overstresses_the_body() -> None:
    assert check(sized("design=light", "temperature_range_C=[-40, 200]"), "ABU311").status == "fail"


@pytest.mark.hard
def test_a_ring_of_a_bearing_does_not_pass_a_thread_of_its_own_diameter() -> None:
    """The core of M62 × 0.5 is 62 − 1.08·0.5 = 61.5 mm wide, the ring 62 mm."""
    screwed = check(sized("design=bearing-ring", "closure=screwed"), "ABU307")
    assert screwed.status == "fail" and "no thread lets the ring pass" in screwed.message
    pressed = check(sized("design=bearing-ring", "closure=pressed"), "ABU307")
    assert pressed.status == "pass"


def test_fits_at_twenty_millimetres_by_the_rows_of_the_standard() -> None:
    """ISO 286-2, over 18 up to 30: H6 0/+13, m5 +8/+17, H7 0/+21, h6 −13/0, p6 +22/+35."""
    fits = {fit.named: fit for fit in standard_fits(20e-3)}
    assert fits["H6/m5"].eccentricity == pytest.approx(2.5e-6)
    assert fits["H7/h6"].eccentricity == pytest.approx(17e-6)
    assert fits["H7/p6"].eccentricity == 0.0
    assert fits["H6/m5"].tightest == pytest.approx(17e-6)
    assert fits["H7/p6"].loosest == pytest.approx(1e-6)


def test_fits_are_ordered_by_the_force_that_mounting_takes() -> None:
    tightest = [fit.tightest for fit in standard_fits(20e-3)]
    assert tightest == sorted(tightest)


def test_a_bore_that_outgrows_its_spindle_adds_half_of_it() -> None:
    cold, warm = standard_fits(20e-3), standard_fits(20e-3, 9e-6)
    for one, other in zip(cold, warm, strict=True):
        expected = max(0.0, one.bore.upper - one.spindle.lower + 9e-6) / 2
        assert other.eccentricity == pytest.approx(expected)


def test_no_fit_outside_the_tables() -> None:
    assert standard_fits(0.6) == () and standard_fits(0.2e-3) == ()
