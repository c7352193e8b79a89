"""Filling, overspeed, burst, cover and fastening against derivations of their own."""

import math
from functools import cache

import pytest

from abu_calc.foundation.checks import Check
from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.balls import candidates
from abu_calc.sizing.design import Design
from abu_calc.sizing.manufacture.cover import burst_ratio


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
