"""Blocks of a report: numbers as text, and tables that fit a width."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.foundation.quantity import Quantity
from abu_calc.reporting.blocks import Grid, number, shown_as


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.text("ab1.", max_size=14), min_size=3, max_size=7).flatmap(
        lambda header: st.tuples(
            st.just(tuple(header)),
            st.lists(st.tuples(*(st.text("xyz9", max_size=25) for _ in header)), min_size=1, max_size=4),
        )
    ),
    st.integers(20, 120),
)
def test_parted_tables_have_every_column_once_and_the_first_each_time(
    table: tuple[tuple[str, ...], list[tuple[str, ...]]], width: int
) -> None:
    header, rows = table
    parts = Grid(header, tuple(rows), frozenset({1, 2}), kept=2).within(width)
    assert all(part.header[:2] == header[:2] for part in parts)
    assert tuple(name for part in parts for name in part.header[2:]) == header[2:]
    for k, row in enumerate(rows):
        assert tuple(cell for part in parts for cell in part.rows[k][2:]) == row[2:]
    for part in parts:
        wide = sum(max(map(len, column)) + 2 for column in zip(part.header, *part.rows, strict=True))
        assert wide <= width or len(part.header) == 3
    assert Grid(header, tuple(rows)).within(1) == [Grid(header, tuple(rows))]


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (-0.0412, "-0.04120"), (9999.6, "10000"), (0.99996, "1.000"), (1e-4, "0.0001000"), (9e-5, "9.000e-05"),
     (1e7, "1.000e+07"), (123456.0, "123500")],
)  # fmt: skip
def test_numbers_have_four_digits_and_no_exponent_between_1e_4_and_1e7(value: float, text: str) -> None:
    assert number(value) == text


@given(st.floats(1e-4, 9.9e6), st.integers(1, 8))
def test_a_number_is_right_to_its_digits(value: float, digits: int) -> None:
    assert float(number(value, digits)) == pytest.approx(value, rel=0.5 * 10 ** (1 - digits) * (1 + 1e-9))


def test_values_are_told_by_their_quantity() -> None:
    assert shown_as(Quantity("share", percent=True), "", 0.043) == "4.300 %"
    assert shown_as(Quantity("mass", "", 3), "g", 240.46) == "240 g"
    assert shown_as(Quantity("speeds", "", 3), "rpm", (100.0, 200.0)) == "100, 200 rpm"
    assert [shown_as(Quantity("x"), "mm", value) for value in (None, True, False, "5-6")] == [
        "not computed",
        "yes",
        "no",
        "5-6 mm",
    ]
