"""Warmth and materials of both parts, worn seats, sorting for the bench, input as people have it."""

import math

import pytest

from abu_calc.features.seats.interference import of_all
from abu_calc.features.seats.notes import sorting_groups
from abu_calc.features.seats.seats import seat_bearing
from abu_calc.standards.tolerance_classes import DeviationLimits
from tests.features.seats.samples import by_designation, seats

STEEL, ALUMINIUM, MAGNESIUM = 12e-6, 23.5e-6, 26e-6


def um(metres: float) -> float:
    return round(1e6 * metres, 4)


def warmth(seat) -> float:
    return um(next(loss.amount for loss in seat.losses if loss.name == "temperature"))


@pytest.mark.parametrize("difference", [-20.0, 20.0])
def test_the_free_diameters_of_warm_parts_meet(difference):
    """Each part grown by itself, from 80 and 140 mm: shaft colder than its ring, housing warmer than its ring."""
    found = seats(ring_temperature_difference_K=difference, housing_temperature_difference_K=difference,
                  temperature_rise_K=40.0, shaft_material="aluminium", housing_material="magnesium")  # fmt: skip
    bore, shaft = 80e-3 * (1 + STEEL * 40), 80e-3 * (1 + ALUMINIUM * (40 - difference))
    assert warmth(found.shaft) == pytest.approx(um(bore - shaft), abs=1e-3)
    ring, housing = 140e-3 * (1 + STEEL * 40), 140e-3 * (1 + MAGNESIUM * (40 + difference))
    assert warmth(found.housing) == pytest.approx(um(housing - ring), abs=1e-3)


def test_a_gain_by_warmth_stresses_and_does_not_grip():
    soft = {"shaft_fit": "p6", "shaft_material": "aluminium"}
    cold, warm = seats(**soft), seats(**soft, temperature_rise_K=60.0)
    assert warm.shaft.required_interference == cold.shaft.required_interference
    gain = (ALUMINIUM - STEEL) * 0.080 * 60
    assert warm.shaft.joint.tightest == pytest.approx(cold.shaft.interference.largest + gain)
    assert "when warm" in warm.shaft.checks[1].message


@pytest.mark.parametrize(
    ("material", "expansion"), [("aluminium", ALUMINIUM), ("magnesium", MAGNESIUM), ("stainless-steel", 16e-6)]
)
def test_a_light_housing_without_a_temperature_tells_the_loss(material, expansion):
    found = seats(housing_material=material)
    check = next(one for one in found.checks if one.code == "ABU614")
    assert check.status == "pass" and check.value == pytest.approx(um((expansion - STEEL) * 0.140 * 10))
    low, high = found.housing.at_work_um["hot"]  # 50 K, assumed
    assert (low, high) == pytest.approx([each - um((expansion - STEEL) * 0.140 * 50) for each in (-30, 28)])
    for known in ("temperature_rise_K", "housing_temperature_difference_K"):
        assert "ABU614" not in [one.code for one in seats(housing_material=material, **{known: 0.0}).checks]
    assert not [one for one in seats(housing_material="cast-iron").checks if one.code == "ABU614"]


def test_the_strength_of_the_part_decides_too():
    """An aluminium housing of 1.2 times the ring: p·(1+q²)/(1−q²) at its bore, by equations of its own."""
    given = {"housing_fit": "P7", "housing_outer_mm": 168.0, "housing_material": "aluminium"}
    found = seats(**given, housing_strength_MPa=10.0).housing
    q1, q2 = (140 - 0.28 * 60) / 140, 140 / 168
    yields = (((1 + q2**2) / (1 - q2**2) + 0.33) / 70e9) + (((1 + q1**2) / (1 - q1**2) - 0.3) / 206e9)
    pressure = found.interference.largest / 0.140 / yields
    assert found.joint.part_stress == pytest.approx(pressure * (1 + q2**2) / (1 - q2**2), rel=1e-9)
    assert found.checks[1].status == "fail" and "10 MPa of the housing" in found.checks[1].message
    assert seats(**given, housing_strength_MPa=500.0).housing.checks[1].status == "pass"


