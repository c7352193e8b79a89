"""Verdicts that an application engineer would sign: each with its reason, and the properties that hold them.

The cases are given with the catalogue row, the pressure by Lamé or the published example that settles them.
"""

import itertools
import math
from functools import cache
from typing import Any

import pytest

from abu_calc.features.seats.seats import BearingSeats, seat_bearing
from abu_calc.standards.bearing_catalogue import bearing as dimensions
from abu_calc.standards.catalogue import catalogue_bearing
from tests.features.seats.samples import by_designation, table
from tests.features.seats.test_advice import DEEP_GROOVE

OPEN = {"shaft_fit": None, "housing_fit": None}
LIGHT_TO_HEAVY = (0.03, 0.08, 0.15, 0.25)


def judged(designation: str, **changes: Any) -> BearingSeats:
    return seat_bearing(by_designation(designation, **(OPEN | changes)))


@cache
def at_share(designation: str, share: float) -> BearingSeats:
    """Under a load of this share of C."""
    ratings = catalogue_bearing(designation).ratings
    assert ratings is not None
    return judged(designation, radial_load_kN=share * ratings.dynamic / 1e3)


def by_sizes(bore: float, outer: float, width: float, kind: str, **changes: Any) -> BearingSeats:
    sizes = {"bore_mm": bore, "outer_mm": outer, "width_mm": width, "chamfer_mm": None, "bearing_type": kind}
    return seat_bearing(table(**(OPEN | sizes | {"series": None} | changes)))


def status(found: BearingSeats, code: str) -> str:
    return next(check.status for check in found.checks if check.code == code)


def message(found: BearingSeats, code: str) -> str:
    return next(check.message for check in found.checks if check.code == code)


def test_1_sizes_of_6205_get_its_rating_and_class() -> None:
    """0.7 kN is 0.047·C of 6205: the row up to 0.05·C, over 17 up to 100 mm, gives j6, and the usual clearance."""
    found = by_sizes(25, 52, 15, "ball", radial_load_kN=0.7)
    assert found.shaft.recommended_fit == "j6" and found.group_to_order == "CN"
    assert found.bearing.ratings is not None and found.bearing.ratings.dynamic == 14_800
    assert any("6205" in note for note in found.shaft.notes)


@pytest.mark.slow
def test_1_sizes_and_designation_agree_at_a_twentieth_of_c() -> None:
    for name in DEEP_GROOVE:
        size, ratings = dimensions(name), catalogue_bearing(name).ratings
        assert ratings is not None
        load = {"radial_load_kN": 0.05 * ratings.dynamic / 1e3}
        named = judged(name, **load)
        sized = by_sizes(*(round(1e3 * length, 6) for length in size[2:5]), "ball", **load)
        for one, other in zip(named.seats, sized.seats, strict=True):
            assert (one.recommended_fit, one.catalogue_fit) == (other.recommended_fit, other.catalogue_fit), name
        assert named.group_to_order == sized.group_to_order, name
        assert named.life.static_safety == sized.life.static_safety, name


def test_1_sizes_of_no_bearing_get_an_estimate_that_says_so() -> None:
    found = by_sizes(26, 53, 15.5, "ball", radial_load_kN=0.7)
    assert found.bearing.ratings is not None and found.shaft.catalogue_fit == "j6"
    assert found.bearing.ratings.dynamic == pytest.approx(14_800, rel=0.25)  # its neighbour's
    assert any("estimated" in note for note in found.shaft.notes)


