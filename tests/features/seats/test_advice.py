"""Verdicts and advice beside the makers' own: their fits never fail, the advice is theirs or a class tighter.

Actions on seats, followed: the check gets the grade and the number that it tells, and no other check gets worse.
"""

import itertools
import re
from random import Random
from typing import Any

import pytest

from abu_calc.features.seats.advice import with_entries
from abu_calc.features.seats.lookup import from_table
from abu_calc.features.seats.seats import judge, seat_bearing
from abu_calc.foundation.checks import RANK
from abu_calc.standards.bearing_catalogue import bearing
from abu_calc.standards.catalogue import catalogue_bearing
from abu_calc.standards.tables import csv_rows
from abu_calc.standards.tolerance_classes import maker_fits, tolerance_classes
from tests.features.seats.samples import by_designation, seats

RATIOS = (0.03, 0.06, 0.08, 0.12)
# 608, and the series 60, 62 and 63 from 6000 to 6320 where all three have the bore: 54 of them below.
NAMES = ["608", *(f"6{series}{number:02}" for series in "023" for number in range(21))]
DEEP_GROOVE = [name for name in NAMES if not name.startswith("60") or name in NAMES[:12]]


def makers(diameter_mm: float, ratio: float) -> str:
    """The catalogue's class for a ball bearing on a solid shaft that turns, typed from practice a second time."""
    light = [(17, "js5"), (100, "j6")]
    normal = [(10, "js5"), (17, "j5"), (100, "k5")]
    return next(name for to, name in (light if ratio <= 0.05 else normal) if diameter_mm <= to)


def judged(name: str, ratio: float, **changes):
    load = ratio * catalogue_bearing(name).ratings.dynamic / 1e3
    return seat_bearing(by_designation(name, radial_load_kN=load, **changes))


def tightness(seat: str, name: str) -> list[str]:
    """Classes of the grade, loose to tight."""
    order = ["f", "g", "h", "js", "j", "k", "m", "n", "p", "r"]
    letters = {one: rank for rank, one in enumerate(order)}
    same = [one for one in tolerance_classes(seat) if one[-1] == name[-1]]
    return sorted(same, key=lambda one: letters[one[:-1].lower()])


def at_most_one_tighter(seat: str, found: str, maker: str) -> bool:
    ladder = tightness(seat, maker)
    return found in ladder[ladder.index(maker) : ladder.index(maker) + 2]


@pytest.mark.slow
@pytest.mark.parametrize("ratio", RATIOS)
def test_the_makers_own_fits_never_fail_and_are_advised(ratio):
    """Every bearing with the maker's class: no check fails, and the advice is that class or one tighter."""
    for name in DEEP_GROOVE:
        shaft = makers(1e3 * bearing(name).bore, ratio)
        found = judged(name, ratio, shaft_fit=shaft, housing_fit="H7")
        assert not [check for check in found.checks if check.status == "fail"], name
        assert at_most_one_tighter("shaft", found.shaft.recommended_fit, shaft), name
        assert found.housing.recommended_fit == "H7", name
        assert found.bearing.load_ratio == pytest.approx(ratio)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", RATIOS)
def test_a_rotating_outer_ring_gets_the_makers_class_or_one_tighter(ratio):
    maker = "M7" if ratio <= 0.05 else "N7"
    for name in DEEP_GROOVE[::3]:
        found = judged(
            name, ratio, shaft_fit="h6", housing_fit=maker, inner_ring_load="stationary", outer_ring_load="rotating"
        )
        assert at_most_one_tighter("housing", found.housing.recommended_fit, maker), name
        again = judged(name, ratio, shaft_fit="h6", housing_fit=found.housing.recommended_fit,
                       inner_ring_load="stationary", outer_ring_load="rotating")  # fmt: skip
        assert not [check for check in again.checks if check.status == "fail"], name


def test_series_come_from_the_designation():
    expected = {"6205": 2.8, "6305": 2.3, "6405": 2.0, "32216": 2.8, "608": 2.8, "635": 2.3, "30310": 2.3}
    assert {name: seat_bearing(by_designation(name)).shaft.joint.factor for name in expected} == expected
    assert seat_bearing(by_designation("6305", series="light")).shaft.joint.factor == 2.8


