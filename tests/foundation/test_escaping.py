"""Text that acts on no terminal, breaks no line and is not too long."""

import tomllib

import pytest

from abu_calc.foundation.errors import LONGEST_FOUND, escaped, escaped_lines, escaped_toml, shortened
from tests.foundation.test_errors import HOSTILE


def test_nothing_in_a_text_acts_on_a_terminal() -> None:
    assert escaped(HOSTILE).isprintable() and "é" in escaped(HOSTILE)
    assert [line.isprintable() for line in escaped_lines(HOSTILE).split("\n")] == [True, True]


def test_toml_reads_escaped_text_as_it_was() -> None:
    text = HOSTILE.replace("\n", "")  # a basic string has one line
    assert tomllib.loads(f'a = "{escaped_toml(text)}"')["a"] == text
    assert tomllib.loads(f'a = "{escaped_toml(chr(0xD800))}"')["a"] == "?"


@pytest.mark.parametrize("most", [1, 2, 30, LONGEST_FOUND])
def test_a_text_is_cut_where_it_is_too_long(most: int) -> None:
    assert shortened("x" * most, most) == "x" * most
    assert shortened("x" * (most + 1), most) == "x" * (most - 1) + "…"
