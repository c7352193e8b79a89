"""Selective assembly: how many groups the parts are sorted into, which go together, how many pairs each gets."""

import math
from typing import Final, NamedTuple

from abu_calc.fits.interference import Interval
from abu_calc.formula import formula
from abu_calc.standards.limits import Limits

MOST_GROUPS: Final = 12
"""Groups that are listed: nobody sorts into more."""
_NOISE: Final = 1e-12
"""Lengths [m] below it are the rounding of conversions."""


class Selection(NamedTuple):
    """Number of groups, and the interference [m] that every pair of matched groups then keeps to."""

    groups: int
    interference: Interval


class Group(NamedTuple):
    """One group: limits [m] of the parts inside and around, which are matched by number, the interference of their
    pairs, the share of all pairs that it gets."""

    number: int
    male: Limits
    female: Limits
    interference: Interval
    share: float


@formula(
    "The fewest equal groups that bring every pair into the asked band, none when no number does",
    signs="n_g T₁ T₂ ei es EI ES",
    where=(
        "Both fields are cut into n_g equal groups and matched by number. Group k then has ei − EI + k·(T₁−T₂)/n_g − "
        "T₂/n_g at least and T₁/n_g + T₂/n_g more at most, so that over all groups least = min(ei − EI, es − ES) − "
        "min(T₁, T₂)/n_g, most = max(ei − EI, es − ES) + min(T₁, T₂)/n_g and n_g ≥ min(T₁, T₂)/(min(…) − asked "
        "least), n_g ≥ min(T₁, T₂)/(asked most − max(…)). However fine the groups, the spread stays above |T₁ − T₂|: "
        "a narrower band, or one beside those middles, cannot be reached by sorting."
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


def sorting_groups(male: Limits, female: Limits, count: int) -> tuple[Group, ...]:
    """The groups of a selection, from the smallest parts to the largest; none where they are too many to sort.

    Both sizes normal and centred, half a field = 3σ, parts outside their fields sorted out: matched groups of both
    parts are then equally full.

    >>> [round(100 * one.share) for one in sorting_groups(Limits(2e-6, 21e-6), Limits(-15e-6, 0.0), 3)]
    [16, 68, 16]
    """
    if not 1 < count <= MOST_GROUPS:
        return ()
    groups = []
    for i in range(count):
        inside, around = _slice(male, i, count), _slice(female, i, count)
        pair = Interval(inside.lower - around.upper, inside.upper - around.lower)
        groups.append(Group(i + 1, inside, around, pair, _share(i, count)))
    return tuple(groups)


def _slice(field: Limits, index: int, count: int) -> Limits:
    width = field.tolerance / count
    return Limits(field.lower + index * width, field.lower + (index + 1) * width)


def _share(index: int, count: int) -> float:
    def below(place: float) -> float:
        return math.erf((6 * place - 3) / math.sqrt(2))

    return (below((index + 1) / count) - below(index / count)) / (2 * math.erf(3 / math.sqrt(2)))
