"""Rolling bearings by designation: boundary dimensions, suffixes, and radial internal clearance.

Suffixes stand behind the basic number: seals, clearance, accuracy. The clearance is that of deep groove ball bearings
before mounting.
"""

import re
from functools import cache
from typing import Final, Literal, NamedTuple

from abu_calc.foundation.errors import InputError
from abu_calc.standards.catalogue import CatalogueBearing, Kind, catalogue, catalogue_bearing
from abu_calc.standards.tables import csv_rows, lengths_for_size, metres, millimetres, unknown
from abu_calc.standards.tolerance_classes import BearingType, Seat

# Angular contact bearings and tapered bearings of GOST share these numbers, with A too (30° of some makers).
_TWO_MEANINGS = re.compile(r"(7[23]\d\d)A?")
# GOST names end in Cyrillic letters that look Latin.
_LATIN = str.maketrans("АВС", "ABC")

Series = Literal["light", "medium", "heavy"]
_BY_DIAMETER: Final[dict[str, Series]] = {"3": "medium", "4": "heavy"}
_ROLLERS: Final = frozenset({"cylindrical", "tapered", "spherical"})
_THIN: Final = frozenset({"16", "68", "69"})
_NU: Final = re.compile(r"(NUP|NU|NJ|N)(10|22|23|2|3|4)(\d\d)(?!\d)")


class Dimensions(NamedTuple):
    """Bore, outside diameter, width and smallest chamfer (per edge) of each ring [m]; `designation` is ISO's."""

    designation: str
    type: BearingType
    bore: float
    outer: float
    inner_width: float
    inner_chamfer: float
    outer_width: float
    outer_chamfer: float

    @property
    def deep_groove(self) -> bool:
        """True if the bearing is a deep groove ball bearing."""
        return self.kind == "ball"

    @property
    def kind(self) -> Kind:
        """Kind of bearing; of one that is not in the makers' catalogue by its letters."""
        row = catalogue_bearing(self.designation)
        if row is not None:
            return row.kind
        return "tapered" if self.type == "tapered" else "ball" if self.designation[:1] == "6" else "angular-contact"

    @property
    def series(self) -> Series:
        """Series by the diameter series: 3 medium, 4 heavy, all others light.

        Wide light is light too, as the handbooks' k has it.

        >>> bearing("6305").series, bearing("7516").series, bearing("635").series
        ('medium', 'light', 'medium')
        """
        number = self.designation.strip("ABCJKNPUX")
        if self.kind in ("needle", "drawn-cup") or "/" in number or number[:2] in _THIN or len(number) < 3:
            return "light"
        return _BY_DIAMETER.get(number[-3] if self.kind in _ROLLERS or len(number) > 4 else number[1], "light")


def bearing(designation: str) -> Dimensions:
    """The dimensions of a bearing by its basic ISO or GOST designation (6203 = 203, 32216 = 7516 = 7516A).

    Range: the two tables, else InputError: 60, 62, 63, 64, 72 (with B, AC or C), 302, 303, 322 up to bore 100 mm by
    both names, and those of the makers' catalogue: 618, 619, 160, 60 … 63 up to 200 mm, 70 and 719 (C, AC), 73B, NU,
    NJ, NUP, N, 213, 222, 223, 230, further tapered ones, NA, HK, BK, and ball bearings with bores from 1 mm.
    72xx and 73xx, bare or with A, are refused: an angular contact bearing or GOST's tapered one.
    GOST's older 7506 … 7510 and 7519, wider than 7506A … 7510A and 7519A, are not known.
    Source: ISO 15:2017, ISO 355:2019; GOST 8338, GOST 831, GOST 27365-87 (names); the makers' catalogues.

    >>> found = bearing("7516")
    >>> found.designation, found.bore, found.outer, found.inner_width
    ('32216', 0.08, 0.14, 0.033)
    """
    name = "".join(designation.upper().split()).translate(_LATIN)
    if (double := _TWO_MEANINGS.fullmatch(name)) is not None:
        number = double[1]
        raise InputError(
            "the designation has two meanings",
            found=designation,
            allowed=f"30{number[1:]} (tapered, GOST {number}A), or an angular contact bearing by its suffix, {number}B",
            remedy="Give the one that is meant, or bore_mm, outer_mm, width_mm and chamfer_mm.",
        )
    known = _known()
    if name in known:
        return _dimensions(known[name])
    row = catalogue_bearing(name)
    if row is None:
        remedy = "Give the basic designation without suffixes, or bore_mm, outer_mm, width_mm and chamfer_mm."
        raise unknown("bearing designation", designation, known_names(), remedy)
    return _of_row(row)


