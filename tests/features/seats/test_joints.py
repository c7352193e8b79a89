"""Seats at work: cold, as mounted, hot; mounting by heat and by force. Numbers by equations of their own."""

import math

import pytest

from abu_calc.features.seats.command import NAMES
from abu_calc.features.seats.seats import seat_bearing
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import machine_of_bearings
from tests.features.seats.samples import by_designation, seats
from tests.features.seats.test_verdicts import judged, status

ALUMINIUM, STEEL = 23.5e-6, 12e-6


def test_a_heated_ring_clears_the_tightest_pair() -> None:
    """80 mm, m6 on a ring of 0 … -15 µm: 45 µm; a two-thousandth of 80 mm is 40 µm."""
    way = seats(shaft_fit="m6").shaft.mounting
    grown = STEEL * 80e-3 * (way.heat_ring_C - 20)
    assert grown == pytest.approx(85e-6, rel=1e-9) and way.hottest_C == 120 and way.cool_part_C is None
    asked = seats(shaft_fit="m6", mounting_clearance_um=10.0).shaft.mounting
    assert STEEL * 80e-3 * (asked.heat_ring_C - 20) == pytest.approx(55e-6, rel=1e-9)


def test_a_ring_that_would_be_too_hot_goes_with_a_cooled_shaft() -> None:
    """Both changes together make up the interference and the clearance; a sealed bearing may be heated to 80 °C."""
    for designation, hottest in (("6202", 120.0), ("6202-2RS", 80.0)):
        way = seat_bearing(by_designation(designation, radial_load_kN=1.0, shaft_fit="m6")).shaft.mounting
        moved = STEEL * 15e-3 * (hottest - 20) + STEEL * 15e-3 * (20 - way.cool_part_C)
        tightest = 18e-6 + 8e-6  # m6: 7 … 18 µm, the ring 0 … -8 µm
        assert way.hottest_C == hottest and moved == pytest.approx(tightest + 7.5e-6, rel=1e-9)


def test_the_press_force_is_that_of_two_tubes_of_one_steel() -> None:
    """Solid shaft, one material: p = E·δ·(1 - q²)/(2·d), q the bore of the ring over its mean outside (Lamé)."""
    found = seats(shaft_fit="m6").shaft
    d, q, length = 80e-3, 80 / (80 + 0.28 * 60), 29e-3
    for force, interference in zip(found.mounting.press_force_N, (11e-6, 45e-6), strict=True):
        pressure = 206e9 * interference * (1 - q**2) / (2 * d)
        assert force == pytest.approx(0.12 * pressure * math.pi * d * length, rel=1e-6)
    assert found.mounting.lets_go_at_C is None  # ring and shaft are of one steel


def test_a_housing_lets_its_ring_go() -> None:
    """52 mm, N7 (-39 … -9 µm) round a ring of 0 … -13 µm: -4 … 39 µm, lost by 11.5e-6·52 mm for each kelvin."""
    way = judged("6205", radial_load_kN=1, housing_material="aluminium", outer_ring_load="rotating", housing_fit="N7")
    housing = way.housing
    per_kelvin = (ALUMINIUM - STEEL) * 52e-3
    assert housing.mounting.lets_go_at_C == pytest.approx([20.0, 20 + 39e-6 / per_kelvin])
    assert housing.mounting.heat_housing_C == pytest.approx(20 + (39e-6 + 26e-6) / (ALUMINIUM * 52e-3))
    assert housing.mounting.heat_ring_C is None


def test_a_loose_ring_needs_no_press() -> None:
    way = seats(housing_fit="H7").housing.mounting
    assert (way.press_force_N, way.heat_housing_C, way.lets_go_at_C) == (None, None, None)


