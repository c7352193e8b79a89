"""Tables of text: ways to write a decimal comma, and the line of the names."""

import numpy as np
import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.recording_table import table_of


@pytest.mark.parametrize("text", [
    "t_s;a\n0;0\n0,001;0,5\n0,002;-1,25\n", "t_s\ta\n0\t0,0\n0,001\t0,5\n0,002\t-1,25\n",
    "t_s a\n0,000 0,0\n0,001 0,5\n0,002 -1,25\n", "t_s, a\n0.0, 0.0\n0.001, 0.5\n0.002, -1.25\n",
    "t_s,a\n0,0\n0.001,0.5\n0.002,-1.25\n", "# by hand\n\nt_s;a\n0,0;0,0\n0,001;5e-1\n0,002;-125e-2\n",
])  # fmt: skip
def test_ways_to_write_the_same_numbers(text: str) -> None:
    """The first row may hold whole numbers only: the comma of a later row counts."""
    table = table_of("r.csv", text, [])
    np.testing.assert_array_equal(table.values, [[0, 0], [0.001, 0.5], [0.002, -1.25]])
    assert table.names[0] == "t_s" and table.head in (1, 3)


@pytest.mark.parametrize(("text", "line"), [
    ("t_s;a\n0;0.5\n0,001;0.5\n", 2), ("t_s;a\n0;1.234,5\n0,1;2\n", 2), ("t_s,a\n0,001,0,5\n0,002,0,6\n", 2),
])  # fmt: skip
def test_commas_that_can_be_read_two_ways_are_refused(text: str, line: int) -> None:
    with pytest.raises(InputError) as refused:
        table_of("r.csv", text, [])
    assert refused.value.place.line == line