def of_size(bore: float, outer: float, width: float, kind: Kind | None = None) -> Dimensions | None:
    """The first tabulated bearing of this bore, outside diameter and inner ring width [m], ball bearings first.

    `kind`: of this type alone. Source: ISO 15:2017, ISO 355:2019, the makers' catalogues.

    >>> of_size(0.080, 0.140, 0.033).designation, of_size(0.017, 0.040, 0.012).designation
    ('32216', '6203')
    >>> of_size(0.050, 0.090, 0.020, "cylindrical").designation
    'NU210'
    """
    return next((entry for entry in all_of_size(bore, outer, width) if kind in (None, entry.kind)), None)


def all_of_size(bore: float, outer: float, width: float) -> tuple[Dimensions, ...]:
    """All tabulated bearings of this bore, outside diameter and inner ring width [m], ball bearings first.

    >>> [entry.designation for entry in all_of_size(0.080, 0.140, 0.033)]
    ['32216', 'NU2216', '22216']
    """
    wanted = millimetres(bore), millimetres(outer), millimetres(width)
    entries = [bearing(name) for name in _by_size().get(wanted, ())]
    return tuple(sorted(entries, key=lambda size: not size.deep_groove))


@cache
def _by_size() -> dict[tuple[float, ...], tuple[str, ...]]:
    """Designations by bore, outside diameter and inner ring width [mm]."""
    names: dict[tuple[float, ...], list[str]] = {}
    for row in csv_rows("bearings"):
        names.setdefault(tuple(map(float, row[3:6])), []).append(row[0])
    for name, entry in catalogue().items():
        size = tuple(map(millimetres, (entry.bore, entry.outer, entry.inner_width)))
        if name not in names.setdefault(size, []):
            names[size].append(name)
    return {size: tuple(designations) for size, designations in names.items()}


def next_size(designation: str, seat: Seat) -> Dimensions | None:
    """The bearing of the same series next to one by its ISO name: of smaller bore for a shaft, larger for a housing.

    >>> next_size("6205", "shaft").designation, next_size("6205", "housing").designation
    ('6204', '6206')
    """
    suffix = designation.lstrip("0123456789")
    series = [
        row
        for row in csv_rows("bearings")
        if row[0][: -2 - len(suffix)] == designation[: -2 - len(suffix)] and row[0].endswith(suffix)
    ]
    places = [row[0] for row in series]
    if designation not in places or len(designation) < 4:
        return None
    place = places.index(designation) + (-1 if seat == "shaft" else 1)
    return _dimensions(series[place]) if 0 <= place < len(series) else None


def known_names() -> frozenset[str]:
    """All names of both tables, ISO's and GOST's."""
    return frozenset(_known()) | frozenset(catalogue())


@cache
def _known() -> dict[str, tuple[str, ...]]:
    """Row by ISO name and by its one or two GOST names."""
    return {name: row for row in csv_rows("bearings") for name in (row[0], *row[1].split("/"))}


def _dimensions(row: tuple[str, ...]) -> Dimensions:
    iso, _, kind, *sizes = row
    bearing_type: BearingType = "tapered" if kind == "tapered" else "radial"
    return Dimensions(iso, bearing_type, *metres(sizes))


def _of_row(row: CatalogueBearing) -> Dimensions:
    rings: BearingType = "tapered" if row.kind == "tapered" else "radial"
    return Dimensions(row.designation, rings, *row[2:8])


Group = Literal["C2", "CN", "C3", "C4", "C5"]
GROUPS: Final[tuple[Group, ...]] = ("C2", "CN", "C3", "C4", "C5")
"""Clearance groups, from tight to loose."""


class ClearanceLimits(NamedTuple):
    """Smallest and largest radial clearance [m]."""

    smallest: float
    largest: float


