"""Charts of the atlas as data: axes ascend, fixed numbers fit within their tolerances, classes have words."""

import pytest

from abu_calc.features.atlas.charts import FixedNumber, cells, charts, place
from abu_calc.features.atlas.machine_numbers import machine_numbers
from abu_calc.inputs.read_machine import read
from abu_calc.sizing import size

MOTOR = {"motor.stall_torque_N_m": 3.0, "run_up.time_s": 1.0, "type_test.test_wheel_imbalance_g_mm": 100.0}


@pytest.mark.parametrize("chart", charts(), ids=lambda chart: chart.name)
def test_a_chart_has_axes_that_ascend_bounds_and_all_its_cells(chart) -> None:  # type: ignore[no-untyped-def]
    for axis in (chart.across, chart.up):
        assert list(axis.values) == sorted(set(axis.values)) and len(axis.values) >= 2
    assert list(chart.bounds) == sorted(chart.bounds) and len(chart.bounds) == 4 and len(chart.words) == 5
    for across in chart.across.values:
        for up in chart.up.values:
            value, low, high = cells()[place(chart.name, across, up)]
            assert low <= value <= high and 0 <= chart.class_of(value) <= 4


def test_all_numbers_of_charts_are_numbers_of_machines() -> None:
    machine = read("avtovaz-707-222").changed(MOTOR)
    known = set(machine_numbers(size(machine.whole("size"))))
    wanted = {each.number for chart in charts() for each in chart.fixed}
    wanted |= {axis.number for chart in charts() for axis in (chart.across, chart.up)}
    assert wanted <= known


def test_numbers_of_a_machine_by_hand() -> None:
    """AvtoVAZ 707: M 6.2 kg, 4 balls Ø15.875 mm of steel 7800 kg/m³ on 23.0625 mm, U 256.02 g·mm at 5800 rpm."""
    numbers = machine_numbers(size(read("avtovaz-707-222").whole("size")))
    ball = 7.8e3 * 3.14159265 / 6 * 0.015875**3
    displaced = 256.021e-6 / 6.2
    assert numbers["mass_over_balls"] == pytest.approx(6.43995 / (4 * ball), rel=1e-4)
    assert numbers["imbalance_share"] == pytest.approx(256.021e-6 / (4 * ball * 0.0230625), rel=1e-4)
    assert numbers["eccentricity"] == pytest.approx(10e-6 / displaced, rel=1e-4)
    assert numbers["friction"] == pytest.approx(2e-6 * 0.0230625 / 0.0079375 / displaced, rel=1e-4)
    assert numbers["speed_ratio"] == pytest.approx(5800 / 60 / (2.5 * (6.2 / 6.43995) ** 0.5), rel=1e-4)
    assert numbers["damping"] == pytest.approx(0.5 * (6.2 / 6.43995) ** 0.5, rel=1e-4)
    assert numbers["runout"] == pytest.approx(90e-6 / displaced, rel=1e-4)
    assert numbers["spindle"] == "horizontal" and numbers["balls"] == 4


def test_a_body_in_space_has_no_place() -> None:
    assert machine_numbers(size(read("angle-grinder-125").whole("size"))) == {}


def test_a_fixed_number_fits_within_its_tolerance() -> None:
    fixed = FixedNumber("damping ratio", "damping", 0.5, 0.25)
    assert fixed.fits(0.38) and fixed.fits(0.62) and not fixed.fits(0.37) and not fixed.fits(0.63)
    assert FixedNumber("balls", "balls", 4.0).fits(4.0) and not FixedNumber("balls", "balls", 4.0).fits(5.0)
    spindle = FixedNumber("spindle", "spindle", "vertical")
    assert spindle.fits("vertical") and not spindle.fits("horizontal") and not spindle.fits(1.0)
