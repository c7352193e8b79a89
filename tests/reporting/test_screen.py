"""A report on one screen: verdict, reasons and tables cut to the room there is."""

import re

import pytest

from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph
from abu_calc.reporting.screen import cut
from abu_calc.reporting.text import as_text, height


@pytest.mark.parametrize("room", range(1, 30))
def test_tables_are_cut_to_the_room_there_is(room: int) -> None:
    rows = tuple((str(number), "x") for number in range(12))
    blocks: list[Block] = [
        Paragraph("first"),
        Heading("Table"),
        Grid(("a", "b"), rows),
        Heading("End"),
        Paragraph("last"),
    ]
    shown = cut(blocks, room)
    text = as_text(shown)
    assert height(shown) <= room and not isinstance(shown[-1], Heading)
    whole = room >= height(blocks)
    assert ("--full" in text) is not whole
    counted = re.search(r"And (\d+) more row", text)
    if counted:
        assert len(re.findall(r"x$", text, re.MULTILINE)) + int(counted[1]) == 12
