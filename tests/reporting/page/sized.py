"""A design that several tests look at, sized once."""

from functools import cache

import abu_calc
from abu_calc.features.design.study import SizeResult


@cache
def sized() -> SizeResult:
    """A grinder that runs at several speeds, was measured, and grinds."""
    return abu_calc.size(abu_calc.read("avtovaz-707-222").changed({"machine.speed_range_rpm": [4000.0, 6500.0]}))
