"""Selective assembly: into how many groups the parts must be sorted."""

import math
from typing import NamedTuple

from abu_calc.fits.interference import Interval
from abu_calc.formula import formula
from abu_calc.standards.limits import Limits


class Selection(NamedTuple):
    """Number of groups, and the interference [m] that every pair of matched groups then keeps to."""

    groups: int
    interference: Interval


@formula(
    "The fewest equal groups that bring every pair into the asked band, none when no number does",
    where=(
        "Both fields are cut into n equal groups and matched by number. Group i then has ei − EI + i·(T₁−T₂)/n − T₂/n "
        "at least and T₁/n + T₂/n more at most, so that over all groups least = min(ei − EI, es − ES) − min(T₁, T₂)/n, "
        "most = max(ei − EI, es − ES) + min(T₁, T₂)/n and n ≥ min(T₁, T₂)/(min(…) − asked least), n ≥ min(T₁, "
        "T₂)/(asked most − max(…)). However fine the groups, the spread stays above |T₁ − T₂|: a narrower band, or one "
        "beside those middles, cannot be reached by sorting."
    ),
    assumed="limits about one nominal size",
    source="derived from the limits of size",
)
def selective_groups(male: Limits, female: Limits, asked: Interval) -> Selection | None:
    """
    >>> found = selective_groups(Limits(2e-6, 21e-6), Limits(-15e-6, 0.0), Interval(10e-6, 28e-6))
    >>> found.groups, round(1e6 * found.interference.smallest, 2), round(1e6 * found.interference.largest, 2)
    (3, 12.0, 26.0)
    """
    ends = male.lower - female.lower, male.upper - female.upper
    narrower = min(male.tolerance, female.tolerance)
    groups = 1
    for room in (min(ends) - asked.smallest, asked.largest - max(ends)):
        if narrower <= _NOISE and room >= -_NOISE:
            continue
        if room <= _NOISE:
            return None
        groups = max(groups, math.ceil(narrower / room - 1e-9))
    share = narrower / groups
    return Selection(groups, Interval(min(ends) - share, max(ends) + share))


_NOISE = 1e-12
"""Lengths [m] below it are the rounding of conversions."""
