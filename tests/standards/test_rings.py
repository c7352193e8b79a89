"""ISO 492 by rows against GOST 520-2011 and the catalogues of makers, its own order, refusals."""

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.foundation.errors import InputError, RangeError
from abu_calc.standards.tables import csv_rows
from abu_calc.standards.tolerance_classes import ring_limits
from tests.rows import for_each
from tests.standards.second_sources import CATALOGUES, CONSOLIDATED, GOST_520

CLASSES = {"radial": ("0", "6", "5", "4", "2"), "tapered": ("0", "6X", "6", "5", "4", "2")}


def rows_of(line: str) -> list[tuple[float, float, float]]:
    """Over, up to, lower of a typed line."""
    start, *parts = line.split()
    ends = [tuple(map(float, part.split(":"))) for part in parts]
    overs = [float(start), *(to for to, _ in ends)]
    return [(over, to, -lower) for over, (to, lower) in zip(overs, ends, strict=False)]


def lower(kind: str, ring: str, name: str, size: float) -> float:
    limits = ring_limits(kind, ring, name, size * 1e-3)
    assert limits.upper == 0
    return round(limits.lower * 1e6, 6)


def at_ends(line: str) -> list[tuple[float, float]]:
    """Sizes just over the beginning and at the end of each typed row, with its figure."""
    return [(size, value) for over, to, value in rows_of(line) for size in (over + 0.001, to)]


@for_each(GOST_520.items())
def test_every_row_stands_in_gost_520(key, line):
    for size, value in at_ends(line):
        assert lower(*key, size) == value, size
    ours = [tuple(map(float, row[3:])) for row in csv_rows("iso492") if row[:3] == key]
    published = rows_of(line)
    assert (ours[0][0], ours[-1][1]) == (published[0][0], published[-1][1])
    assert all(one[1] == following[0] for one, following in itertools.pairwise(ours))
    ends = {to for _, to, _ in published}
    assert {to for _, to, _ in ours} <= ends


def test_the_table_has_every_class_and_no_other():
    assert {row[:3] for row in csv_rows("iso492")} == set(GOST_520)
    assert set(GOST_520) == {
        (kind, ring, n) for kind, names in CLASSES.items() for ring in ("inner", "outer") for n in names
    }


@for_each(CATALOGUES)
def test_the_catalogues_of_makers_agree(maker, kind, ring, name, line):
    for size, value in at_ends(line):
        assert lower(kind, ring, name, size) == value, (maker, size)


@pytest.mark.parametrize("name", CONSOLIDATED)
def test_a_catalogue_in_inches_agrees_within_its_rounding(name):
    """Printed in steps of 0.00005 in = 1.27 µm: the figure is within one step."""
    for size, value in at_ends(CONSOLIDATED[name]):
        assert lower("radial", "outer", name, size) == pytest.approx(value * 2.54, abs=1.27)


@pytest.mark.parametrize(("size", "nsk"), [(18, -8), (30, -10)])
def test_tapered_bores_up_to_30_mm_are_not_those_of_nsk(size, nsk):
    """NSK prints the rows of radial bearings there; GOST 520-2011, SKF and ISB print 12 µm up to 50 mm."""
    assert lower("tapered", "inner", "0", size) == -12 != nsk == lower("radial", "inner", "0", size)


def test_a_row_that_one_maker_alone_prints_is_refused():
    """SKF goes on to 500 mm (28 µm); GOST 520-2011 ends radial bores of class 5 at 400 mm."""
    with pytest.raises(RangeError, match="up to 400 mm"):
        ring_limits("radial", "inner", "5", 0.450)


@pytest.mark.parametrize("kind", CLASSES)
@pytest.mark.parametrize("ring", ["inner", "outer"])
@settings(derandomize=True, deadline=None, max_examples=40)
@given(size=st.floats(18.5, 250.0))
def test_a_finer_class_is_never_wider_and_a_larger_ring_never_narrower(kind, ring, size):
    widths = [ring_limits(kind, ring, name, size * 1e-3).tolerance for name in CLASSES[kind]]
    assert widths == sorted(widths, reverse=True)
    assert ring_limits(kind, ring, "0", 1.3 * size * 1e-3).tolerance >= widths[0]


# Tapered bearings share rows: 6X has those of Normal, 6 and 5 those of radial class 6, 4 those of radial class 5.
SHARED = {"6X": ("tapered", "0"), "6": ("radial", "6"), "5": ("radial", "6"), "4": ("radial", "5")}


@pytest.mark.parametrize("ring", ["inner", "outer"])
@pytest.mark.parametrize("name", SHARED)
def test_tapered_bearings_share_rows(name, ring):
    kind, same = SHARED[name]
    for size, _ in at_ends(GOST_520["tapered", ring, name]):
        assert lower("tapered", ring, name, size) == lower(kind, ring, same, size)


@pytest.mark.parametrize(
    ("kind", "ring", "name", "size"),
    [("radial", "inner", "0", 0.6), ("radial", "inner", "0", 500.001), ("radial", "inner", "2", 250.001),
     ("radial", "outer", "0", 2.5), ("radial", "outer", "4", 400.001), ("tapered", "inner", "4", 10),
     ("tapered", "inner", "4", 315.001), ("tapered", "outer", "2", 18), ("tapered", "outer", "0", float("nan"))],
)  # fmt: skip
def test_rings_outside_the_table_are_refused(kind, ring, name, size):
    with pytest.raises(RangeError, match=r"allowed: over .* mm"):
        ring_limits(kind, ring, name, size * 1e-3)


def test_unknown_accuracy_classes_are_refused():
    with pytest.raises(InputError, match="0, 6, 5, 4, 2"):
        ring_limits("radial", "inner", "P6", 0.050)
    with pytest.raises(InputError, match="0, 6X, 6, 5, 4, 2"):
        ring_limits("tapered", "inner", "T", 0.050)
