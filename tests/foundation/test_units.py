"""Conversions between units of files and SI."""

import cmath
import math

import pytest

from abu_calc.foundation.units import (
    SI_PER_UNIT,
    SYMBOLS,
    from_si,
    level_from_velocity,
    to_si,
    unit_of,
    velocity_from_level,
    wrapped_deg,
)
from tests.rows import for_each


@for_each(SI_PER_UNIT)
def test_there_and_back_is_nowhere(unit: str) -> None:
    assert from_si(to_si(0.37, unit), unit) == pytest.approx(0.37, rel=1e-15)


@pytest.mark.parametrize(("amount", "unit", "same", "other"), [
    (60, "rpm", 1, "hz"), (360, "deg", 2 * math.pi, "rad"), (1000, "g_mm", 1e-3, "kg"),
    (1, "kN_per_m", 1000, "N_per_m"), (1000, "um", 1, "mm"), (1, "GPa", 1000, "MPa"),
    (1000, "mrad", 1, "rad"), (1, "min", 60, "s"),
])  # fmt: skip
def test_one_quantity_in_two_units_is_one_si_value(amount: float, unit: str, same: float, other: str) -> None:
    """1000 g·mm are 1 g·m, 1e-3 kg·m."""
    assert to_si(amount, unit) == pytest.approx(to_si(same, other), rel=1e-14)


def test_ten_times_the_velocity_is_twenty_decibels_more() -> None:
    assert level_from_velocity(5e-8) == 0.0
    for level in (0.0, 109.0, 111.3):
        assert level_from_velocity(10 * velocity_from_level(level)) == pytest.approx(level + 20, abs=1e-12)


@pytest.mark.parametrize("turns", range(-4, 5))
@pytest.mark.parametrize("angle", [-179.9, -90.0, 0.0, 0.1, 180.0])
def test_a_wrapped_angle_is_the_same_direction(turns: int, angle: float) -> None:
    given = math.radians(angle + 360 * turns)
    degrees = wrapped_deg(given)
    assert -180 < degrees <= 180
    assert cmath.rect(1, math.radians(degrees)) == pytest.approx(cmath.rect(1, given), abs=1e-13)


def test_half_a_turn_back_is_half_a_turn_ahead() -> None:
    assert wrapped_deg(-math.pi) == wrapped_deg(math.pi) == 180


def test_a_key_carries_the_longest_unit_that_it_ends_in() -> None:
    assert unit_of("stiffness_kN_per_m") == "kN/m" and unit_of("time_s") == "s" and unit_of("level_db") == "dB"
    assert unit_of("torque_N_m") == "N·m" != unit_of("length_m") == "m"
    assert all(unit_of(f"key_{unit}") == SYMBOLS.get(unit, unit) for unit in SI_PER_UNIT)
