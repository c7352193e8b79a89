"""Boundary dimensions of rolling bearings by designation."""

import re
from functools import cache
from typing import Final, Literal, NamedTuple

from abu_calc.errors import InputError
from abu_calc.standards.limits import BearingType, Seat
from abu_calc.standards.maker_fits import Kind
from abu_calc.standards.tables import csv_rows, unknown
from abu_calc.units import from_si, to_si

# Angular contact bearings and tapered bearings of GOST share these numbers, with A too (30° of some makers).
_TWO_MEANINGS = re.compile(r"(7[23]\d\d)A?")
# GOST names end in Cyrillic letters that look Latin.
_LATIN = str.maketrans("АВС", "ABC")

Series = Literal["light", "medium", "heavy"]
_BY_DIAMETER: Final[dict[str, Series]] = {"3": "medium", "4": "heavy"}


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
        """True if the bearing is a deep groove ball bearing: series 60 … 64."""
        return self.designation.startswith("6")

    @property
    def kind(self) -> Kind:
        """Kind of bearing."""
        return "tapered" if self.type == "tapered" else "ball" if self.deep_groove else "angular-contact"

    @property
    def series(self) -> Series:
        """Series by the diameter series: 3 medium, 4 heavy, all others light.

        Wide light is light too, as the handbooks' k has it.

        >>> bearing("6305").series, bearing("7516").series, bearing("635").series
        ('medium', 'light', 'medium')
        """
        number = self.designation.rstrip("ABC")
        return _BY_DIAMETER.get(number[2] if self.type == "tapered" else number[1], "light")


def bearing(designation: str) -> Dimensions:
    """The dimensions of a bearing by its basic ISO or GOST designation (6203 = 203, 32216 = 7516 = 7516A).

    Range: series 60, 62, 63, 64, 72 (with B, AC or C), 302, 303, 322 up to bore 100 mm and small sizes of 60, 62;
    else InputError. 72xx and 73xx, bare or with A, are refused: an angular contact bearing or GOST's tapered one.
    GOST's older 7506 … 7510 and 7519, wider than 7506A … 7510A and 7519A, are not known.
    Source: ISO 15:2017, ISO 355:2019; GOST 8338, GOST 831, GOST 27365-87 (names).

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
    if name not in known:
        remedy = "Give the basic designation without suffixes, or bore_mm, outer_mm, width_mm and chamfer_mm."
        raise unknown("bearing designation", designation, known, remedy)
    return _dimensions(known[name])


def of_size(bore: float, outer: float, width: float) -> Dimensions | None:
    """The first tabulated bearing of this bore, outside diameter and inner ring width [m], radial ones first.

    Source: ISO 15:2017, ISO 355:2019.

    >>> of_size(0.080, 0.140, 0.033).designation, of_size(0.017, 0.040, 0.012).designation
    ('32216', '6203')
    """
    wanted = [round(from_si(size, "mm"), 6) for size in (bore, outer, width)]
    return next((_dimensions(row) for row in csv_rows("bearings") if [*map(float, row[3:6])] == wanted), None)


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
    """All names of the table, ISO's and GOST's."""
    return frozenset(_known())


@cache
def _known() -> dict[str, tuple[str, ...]]:
    """Row by ISO name and by its one or two GOST names."""
    return {name: row for row in csv_rows("bearings") for name in (row[0], *row[1].split("/"))}


def _dimensions(row: tuple[str, ...]) -> Dimensions:
    iso, _, kind, *sizes = row
    bearing_type: BearingType = "tapered" if kind == "tapered" else "radial"
    return Dimensions(iso, bearing_type, *(to_si(float(size), "mm") for size in sizes))
