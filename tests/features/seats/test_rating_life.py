"""Rating life against published examples, equivalent loads, static safety, speed, what is missing."""

import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.features.seats.bearing import equivalent_dynamic, equivalent_static, load_factors
from abu_calc.features.seats.life_in_use import UseLoads, combined_load, lives_in_use
from abu_calc.features.seats.lookup import from_table
from abu_calc.features.seats.rating_life import basic_rating_life, life_modification, reference_viscosity
from abu_calc.features.seats.seats import seat_bearing
from abu_calc.standards.catalogue import Ratings, catalogue_bearing
from tests.features.seats.samples import by_designation

RPM = math.pi / 30
CN_6208 = Ratings(29_100, 17_900)
"""6208 as NSK rates it."""


def hours(load: float, rating: float, rpm: float, power: float = 3.0) -> float:
    return basic_rating_life(load / rating, rpm * RPM, power) / 3600


@pytest.mark.parametrize(
    ("load", "rating", "rpm", "power", "published"),
    [
        (10.0, 55.3, 3000, 3, 940),  # SKF General Catalogue 2006, p. 78, example 1: 6309
        (2.5, 29.1, 900, 3, 29_000),  # NSK E1102e, 5.7, example 1: 6208, by its diagrams
        (3.07, 29.1, 900, 3, 15_800),  # NSK, example 3: 6208 with 1 kN of axial load
        (3.164, 38.0, 600, 10 / 3, 109_750),  # NSK, example 5: HR30305DJ
        (3.931, 43.0, 600, 10 / 3, 80_400),  # NSK, example 5: HR30206J
    ],
)
def test_published_lives(load: float, rating: float, rpm: float, power: float, published: float) -> None:
    """NSK rounds its life and speed factors to three digits: 2 % in the third power."""
    assert hours(load, rating, rpm, power) == pytest.approx(published, rel=0.02)


def test_published_equivalent_load_of_a_ball_bearing() -> None:
    """NSK, example 3: 6208, 2.5 kN and 1 kN: f0·F_a/C0 = 0.782, X = 0.56, Y = 1.67, P = 3070 N, printed to 10 N."""
    row = catalogue_bearing("6208")
    assert row is not None
    factors, known = load_factors("ball", row._replace(f0=14.0), CN_6208, 1000.0)
    assert known and factors is not None and pytest.approx(1.67, abs=0.005) == factors.Y
    assert equivalent_dynamic(2500.0, 1000.0, factors) == pytest.approx(3070, abs=8)


def test_published_equivalent_load_of_a_tapered_bearing() -> None:
    """NSK, example 5: e = 0.83, Y = 0.73, F_r 1569 N, F_a 3474 N: 3164 N."""
    row = catalogue_bearing("31305") or catalogue_bearing("31306")
    assert row is not None
    factors, _ = load_factors("tapered", row._replace(e=0.83, Y=0.73, Y0=0.4), Ratings(38e3, 40e3), 3474.0)
    assert equivalent_dynamic(1569.0, 3474.0, factors) == pytest.approx(3164, abs=1)


def test_published_example_through_the_command_s_way() -> None:
    """6309 of the catalogue has C = 55.3 kN, as the example; ISO's viscosity is 9.65 mm²/s (SKF's diagram: 8.15)."""
    found = seat_bearing(
        by_designation("6309", radial_load_kN=10.0, speed_rpm=3000.0, lubricant_viscosity_mm2_per_s=20.0,
                       contamination_factor=0.8)
    )  # fmt: skip
    life = found.life
    assert life.basic is not None and life.modified is not None and life.kappa is not None
    assert life.basic / 3600 == pytest.approx(940, rel=0.005)
    assert life.kappa == pytest.approx(20 / 9.65, rel=1e-3)
    # SKF's scale for its standard bearings reads near 5 at η_c·Pu/P = 0.107 and κ = 2.07; 8 is its Explorer scale.
    assert life.modified / life.basic == pytest.approx(4.8, abs=0.3)