@pytest.mark.parametrize(
    ("found", "seat", "expected"),
    [
        # P/C = 0.2: rollers over 30 up to 50 mm, m5; the rows for very heavy loads begin above 50 mm.
        (lambda: by_sizes(50, 90, 20, "cylindrical", dynamic_load_rating_kN=73.7, radial_load_kN=15), "shaft", "m5"),
        # P/C = 0.18 and 0.19: cylindrical over 85 up to 140 mm, and spherical over 70 up to 140 mm, p6.
        (lambda: judged("NU320", radial_load_kN=80), "shaft", "p6"),
        (lambda: judged("22220", radial_load_kN=80), "shaft", "p6"),
        # Rollers above 0.1·C, rotating outer ring: P7.
        (
            lambda: by_sizes(
                100, 180, 34, "cylindrical", dynamic_load_rating_kN=285, radial_load_kN=40, outer_ring_load="rotating",
                inner_ring_load="stationary",
            ),
            "housing",
            "P7",
        ),
    ],
    ids=["NU210", "NU320", "22220", "NU220"],
)  # fmt: skip
def test_2_the_row_governs_under_heavy_loads(found: Any, seat: str, expected: str) -> None:
    result = found()
    fit = getattr(result, seat)
    assert (fit.recommended_fit, fit.catalogue_fit) == (expected, expected)
    assert fit.rule_fit != expected and any("governs" in note for note in fit.notes)
    code = {"shaft": "ABU601", "housing": "ABU611"}[seat]
    assert status(result, code) == "pass"


@pytest.mark.parametrize("number", range(12, 21))
def test_2_ball_bearings_at_a_quarter_of_c_take_k5(number: int) -> None:
    """Ball bearings over 17 up to 100 mm above 0.05·C: k5, however heavy the load."""
    name = f"62{number}"
    ratings = catalogue_bearing(name).ratings
    assert ratings is not None
    found = judged(name, radial_load_kN=0.25 * ratings.dynamic / 1e3)
    assert (found.shaft.recommended_fit, found.group_to_order) == ("k5", "C3")
    assert found.shaft.rule_fit in ("p5", "p6", "r6")


def test_3_a_load_above_c0_fails_whatever_the_class() -> None:
    """6205, 14 kN: C0/P0 = 7.8/14 = 0.557."""
    found = judged("6205", radial_load_kN=14)
    assert found.life.static_safety == pytest.approx(7.8 / 14) and status(found, "ABU631") == "fail"
    assert found.shaft.recommended_fit is None
    for fit in ("k5", "m5", "r6"):
        assert status(judged("6205", radial_load_kN=14, shaft_fit=fit), "ABU631") == "fail"


def test_4_half_of_the_pairs_short_at_speed_fails_and_the_advice_mends_it() -> None:
    """6205, 1 kN, 60 000 rpm on k5: 3.27 µm by the load and 8.2 by the spinning ring, mean 11.5 µm, σ 2.24."""
    found = judged("6205", radial_load_kN=1, speed_rpm=60_000, shaft_fit="k5", housing_fit="H7")
    growth = 3.3 * 7800 / (16 * 206e9) * (60_000 * math.pi / 30) ** 2 * 0.025 * (0.025 + 0.28 * 0.027) ** 2
    needed = 0.08 * math.sqrt(25 * 1000 / 15) + 1e6 * growth
    sigma = math.hypot(4.5, 5) / 3
    share = 0.5 * math.erfc((11.5 - needed) / sigma / math.sqrt(2))
    assert found.shaft.short_pairs_share == pytest.approx(share, rel=1e-6) == pytest.approx(0.49, abs=0.005)
    assert (status(found, "ABU605"), status(found, "ABU601")) == ("fail", "warn")
    again = judged("6205", radial_load_kN=1, speed_rpm=60_000, shaft_fit=found.shaft.recommended_fit)
    assert status(again, "ABU605") == "pass" and again.shaft.short_pairs_share < 0.01


def test_4_the_demand_is_no_more_than_nearly_all_pairs_of_the_catalogues_class_have() -> None:
    """6205, 3 kN: k5 has a mean of 11.5 µm and σ 2.24, so j5 of mean 5.5 is asked for 4.78 µm, not 5.66."""
    sigma = math.hypot(4.5, 5) / 3
    found = judged("6205", radial_load_kN=3, speed_rpm=1500, shaft_fit="j5")
    assert found.shaft.catalogue_fit == "k5"
    share = 0.5 * math.erfc((5.5 - (11.5 - 3 * sigma)) / sigma / math.sqrt(2))
    assert found.shaft.short_pairs_share == pytest.approx(share, rel=0.02)  # an ordinary speed counts a little