def test_a_worn_shaft_tells_its_grip_and_what_a_repair_must_restore():
    """Worn to −14 … −6 µm, ring 0/−10: 6205 wants 5.6 µm; k6 is +2 … +15."""
    assert seat_bearing(by_designation("6205", shaft_fit="k6", radial_load_kN=2.0)).shaft.repair is None
    table = by_designation("6205", shaft_fit="k6", shaft_limits_um=(-14.0, -6.0), shaft_rz_um=2.5, radial_load_kN=2.0)
    shaft = seat_bearing(table).shaft
    repair = shaft.repair
    assert (shaft.fit, um(shaft.interference.smallest), um(shaft.interference.largest)) == ("measured", -14, 4)
    assert (um(repair.grip_left.smallest), um(repair.grip_left.largest)) == (-15, 3)  # 0.4·2.5 µm smoothed
    assert (repair.restore_fit, um(repair.restore_limits.lower), um(repair.restore_limits.upper)) == ("k6", 2, 15)
    assert (um(repair.bonding_gap), 1e3 * repair.next_seat, repair.next_bearing) == (14, 20, "6204")
    assert shaft.checks[0].status == "fail" and "the measured shaft" in shaft.checks[0].message
    housing = seat_bearing(by_designation("6205", housing_fit=None, housing_limits_um=(20.0, 60.0))).housing
    assert (housing.repair.restore_fit, 1e3 * housing.repair.next_seat) == ("H7", 62)
    assert seats(shaft_limits_um=(5.0, 5.0)).shaft.repair.next_bearing is None


def test_groups_of_the_bench_by_a_count_of_parts():
    """Three groups of k6 on a bore of 0/−15: limits by hand, shares by counting normal parts inside their fields."""
    groups = sorting_groups(DeviationLimits(2e-6, 21e-6), DeviationLimits(-15e-6, 0.0), "shaft", 3)
    assert [(um(one.part_limits.lower), um(one.part_limits.upper)) for one in groups] == [
        (2, 8.3333), (8.3333, 14.6667), (14.6667, 21)]  # fmt: skip
    rings = [(um(one.ring_limits.lower), um(one.ring_limits.upper)) for one in groups]
    assert rings == [(-15, -10), (-10, -5), (-5, 0)]
    for one in groups:
        assert one.interference[0] == pytest.approx(one.part_limits.lower - one.ring_limits.upper)
        assert one.interference[1] == pytest.approx(one.part_limits.upper - one.ring_limits.lower)
    inside = [0.5 * (math.erf(b / 2**0.5) - math.erf(a / 2**0.5)) for a, b in ((-3, -1), (-1, 1), (1, 3))]
    assert [one.pairs_of_100 for one in groups] == pytest.approx([100 * one / sum(inside) for one in inside])
    assert sum(one.pairs_of_100 for one in groups) == pytest.approx(100)
    found = seats(asked_interference_um=(10.0, 28.0)).shaft
    assert len(found.sorting_groups) == 3 and "Every pair has the required" in found.notes[-1]
    assert seats(asked_interference_um=(0.0, 40.0)).shaft.sorting_groups == ()


@pytest.mark.parametrize("share", [0.0, 1e-9, 3e-6, 2e-4, 0.004, 0.03, 0.2, 0.5, 0.8, 0.97, 0.999, 1 - 1e-9, 1.0])
def test_words_say_what_the_number_does(share):
    """Read back: within half a unit of the words."""
    words = of_all(share).removesuffix(" pairs")
    rest = words.removeprefix("all but ").removeprefix("under ")
    known = {"no": 0.0, "all": 1.0, "nearly all": 1.0}
    if rest in known:
        value = known[rest]
    else:
        count, total = rest.replace("a million", "1000000").split(" of ")
        value = int(count) / int(total)
    value = 1 - value if words.startswith("all but") else value
    assert value == pytest.approx(share, rel=0.11, abs=1.1e-6)
