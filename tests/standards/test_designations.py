"""Designations as people write them, and those that are refused for a true reason."""

import re

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.standards.bearing_catalogue import read_designation
from tests.rows import for_each


@for_each([
        ("6203", "6203", None, None), ("6203-2RS", "6203", None, None), ("6203ZZ", "6203", None, None),
        ("6203 2Z C3 P5", "6203", "C3", "5"), ("6203-2RS1/C3", "6203", "C3", None), ("6203/P63", "6203", "C3", "6"),
        ("6203.2ZR.C4", "6203", "C4", None), ("608-2RSH", "608", None, None), ("180203", "6203", None, None),
        ("80203", "6203", None, None), ("203", "6203", None, None), ("7206 BEP", "7206B", None, None),
        ("32216 J2/Q", "32216", None, None), ("6205 llu", "6205", None, None), ("6203 CN", "6203", "CN", None),
        ("NU 208 ECP", "NU208", None, None), ("NJ2310/C3", "NJ2310", "C3", None), ("22216 E", "22216", None, None),
        ("22220 CC/W33 C3", "22220", "C3", None), ("HK 1010", "HK1010", None, None), ("6312 C5", "6312", "C5", None),
        ("7208 BECBP", "7208B", "CB", None), ("7210 BEGAP", "7210B", "GA", None), ("7005C/P4", "7005C", None, "4"),
        ("6-205", "6205", None, "6"), ("76-180205", "6205", "C3", "6"), ("5 – 206", "6206", None, "5"),
        ("0−205", "6205", None, "0"), ("6Х-7516", "32216", None, "6X"),
        ("32008 X/Q", "32008", None, None), ("61805-2Z", "61805", None, None), ("NA4905", "NA4905", None, None),
    ])  # fmt: skip
def test_suffixes_are_read(text, name, group, accuracy):
    found = read_designation(text)
    assert (found.size.designation, found.group, found.accuracy) == (name, group, accuracy)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("NN 3008", "cylindrical roller bearings"), ("NU 4908", "cylindrical roller"),
        ("24140", "spherical roller bearings"), ("HK9999", "drawn-cup"),
        ("6203-FOO", "suffix FOO"), ("62033", "unknown bearing designation"),
        ("7216", "two meanings"), ("6203 C3 QQQ8", "suffix 8"), ("", "unknown bearing designation"),
        ("6203-P7", "suffix P7|suffix 7"), ("9-205", "prefix 9.*6-205, 76-180205.*Give 205"), ("А75-205", "prefix A75"),
        ("6-205/P5", "both give the class"), ("6-999", "unknown bearing designation .found 6-999"),
    ],
)  # fmt: skip
def test_what_is_not_known_is_refused_for_a_true_reason(text, said):
    with pytest.raises(InputError) as refused:
        read_designation(text)
    assert re.search(said, str(refused.value), re.DOTALL), str(refused.value)


@pytest.mark.parametrize(
    ("name", "sizes"),
    [("619/2.5", (2.5, 7, 2.5)), ("618/1.5", (1.5, 4, 1.2)), ("619/1", (1, 4, 1.6)),
     ("618/8", (8, 16, 4))],
)  # fmt: skip
def test_miniature_bearings_have_two_names(name, sizes):
    """ISO 15, dimension series 18 and 19: SKF's 618/2.5 is NSK's 682X."""
    found = read_designation(name).size
    assert [round(1e3 * length, 6) for length in (found.bore, found.outer, found.inner_width)] == list(sizes)
