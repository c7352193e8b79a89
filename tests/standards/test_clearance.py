"""Groups of radial clearance."""

import itertools

import pytest

from abu_calc.foundation.errors import InputError, RangeError
from abu_calc.standards.bearing_catalogue import GROUPS, of_size, radial_clearance
from abu_calc.standards.internal_clearance import internal_clearance
from abu_calc.standards.tables import csv_rows
from tests.standards.second_sources import NSK_CLEARANCE, SHJF_CLEARANCE, SKF_PAIRS, TPI_CLEARANCE

BORES = (4, 8, 17, 20, 25, 35, 45, 60, 70, 90, 110, 130, 150, 170, 190)


def micrometres(group, bore):
    return tuple(round(1e6 * one, 6) for one in radial_clearance(group, bore * 1e-3))


@pytest.mark.parametrize("source", [TPI_CLEARANCE, SHJF_CLEARANCE], ids=["TPI", "SHJF"])
def test_rows_up_to_100_mm_agree_with_the_catalogues(source):
    for to, row in source.items():
        over = max(over for over in (2.5, 6, 10, 18, 24, 30, 40, 50, 65, 80) if over < to)
        for bore in (over + 0.001, to):
            ours = itertools.chain(*(micrometres(group, bore) for group in GROUPS))
            assert tuple(ours)[: len(row)] == row, bore


def test_rows_over_100_mm_agree_with_nsk():
    for to, row in NSK_CLEARANCE.items():
        for bore in (to - 19.999, to):
            assert tuple(itertools.chain(*(micrometres(group, bore) for group in GROUPS))) == row, bore


def test_every_row_has_a_second_source():
    confirmed = {*TPI_CLEARANCE, *SHJF_CLEARANCE, *NSK_CLEARANCE}
    assert {float(row[2]) for row in csv_rows("radial_clearance")} <= confirmed


def test_pairs_of_angular_contact_bearings_agree_with_the_later_edition():
    for bore, row in SKF_PAIRS.items():
        for group, ends in zip(("CA", "CB", "CC", "GA", "GB", "GC"), row, strict=True):
            ours = internal_clearance("angular-contact", group, bore * 1e-3)
            assert tuple(round(1e6 * end, 6) for end in ours) == ends, (bore, group)


@pytest.mark.parametrize("group", GROUPS)
def test_the_rows_of_a_group_leave_no_gap(group):
    rows = [row for row in csv_rows("radial_clearance") if row[0] == group]
    assert (rows[0][1], rows[-1][2]) == ("2.5", "200")
    assert all(one[2] == following[1] for one, following in itertools.pairwise(rows))


@pytest.mark.parametrize("bore", BORES)
def test_groups_follow_one_another_and_overlap(bore):
    rows = [micrometres(group, bore) for group in GROUPS]
    for (small, large), (next_small, next_large) in itertools.pairwise(rows):
        assert small < next_small < large < next_large


@pytest.mark.parametrize("group", GROUPS)
def test_larger_bores_never_have_less(group):
    rows = [micrometres(group, bore) for bore in BORES]
    for less, more in itertools.pairwise(rows):
        assert less[0] <= more[0] and less[1] <= more[1]


@pytest.mark.parametrize("bore", [2.5, 200.001, float("nan"), -10.0])
def test_bores_outside_are_refused(bore):
    with pytest.raises(RangeError, match=r"over 2.5 up to 200 mm"):
        radial_clearance("CN", bore * 1e-3)


def test_unknown_groups_are_refused():
    with pytest.raises(InputError, match="C2, CN, C3, C4"):
        radial_clearance("C6", 0.02)


def test_sizes_find_their_bearing():
    assert of_size(0.030, 0.062, 0.016).designation == "6206"  # before 7206 and 30206
    assert of_size(0.030, 0.062, 0.0161) is None
    assert of_size(0.008, 0.022, 0.007).deep_groove and not of_size(0.080, 0.140, 0.033).deep_groove
