"""Values that scripts give are those a file would hold; nothing is nested without end."""

import datetime
from collections import OrderedDict
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.values_with_units import DEEPEST, check_nesting, found_as, plain_number, plain_value


@pytest.mark.parametrize(("given", "plain"), [
    (np.float64(2.5), 2.5), (np.int32(3), 3), (Decimal("0.5"), 0.5), (Fraction(1, 4), 0.25), (np.str_("mm"), "mm"),
    ((1, (2.0, "x")), [1, [2.0, "x"]]), (OrderedDict(a=np.float32(1.5)), {"a": 1.5}), (True, True),
    (datetime.date(2020, 1, 2), datetime.date(2020, 1, 2)),
])  # fmt: skip
def test_values_of_other_libraries_become_pythons_own(given: object, plain: object) -> None:
    value = plain_value(given, "key")
    assert value == plain and type(value) is type(plain)


@pytest.mark.parametrize("given", [True, "2", None, 2j, Decimal("sNaN"), Fraction(10**400), [1]])
def test_what_is_no_real_number_is_none(given: object) -> None:
    assert plain_number(given) is None


@pytest.mark.parametrize(("given", "key"), [
    (None, "a"), ({"b": {"c": None}}, "a.b.c"), ({"b": [1, object()]}, "a.b"), ({"b": {1: 2}}, "a.b"), ({1, 2}, "a"),
])  # fmt: skip
def test_what_no_file_can_hold_is_refused_by_its_key(given: object, key: str) -> None:
    with pytest.raises(InputError) as refused:
        plain_value(given, "a")
    assert refused.value.place.key == key and refused.value.allowed


def test_a_value_that_holds_itself_is_refused() -> None:
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(InputError, match="nested too deeply"):
        plain_value(endless, "a")


@pytest.mark.parametrize("text", ["a = " + "[" * 33 + "]" * 33, "a" + ".a" * 40 + " = 1", "a = " + "{a=" * 33])
def test_a_text_nested_too_deeply_is_refused_at_its_line(text: str) -> None:
    with pytest.raises(InputError) as refused:
        check_nesting("# first\n\n" + text, "m.toml")
    assert (refused.value.place.file, refused.value.place.line) == ("m.toml", 3)


@pytest.mark.parametrize("text", [
    "a = " + "[" * DEEPEST + "]" * DEEPEST, "a" + ".a" * (DEEPEST - 1) + " = 1", "a = [1]\n" * 100,
    'a = "' + "[." * 50 + '"',
    "# " + "[" * 50, "a.b = 1\n" * 50, "x = 1.5\n" * 50,
])  # fmt: skip
def test_brackets_in_a_row_or_in_texts_are_not_nested(text: str) -> None:
    check_nesting(text, "m.toml")


def test_a_value_without_a_form_of_its_own_is_shown_by_its_type() -> None:
    class Silent:
        def __repr__(self) -> str:
            raise RuntimeError

    assert found_as(Silent()) == "a value of type Silent"
    assert found_as(10**5000) == "a value of type int"
    assert len(found_as("x" * 100)) == 60
