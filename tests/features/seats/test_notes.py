"""Losses, creep, clearance left, fields to choose from, the drawing, selective assembly."""

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.features.seats.creep import slip_torque
from abu_calc.features.seats.interference import Interval
from abu_calc.features.seats.notes import selective_groups
from abu_calc.features.seats.seats import seat_bearing
from abu_calc.foundation.checks import overall
from abu_calc.standards.tolerance_classes import DeviationLimits
from tests.features.seats.samples import by_designation, seats

WHOLE = st.integers(-40, 40)
WIDTHS = st.integers(0, 40)


def um(metres: float) -> float:
    return round(1e6 * metres, 6)


def test_the_ledger_lists_every_loss_and_what_counts():
    shaft = seats(shaft_fit="m6", shaft_rz_um=4.0, ring_temperature_difference_K=10.0, speed_rpm=3000.0).shaft
    told = [(loss.name, um(loss.amount), loss.counted) for loss in shaft.losses]
    assert told[0] == ("load", pytest.approx(13 * 3 * 2.8 / 29, abs=1e-5), False)
    assert told[1] == ("load", pytest.approx(0.08 * math.sqrt(80 * 3000 / 33), abs=1e-5), True)
    assert told[2] == ("smoothing", pytest.approx(0.4 * 4), True)
    assert told[3] == ("smoothing", pytest.approx(11 * 2 / 82, abs=1e-5), False)  # 11 − 11·80/82
    assert told[4] == ("temperature", pytest.approx(12e-6 * 80e3 * 10), True)
    assert [name for name, _, _ in told[5:]] == ["centrifugal growth"]
    assert "unverified" in shaft.losses[3].formula
    counted = sum(loss.amount for loss in shaft.losses if loss.counted)
    assert counted == pytest.approx(shaft.required_interference, rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "verdict"),
    [({"shaft_fit": "m6"}, "holds"), ({"shaft_fit": "k6"}, "may creep"), ({"shaft_fit": "j6"}, "may creep"),
     ({"shaft_fit": "g6"}, "creeps"), ({"shaft_fit": "g6", "inner_ring_load": "stationary"}, "needs no grip"),
     ({"shaft_fit": "g6", "inner_ring_load": "indeterminate"}, "creeps"), ({"radial_load_kN": None}, "may creep")],
)  # fmt: skip
def test_creep_by_the_kind_of_load(changes, verdict):
    assert seats(**changes).shaft.creep.verdict == verdict


def test_probability_of_creep_of_the_example():
    """k6: mean 19, σ = √(9.5² + 7.5²)/3 µm, asked 6.8224 µm."""
    sigma = math.hypot(9.5, 7.5) / 3
    expected = 0.5 * math.erfc((19 - 6.82242) / sigma / math.sqrt(2))
    assert seats().shaft.creep.probability == pytest.approx(expected, rel=1e-4)


def test_friction_torque_of_the_example():
    """m6, least 11 µm on a solid shaft: p = E·δ·(1−q²)/(2d); the moment summed over strips of the seat."""
    shaft = seats(shaft_fit="m6", starting_torque_N_m=100.0).shaft
    pressure = 206e9 * 11e-6 * (1 - (80 / 96.8) ** 2) / 0.160
    strips = sum(0.12 * pressure * (0.040 * math.tau / 360) * 0.029 * 0.040 for _ in range(360))
    assert shaft.creep.friction_moment[0] == pytest.approx(strips, rel=1e-9)
    assert slip_torque(0.12, pressure, 0.080, 0.029) == pytest.approx(strips, rel=1e-9)
    assert shaft.creep.friction_moment[1] > shaft.creep.friction_moment[0]
    assert shaft.creep.holds_at_start is True


def test_losses_lower_the_friction_torque_and_speed_does_not():
    plain = seats(shaft_fit="m6").shaft.creep.friction_moment[0]
    rough = seats(shaft_fit="m6", shaft_rz_um=4.0).shaft.creep.friction_moment[0]
    assert rough == pytest.approx(plain * (11 - 1.6) / 11)
    assert seats(shaft_fit="m6", speed_rpm=3000.0).shaft.creep.friction_moment[0] == plain


