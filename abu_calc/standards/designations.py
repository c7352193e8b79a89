"""Suffixes behind the basic number of a bearing's designation: seals, clearance, accuracy."""

import re
from typing import Final, NamedTuple

from abu_calc.errors import InputError
from abu_calc.standards.bearings import Dimensions, bearing, known_names

_TOKENS: Final = (
    (r"P6X", "class"),
    (r"P([0-6])([2-5])", "class and group"),
    (r"P([024-6])", "class"),
    (r"C[2-5]|CN", "group"),
    (r"2RS[HLR]?[12]?|2R[ZUK]|2Z[ER]?|ZZ[E]?|2NSE?|LLU|LLB|LLH|DDU?|VV|RS[HLR]?[12]?|RZ|Z", "closure"),
    (r"E?TN[0-9]?H?|TVH|MA|M|JN|J2|J|Q|NR|N|W64|VT[0-9]+[A-Z]?|MT[0-9]+|GJN|WT|S[01]|E|P|Y", "other"),
)
_SEPARATORS: Final = " -/.,"
# Shields and seals of GOST names: 60203, 80203 shields, 160203, 180203 seals.
_GOST_CLOSED: Final = re.compile(r"(60|80|160|180)(\d{3})$")
_ROLLERS: Final = re.compile(r"(NUP|NU|NJ|NF|N)(\d)(\d\d)")
_TYPES: Final = (
    (re.compile(r"(NUP|NU|NJ|NF|NN|N)\s*\d{3,4}"), "cylindrical roller bearings", "cylindrical"),
    (re.compile(r"2[0-4][0-9]\d{2}"), "spherical roller bearings", "spherical"),
    (re.compile(r"(N[AK]|HK|RNA)\s*\d+"), "needle roller bearings", "cylindrical"),
)


class Designation(NamedTuple):
    """Sizes by the basic number; the clearance group and the accuracy class that the suffixes name (None: none)."""

    size: Dimensions
    group: str | None
    accuracy: str | None


def read_designation(text: str) -> Designation:
    """A designation with its suffixes: 6203-2RS, 6203ZZ, 6203-2Z/C3, 180203.

    Seals, shields, cages, snap rings and greases do not change the seats and are passed over.
    InputError: a number that is not tabulated, a suffix that is not known.

    >>> read_designation("6203-2RS1/C3").group, read_designation("6203ZZ").size.designation
    ('C3', '6203')
    """
    spaced = " ".join(text.upper().split()).translate(str.maketrans("АВС", "ABC"))
    name = spaced.replace(" ", "")
    if (closed := _GOST_CLOSED.fullmatch(name)) and closed[2].lstrip("0") in known_names():
        name = closed[2].lstrip("0")
    if name in known_names():
        return Designation(bearing(name), None, None)
    _refuse_other_types(name, text)
    for written in (name, spaced):
        basic = max((prefix for prefix in known_names() if written.startswith(prefix)), key=len, default=None)
        if basic is not None and not written[len(basic)].isdigit():
            group, accuracy = _suffixes(written[len(basic) :], text, basic)
            return Designation(bearing(basic), group, accuracy)
    return Designation(bearing(text), None, None)  # refused there, with the nearest known


def _suffixes(rest: str, text: str, basic: str) -> tuple[str | None, str | None]:
    group = accuracy = None
    while rest := rest.lstrip(_SEPARATORS):
        token = next(((m, what) for pattern, what in _TOKENS if (m := re.match(pattern, rest))), None)
        if token is None:
            raise InputError(
                f"the suffix {rest} of the bearing designation is not known",
                found=text,
                remedy=f"The nearest known one is {basic}; seals, C2 … C5 and P6 … P2 may follow it.",
            )
        match, what = token
        rest = rest[match.end() :]
        if what == "class and group":
            accuracy, group = match[1], f"C{match[2]}"
        elif what == "class":
            accuracy = match[0].removeprefix("P")
        elif what == "group":
            group = match[0]
    return group, accuracy


def _refuse_other_types(name: str, text: str) -> None:
    for pattern, what, kind in _TYPES:
        if pattern.match(name):
            raise InputError(
                f"{what} are not in the table of bearings",
                found=text,
                allowed="deep groove and angular contact ball bearings (60 … 64, 72), tapered ones (302, 303, 322)",
                remedy=f'Give bore_mm, outer_mm, width_mm and bearing_type = "{kind}"{_like(name)}.',
            )


def _like(name: str) -> str:
    """The sizes of the ball bearing of the same dimension series (ISO 15): NU 208 is as wide as 6208."""
    rollers = _ROLLERS.match(name)
    size = f"6{rollers[2]}{rollers[3]}" if rollers else ""
    if size not in known_names() or not rollers or rollers[2] not in "0234":
        return ""
    equivalent = bearing(size)
    numbers = " × ".join(f"{1e3 * length:g}" for length in (equivalent.bore, equivalent.outer, equivalent.inner_width))
    return f" (by ISO 15 {numbers} mm, as {size})"
