"""Format of files: optional, of this version, refused if newer."""

import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.kinds import KINDS
from abu_calc.inputs.reading.schema import template_of
from abu_calc.inputs.reading.sources import text_of
from abu_calc.inputs.reading.text import FORMAT

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