@pytest.mark.slow
@settings(derandomize=True, deadline=None)
@given(st.sampled_from(["ball", "cylindrical"]), st.sampled_from([0.1, 0.4, 1.0, 4.0]), st.floats(1e-3, 0.3))
def test_a_iso_is_continuous_where_its_branches_meet(kind: Any, place: float, ratio: float) -> None:
    """ISO rounds its constants to five digits: 0.3 % at a_ISO near 50."""
    below, above = (life_modification(kind, place * (1 + sign * 1e-9), ratio) for sign in (-1, 1))
    assert below == pytest.approx(above, rel=0.02)


@pytest.mark.slow
@settings(derandomize=True, deadline=None)
@given(st.floats(0.05, 5), st.floats(0.05, 5), st.floats(0, 0.5), st.floats(0, 0.5))
def test_more_viscosity_or_less_load_never_shortens_life(kappa: float, other: float, low: float, high: float) -> None:
    first, second = sorted((kappa, other))
    less, more = sorted((low, high))
    for kind in ("ball", "cylindrical"):
        assert life_modification(kind, first, less) <= life_modification(kind, second, more) * 1.001  # type: ignore[arg-type]
        assert 0.09 < life_modification(kind, first, less) <= 50  # type: ignore[arg-type]


def test_the_reference_viscosity_is_continuous_at_1000_rpm() -> None:
    below, above = (reference_viscosity(0.1, turns * RPM) for turns in (999.999, 1000.001))
    assert below == pytest.approx(above, rel=0.03)  # 45000·1000^−0.83 = 145.6, 4500·1000^−0.5 = 142.3


@pytest.mark.slow
@settings(derandomize=True, deadline=None)
@given(
    st.sampled_from(["6205", "7205C", "7205B", "7205AC", "30208", "22208", "NU208", "NA4905"]),
    st.floats(1, 5000), st.floats(0, 5000),
)  # fmt: skip
def test_equivalent_loads_are_never_below_the_radial_one_by_much(name: str, radial: float, axial: float) -> None:
    """P0 ≥ F_r; P may fall below F_r just above e by the steps of ISO's table, by a few per cent."""
    row = catalogue_bearing(name)
    assert row is not None and row.ratings is not None
    factors, _ = load_factors(row.kind, row, row.ratings, axial)
    assert equivalent_static(radial, axial, factors) >= radial
    assert equivalent_dynamic(radial, axial, factors) >= 0.95 * radial


@pytest.mark.parametrize(
    ("changes", "undone"),
    [
        ({}, {"ABU632", "ABU633", "ABU634", "ABU635"}),
        ({"speed_rpm": 3000.0}, {"ABU633", "ABU635"}),
        ({"speed_rpm": 3000.0, "axial_load_kN": 0.0}, {"ABU633"}),
        ({"speed_rpm": 3000.0, "axial_load_kN": 0.1, "lubricant_viscosity_mm2_per_s": 15.0}, set()),
        ({"lubricant_viscosity_mm2_per_s": 15.0}, {"ABU632", "ABU633", "ABU634", "ABU635"}),
    ],
)
def test_what_is_missing_is_not_evaluated_and_does_not_decide(changes: dict[str, Any], undone: set[str]) -> None:
    found = seat_bearing(by_designation("6205", radial_load_kN=0.7, shaft_fit="j6", housing_fit="H7", **changes))
    optional = {check.code for check in found.checks if check.status == "not-done"}
    assert optional == undone and not any(check.requested for check in found.checks if check.code in undone)
    assert all(check.remedy for check in found.checks if check.code in undone)


@pytest.mark.parametrize(
    ("name", "changes", "code", "status"),
    [
        ("6205", {"speed_rpm": 18_000.0}, "ABU634", "pass"),
        ("6205", {"speed_rpm": 18_001.0}, "ABU634", "fail"),
        ("6205", {"axial_load_kN": 3.9}, "ABU635", "pass"),
        ("6205", {"axial_load_kN": 4.0}, "ABU635", "warn"),
        ("NU205", {"axial_load_kN": 0.1}, "ABU635", "fail"),
        ("HK2512", {"axial_load_kN": 0.1}, "ABU635", "fail"),
        ("NU205", {"radial_load_kN": 25.0}, "ABU631", "warn"),
        ("6205", {"speed_rpm": 9000.0, "required_life_h": 5000.0}, "ABU632", "pass"),
        ("6205", {"speed_rpm": 9000.0, "required_life_h": 20_000.0}, "ABU632", "fail"),
        ("6205", {"speed_rpm": 9000.0, "radial_load_kN": 2.0}, "ABU632", "warn"),
    ],
)
def test_checks_of_the_bearing(name: str, changes: dict[str, Any], code: str, status: str) -> None:
    found = seat_bearing(by_designation(name, **({"radial_load_kN": 0.7} | changes)))
    assert next(check.status for check in found.checks if check.code == code) == status


