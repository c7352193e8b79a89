"""Values of an exchange file as ISO 10303-21 spells them."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from abu_calc.reporting.solids.step import EntityFile, spelled, written_string


@pytest.mark.parametrize(
    ("value", "text"),
    [(1.0, "1."), (-0.0, "0."), (1e-7, "1.E-07"), (1.5e22, "1.5E+22"), (3, "3"), (True, ".T."), (None, "$"),
     ("it's \\", "'it\\X\\27s \\\\'"), ((1.0, (2.5,)), "(1.,(2.5))"), ("шар", "'\\X2\\044804300440\\X0\\'"),
     ("𝄞", "'\\X4\\0001D11E\\X0\\'")],
)  # fmt: skip
def test_values_are_spelled(value: object, text: str) -> None:
    assert spelled(value) == text


@pytest.mark.slow
@given(st.text())
def test_strings_hold_ascii_alone_and_read_back(text: str) -> None:
    """No apostrophe stands in a string: readers such as OpenCASCADE take one before ")" for the string's end."""
    written = written_string(text)
    assert (written.isascii() and written.isprintable()) or written == ""
    plain = {"\\\\": "\\", "\\X\\27": "'"}
    back = re.sub(r"\\\\|\\X\\27|\\X([24])\\([0-9A-F]+)\\X0\\", lambda match: plain.get(match[0]) or "".join(
        chr(int(match[2][k : k + 2 * int(match[1])], 16)) for k in range(0, len(match[2]), 2 * int(match[1]))
    ), written)  # fmt: skip
    shown = "".join(sign if sign.isprintable() else " " for sign in text)
    assert back == shown and "'" not in written


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_read_back_whole(value: float) -> None:
    assert float(spelled(value)) == value and re.fullmatch(r"-?\d+\.\d*(E[+-]\d+)?", spelled(value))


def test_what_is_no_value_is_refused() -> None:
    with pytest.raises(ValueError, match="finite"):
        spelled(float("nan"))
    with pytest.raises(TypeError):
        spelled({1})


def test_equal_values_are_one_entity_and_things_are_not() -> None:
    file = EntityFile()
    assert file.add("DIRECTION", "", (0.0, 0.0, 1.0)) == file.add("DIRECTION", "", (0.0, 0.0, 1.0))
    assert file.own("PRODUCT", "a") != file.own("PRODUCT", "a")
    assert next(iter(file.lines())) == "#1=DIRECTION('',(0.,0.,1.));"