def radial_clearance(group: str, bore: float) -> ClearanceLimits:
    """Radial internal clearance of a group for a bore [m], by the row of the table.

    Range: deep groove ball bearings with cylindrical bore, over 2.5 up to 200 mm (RangeError); C2, CN, C3, C4,
    C5 (InputError). Source: ISO 5753-1:2009, as makers' catalogues print it.

    >>> radial_clearance("CN", 0.017)
    ClearanceLimits(smallest=3e-06, largest=1.8e-05)
    """
    rows = _rows()
    if group not in rows:
        raise unknown("clearance group", group, rows)
    fault = "bore is outside the table of clearance groups"
    return ClearanceLimits(*lengths_for_size(rows[group], bore, fault, "Leave internal_clearance out."))


@cache
def _rows() -> dict[str, list[list[float]]]:
    rows_by_group: dict[str, list[list[float]]] = {}
    for group, *row in csv_rows("radial_clearance"):
        rows_by_group.setdefault(group, []).append([*map(float, row)])
    return rows_by_group


_TOKENS: Final = (
    (r"P6X", "class"),
    (r"P([0-6])([2-5])", "class and group"),
    (r"P([024-6])", "class"),
    (r"C[2-5]|CN", "group"),
    (r"2RS[HLR]?[12]?|2R[ZUK]|2Z[ER]?|ZZ[E]?|2NSE?|LLU|LLB|LLH|DDU?|VV|RS[HLR]?[12]?|RZ|Z", "closure"),
    (r"E(?=C[ABC])", "other"),
    (r"EC[JMP]?[ALM]?|CC|W33|E[TW]|TVP[0-9]?|XL|QCL7C|C[ABC]|G[ABC]", "roller or pair"),
    (r"E?TN[0-9]?H?|TVH|MA|M|JN|J2|J|Q|NR|N|W64|VT[0-9]+[A-Z]?|MT[0-9]+|GJN|WT|S[01]|E|P|X|R|Y", "other"),
)
PAIRS: Final = ("CA", "CB", "CC", "GA", "GB", "GC")
"""Groups of axial clearance, then of preload, of universally matchable angular contact bearings."""
_SEPARATORS: Final = " -/.,"
# Shields and seals of GOST names: 60203, 80203 shields, 160203, 180203 seals.
_GOST_CLOSED: Final = re.compile(r"(60|80|160|180)(\d{3})$")
# GOST puts the class before the number, and a clearance group before the class: 6-205, 76-180205.
_GOST_CLASS: Final = re.compile(r"([A-Z]?\d*?)(6[XХ]|\d)[-‐‑‒–—―−](\d{3}.*)")
_GOST_GROUPS: Final = {"": None, "6": "C2", "7": "C3", "8": "C4", "9": "C5"}
"""Clearance groups of GOST 24810 by those of ISO 5753."""
_GOST_CLASSES: Final = ("0", "6", "6X", "5", "4", "2")
_SMALL: Final = re.compile(r"61([89])/(\d(?:\.5)?)(?![\d.])")
_LIKE_BALL: Final = re.compile(r"(NUP|NU|NJ|NF|N)(\d)(\d\d)")
_TYPES: Final = (
    (re.compile(r"(NUP|NU|NJ|NF|NN|N)\s*\d{3,4}"), "cylindrical roller bearings of this number", "cylindrical"),
    (re.compile(r"2[0-4][0-9]\d{2}"), "spherical roller bearings of this number", "spherical"),
    (re.compile(r"(N[AK]|RNA)\s*\d+"), "needle roller bearings of this number", "needle"),
    (re.compile(r"[HB]K\s*\d+"), "drawn-cup needle roller bearings of this number", "drawn-cup"),
)


Closure = Literal["shields", "seals"]
"""Shields and seals without contact; seals that rub on the inner ring."""
_RUBBING: Final = re.compile(r"2?RS(?!L)|2NS|LLU|LLH|DD")


class Designation(NamedTuple):
    """Sizes by the basic number; the clearance group, the accuracy class and the closure that the suffixes name (None:
    none)."""

    size: Dimensions
    group: str | None
    accuracy: str | None
    closure: Closure | None = None


