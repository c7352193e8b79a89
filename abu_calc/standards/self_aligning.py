"""Self-aligning ball bearings by designation: boundary dimensions, and the run-out of their outer rings."""

from functools import cache

from abu_calc.foundation.frozen import dataclass
from abu_calc.standards.tables import csv_rows, metres, micrometres, row_of_size

RUNOUT_CLASSES = ("0", "6", "5")
"""Tolerance classes of ISO 492 with a tabulated run-out, coarsest first."""


@dataclass(frozen=True)
class SelfAligningBearing:
    """Designation, bore, outside diameter, width [m]."""

    designation: str
    bore: float
    outside_diameter: float
    width: float


@cache
def self_aligning_bearings() -> tuple[SelfAligningBearing, ...]:
    """All bearings of the series 12, 13, 22, 23.

    >>> next(each for each in self_aligning_bearings() if each.designation == "1206").outside_diameter
    0.062
    """
    return tuple(SelfAligningBearing(name, *metres(sizes)) for name, *sizes in csv_rows("self_aligning"))


def outer_run_out(bearing_class: str, outside_diameter: float) -> float | None:
    """Radial run-out K_ea [m] of an outer ring of a tolerance class; None outside the table. Source: ISO 492:2014.

    >>> outer_run_out("5", 0.062)
    8e-06
    """
    rows = [tuple(map(float, row)) for name, *row in csv_rows("outer_runout") if name == bearing_class]
    row = row_of_size(rows, outside_diameter)
    return None if row is None else micrometres(row[2])
