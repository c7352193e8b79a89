"""Blocks of a report: numbers as text, and tables that fit a width."""

from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.reporting.blocks import Grid


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
