"""Equivalent dynamic and static load of a bearing under a radial and an axial load (ISO 281, ISO 76)."""

from bisect import bisect_left
from typing import Final, NamedTuple

from abu_calc.foundation.formula import formula
from abu_calc.foundation.validity import Range
from abu_calc.standards.catalogue import CatalogueBearing, Kind, Ratings

LOADS: Final = Range("load of the bearing", 0.0, 1e9, "N")


class LoadFactors(NamedTuple):
    """Factors of the equivalent loads: P = F_r up to e, X·F_r + Y·F_a above; P0 = X0·F_r + Y0·F_a, F_r at least.

    `below`: Y up to e, which spherical roller bearings have.
    """

    e: float
    X: float
    Y: float
    X0: float
    Y0: float
    below: float = 0.0


_BALL: Final = (
    (0.172, 0.19, 2.30), (0.345, 0.22, 1.99), (0.689, 0.26, 1.71), (1.03, 0.28, 1.55), (1.38, 0.30, 1.45),
    (2.07, 0.34, 1.31), (3.45, 0.38, 1.15), (5.17, 0.42, 1.04), (6.89, 0.44, 1.00),
)  # fmt: skip
"""f0·F_a/C0, e and Y of deep groove ball bearings."""
_FIFTEEN: Final = (
    (0.178, 0.38, 1.47), (0.357, 0.40, 1.40), (0.714, 0.43, 1.30), (1.07, 0.46, 1.23), (1.43, 0.47, 1.19),
    (2.14, 0.50, 1.12), (3.57, 0.55, 1.02), (5.35, 0.56, 1.00), (7.14, 0.56, 1.00),
)  # fmt: skip
"""The same of angular contact ball bearings of 15°."""
_USUAL_F0: Final = 14.0
_TAPERED: Final = LoadFactors(0.37, 0.4, 1.6, 0.5, 0.9)
"""Factors of a usual tapered bearing (302, 322 of middle size), where no row gives them."""


def load_factors(
    kind: Kind, entry: CatalogueBearing | None, ratings: Ratings, axial: float
) -> tuple[LoadFactors | None, bool]:
    """Factors of a bearing, and whether they are its own; None for bearings that carry no axial load.

    Source: ISO 281:2007, table 3 and ISO 76:2006, as the makers print them; tapered and spherical ones by their rows.
    """
    own = entry is not None
    if kind == "ball":
        f0 = entry.f0 if entry and entry.f0 else _USUAL_F0
        e, Y = _between(_BALL, f0 * axial / ratings.static)
        return LoadFactors(e, 0.56, Y, 0.6, 0.5), own
    if kind == "angular-contact":
        if entry is None or (entry.e is None and entry.f0 is not None):
            f0 = entry.f0 if entry and entry.f0 else _USUAL_F0
            e, Y = _between(_FIFTEEN, f0 * axial / ratings.static)
            return LoadFactors(e, 0.44, Y, 0.5, 0.46), own
        steep = entry.e is not None and entry.e > 1
        return (LoadFactors(1.14, 0.35, 0.57, 0.5, 0.26) if steep else LoadFactors(0.68, 0.41, 0.87, 0.5, 0.38)), own
    row = entry if entry and entry.e is not None and entry.Y is not None and entry.Y0 is not None else None
    if kind == "tapered":
        if row is None or row.e is None or row.Y is None or row.Y0 is None:
            return _TAPERED, False
        return LoadFactors(row.e, 0.4, row.Y, 0.5, row.Y0), True
    if kind == "spherical":
        if row is None or row.e is None or row.Y is None or row.Y0 is None:
            return LoadFactors(0.3, 0.67, 3.3, 1.0, 2.2, 2.2), False
        return LoadFactors(row.e, 0.67, 1.5 * row.Y, 1.0, row.Y0, row.Y), True
    if carries_by_flanges(entry):
        # Other series than 10, 2, 3 and 4 are wide.
        wide = entry is not None and entry.designation.lstrip("NJUP")[:2] in ("22", "23")
        return (LoadFactors(0.3, 0.92, 0.4, 1.0, 0.0) if wide else LoadFactors(0.2, 0.92, 0.6, 1.0, 0.0)), own
    return None, own


def carries_by_flanges(entry: CatalogueBearing | None) -> bool:
    """True for cylindrical roller bearings whose flanges carry axial loads: NJ in one direction, NUP in both."""
    return entry is not None and entry.designation.startswith(("NJ", "NUP"))


def _between(table: tuple[tuple[float, float, float], ...], place: float) -> tuple[float, float]:
    """e and Y at f0·F_a/C0, linear between the rows, constant outside."""
    if place <= table[0][0]:
        return table[0][1:]
    if place >= table[-1][0]:
        return table[-1][1:]
    upper = bisect_left(table, place, key=lambda row: row[0])
    (low, e_low, Y_low), (high, e_high, Y_high) = table[upper - 1], table[upper]
    share = (place - low) / (high - low)
    return e_low + share * (e_high - e_low), Y_low + share * (Y_high - Y_low)


@formula(
    "Equivalent dynamic load of a bearing",
    "P = X_b·F_r + Y_b·F_a",
    "N",
    where=(
        "Up to F_a/F_r = e, X_b is 1 and Y_b is 0 (spherical roller bearings: Y1). Above it, X_b and Y_b are the "
        "factors of the type. Those of ball bearings depend on f0·F_a/C0. NU, N and needle roller bearings carry no "
        "axial load, so that P is F_r. NJ and NUP carry up to half of F_r (SKF General Catalogue, 2006)."
    ),
    checked=(LOADS,),
    source="ISO 281:2007",
)
def equivalent_dynamic(radial: float, axial: float, factors: LoadFactors | None) -> float:
    """
    >>> round(equivalent_dynamic(2500.0, 1000.0, LoadFactors(0.268, 0.56, 1.666, 0.6, 0.5)))
    3066
    """
    LOADS.check(radial)
    if factors is None or not LOADS.check(axial):
        return radial
    if axial <= factors.e * radial:
        return radial + factors.below * axial
    return factors.X * radial + factors.Y * axial


@formula(
    "Equivalent static load of a bearing",
    "P_0 = max(X_0·F_r + Y_0·F_a, F_r)",
    "N",
    checked=(LOADS,),
    source="ISO 76:2006",
)
def equivalent_static(radial: float, axial: float, factors: LoadFactors | None) -> float:
    """
    >>> equivalent_static(1000.0, 2000.0, LoadFactors(0.3, 0.56, 1.5, 0.6, 0.5))
    1600.0
    """
    if factors is None:
        return LOADS.check(radial)
    return max(factors.X0 * LOADS.check(radial) + factors.Y0 * LOADS.check(axial), radial)
