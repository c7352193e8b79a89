"""Designations as people write them, and those that are refused for a true reason."""

import re

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.standards.bearing_catalogue import read_designation


@pytest.mark.parametrize(
    ("text", "name", "group", "accuracy"),
    [
        ("6203", "6203", None, None), ("6203-2RS", "6203", None, None), ("6203ZZ", "6203", None, None),
        ("6203 2Z C3 P5", "6203", "C3", "5"), ("6203-2RS1/C3", "6203", "C3", None), ("6203/P63", "6203", "C3", "6"),
        ("6203.2ZR.C4", "6203", "C4", None), ("608-2RSH", "608", None, None), ("180203", "6203", None, None),
        ("80203", "6203", None, None), ("203", "6203", None, None), ("7206 BEP", "7206B", None, None),
        ("32216 J2/Q", "32216", None, None), ("6205 llu", "6205", None, None), ("6203 CN", "6203", "CN", None),
    ],
)  # fmt: skip
def test_suffixes_are_read(text, name, group, accuracy):
    found = read_designation(text)
    assert (found.size.designation, found.group, found.accuracy) == (name, group, accuracy)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("NU 208", "cylindrical roller bearings.*40 × 80 × 18 mm, as 6208"), ("NJ2310", "cylindrical roller"),
        ("22216", "spherical roller bearings"), ("6203-FOO", "suffix FOO"), ("62033", "unknown bearing designation"),
        ("7216", "two meanings"), ("6203 C3 QQQ8", "suffix 8"), ("", "unknown bearing designation"),
        ("6203-P7", "suffix P7|suffix 7"),
    ],
)  # fmt: skip
def test_what_is_not_known_is_refused_for_a_true_reason(text, said):
    with pytest.raises(InputError) as refused:
        read_designation(text)
    assert re.search(said, str(refused.value), re.DOTALL), str(refused.value)
