"""Self-aligning ball bearings by designation: boundary dimensions, and the run-out of their outer rings."""

from functools import cache

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.standards.tables import csv_rows

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
    return tuple(
        SelfAligningBearing(name, *(to_si(float(size), "mm") for size in sizes))
        for name, *sizes in csv_rows("self_aligning")
    )


def outer_run_out(bearing_class: str, outside_diameter: float) -> float | None:
    """Radial run-out K_ea [m] of an outer ring of a tolerance class; None outside the table. Source: ISO 492:2014.

    >>> outer_run_out("5", 0.062)
    8e-06
    """
    size = round(from_si(outside_diameter, "mm"), 6)
    for name, over, to, run_out in csv_rows("outer_runout"):
        if name == bearing_class and float(over) < size <= float(to):
            return round(to_si(float(run_out), "um"), 12)
    return None
