"""Requirements of seats: no second source, so held to the order that the classes have."""

import itertools

import pytest

from abu_calc.standards.tables import toml_table

TABLE = toml_table("seat_requirements")
CLASSES = ("0", "6", "5", "4", "2")


def test_every_class_is_there_once():
    assert tuple(TABLE["form_share"]) == CLASSES
    for seat in ("shaft", "housing"):
        assert tuple(TABLE[seat]["roughness"]) == tuple(TABLE[seat]["shoulder"]) == CLASSES


@pytest.mark.parametrize("seat", ["shaft", "housing"])
def test_a_finer_class_never_asks_for_less(seat):
    for coarse, fine in itertools.pairwise(CLASSES):
        assert TABLE["form_share"][fine] <= TABLE["form_share"][coarse]
        assert TABLE[seat]["shoulder"][fine] < TABLE[seat]["shoulder"][coarse]
        assert all(a <= b for a, b in zip(*(TABLE[seat]["roughness"][name] for name in (fine, coarse)), strict=True))


def test_a_housing_and_a_large_seat_may_be_rougher_and_a_shaft_never():
    for name in CLASSES:
        shaft, housing = TABLE["shaft"], TABLE["housing"]
        assert shaft["shoulder"][name] == housing["shoulder"][name] - 1
        assert all(a <= b for a, b in zip(shaft["roughness"][name], housing["roughness"][name], strict=True))
        assert all(table["roughness"][name][1] == pytest.approx(2 * table["roughness"][name][0], rel=0.02)
                   for table in (shaft, housing))  # fmt: skip
