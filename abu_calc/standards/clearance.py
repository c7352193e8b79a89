"""Radial internal clearance of deep groove ball bearings, before mounting."""

from functools import cache
from typing import Final, Literal, NamedTuple

from abu_calc.errors import RangeError
from abu_calc.standards.tables import csv_rows, unknown
from abu_calc.units import from_si, to_si

Group = Literal["C2", "CN", "C3", "C4"]
GROUPS: Final[tuple[Group, ...]] = ("C2", "CN", "C3", "C4")
"""Clearance groups, from tight to loose."""


class Clearance(NamedTuple):
    """Smallest and largest radial clearance [m]."""

    smallest: float
    largest: float


def radial_clearance(group: str, bore: float) -> Clearance:
    """Radial internal clearance of a group for a bore [m], by the row of the table.

    Range: deep groove ball bearings with cylindrical bore, over 2.5 up to 200 mm (RangeError); C2, CN, C3, C4
    (InputError). Source: ISO 5753-1:2009; over 100 mm not held against a second print.

    >>> radial_clearance("CN", 0.017)
    Clearance(smallest=3e-06, largest=1.8e-05)
    """
    rows = _rows()
    if group not in rows:
        raise unknown("clearance group", group, rows)
    millimetres = round(from_si(bore, "mm"), 6)
    for over, to, smallest, largest in rows[group]:
        if over < millimetres <= to:
            return Clearance(round(to_si(smallest, "um"), 12), round(to_si(largest, "um"), 12))
    raise RangeError(
        "bore is outside the table of clearance groups",
        found=f"{millimetres:g} mm",
        allowed=f"over {rows[group][0][0]:g} up to {rows[group][-1][1]:g} mm",
        remedy="Leave internal_clearance out.",
    )


@cache
def _rows() -> dict[str, list[list[float]]]:
    rows_by_group: dict[str, list[list[float]]] = {}
    for group, *row in csv_rows("radial_clearance"):
        rows_by_group.setdefault(group, []).append([*map(float, row)])
    return rows_by_group
