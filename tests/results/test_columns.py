"""Tables in lines of text: within their width, without losing a character."""

from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.report.blocks import Facts, Grid
from abu_calc.report.columns import columns, table_lines, widths_within
from abu_calc.report.text import as_text

CELLS = st.text(alphabet="ab µ…轴", max_size=30)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(CELLS, CELLS, CELLS), min_size=1, max_size=4), st.integers(8, 60), st.booleans())
def test_tables_keep_to_their_width_and_lose_nothing(rows: list[tuple[str, str, str]], room: int, right: bool) -> None:
    cells = [[(cell, "") for cell in row] for row in rows]
    widths = widths_within(cells, room)
    assert sum(widths) <= room and all(width <= 30 * 2 for width in widths)
    shown = [*table_lines(cells, widths, 2, frozenset({1} if right else ()))]
    assert all(columns(piece) == width + 2 for line in shown for (piece, _), width in zip(line, widths, strict=True))
    for index in range(3):
        column = "".join(line[index][0] for line in shown)
        assert "".join(column.split()) == "".join("".join(row[index] for row in rows).split())


def test_words_are_broken_only_where_no_line_holds_them() -> None:
    grid = Grid(("what", "why"), (("a seat", "the ring creeps on its seat"), ("x" * 30, "no")))
    assert as_text([grid], 24).splitlines() == [
        "  what        why", "  a seat      the ring", "              creeps on", "              its seat",
        "  xxxxxxxxxx  no", "  xxxxxxxxxx", "  xxxxxxxxxx",
    ]  # fmt: skip


def test_facts_of_a_narrow_terminal_leave_room_for_their_values() -> None:
    lines = as_text([Facts((("mass with balls", "m", "142.7 g"), ("share of the machine's mass", "", "2.85 %")))], 40)
    assert lines == "  mass with balls      142.7 g\n  share of the         2.85 %\n  machine's mass\n"
