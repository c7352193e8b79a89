"""Keys and values in messages are those that TOML would read.

Format of files: optional, of this version, refused if newer.
"""

import datetime
import math
import tomllib

import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.units import SI_PER_UNIT
from abu_calc.inputs.reading.kinds import KINDS
from abu_calc.inputs.reading.schema import template_of
from abu_calc.inputs.reading.sources import text_of
from abu_calc.inputs.reading.text import (
    FORMAT,
    LONGEST_SHOWN,
    is_number,
    key_path,
    quoted,
    shown,
    shown_short,
    unit_suffix,
    unit_symbol,
)
from tests.rows import for_each

TEXTS = ["plain", 'in "quotes"', "back\\slash", "tab\tbell\x07\x7f", "é 球", ""]


@pytest.mark.parametrize("value", [
    True, 3, 2.5, 1e-9, "text", [1, 2.5], [[1.0], ["a"]], math.inf, datetime.date(2020, 1, 2), *TEXTS,
])  # fmt: skip
def test_toml_reads_what_is_shown(value: object) -> None:
    assert tomllib.loads(f"a = {shown(value)}")["a"] == value


@pytest.mark.parametrize("text", TEXTS)
def test_a_key_path_leads_to_its_entry(text: str) -> None:
    assert tomllib.loads(f"{key_path(('outer', text))} = 1") == {"outer": {text: 1}}
    assert tomllib.loads(f"a = {quoted(text)}")["a"] == text


def test_places_in_lists_stand_in_brackets() -> None:
    assert key_path(("bearing", 0, "shaft_fit")) == "bearing[0].shaft_fit"
    assert key_path(()) == ""


def test_what_is_long_is_cut() -> None:
    assert len(shown_short("x" * 500)) == LONGEST_SHOWN and shown_short("x") == '"x"'
    assert shown_short([{}]) == "an array of tables" and shown({}) == "a table" and shown(10**301) == "a huge integer"


@for_each(SI_PER_UNIT)
def test_a_key_ends_in_the_whole_of_its_unit(unit: str) -> None:
    assert unit_suffix(f"some_{unit}") == unit
    assert unit_suffix(f"some{unit}") != unit
    assert unit_symbol(f"some_{unit}").startswith(" ")


@pytest.mark.parametrize(("value", "number"), [
    (0, True), (-2.5, True), (True, False), (math.nan, False), (math.inf, False), ("1", False), (None, False),
])  # fmt: skip
def test_a_number_is_finite_and_no_truth(value: object, number: bool) -> None:
    assert is_number(value) is number


TEXT = text_of("avtovaz-707-222")


def test_a_file_may_say_its_format() -> None:
    machine = abu_calc.read(f"format = {FORMAT}\n{TEXT}")
    assert machine.tables == abu_calc.read("avtovaz-707-222").tables
    assert machine.changed({"wheel.mass_kg": 0.5}).whole().wheel.mass_kg == 0.5


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_each_template_says_it(kind: object) -> None:
    text = template_of(kind.name)  # type: ignore[attr-defined]
    assert f"\nformat = {FORMAT}\n" in text


@pytest.mark.parametrize("given", [str(FORMAT + 1), "99", "0", "-1", "true", "1.0", '"1"', "[1]", "nan"])
def test_others_are_refused_with_their_line(given: str) -> None:
    with pytest.raises(InputError) as caught:
        abu_calc.read(f"# a comment\nformat = {given}\n{TEXT}")
    assert (caught.value.place.line, caught.value.place.key) == (2, "format")
    assert caught.value.allowed == f"1 … {FORMAT}"


def test_a_table_of_that_name_is_refused() -> None:
    with pytest.raises(InputError):
        abu_calc.read(f"{TEXT}\n[format]\nx = 1")