@pytest.mark.parametrize(("given", "cold", "hot"), [
    ({}, 0.0, 50.0), ({"temperature_rise_K": 60.0}, 0.0, 60.0), ({"temperature_rise_K": -60.0}, -60.0, 0.0),
    ({"temperature_range_K": (-40.0, 90.0)}, -40.0, 90.0),
    ({"temperature_rise_K": 30.0, "temperature_range_K": (-10.0, 20.0)}, -10.0, 30.0),
])  # fmt: skip
def test_cold_and_hot_are_those_given_or_the_usual_ones(given: dict[str, object], cold: float, hot: float) -> None:
    """J7 of 52 mm: -12 … 18 µm, the ring 0 … -13 µm."""
    housing = judged("6205", radial_load_kN=0.5, housing_material="aluminium", housing_fit="J7", **given).housing
    for state, rise in (("cold", cold), ("hot", hot)):
        lost = 1e6 * (ALUMINIUM - STEEL) * 52e-3 * rise
        assert housing.at_work_um[state] == pytest.approx([-31 - lost, 12 - lost], abs=1e-6)


def test_the_clearance_inside_follows_both_seats() -> None:
    """A cold aluminium housing presses the ring, so the clearance falls; in steel all three are alike."""
    inside = judged("6208", radial_load_kN=3, housing_material="aluminium", temperature_range_K=(-60, 40),
                    internal_clearance="C3").clearance_at_work  # fmt: skip
    assert inside["cold"][0] < inside["mounted"][0] - 5e-6 and inside["hot"][0] >= inside["mounted"][0]
    steel = judged("6208", radial_load_kN=3, internal_clearance="C3").clearance_at_work
    assert steel["cold"] == pytest.approx(steel["hot"])


@pytest.mark.parametrize("designation", ["6203", "6205", "6308", "NU210", "6020"])
@pytest.mark.parametrize("rise", [None, 60.0, -60.0])
def test_a_light_alloy_gets_a_step_tighter_and_never_a_coarser_grade(designation: str, rise: float | None) -> None:
    """J7 where H7 stands for iron (SKF, electric motors and generators), cold or hot."""
    load = {"radial_load_kN": 0.5, "temperature_rise_K": rise}
    iron, light = (judged(designation, **load, housing_material=name) for name in ("cast-iron", "aluminium"))
    assert (iron.housing.recommended_fit, light.housing.recommended_fit) == ("H7", "J7")


def test_a_class_for_warm_light_alloy_that_loosens_hot_tells_the_ways_out() -> None:
    """6205 in thick aluminium under a rotating load: P7 is 8 … 51 µm, at 70 °C -22 … 21 µm."""
    found = judged("6205", radial_load_kN=1, housing_material="aluminium", inner_ring_load="stationary",
                   outer_ring_load="rotating")  # fmt: skip
    told = next(check for check in found.checks if check.code == "ABU611")
    assert found.housing.recommended_fit == "P7" and told.status == "warn"
    assert "70 °C assumed, the mean is -0.4 µm" in told.message and "steel sleeve" in (told.remedy or "")


def test_the_load_of_a_process() -> None:
    """Afanasiev 2015: 4100 N, 2.8 times it normal to the work: 12.2 kN, by four bearings 3.05 kN each."""
    found = seats(radial_load_kN=None, cutting_force_N=4100.0, normal_to_cutting_ratio=2.8, bearings_sharing=4)
    assert found.bearing.service.radial_load == pytest.approx(4100 * math.sqrt(1 + 2.8**2) / 4, rel=1e-12)
    assert any("shared by 4 bearings" in note for note in found.shaft.notes)
    with pytest.raises(InputError, match="both give the radial load"):
        machine_of_bearings([{"designation": "6205", "radial_load_kN": 1.0, "cutting_force_N": 900.0}], NAMES)
    with pytest.raises(InputError, match="without cutting_force_N"):
        machine_of_bearings([{"designation": "6205", "bearings_sharing": 2}], NAMES)


def test_a_measured_ring_takes_the_place_of_its_class() -> None:
    """A shaft of 2 … 5 µm in a bore of -6 … -2 µm: 4 … 11 µm, whatever the class of the bearing."""
    found = seats(shaft_limits_um=(2.0, 5.0), shaft_fit=None, ring_bore_limits_um=(-6.0, -2.0)).shaft
    assert found.interference_um == pytest.approx([4, 11]) and found.ring_limits_um == pytest.approx([-6, -2])
    assert status(seats(shaft_fit="m6", ring_bore_limits_um=(-6.0, -2.0)), "ABU601") == "pass"
