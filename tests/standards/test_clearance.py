"""Groups of radial clearance."""

import itertools

import pytest

from abu_calc.errors import InputError, RangeError
from abu_calc.standards.bearings import of_size
from abu_calc.standards.clearance import GROUPS, radial_clearance

# Another maker's catalogue, a bore inside each row and at its upper end: smallest and largest of C2, CN, C3, C4, µm.
PUBLISHED = {
    (7, 10): (0, 7, 2, 13, 8, 23, 14, 29),
    (12, 18): (0, 9, 3, 18, 11, 25, 18, 33),
    (20, 24): (0, 10, 5, 20, 13, 28, 20, 36),
    (25, 30): (1, 11, 5, 20, 13, 28, 23, 41),
    (35, 40): (1, 11, 6, 20, 15, 33, 28, 46),
    (45, 50): (1, 11, 6, 23, 18, 36, 30, 51),
    (60, 65): (1, 15, 8, 28, 23, 43, 38, 61),
    (70, 80): (1, 15, 10, 30, 25, 51, 46, 71),
    (90, 100): (1, 18, 12, 36, 30, 58, 53, 84),
}
BORES = (4, 8, 17, 20, 25, 35, 45, 60, 70, 90, 110, 130, 150, 170, 190)


def micrometres(group, bore):
    return tuple(round(1e6 * one, 6) for one in radial_clearance(group, bore * 1e-3))


@pytest.mark.parametrize(("bores", "row"), PUBLISHED.items())
def test_published_rows(bores, row):
    for bore in bores:
        assert tuple(itertools.chain(*(micrometres(group, bore) for group in GROUPS))) == row


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
