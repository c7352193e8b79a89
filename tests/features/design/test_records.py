"""Records of a sized design against its SI numbers and against identities between them."""

import math

import pytest

from abu_calc.features.design.records import AccuracyBudget, AutobalancerRecord, Section
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import SpeedLevel
from tests.sizing.machines import machine


@pytest.fixture(scope="module")
def design() -> Design:
    return size(machine())


def test_the_chosen_design_in_user_units_obeys_its_formulas(design: Design) -> None:
    """sin β = r/R_p; m·R_p·sin nβ/sin β; F = m·R_p·Ω² at the top speed; √(g/R_p)."""
    record = AutobalancerRecord.of(design.case.autobalancer, design.autobalancer, design.track)
    radius, pitch = record.ball_diameter_mm / 2, record.pitch_radius_mm
    assert pitch == pytest.approx(record.race_radius_mm - radius)
    beta = math.asin(radius / pitch)
    capacity = record.ball_mass_g * pitch * math.sin(record.ball_count * beta) / math.sin(beta)
    assert record.capacity_g_mm == pytest.approx(capacity, rel=1e-9)
    speed = design.case.speed_range[1]
    assert record.ball_force_N == pytest.approx(record.ball_mass_g * pitch * 1e-6 * speed**2, rel=1e-9)
    assert record.carry_over_rpm == pytest.approx(math.sqrt(9.80665 / (pitch / 1e3)) * 30 / math.pi, rel=1e-9)
    assert record.mass_g == pytest.approx(1e3 * design.autobalancer.mass) and record.why_not is None


def test_the_expected_residual_is_a_root_of_squares_below_the_plain_sum(design: Design) -> None:
    budget = AccuracyBudget.of(design, None)
    parts = [budget.race_eccentricity_um, budget.rolling_friction_um, budget.race_ovality_um, budget.plane_offset_um]
    assert budget.residual_um == pytest.approx(math.hypot(*(part or 0.0 for part in parts)), rel=1e-9)
    assert budget.worst_um is not None and budget.residual_um is not None and budget.worst_um >= budget.residual_um
    assert budget.rolling_friction_reached_um is None


def test_the_section_holds_its_own_lengths(design: Design) -> None:
    section = Section.of(design)
    candidate = design.autobalancer
    assert section.race_diameter_mm == pytest.approx(2e3 * candidate.race_radius)
    assert section.bore_diameter_mm < section.hub_diameter_mm < section.race_diameter_mm <= section.ring_diameter_mm
    assert 2 * section.web_mm + section.inner_width_mm == pytest.approx(1e3 * candidate.housing.width)
    balls = candidate.balls_mass
    assert sum(part.mass_g for part in section.parts) == pytest.approx(1e3 * (candidate.mass - balls), rel=1e-6)


def test_a_level_keeps_its_speed_in_rpm() -> None:
    level = SpeedLevel(speed=100 * math.pi, level_after_db=98.5)
    assert (level.speed_rpm, level.level_after_db) == (pytest.approx(3000.0), 98.5)