@pytest.mark.parametrize(
    ("seat", "kind", "load", "ratio", "diameter", "accuracy", "classes"),
    [
        ("shaft", "cylindrical", "rotating", 0.08, 40, "0", ("m5",)),
        ("shaft", "tapered", "rotating", 0.02, 80, "0", ("m6",)),
        ("shaft", "spherical", "rotating", 0.08, 90, "6", ("n6",)),
        ("shaft", "ball", "indeterminate", 0.08, 17, "0", ("j5",)),
        ("shaft", "ball", "rotating", 0.03, 40, "4", ("js4",)),
        ("shaft", "ball", "rotating", 0.08, 40, "5", ("k4",)),
        ("shaft", "ball", "rotating", 0.08, 120, "5", ("m4",)),
        ("housing", "tapered", "rotating", 0.2, 80, "0", ("P7",)),
        ("housing", "ball", "indeterminate", 0.08, 52, "0", ("K7", "J7")),
        ("housing", "ball", "stationary", 0.0, 52, "2", ("H5", "H6", "JS5")),
    ],
)
def test_rows_of_the_makers_table(seat, kind, load, ratio, diameter, accuracy, classes):
    assert maker_fits(seat, kind, load, ratio, diameter / 1e3, accuracy).classes == classes


def test_split_housings_take_no_class_that_pinches():
    assert maker_fits("housing", "ball", "rotating", 0.08, 0.08, "0", split=True) is None
    assert maker_fits("housing", "ball", "indeterminate", 0.08, 0.08, "0", split=True).classes == ("J7",)
    found = seats(housing_fit="K7", housing_split=True).housing
    assert (found.checks[1].status, found.recommended_fit) == ("warn", "H7") and "pinch" in found.checks[1].message
    turning = seats(housing_fit="N7", housing_split=True, outer_ring_load="rotating").housing
    assert turning.recommended_fit is None and turning.checks[1].status == "warn"
    loose = seats(housing_fit="H7", housing_split=True, outer_ring_load="rotating").housing
    assert loose.checks[0].status == "fail" and "one-piece" in loose.checks[0].remedy
    assert seats(housing_fit="J7", housing_split=True).housing.checks[1].status == "pass"


def test_every_row_of_the_makers_table_is_a_tabulated_class_and_rows_follow_on():
    rows = csv_rows("maker_fits")
    for seat, *_, fits, _ in rows:
        assert set(fits.replace("|", "/").split("/")) <= set(tolerance_classes(seat))
    for one, other in itertools.pairwise(rows):
        if one[:6] == other[:6]:
            assert one[7] == other[6]  # the next row begins where this one ends


def test_a_load_above_a_quarter_of_the_static_rating_is_told():
    """6205: C0 is 7.8 kN."""
    told = [" ".join(seat_bearing(by_designation("6205", radial_load_kN=load)).shaft.notes) for load in (1.9, 2.0)]
    assert ["quarter of C0" in notes for notes in told] == [False, True]


def test_the_example_keeps_its_conclusion():
    """k6 does not reach the required interference and m6 does; K7 may creep and M7 hardly."""
    k6, m6 = seats(shaft_fit="k6").shaft, seats(shaft_fit="m6").shaft
    assert k6.interference.smallest < k6.required_interference <= m6.interference.smallest
    assert [one.checks[0].status for one in (k6, m6)] == ["warn", "pass"]
    assert (k6.creep.verdict, m6.creep.verdict, k6.recommended_fit) == ("may creep", "holds", "m6")
    assert str(k6.checks[0].remedy).startswith(
        "Specify m6: the least interference rises from "
    ) and "Then ABU601 passes." in str(k6.checks[0].remedy)
    K7, M7 = seats(housing_fit="K7").housing, seats(housing_fit="M7").housing
    assert "can creep" in K7.checks[0].message and "hardly creeps" in M7.checks[0].message


