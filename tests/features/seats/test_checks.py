"""Checks of seats: what fails, what warns, what cannot be judged."""

from typing import Any

import pytest

from abu_calc.features.seats.seats import seat_bearing
from abu_calc.foundation.checks import Check, overall
from tests.features.seats.samples import by_designation, seats


def um(metres: float) -> float:
    return round(1e6 * metres, 6)


def span(interval: Any) -> list[float]:
    return [um(interval.smallest), um(interval.largest)]


def check(fit: Any, number: int) -> Check:
    return fit.checks[number]


@pytest.mark.parametrize(("missing", "said"), [("radial_load_kN", "no radial load"), ("chamfer_mm", "no chamfer")])
def test_what_is_not_known_is_not_done(missing: str, said: str) -> None:
    found = seats(**{missing: None, "width_mm": 33.5})  # no tabulated bearing has these sizes
    shaft = found.shaft
    assert (shaft.required_interference, shaft.required_by) == (None, None)
    assert shaft.recommended_fit == "k5" and "is not known, so k5 is the class that SKF" in " ".join(shaft.notes)
    assert shaft.load_intensity is None
    assert check(shaft, 0).status == "not-done"
    assert said in check(shaft, 0).message
    assert missing in check(shaft, 0).remedy
    assert span(shaft.interference) == [2, 36]
    assert overall(found.checks) == "not-done"


def test_a_rotating_outer_ring_must_grip() -> None:
    housing = seats(housing_fit="M7", outer_ring_load="rotating").housing
    assert check(housing, 0).status == "pass"  # the catalogue's own class
    assert check(housing, 0).limit == pytest.approx(9.0252, abs=1e-4)  # 0.08·√(140·3000/33)
    assert housing.recommended_fit == "M7"  # of 32216, which has these sizes: P/C = 0.016
    unknown = {"width_mm": 33.5, "outer_ring_load": "rotating"}  # no bearing: the rule alone decides
    assert seats(housing_fit="M7", **unknown).housing.recommended_fit == "P7"
    loose = seats(housing_fit="H7", outer_ring_load="indeterminate").housing
    assert [check.status for check in loose.checks if check.code in ("ABU611", "ABU615")] == ["fail", "fail"]


def test_too_tight_a_seat_fails() -> None:
    fit = by_designation("6000", shaft_fit="r6", radial_load_kN=0.1)
    shaft = seat_bearing(fit).shaft
    assert (um(shaft.interference.largest), um(shaft.permitted_interference)) == (36, 10)
    assert (check(shaft, 1).code, check(shaft, 1).status) == ("ABU602", "fail")
    assert "400 MPa of the ring (Lamé)" in check(shaft, 1).message


def test_a_thousandth_of_the_diameter_warns_and_stress_fails() -> None:
    own = seat_bearing(by_designation("608", shaft_fit="js5", radial_load_kN=0.2)).shaft
    assert own.checks[1].status == "pass" and own.recommended_fit == "js5"  # 11 µm, but the catalogue's own class
    small = seat_bearing(by_designation("608", shaft_fit="k5", radial_load_kN=0.2)).shaft
    assert small.checks[1].status == "warn" and small.checks[1].limit == pytest.approx(8)
    assert seat_bearing(by_designation("608", shaft_fit="r6", radial_load_kN=0.2)).shaft.checks[1].status == "fail"


def test_without_a_load_a_normal_one_is_judged_and_told() -> None:
    found = seat_bearing(by_designation("6205", radial_load_kN=None, shaft_fit=None, housing_fit=None))
    assert found.shaft.checks[0].status == "pass" and found.shaft.recommended_fit == "k5"
    assert "kN (normal, assumed)" in found.shaft.checks[0].message
    light = seat_bearing(by_designation("6205", radial_load_kN=None, shaft_fit="h5", housing_fit=None)).shaft
    assert light.checks[0].status == "warn"  # an assumed load never fails a class
    loose = seat_bearing(by_designation("6205", radial_load_kN=None, shaft_fit="g6", housing_fit=None)).shaft
    assert loose.checks[0].status == "fail"  # most pairs are loose: no load is held
    assert found.housing.checks[0].status == "pass" and found.housing.recommended_fit == "H7"


@pytest.mark.parametrize(
    ("shaft", "housing", "status"), [("j6", "H7", "warn"), ("h6", "H7", "pass"), ("p6", "N7", "fail")]
)
def test_cn_warns_with_the_share_unless_most_have_none_left(shaft: str, housing: str, status: str) -> None:
    found = seat_bearing(by_designation("6208", shaft_fit=shaft, housing_fit=housing, internal_clearance="CN"))
    check = found.checks[-1]
    assert (check.code, check.status) == ("ABU621", status) and "have none left" in check.message
    assert (found.clearance.below_zero_probability >= 0.5) == (status == "fail")


def test_a_light_alloy_that_lets_a_rotating_load_go_fails_also_without_a_load_and_names_what_helps() -> None:
    turning = {
        "radial_load_kN": None, "inner_ring_load": "stationary", "outer_ring_load": "rotating", "shaft_fit": None,
        "temperature_range_K": [0.0, 80.0], "housing_material": "aluminium",
    }  # fmt: skip
    check = seat_bearing(by_designation("6310", **turning, housing_fit="N7")).housing.checks[0]
    assert check.status == "fail" and "a housing of steel" in (check.remedy or "")
    steel = seat_bearing(by_designation("6310", **{**turning, "housing_material": "steel"}, housing_fit=None)).housing
    assert steel.checks[0].status == "pass" and steel.recommended_fit is not None
    # Under such a load no class holds in steel, either.
    heavy = seat_bearing(by_designation("6312", **{**turning, "radial_load_kN": 68.7}, housing_fit=None)).housing
    assert heavy.checks[0].status == "fail" and "steel" not in (heavy.checks[0].remedy or "")


def test_start_is_checked_only_where_a_torque_is_given_and_a_ring_must_grip() -> None:
    codes = [check.code for check in seats(shaft_fit="m6", starting_torque_N_m=500.0).checks]
    assert codes[:6] == ["ABU601", "ABU602", "ABU603", "ABU605", "ABU611", "ABU612"]
    shaft = seats(shaft_fit="m6", starting_torque_N_m=500.0).shaft
    assert (shaft.creep.holds_at_start, shaft.checks[2].status) == (False, "fail")
    assert shaft.recommended_fit not in ("m6", None)
    assert seats(starting_torque_N_m=0.0, shaft_fit="m6").shaft.checks[2].status == "pass"
    unknown_length = seats(chamfer_mm=None, width_mm=33.5, starting_torque_N_m=1.0).shaft
    assert unknown_length.checks[2].status == "not-done"
