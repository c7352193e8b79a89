"""Internal clearance of any rolling bearing before mounting, and the preload of pairs of angular contact bearings.

Deep groove, roller and tapered bearings have radial clearance; that of pairs of angular contact bearings is axial.
"""

import itertools
from functools import cache
from typing import Final, NamedTuple

from abu_calc.foundation.units import to_si
from abu_calc.standards.bearing_catalogue import GROUPS, PAIRS, ClearanceLimits, radial_clearance
from abu_calc.standards.catalogue import Kind
from abu_calc.standards.tables import csv_rows, lengths_for_size, millimetres, unknown

CONTACT_ANGLE: Final = 40.0
"""Contact angle [deg] of the pairs that are tabulated: suffix B."""
_AS: Final[dict[Kind, Kind]] = {"needle": "cylindrical"}
_HERTZ: Final = 1.5
"""Exponent of a ball's force by its approach."""


def groups_of(kind: Kind) -> tuple[str, ...]:
    """Clearance groups of a type, from tight to loose; empty where none is tabulated.

    >>> groups_of("angular-contact"), groups_of("drawn-cup")
    (('GC', 'GB', 'GA', 'CA', 'CB', 'CC'), ())
    """
    if kind == "angular-contact":
        return (*reversed(PAIRS[3:]), *PAIRS[:3])
    return () if kind == "drawn-cup" else GROUPS


def usual_group(kind: Kind) -> str:
    """The group of a bearing whose designation names none."""
    return "CB" if kind == "angular-contact" else "CN"


def internal_clearance(kind: Kind, group: str, bore: float) -> ClearanceLimits:
    """Clearance [m] of a group for a bore [m]: radial, of angular contact bearings axial and of a pair.

    Range: the rows of the tables (RangeError); a group of the type (InputError). Sources: ISO 5753-1:2009; pairs by
    NSK (tapered) and SKF (angular contact, 40°), not verified.

    >>> internal_clearance("cylindrical", "CN", 0.050)
    ClearanceLimits(smallest=3e-05, largest=6e-05)
    """
    if kind == "ball":
        return radial_clearance(group, bore)
    rows = _rows().get((_AS.get(kind, kind), group))
    if rows is None:
        raise unknown(f"clearance group of {kind} bearings", group, groups_of(kind))
    fault = f"bore is outside the table of clearance groups of {kind} bearings"
    return ClearanceLimits(*lengths_for_size(rows, bore, fault, "Leave internal_clearance out."))


class _Point(NamedTuple):
    clearance: float
    preload: float


def pair_preload(clearance: float, bore: float) -> float | None:
    """Preload [N] of a pair of angular contact bearings by its axial clearance [m]; 0 with clearance, None outside.

    Range: bores over 10 up to 250 mm, contact angle 40°. Between the ends of the groups GA, GB, GC by their figures;
    beyond them by Hertz's power 3/2. Source: SKF General Catalogue, 2006; not verified.

    >>> round(pair_preload(-4e-6, 0.040)), pair_preload(2e-6, 0.040)
    (160, 0.0)
    """
    if clearance >= 0:
        return 0.0
    points = _preloads(millimetres(bore))
    if points is None:
        return None
    first, last = points[0], points[-1]
    if -clearance <= -first.clearance:
        return first.preload * float((clearance / first.clearance) ** _HERTZ)
    for low, high in itertools.pairwise(points):
        if -clearance <= -high.clearance:
            share = (clearance - low.clearance) / (high.clearance - low.clearance)
            return low.preload + share * (high.preload - low.preload)
    return last.preload * float((clearance / last.clearance) ** _HERTZ)


def preload_limits(group: str, bore: float) -> tuple[float, float] | None:
    """Preload [N] of a mounted pair of a group above which it warns, and fails; None where no preload is tabulated.

    The most of the next heavier group before mounting, and twice the most of the heaviest; assumed.
    """
    groups = groups_of("angular-contact")
    heavier, heaviest = (
        pair_preload(internal_clearance("angular-contact", each, bore).smallest, bore)
        for each in (groups[max(groups.index(group) - 1, 0)], groups[0])
    )
    return None if heavier is None or heaviest is None else (heavier, 2 * heaviest)


@cache
def _preloads(bore_mm: float) -> tuple[_Point, ...] | None:
    rows = [row for row in csv_rows("pair_preload") if float(row[0]) < bore_mm <= float(row[1])]
    points = tuple(_Point(to_si(float(row[2]), "um"), float(row[3])) for row in rows)
    return tuple(sorted(points, key=lambda point: -point.clearance)) or None


@cache
def _rows() -> dict[tuple[str, str], list[tuple[float, float, float, float]]]:
    rows_by_group: dict[tuple[str, str], list[tuple[float, float, float, float]]] = {}
    for kind, group, *row in csv_rows("roller_clearance"):
        over, to, smallest, largest = map(float, row)
        rows_by_group.setdefault((kind, group), []).append((over, to, smallest, largest))
    return rows_by_group