def displacement(r: float, a: float, b: float, inside: float, outside: float) -> float:
    mean = (inside * a**2 - outside * b**2) / (b**2 - a**2)
    swing = (inside - outside) * a**2 * b**2 / (b**2 - a**2)
    return (0.7 * mean * r + 1.3 * swing / r) / 206e9


def test_clearance_left_by_the_displacements_of_the_tubes():
    """6203, k6 1 … 20 µm and N7; raceways by Lamé's displacement at the other side of each tube."""
    given = by_designation("6203", shaft_fit="k6", housing_fit="N7", internal_clearance="CN",
                           raceway_temperature_difference_K=5.0)  # fmt: skip
    found = seat_bearing(given)
    d, outer, d1, D1 = 0.017, 0.040, 0.017 + 0.28 * 0.023, 0.040 - 0.28 * 0.023
    pressures = [found.shaft.joint.pressure_rate, found.housing.joint.pressure_rate]
    grows = 2 * displacement(d1 / 2, d / 2, d1 / 2, pressures[0], 0)
    shrinks = -2 * displacement(D1 / 2, D1 / 2, outer / 2, 0, pressures[1])
    inner, housing = found.shaft.interference, found.housing.interference
    warmth = 12e-6 * (d1 + D1) / 2 * 5
    assert um(inner.largest) == 20
    left = found.clearance
    expected = 3e-6 - 20e-6 * grows - housing.largest * shrinks - warmth
    assert left.mounted.smallest == pytest.approx(expected, rel=1e-9)
    tight = max(housing.smallest, 0.0)
    assert left.mounted.largest == pytest.approx(18e-6 - 1e-6 * grows - tight * shrinks - warmth, rel=1e-9)
    assert left.mounted.smallest < left.probable.smallest < left.probable.largest < left.mounted.largest
    assert grows == pytest.approx(d / d1)  # a solid shaft of the same steel passes on d/d₁ of the interference


def test_the_group_to_choose_passes():
    given = {"shaft_fit": "m5", "housing_fit": "H7"}
    found = seat_bearing(by_designation("6206", internal_clearance="C2", **given))
    check = found.checks[-1]
    assert (check.code, check.status) == ("ABU621", "fail")
    choice = found.clearance.group_to_choose
    assert choice in check.remedy
    again = seat_bearing(by_designation("6206", internal_clearance=choice, **given))
    assert again.checks[-1].status == "pass"


@pytest.mark.few(1)
@pytest.mark.parametrize("changes", [{}, {"outer_ring_load": "rotating", "housing_fit": "M7"},
                                     {"inner_ring_load": "stationary", "shaft_fit": "h6"}])  # fmt: skip
def test_every_admissible_field_passes_and_no_other_does(changes):
    found = seats(**changes)
    for fit, key in ((found.shaft, "shaft_fit"), (found.housing, "housing_fit")):
        names = [one.fit for one in fit.admissible_fits]
        assert fit.recommended_fit == names[0]
        assert len(names) == len(set(names))
        for name in ("f6", "h6", "k6", "m6", "r6") if fit.seat == "shaft" else ("F7", "H7", "K7", "M7", "P7"):
            again = seats(**(changes | {key: name}))
            judged = again.shaft if fit.seat == "shaft" else again.housing
            assert (overall(judged.checks) == "pass") == (name in names)
        for one in fit.admissible_fits:
            again = seats(**(changes | {key: one.fit}))
            judged = again.shaft if fit.seat == "shaft" else again.housing
            assert one.interference == judged.interference
            assert one.clearance_probability == judged.clearance_probability


def test_the_source_recommends_m6_and_the_loose_ring_its_own_field():
    assert [one.fit for one in seats().shaft.admissible_fits[:3]] == ["m6", "k6", "n6"]
    assert [one.fit for one in seats(housing_fit="M7").housing.admissible_fits[:2]] == ["H7", "G7"]


