"""Levels as instruments show them, and a measurement beside the prediction."""

import math

import pytest

from abu_calc.simulation.vibration_records import (
    HandleLevels,
    compared,
    level_where_measured,
    measured_place,
)
from abu_calc.sizing import size
from abu_calc.sizing.case import read_case
from abu_calc.sizing.places import LevelPlace, Levels
from tests.sizing.machines import PINNED, machine

SPEED = 5800 * math.pi / 30
BODY = {
    "machine__transverse_inertia_kg_m2": 0.1,
    "machine__center_of_mass_to_wheel_mm": 200.0,
    "machine__handle": [{"name": "rear", "from_center_of_mass_mm": -200.0}],
}


def test_nothing_is_compared_without_a_measurement() -> None:
    design = size(machine(**PINNED))
    assert compared(design.case, 100.0) is level_where_measured(design, 1e-5) is None


def test_a_measurement_above_the_prediction_has_a_positive_difference() -> None:
    record = compared(read_case(machine(measured_after={"measured_level_db": 103.0})), 100.0, 105.0)
    assert record is not None and (record.unit, record.place) == ("dB", "wheel plane")
    assert (record.measured_level_db, record.predicted_level_db) == pytest.approx((103.0, 100.0))
    assert (record.difference_db, record.predicted_loaded_db) == (pytest.approx(3.0), 105.0)


def test_without_a_prediction_there_is_no_difference() -> None:
    record = compared(read_case(machine(measured_after={"measured_level_db": 103.0})), None)
    assert record is not None and record.predicted_level_db is record.difference_db is record.predicted_value is None


def test_the_prediction_is_that_of_the_place_where_it_was_measured() -> None:
    """A handle moves by |1/M − 0.4|/(1/M + 0.4) of what the wheel moves, a_p a_w/J = −0.4 and a_w²/J = 0.4 1/kg."""
    design = size(machine(**BODY, measured_after={"measured_level_db": 100.0, "measured_at": "rear"}))
    shown = design.case.table.measured_after.shown  # type: ignore[union-attr]
    assert shown is not None and measured_place(design.case, shown) == ("rear", (0.0, 0.0, -0.2))
    mass = 6.2 + design.autobalancer.mass
    moved = 1e-5 * abs(1 / mass - 0.4) / (1 / mass + 0.4)
    level = 20 * math.log10(moved * SPEED / math.sqrt(2) / 5e-8)
    assert level_where_measured(design, 1e-5) == pytest.approx(level, abs=1e-6)
    assert level_where_measured(design, None) is None


def test_a_place_pressed_at_once_stands_beside_the_settled_one() -> None:
    settled, hasty = (LevelPlace("rear", 3.0, Levels(110.0, after)) for after in (101.0, 115.0))
    levels = HandleLevels.of(settled, hasty=hasty)
    assert (levels.reduction_db, levels.level_at_once_db) == (pytest.approx(9.0), 115.0)
    shown = HandleLevels.of(settled, SPEED).shown_before
    assert levels.shown_before is None and shown is not None
    assert shown.velocity_mm_per_s == pytest.approx(5e-5 * 10 ** (110 / 20))
    assert shown.displacement_um == pytest.approx(1e3 * shown.velocity_mm_per_s / SPEED)
