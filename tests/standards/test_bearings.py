"""Boundary dimensions of bearings."""

import pytest

from abu_calc.errors import InputError
from abu_calc.standards.bearings import bearing
from abu_calc.standards.tables import csv_rows

ROWS = csv_rows("bearings")


def millimetres(designation):
    found = bearing(designation)
    sizes = (found.bore, found.outer, found.inner_width, found.inner_chamfer)
    return [round(1e3 * size, 6) for size in sizes]


@pytest.mark.parametrize(
    ("designation", "sizes"),
    [
        ("6203", [17, 40, 12, 0.6]), ("203", [17, 40, 12, 0.6]), ("608", [8, 22, 7, 0.3]), ("18", [8, 22, 7, 0.3]),
        ("6000", [10, 26, 8, 0.3]), ("6310", [50, 110, 27, 2]), ("6410", [50, 130, 31, 2.1]),
        ("7206B", [30, 62, 16, 1]), ("46206", [30, 62, 16, 1]), ("30206", [30, 62, 16, 1]),
        ("30310", [50, 110, 27, 2.5]), ("32216", [80, 140, 33, 2.5]), ("7516", [80, 140, 33, 2.5]),
    ],
)  # fmt: skip
def test_published_dimensions(designation, sizes):
    assert millimetres(designation) == sizes


def test_spaces_and_case_do_not_matter():
    assert bearing(" 7206 b") == bearing("7206B")


@pytest.mark.parametrize("row", ROWS, ids=[row[0] for row in ROWS])
def test_rows_follow_the_system_of_designations(row):
    """Bore number times five (20 mm up), sections that nest, ISO and GOST names of one bearing."""
    found = bearing(row[0])
    digits = row[0].rstrip("ABC")
    if len(digits) > 3:
        code = int(digits[-2:])
        assert 1e3 * found.bore == pytest.approx({0: 10, 1: 12, 2: 15, 3: 17}.get(code, 5 * code))
    assert found.bore < found.outer
    assert 0 < 2 * found.inner_chamfer < found.inner_width
    assert 0 < 2 * found.outer_chamfer < found.outer_width <= found.inner_width
    assert found.type == ("tapered" if row[0].startswith("3") else "radial")
    if not row[1].startswith(("72", "73")):
        assert bearing(row[1]) == found


@pytest.mark.parametrize("series", ["60", "62", "63", "64", "302", "303", "322"])
def test_a_series_grows_with_its_bore(series):
    rows = [row for row in ROWS if row[0][:-2] == series]
    assert len(rows) >= 16
    for column in (3, 4, 5, 6):
        sizes = [float(row[column]) for row in rows]
        assert sizes == sorted(sizes)


def test_names_are_unique():
    names = [name for row in ROWS for name in row[:2]]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("designation", ["7216", "7310"])
def test_a_name_with_two_meanings_is_refused(designation):
    with pytest.raises(InputError, match=f"30{designation[1:]}.*{designation}B"):
        bearing(designation)


@pytest.mark.parametrize(("designation", "nearest"), [("6203-2RS", "6203"), ("30216A", "30216"), ("32221", "32")])
def test_unknown_designations_are_refused_with_the_nearest(designation, nearest):
    with pytest.raises(InputError, match=f"nearest known one is {nearest}"):
        bearing(designation)


def test_nonsense_is_refused_with_a_remedy():
    with pytest.raises(InputError, match="bore_mm"):
        bearing("???")
