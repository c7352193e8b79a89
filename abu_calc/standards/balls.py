"""Balls: stock diameters and materials, with the conversion of hardness from Rockwell C to Vickers."""

from bisect import bisect_left
from fractions import Fraction
from functools import cache
from typing import Literal, NamedTuple

from abu_calc.foundation.validity import Range
from abu_calc.standards.tables import metres, toml_table, unknown

STOCK_TOLERANCE = 0.01e-3
"""Largest difference [m] between a diameter and the stock size it means.

Sources round 19.844 mm to 19.84.
"""

_ROUNDING = 1e-9


class Material(NamedTuple):
    """Density [kg/m³], Young's modulus [Pa], Poisson's ratio, thermal expansion [1/K]."""

    name: str
    density: float
    youngs_modulus: float
    poisson_ratio: float
    expansion: float


@cache
def stock_diameters(sizes: Literal["metric", "all"] = "all") -> tuple[float, ...]:
    """Diameters [m] that balls are stocked in, ascending, 3 … 30 mm. Source: ISO 3290-1:2014.

    `sizes`: metric (whole and half millimetres), or all (inch sizes, too).

    >>> [d for d in stock_diameters() if 15.9e-3 < d < 17e-3]
    [0.016, 0.0165, 0.01666875]
    >>> [d for d in stock_diameters("metric") if 15.9e-3 < d < 17e-3]
    [0.016, 0.0165]
    """
    table = toml_table("balls")
    inch = table["inch"] if sizes == "all" else ()
    return tuple(metres(sorted((*table["metric"], *inch))))


def stock_diameter(diameter: float) -> float | None:
    """The stock diameter [m] that `diameter` [m] means (nearest, within 0.01 mm), or None when it means none.

    >>> stock_diameter(0.01984), stock_diameter(0.0157)
    (0.01984375, None)
    """
    near = min(stock_diameters(), key=lambda d: abs(d - diameter))
    return near if abs(near - diameter) <= STOCK_TOLERANCE + _ROUNDING else None


def inch_size(diameter: float) -> str:
    """The inch fraction that names a stock ball of a diameter [m]; nothing for a metric one.

    >>> inch_size(0.005953125), inch_size(0.0269875), inch_size(0.006)
    ('15/64 in', '1 1/16 in', '')
    """
    near = stock_diameter(diameter)
    if near is None or any(abs(near - each) < _ROUNDING for each in stock_diameters("metric")):
        return ""
    size = Fraction(near / 25.4e-3).limit_denominator(64)
    whole, part = divmod(size, 1)
    return " ".join(str(each) for each in (whole, part) if each) + " in"


def material(name: str) -> Material:
    """The material of balls. Unknown names are refused with InputError.

    >>> material("steel").density
    7800.0
    """
    return _material("balls", name)


def seat_material(name: str) -> Material:
    """The material of a ring, shaft or housing, such as steel, cast-iron, aluminium (handbook mean values)."""
    return _material("seats", name)


def seat_strength(name: str) -> float:
    """Stress [Pa] that a shaft or housing of usual grade bears; assumed, on the low side.

    >>> seat_strength("steel") > seat_strength("magnesium")
    True
    """
    strengths = toml_table("materials")["strength"]
    if name not in strengths:
        raise unknown("material", name, strengths)
    return float(strengths[name])


@cache
def _material(group: str, name: str) -> Material:
    materials = toml_table("materials")[group]
    if name not in materials:
        raise unknown("material", name, materials)
    return Material(name, **materials[name])


def vickers(hrc: float) -> float:
    """Vickers hardness HV of a Rockwell C hardness, linear between the rows of the table (20 … 68 HRC).

    Source: ASTM E140-12b, table 1 (non-austenitic steels), as stated in the data file.

    >>> vickers(60)
    697.0
    """
    rows: list[tuple[float, float]] = toml_table("hardness")["rows"]
    Range("hardness", rows[0][0], rows[-1][0], "HRC", key="autobalancer.race_hardness_HRC").check(hrc)
    upper = max(1, bisect_left(rows, hrc, key=lambda row: row[0]))
    (low, low_hv), (high, high_hv) = rows[upper - 1], rows[upper]
    return float(low_hv + (hrc - low) / (high - low) * (high_hv - low_hv))