def test_4_the_limits_of_short_pairs_come_from_the_file() -> None:
    given = {"radial_load_kN": 1, "speed_rpm": 60_000, "shaft_fit": "k5"}
    assert status(judged("6205", **given, short_pairs_warn_percent=50.0, short_pairs_fail_percent=60.0), "ABU605") == (
        "pass"
    )
    assert status(judged("6205", **given, short_pairs_fail_percent=49.5), "ABU605") == "warn"


def test_5_a_hollow_shaft_needs_what_lame_says() -> None:
    """6210, bore 40 mm: 63 % of the pressure, 1.59 times the interference; m5 is nearest to 1.59 × 13.5 µm."""
    solid, hollow = (judged("6210", radial_load_kN=3, shaft_bore_mm=bore) for bore in (None, 40.0))
    assert hollow.shaft.pressure_kept == pytest.approx(0.63, abs=0.005)
    ratio = hollow.shaft.required_interference / solid.shaft.required_interference
    assert ratio == pytest.approx(1.59, abs=0.005)
    assert (solid.shaft.recommended_fit, hollow.shaft.recommended_fit) == ("k5", "m5")


def test_5_the_published_hollow_shaft_of_skf() -> None:
    """General Catalogue 2006, page 173: 6208 under normal load, bore 0.8·d: 1.7 × 13.5 = 23 µm, m6."""
    found = judged("6208", radial_load_kN=3, shaft_bore_mm=32.0)
    assert 1 / found.shaft.pressure_kept == pytest.approx(1.7, abs=0.02)  # which SKF read off its diagram
    assert found.shaft.recommended_fit == "m6"
    assert 1e6 * found.shaft.joint.with_class("m6").mean == pytest.approx(23, abs=0.5)


def test_5_a_thin_aluminium_housing_takes_the_class_for_thin_walls() -> None:
    """6205 in aluminium 58/52 mm: 22 % of the pressure; the row's class for thin-walled housings is P7, not N7."""
    load = {"radial_load_kN": 1, "inner_ring_load": "stationary", "outer_ring_load": "rotating"}
    thick = judged("6205", **load)
    thin = judged("6205", **load, housing_material="aluminium", housing_outer_mm=58.0)
    assert thin.housing.pressure_kept == pytest.approx(0.22, abs=0.005)
    assert (thick.housing.recommended_fit, thin.housing.recommended_fit) == ("N7", "P7")
    assert status(thin, "ABU615") in ("pass", "warn")


def test_6_a_cold_aluminium_housing_is_tight_and_gets_ways_out() -> None:
    """6208, −60 K: aluminium shrinks by 11.5e-6 · 80 mm · 60 K = 55.2 µm more than the ring: H7 is 12 … 55 µm tight."""
    found = judged("6208", radial_load_kN=3, housing_material="aluminium", temperature_rise_K=-60, housing_fit="H7")
    assert status(found, "ABU611") == "warn" and "12.2 … 55.2 µm tight" in message(found, "ABU611")
    assert found.shaft.recommended_fit == "k5"
    assert found.housing.recommended_fit == "J7"
    again = judged("6208", radial_load_kN=3, housing_material="aluminium", temperature_rise_K=-60)
    told = next(check for check in again.checks if check.code == "ABU611")
    assert told.status == "warn" and "steel sleeve" in told.remedy and "O-ring" in told.remedy
    # J7 of 80 mm: −12 … 18 µm, the ring 0 … −13 µm; the gap is that as mounted.
    assert "-31 … 12 µm at every temperature" in told.remedy and "up to 31 µm hot" in told.remedy


def test_6_the_fits_stand_for_each_temperature() -> None:
    found = judged(
        "6208", radial_load_kN=3, housing_material="aluminium", temperature_rise_K=30, temperature_range_K=(-40.0, 60.0)
    )
    cases = {case.name: 1e6 * case.loss for case in found.housing.joint.thermal_cases}
    per_kelvin = 11.5e-6 * 80e3
    assert cases == pytest.approx(
        {"mounting": 0, "working": 30 * per_kelvin, "lowest": -40 * per_kelvin, "highest": 60 * per_kelvin}
    )


