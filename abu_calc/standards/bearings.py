"""Boundary dimensions of rolling bearings by designation."""

import re
from functools import cache
from typing import NamedTuple

from abu_calc.errors import InputError
from abu_calc.standards.limits import BearingType
from abu_calc.standards.tables import csv_rows, unknown
from abu_calc.units import from_si, to_si

# Angular contact bearings of ISO and tapered bearings of GOST share these numbers.
_TWO_MEANINGS = re.compile(r"7[23]\d\d")


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
        """Whether the bearing is a deep groove ball bearing: series 60 … 64."""
        return self.designation.startswith("6")


def bearing(designation: str) -> Dimensions:
    """The dimensions of a bearing by its basic ISO or GOST designation (6203 = 203, 32216 = 7516).

    Range: series 60, 62, 63, 64, 72 (with B, AC or C), 302, 303, 322 up to bore 100 mm and small sizes of 60, 62;
    else InputError. Bare 72xx and 73xx are refused: ISO's angular contact bearing or GOST's tapered one.
    Source: ISO 15:2017, ISO 355:2019.

    >>> found = bearing("7516")
    >>> found.designation, found.bore, found.outer, found.inner_width
    ('32216', 0.08, 0.14, 0.033)
    """
    name = "".join(designation.upper().split())
    if _TWO_MEANINGS.fullmatch(name):
        tapered = f"30{name[1:]}"
        raise InputError(
            "the designation has two meanings",
            found=designation,
            allowed=f"{tapered} (tapered, GOST {name}), or ISO's angular contact bearing with its suffix, {name}B",
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


@cache
def _known() -> dict[str, tuple[str, ...]]:
    """Row by ISO and by GOST name."""
    return {name: row for row in csv_rows("bearings") for name in row[:2]}


def _dimensions(row: tuple[str, ...]) -> Dimensions:
    iso, _, kind, *sizes = row
    bearing_type: BearingType = "tapered" if kind == "tapered" else "radial"
    return Dimensions(iso, bearing_type, *(to_si(float(size), "mm") for size in sizes))
