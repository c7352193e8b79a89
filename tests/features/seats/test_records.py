"""Bearing seats as results hold them: micrometres, and what a ring without need of interference shows."""

import pytest

from abu_calc.features.seats.records import seat_results, um, um_pair
from abu_calc.features.seats.seats import seat_bearing
from tests.features.seats.samples import by_designation, seats


def test_micrometres_are_free_of_the_rounding_of_metres() -> None:
    assert um(2e-6 + 1e-13) == 2.0 and um_pair((-15e-6, 0.0)) == (-15.0, 0.0)


def test_both_seats_come_shaft_first_with_their_limits() -> None:
    """80 k6: +2 … +21 µm, ring −15 … 0 µm (ISO 286-2, ISO 492)."""
    shaft, housing = seat_results(seats())
    assert (shaft.seat, housing.seat) == ("shaft", "housing")
    assert (shaft.part_limits_um, shaft.ring_limits_um) == ((2.0, 21.0), (-15.0, 0.0))
    assert shaft.interference_um == (2.0, 36.0) and shaft.tightest_um == 36.0
    assert (shaft.diameter_mm, shaft.ring_width_mm, shaft.chamfer_mm) == pytest.approx((80.0, 33.0, 2.0))


def test_a_ring_under_a_fixed_load_needs_no_interference() -> None:
    shaft, housing = seat_results(seats())
    assert housing.needs_no_grip and housing.needed_um is None and housing.needed_by is None
    assert not shaft.needs_no_grip and shaft.needed_um == shaft.required_interference_um is not None


def test_a_clearance_fit_has_no_tightest_interference() -> None:
    _, housing = seat_results(seats(housing_fit="G7"))
    assert housing.interference_um[1] < 0 and housing.tightest_um == 0.0


def test_the_clearance_left_and_the_verdict_stand_in_both_seats() -> None:
    judged = seat_bearing(by_designation("6208", shaft_fit="p6", housing_fit="N7", internal_clearance="CN"))
    shaft, housing = seat_results(judged)
    assert shaft.internal_clearance == housing.internal_clearance is not None
    assert shaft.bearing_verdict == housing.bearing_verdict == "fail"