def read_designation(text: str) -> Designation:
    """A designation with its suffixes: 6203-2RS, 6203ZZ, 6203-2Z/C3, 180203; or with GOST's class: 6-205, 76-180205.

    Cages, snap rings and greases change neither seats nor ratings and are passed over. Seals change the limiting speed.
    InputError: a number that is not tabulated, a suffix that is not known.

    >>> read_designation("6203-2RS1/C3").group, read_designation("6203ZZ").size.designation
    ('C3', '6203')
    """
    spaced = " ".join(text.upper().split()).translate(str.maketrans("АВС", "ABC"))
    name = spaced.replace(" ", "")
    if classed := _GOST_CLASS.fullmatch(name):
        return _with_gost_class(classed[1], classed[2].replace("Х", "X"), classed[3], text)
    name = _as_nsk(name)
    closure: Closure | None = None
    if (closed := _GOST_CLOSED.fullmatch(name)) and closed[2].lstrip("0") in known_names():
        name, closure = closed[2].lstrip("0"), "seals" if len(closed[1]) > 2 else "shields"
    if name in known_names():
        return Designation(bearing(name), None, None, closure)
    if (row := _NU.match(name)) and catalogue_bearing(row[0]):
        return Designation(bearing(row[0]), *_suffixes(name[row.end() :], text, row[0]))
    for written in (name, spaced):
        basic = max((prefix for prefix in known_names() if written.startswith(prefix)), key=len, default=None)
        if basic is not None and not written[len(basic)].isdigit():
            return Designation(bearing(basic), *_suffixes(written[len(basic) :], text, basic))
    _refuse_other_types(name, text)
    return Designation(bearing(text), None, None)  # refused there, with the nearest known


def _with_gost_class(group: str, accuracy: str, basic: str, text: str) -> Designation:
    """A designation behind GOST's prefix of clearance group and accuracy class; InputError for another prefix."""
    try:
        rest = read_designation(basic)
    except InputError as error:
        error.found = text
        raise
    if accuracy not in _GOST_CLASSES or group not in _GOST_GROUPS:
        raise InputError(
            f"the prefix {group}{accuracy} of the bearing designation is not known", found=text,
            allowed="an accuracy class 0, 6, 5, 4 or 2, a clearance group 6, 7, 8 or 9 before it: 6-205, 76-180205",
            remedy=f'Give {basic}, with bearing_class = "{accuracy if accuracy in _GOST_CLASSES else 0}".',
        )  # fmt: skip
    if rest.accuracy is not None or (group and rest.group is not None):
        raise InputError(
            "prefix and suffix of the bearing designation both give the class or the clearance", found=text,
            remedy="Leave out the one or the other.",
        )  # fmt: skip
    return rest._replace(group=_GOST_GROUPS[group] or rest.group, accuracy=accuracy)


def _as_nsk(name: str) -> str:
    """The name that the table has for miniature bearings of SKF: 618/2.5 is 682X of NSK."""
    small = _SMALL.match(name)
    if small is None or f"61{small[1]}/{small[2]}" in known_names():
        return name
    return f"6{small[1]}{small[2][0]}{'X' if '.' in small[2] else ''}{name[small.end() :]}"


def _suffixes(rest: str, text: str, basic: str) -> tuple[str | None, str | None, Closure | None]:
    group = accuracy = None
    closure: Closure | None = None
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
        if what == "closure":
            closure = "seals" if _RUBBING.match(match[0]) else closure or "shields"
        if what == "class and group":
            accuracy, group = match[1], f"C{match[2]}"
        elif what == "class":
            accuracy = match[0].removeprefix("P")
        elif what == "group" or (what == "roller or pair" and match[0] in PAIRS and basic[0] == "7"):
            group = match[0]
    return group, accuracy, closure


def _refuse_other_types(name: str, text: str) -> None:
    for pattern, what, kind in _TYPES:
        if pattern.match(name):
            raise InputError(
                f"{what} are not in the table of bearings",
                found=text,
                allowed="ball bearings, NU, 222, 223, 302, 303, 322, NA, HK and the like up to usual sizes",
                remedy=f'Give bore_mm, outer_mm, width_mm and bearing_type = "{kind}"{_like(name)}.',
            )


def _like(name: str) -> str:
    """The sizes of the ball bearing of the same dimension series (ISO 15): NU 208 is as wide as 6208."""
    rollers = _LIKE_BALL.match(name)
    size = f"6{rollers[2]}{rollers[3]}" if rollers else ""
    if size not in known_names() or not rollers or rollers[2] not in "0234":
        return ""
    equivalent = bearing(size)
    numbers = " × ".join(f"{1e3 * length:g}" for length in (equivalent.bore, equivalent.outer, equivalent.inner_width))
    return f" (by ISO 15 {numbers} mm, as {size})"