def test_the_axial_part_moves_the_row() -> None:
    """6205, 0.5 kN with 1.5 kN axial: P = 2.2 kN = 0.15·C, so k5 and not j6."""
    plain, loaded = (
        seat_bearing(by_designation("6205", radial_load_kN=0.5, axial_load_kN=axial, shaft_fit=None))
        for axial in (None, 1.5)
    )
    assert (plain.shaft.recommended_fit, loaded.shaft.recommended_fit) == ("j6", "k5")


@settings(derandomize=True, deadline=None, max_examples=40)
@given(st.floats(1e-3, 1e4), st.floats(1e-3, 1e4), st.sampled_from([3.0, 10 / 3]))
def test_a_combined_load_lies_between_its_larger_part_and_the_sum(one: float, other: float, power: float) -> None:
    found = combined_load(one, other, power)
    assert max(one, other) * (1 - 1e-12) <= found <= (one + other) * (1 + 1e-12)
    assert found == pytest.approx(combined_load(other, one, power), rel=1e-9, abs=1e-9)


def test_the_cube_mean_of_two_equal_forces_in_closed_form() -> None:
    """|1 + e^{iθ}|³ = 8·cos³(θ/2): its mean is 32/(3π)."""
    assert combined_load(1.0, 1.0, 3.0) == pytest.approx((32 / (3 * math.pi)) ** (1 / 3), rel=1e-4)


def test_two_bearings_share_the_wheel_s_forces_by_the_lever_rule() -> None:
    """Places 40 and 140 mm: the front one takes 1.4, the rear one 0.4 of a force at the wheel."""
    pair = [
        from_table(by_designation("6204", name=name, position_mm=place, speed_rpm=5800.0))
        for name, place in (("front", 40.0), ("rear", 140.0))
    ]
    front, rear = lives_in_use(pair, UseLoads(100.0, 10.0, 0.0), 600.0)
    assert front.lives is not None and rear.lives is not None
    assert (front.lives.load_without, rear.lives.load_without) == pytest.approx((140, 40))
    assert front.lives.load_with == pytest.approx(14)
    assert front.lives.life_with == pytest.approx(min(1000 * front.lives.life_without, 1e12))
    alone = lives_in_use(pair[:1], UseLoads(100.0, 10.0, 0.0), 600.0)[0]
    assert alone.lives is None and alone.checks[0].status == "not-done" and not alone.checks[0].requested


@pytest.mark.parametrize(
    ("name", "limit"),
    [("6206", 15_000), ("6206-2RS1", 6600), ("6206ZZ", 11_250), ("6206-2RSL", 11_250), ("6206LLU/C3", 6600),
     ("180206", 6600), ("80206", 11_250)],
)  # fmt: skip
def test_seals_lower_the_limiting_speed(name: str, limit: float) -> None:
    """SKF, Rolling bearings, 2018: 6206 15,000 rpm, 2RS1 7500, 2RZ and 2Z 12,000. The least share of all rows holds."""
    life = seat_bearing(by_designation(name, radial_load_kN=0.7)).life
    assert life.limiting_speed is not None and life.limiting_speed / RPM == pytest.approx(limit)


def test_a_sealed_bearing_fails_at_the_speed_of_an_open_one() -> None:
    """6004: open 24,000 rpm, with rubbing seals 11,000 by the same catalogue."""
    for name, status in (("6004", "pass"), ("6004-2RS", "fail")):
        found = seat_bearing(by_designation(name, radial_load_kN=0.4, speed_rpm=18_000.0))
        assert next(check.status for check in found.checks if check.code == "ABU634") == status