@pytest.mark.parametrize(
    ("name", "changes", "shaft", "housings"),
    [
        ("HK1010", {}, "h5", ("N6", "N7")),
        ("HK1010", {"housing_material": "aluminium"}, "h5", ("R6", "R7")),
        ("BK1612", {"housing_material": "magnesium"}, "h5", ("R6", "R7")),
        ("71910C", {"bearing_class": "4"}, "js4", ("JS5", "H5")),
        ("7005C", {"bearing_class": "4", "radial_load_kN": 0.9}, "js4", ("JS5", "H5")),
        ("NA4905", {}, "j6", ("H7",)),
        ("61905", {}, "k5", ("H7",)),
        ("16005", {}, "k5", ("H7",)),
    ],
)
def test_7_types_get_the_classes_of_their_makers(
    name: str, changes: dict[str, Any], shaft: str, housings: tuple[str, ...]
) -> None:
    found = judged(name, **({"radial_load_kN": 0.6} | changes))
    assert found.shaft.recommended_fit == shaft and found.housing.recommended_fit in housings


@pytest.mark.parametrize(("name", "bore", "outer"), [("681", 1.0, 3.0), ("681X", 1.5, 4.0), ("692", 2.0, 6.0)])
def test_7_bores_below_2_5_mm_are_judged(name: str, bore: float, outer: float) -> None:
    """Bore 0 … −8 µm and outside 0 … −8 µm by ISO 492; a press fit overstresses so small a ring, which is told."""
    found = judged(name, radial_load_kN=0.005, shaft_fit="js5")
    assert (1e3 * found.bearing.inner.diameter, 1e3 * found.bearing.outer.diameter) == pytest.approx((bore, outer))
    assert [1e6 * seat.ring_limits.lower for seat in found.seats] == pytest.approx([-8, -8])
    assert status(found, "ABU602") == "fail" and found.shaft.recommended_fit is None
    remedy = next(check.remedy for check in found.checks if check.code == "ABU602")
    assert remedy is not None and "bond" in remedy


def test_7_needles_run_on_the_shaft_with_clearance() -> None:
    """HK1010: under the needles F8, 10 mm: +13 … +35 µm; h5: 0 … −6 µm; 13 … 41 µm of clearance."""
    found = judged("HK1010", radial_load_kN=0.5)
    assert [round(1e6 * -end, 6) for end in reversed(found.shaft.interference)] == [13, 41]
    assert "raceway" in message(found, "ABU601") and status(found, "ABU601") == "pass"
    tight = judged("HK1010", radial_load_kN=0.5, shaft_fit="p6")
    assert status(tight, "ABU601") == "fail"


@pytest.mark.parametrize("changes", [{"outer_ring_load": "rotating"}, {"housing_fit": "N7"}])
def test_7_the_clearance_to_order_with_n7_leaves_it_to_all_but_one_in_a_hundred(changes: dict[str, Any]) -> None:
    found = judged("6206", radial_load_kN=1.5, **changes)
    group = found.group_to_order
    assert group is not None
    fits = {"shaft_fit": found.shaft.recommended_fit, "housing_fit": "N7"}
    again = judged("6206", radial_load_kN=1.5, internal_clearance=group, **fits)
    assert again.clearance is not None and again.clearance.below_zero_probability <= 0.01


@pytest.mark.slow
@pytest.mark.parametrize("ratio", LIGHT_TO_HEAVY)
def test_54_bearings_get_the_makers_row(ratio: float) -> None:
    """None is off by a class: the row governs where no loss is given."""
    for name in DEEP_GROOVE:
        found = at_share(name, ratio)
        row = found.shaft.joint.maker
        assert row is not None and found.shaft.recommended_fit == row.classes[0], name
        assert found.housing.recommended_fit == "H7", name


# Light loads (up to 0.06 C), then normal and heavy ones: up to 18, 100 and 140 mm. NSK E1102e, table 9.2; NTN 2203/E,
# table of shaft fits. NSK prints j6 for its js6, and k6 and m6 for k5 and m5 where the clearance does not matter.
OTHER_MAKERS = {
    "NSK": (("js5", "js6", "k6"), ("js5", "k5", "m5")),
    "NTN": (("h5", "js6", "k6"), ("js5", "k5", "m5")),
}
STEPS = ("h", "j", "k", "m", "n", "p", "r")


