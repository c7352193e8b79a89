"""Messages of errors: place, facts and remedy, safe for a terminal and of bounded length.

Text that acts on no terminal, breaks no line and is not too long.
"""

import tomllib

import pytest

from abu_calc.foundation.errors import (
    LONGEST_FOUND,
    AbuError,
    ChaoticError,
    InputError,
    NotTrustworthyError,
    OutputError,
    Place,
    RangeError,
    StoppedError,
    escaped,
    escaped_lines,
    escaped_toml,
    shortened,
)

HOSTILE = "a\nb\r\x1b[31m\x00\u202e\ufeff\u2028é"


def test_an_error_says_place_fact_limit_and_remedy() -> None:
    error = InputError(
        "too fast", place=Place("m.toml", 3, "machine.speed_rpm"), found="9e9", allowed="at most 1", remedy="slow down"
    )
    assert str(error) == "m.toml:3: machine.speed_rpm: too fast (found 9e9; allowed: at most 1)\n  Slow down"
    assert str(InputError("too fast")) == "too fast"


def test_an_error_told_of_another_place_keeps_its_kind_and_its_facts() -> None:
    first = RangeError("outside", found="2", allowed="1", remedy="less")
    moved = first.at(Place(key="speed"), more=" here")
    assert (type(moved), moved.message, moved.place.key) == (RangeError, "outside here", "speed")
    assert (moved.found, moved.allowed, moved.remedy) == (first.found, first.allowed, first.remedy)


@pytest.mark.parametrize(("error", "status"), [
    (AbuError(), 3), (InputError(""), 2), (RangeError(""), 2), (OutputError(""), 2), (NotTrustworthyError(), 3),
    (ChaoticError(), 3), (StoppedError(""), 130), (StoppedError("", 143), 143),
])  # fmt: skip
def test_each_error_has_its_exit_status(error: AbuError, status: int) -> None:
    assert error.exit_status == status


def test_nothing_in_a_message_acts_on_a_terminal() -> None:
    for text in (str(Place(HOSTILE, 1, HOSTILE)), str(InputError("bad", found=HOSTILE))):
        assert text.isprintable() and "é" in text


def test_long_values_are_cut() -> None:
    cut = InputError("bad", found="x" * 10_000, remedy="write " + "y" * 10_000)
    assert cut.found is not None and len(cut.found) == LONGEST_FOUND and cut.found.endswith("…")
    assert len(str(cut)) < 3 * LONGEST_FOUND


@pytest.mark.parametrize(("place", "text"), [
    (Place(), ""), (Place("f"), "f"), (Place(line=2), "line 2"), (Place("f", 2), "f:2"), (Place("f", key="k"), "f: k"),
])  # fmt: skip
def test_a_place_is_shown_as_far_as_it_is_known(place: Place, text: str) -> None:
    assert str(place) == text


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