def test_the_drawing_of_the_example():
    shaft, housing = (seat.requirements for seat in seats().seats)
    assert (shaft.field, um(shaft.limits.lower), um(shaft.limits.upper)) == ("m6", 11, 30)
    assert um(shaft.roundness) == um(shaft.profile) == 19 / 4 and um(housing.roundness) == 10
    assert (um(shaft.roughness_Ra), um(housing.roughness_Ra)) == (1.25, 2.5)  # 80 mm is still the smaller row
    assert (shaft.shoulder_runout_grade, um(shaft.shoulder_runout)) == ("IT7", 30)
    assert (housing.shoulder_runout_grade, um(housing.shoulder_runout)) == ("IT8", 63)
    assert "unverified" in shaft.source
    fine = seats(bearing_class="4").shaft.requirements
    assert (um(fine.profile), um(fine.roughness_Ra), um(fine.shoulder_runout)) == (8 / 8, 0.32, 8)  # k4


def test_finer_classes_ask_for_more():
    order = [seats(bearing_class=name).seats for name in ("0", "6", "5", "4", "2")]
    for coarse, fine in itertools.pairwise(order):
        for one, other in zip(coarse, fine, strict=True):
            assert um(other.requirements.profile) <= um(one.requirements.profile)
            assert um(other.requirements.roughness_Ra) <= um(one.requirements.roughness_Ra)


def group_extremes(male: DeviationLimits, female: DeviationLimits, groups: int) -> tuple[float, float]:
    """Group by group: its own slices of both fields."""
    lows, highs = [], []
    for i in range(groups):
        slices = [[f.lower + k * f.tolerance / groups for k in (i, i + 1)] for f in (male, female)]
        lows.append(slices[0][0] - slices[1][1])
        highs.append(slices[0][1] - slices[1][0])
    return min(lows), max(highs)


@settings(derandomize=True, deadline=None, max_examples=100)
@given(WHOLE, WIDTHS, WHOLE, WIDTHS, WHOLE, st.integers(1, 60))
@pytest.mark.slow
def test_groups_are_the_fewest_that_do(a, wide_a, b, wide_b, low, width):
    male, female = DeviationLimits(a * 1e-6, (a + wide_a) * 1e-6), DeviationLimits(b * 1e-6, (b + wide_b) * 1e-6)
    asked = Interval(low * 1e-6, (low + width) * 1e-6)
    found = selective_groups(male, female, asked)
    tried = (n for n in range(1, 61)
             if group_extremes(male, female, n)[0] >= asked.smallest - 1e-11
             and group_extremes(male, female, n)[1] <= asked.largest + 1e-11)  # fmt: skip
    assert (found.groups if found else None) == next(tried, None)
    if found:
        assert (found.interference.smallest, found.interference.largest) == pytest.approx(
            group_extremes(male, female, found.groups), abs=1e-11
        )


def test_a_band_is_meant_for_every_seat_that_may_be_tight():
    found = seats(asked_interference_um=(10.0, 28.0))
    assert found.shaft.selective_groups == 3
    assert "assembly into 3 equal groups" in found.shaft.notes[-1]
    assert found.housing.asked_interference is not None  # K7 may be tight
    loose = seats(asked_interference_um=(10.0, 28.0), housing_fit="H7").housing
    assert loose.selective_groups is None and loose.asked_interference is None
    # Without a band: from what the load needs to what the ring bears. 15 µm by 17 - 6.82 µm is 1.5: two groups.
    own = seats().shaft
    assert own.asked_interference_um == pytest.approx([6.8224, 80.0], abs=1e-3) and own.selective_groups == 2
    least = min(group.interference_um[0] for group in own.sorting_groups)
    assert least >= own.asked_interference_um[0] and seats(shaft_fit="m6").shaft.asked_interference is None
    narrow = seats(asked_interference_um=(10.0, 12.0)).shaft
    assert narrow.selective_groups is None and "Sorting cannot keep k6" in narrow.notes[-1]
    assert "17 … 21 µm" in narrow.notes[-1]
    assert "without sorting" in seats(asked_interference_um=(0.0, 40.0)).shaft.notes[-1]