@pytest.mark.parametrize("maker", OTHER_MAKERS)
@pytest.mark.slow
def test_54_bearings_agree_with_the_rows_of_other_makers(maker: str) -> None:
    """At most two of 216 are off by more than one class; js counts as j. NTN has h5 up to 18 mm: one step looser."""
    light, heavy = OTHER_MAKERS[maker]
    off = []
    for name, ratio in itertools.product(DEEP_GROOVE, LIGHT_TO_HEAVY):
        bore = 1e3 * dimensions(name).bore
        row = (light if ratio <= 0.06 else heavy)[0 if bore <= 18 else 1 if bore <= 100 else 2]
        fit = at_share(name, ratio).shaft.recommended_fit
        assert fit is not None
        steps = abs(STEPS.index(fit[0]) - STEPS.index(row[0]))
        assert steps == 0 or (maker, row) == ("NTN", "h5"), (name, ratio, fit, row)
        off += [name] if steps > 1 else []
    assert len(DEEP_GROOVE) == 54 and len(off) <= 2, off


LOADS = [0.0, 0.02, 0.05, 0.051, 0.1, 0.101, 0.25, 0.5, 0.7]
NAMES = ["608", "6205", "6212", "6320", "61810", "7208B", "7010C", "NU208", "NU320", "22220", "30208", "32216",
         "NA4905", "HK1512"]  # fmt: skip
SERVICES: list[dict[str, Any]] = [
    {},
    {"speed_rpm": 9000.0, "ring_temperature_difference_K": 15.0},
    {"shaft_bore_mm": "0.8", "housing_material": "aluminium", "housing_outer_mm": "1.15"},
    {"housing_material": "aluminium", "temperature_rise_K": -50.0},
    {"outer_ring_load": "rotating", "inner_ring_load": "stationary"},
    {"outer_ring_load": "indeterminate", "inner_ring_load": "indeterminate", "temperature_range_K": (-40.0, 80.0)},
]


@pytest.mark.slow
def test_a_recommended_class_never_fails_a_check_of_its_seat() -> None:
    """Every bearing in every service, each under one of the loads."""
    for number, (name, service) in enumerate(itertools.product(NAMES, SERVICES)):
        keeps_its_checks(name, service, [LOADS[number % len(LOADS)]])


@pytest.mark.few(0, 2)
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.hard if number % 2 else pytest.mark.slow)
        for number, name in enumerate(NAMES)
    ],
)
def test_a_recommended_class_never_fails_under_any_load(name: str) -> None:
    for service in SERVICES:
        keeps_its_checks(name, service, LOADS)


def keeps_its_checks(name: str, service: dict[str, Any], shares: list[float]) -> None:
    """Written into the file it keeps or mends every check that a tolerance class can decide."""
    size, ratings = dimensions(name), catalogue_bearing(name).ratings
    assert ratings is not None
    given = dict(service)
    if "shaft_bore_mm" in given:
        given["shaft_bore_mm"] = 0.8e3 * size.bore
        given["housing_outer_mm"] = 1.15e3 * size.outer
    for ratio in shares:
        load = {"radial_load_kN": ratio * ratings.dynamic / 1e3}
        found = judged(name, **load, **given)
        fits = {"shaft_fit": found.shaft.recommended_fit, "housing_fit": found.housing.recommended_fit}
        again = judged(name, **load, **given, **fits)
        for fit, codes in ((found.shaft, ("601", "602", "605")), (found.housing, ("611", "612", "615"))):
            if fit.recommended_fit is not None:
                failed = [c for c in again.checks if c.status == "fail" and c.code.removeprefix("ABU") in codes]
                assert not failed, (name, service, ratio, fits, failed)


@pytest.mark.parametrize(
    "changes",
    [
        {"shaft_bore_mm": 40.0},
        {"temperature_range_K": (-40.0, 90.0), "shaft_material": "aluminium", "speed_rpm": 5000.0},
    ],
)
def test_the_counted_losses_add_up_to_the_required_interference(changes: dict[str, Any]) -> None:
    found = judged("6210", radial_load_kN=3, shaft_rz_um=2.0, **changes)
    counted = sum(loss.amount for loss in found.shaft.losses if loss.counted)
    assert counted == pytest.approx(found.shaft.required_interference, rel=1e-12)