def test_a_fit_is_advised_where_none_is_given():
    found = seat_bearing(by_designation("608", shaft_fit=None, housing_fit=None, radial_load_kN=0.4))
    assert [(seat.fit, seat.fit_given, seat.recommended_fit) for seat in found.seats] == [
        ("js5", False, "js5"), ("H7", False, "H7"),
    ]  # fmt: skip
    assert found.group_to_order == "CN" and found.clearance is None
    bare = seats(shaft_fit=None, housing_fit=None, radial_load_kN=None)
    assert bare.shaft.fit == "n6" and bare.shaft.checks[0].status == "pass"  # as 32216, tapered
    other = seats(shaft_fit=None, housing_fit=None, radial_load_kN=None, width_mm=33.5)
    assert other.shaft.fit == "k5"  # a type that is not told is taken as ball


def test_advice_names_the_group_that_makes_the_fit_good():
    """6207 on k5: a fifth of the CN bearings has no clearance left, so C3 is ordered, not a looser fit written."""
    tight = judged("6207", 0.08, shaft_fit="k5", housing_fit="H7", internal_clearance="CN")
    check = tight.checks[-1]
    assert (check.code, check.status) == ("ABU621", "warn") and "20 of 100 bearings" in check.message
    assert (tight.shaft.recommended_fit, tight.group_to_order) == (
        "k5",
        "C3",
    ) and str(check.remedy).startswith("Specify group C3: ")
    assert judged("6207", 0.03, shaft_fit="j6", housing_fit="H7").group_to_order == "CN"
    jammed = judged("6207", 0.08, shaft_fit="p6", housing_fit="N7", internal_clearance="C2")
    assert jammed.checks[-1].status == "fail"


def test_the_nearest_fields_that_fail_are_named_with_the_reason():
    shaft = judged("6205", 0.08, shaft_fit="k5", housing_fit="H7", internal_clearance="C3").shaft
    looser, tighter = shaft.rejected_fits
    assert looser.fit == "j5" and "demanded" in looser.why and "of 100 pairs have less" in looser.why
    assert tighter.fit == "n5" and "no operating clearance is left" in tighter.why
    for one in shaft.rejected_fits:
        again = judged("6205", 0.08, shaft_fit=one.fit, housing_fit="H7", internal_clearance="C3")
        assert any(check.status in ("fail", "warn") for check in again.checks)


BEARINGS = ("6203", "6206", "6304", "608", "NU206", "7206B", "30206", "22208")
COUNT = 60


def drawn(seed: int) -> dict[str, Any]:
    """A bearing with seats and load at random."""
    rng = Random(seed)
    angular = BEARINGS[seed % len(BEARINGS)].endswith("B")
    return {
        "designation": BEARINGS[seed % len(BEARINGS)], "radial_load_kN": round(10 ** rng.uniform(-1, 1), 3),
        "shaft_fit": rng.choice(("g6", "h6", "js6", "k6", "m6", "p6")),
        "housing_fit": rng.choice(("G7", "H7", "J7", "K7", "N7")),
        "internal_clearance": rng.choice(("CA", "CB", "CC", "GA") if angular else ("C2", "CN", "C3")),
        "outer_ring_load": rng.choice(("stationary", "rotating")),
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(COUNT))
def test_every_action_holds_when_followed(seed: int) -> None:
    bearing = from_table(by_designation(**drawn(seed)))
    found = judge(bearing)
    ranks = {check.code: RANK.index(check.status) for check in found.checks}
    for code, action in found.actions.items():
        after = judge(with_entries(bearing, dict(entry.split("=") for entry in action.overrides)))
        now = {check.code: check for check in after.checks}
        if not action.overrides:
            assert "no class suits all checks" in action.text
            continue
        worse = [each for each, check in now.items() if check.requested and RANK.index(check.status) < ranks[each]]
        assert not worse, action.text
        told = "pass" if f"Then {code} passes." in action.text else "warn" if "still warns." in action.text else "fail"
        assert now[code].status == told, action.text
        number = re.search(r" to ([-\d.]+) (?:µm|%|N)", action.text)
        if number and "under" not in action.text:
            assert float(number[1]) == pytest.approx(now[code].value, rel=6e-3, abs=6e-3), action.text
