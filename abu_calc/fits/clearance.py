"""Clearance left in a deep groove ball bearing after mounting."""

import math
from collections.abc import Callable
from typing import Final, NamedTuple

from abu_calc.fits.bearing import Bearing
from abu_calc.fits.interference import Interval
from abu_calc.fits.joint import Joint
from abu_calc.fits.stress import inner_ring_diameter, outer_ring_diameter
from abu_calc.formula import formula
from abu_calc.standards.balls import seat_material
from abu_calc.standards.clearance import GROUPS, radial_clearance

_TAIL: Final = 0.00135
"""Share beyond 3σ on one side of a normal law."""
_REACH: Final = 5.0
_PANELS: Final = 24
_HALVINGS: Final = 22

_Law = tuple[tuple[float, float], ...]
"""Losses of clearance by both seats [m], each with its share of bearings."""


class ClearanceLeft(NamedTuple):
    """Radial clearance [m] of a group before and after mounting: the extremes, the 0.135 % and 99.865 % ends and the
    mean of all bearings, the share below zero, the part that warmth takes, and the tightest group whose lower end
    stays above zero (None: no group)."""

    group: str
    initial: Interval
    mounted: Interval
    probable: Interval
    mean: float
    below_zero: float
    warmth: float
    group_to_choose: str | None


class Mounting:
    """Effect of two seats on the clearance of their bearing, whatever its group."""

    def __init__(self, bearing: Bearing, shaft: Joint, housing: Joint) -> None:
        bore, outer = bearing.inner.diameter, bearing.outer.diameter
        raceways = (inner_ring_diameter(bore, outer) + outer_ring_diameter(bore, outer)) / 2
        self.bore = bore
        self.joints = (shaft, housing)
        self.warmth = seat_material("steel").expansion * raceways * (bearing.service.inner_over_outer or 0.0)
        self.law = _together(_growth(shaft), _growth(housing))

    def share_below(self, group: str, clearance: float = 0.0) -> float:
        """Share of bearings of a group that keep less than a clearance [m]."""
        start = Interval(*radial_clearance(group, self.bore))
        middle, sigma = (start.smallest + start.largest) / 2, (start.largest - start.smallest) / 6
        level, scale = clearance + self.warmth - middle, sigma * math.sqrt(2)
        return sum([share * 0.5 * math.erfc(-(level + taken) / scale) for taken, share in self.law])

    def keeps(self, group: str) -> bool:
        """True if all but 0.135 % of the bearings of a group keep clearance."""
        return self.share_below(group) <= _TAIL

    @property
    def group_to_choose(self) -> str | None:
        """The tightest group that keeps its clearance, None where none does."""
        return next((group for group in GROUPS if self.keeps(group)), None)

    def end(self, group: str, share: float) -> float:
        """Clearance [m] that a share of the bearings of a group has not."""
        low, high = _extremes(self, group)
        spread = high - low
        return _where(lambda clearance: self.share_below(group, clearance), share, low - spread, high + spread)


@formula(
    "Clearance that a bearing keeps",
    "initial − change of both raceways − α·(d_i+d_e)/2·ΔT",
    "m",
    shown="um",
    where=(
        "The raceways change by the raceway change at the interference less smoothing and less what warmth takes "
        "from the grip; a loose ring changes nothing. The extreme clearance takes all extremes together; the "
        "probable one are the 0.135 % and 99.865 % ends of initial − Σ rate·max(interference, 0), integrated over "
        "the three normal laws."
    ),
    checked=("deep groove ball bearings",),
    assumed="rings as plain tubes; sizes and clearance independent, normal, half a field = 3σ",
    source="Lamé; ISO 5753-1:2009 for the groups",
)
def clearance_left(group: str, bearing: Bearing, shaft: Joint, housing: Joint) -> ClearanceLeft:
    mounting = Mounting(bearing, shaft, housing)
    start = Interval(*radial_clearance(group, bearing.inner.diameter))
    taken = sum(change * share for change, share in mounting.law)
    return ClearanceLeft(
        group=group,
        initial=start,
        mounted=Interval(*_extremes(mounting, group)),
        probable=Interval(mounting.end(group, _TAIL), mounting.end(group, 1 - _TAIL)),
        mean=(start.smallest + start.largest) / 2 - taken - mounting.warmth,
        below_zero=mounting.share_below(group),
        warmth=mounting.warmth,
        group_to_choose=mounting.group_to_choose,
    )


def _extremes(mounting: Mounting, group: str) -> tuple[float, float]:
    start = radial_clearance(group, mounting.bore)
    most = sum(_change(joint, joint.interference.largest) for joint in mounting.joints)
    least = sum(_change(joint, joint.interference.smallest) for joint in mounting.joints)
    return start.smallest - most - mounting.warmth, start.largest - least - mounting.warmth


def _change(joint: Joint, interference: float) -> float:
    return max(interference - joint.mounted_losses, 0.0) * joint.raceway_rate


def _growth(joint: Joint) -> _Law:
    """Loss of clearance by one seat.

    Loose pairs lose nothing. The others are summed by Simpson's rule over the normal law.
    """
    male, female = joint.male_and_female
    sigma = math.hypot(male.tolerance, female.tolerance) / 6
    mean = male.middle - female.middle - joint.mounted_losses
    if sigma == 0 or mean <= -_REACH * sigma:  # a share of 3e-7 of all pairs is tight, by a hair
        return ((joint.raceway_rate * max(mean, 0.0), 1.0),)
    low, high = max(0.0, mean - _REACH * sigma), mean + _REACH * sigma
    step = (high - low) / _PANELS
    points = [low + i * step for i in range(_PANELS + 1)]
    weights = [1 if i in (0, _PANELS) else 4 if i % 2 else 2 for i in range(_PANELS + 1)]
    shares = [weight * math.exp(-(((x - mean) / sigma) ** 2) / 2) for x, weight in zip(points, weights, strict=True)]
    tight = 0.5 * math.erfc(-mean / (sigma * math.sqrt(2)))
    scale = tight / sum(shares)
    return (
        (0.0, 1 - tight),
        *((joint.raceway_rate * x, scale * share) for x, share in zip(points, shares, strict=True)),
    )


def _together(law: _Law, other: _Law) -> _Law:
    return tuple([(a + b, p * q) for a, p in law for b, q in other if p * q > 1e-10])


def _where(rising: Callable[[float], float], level: float, low: float, high: float) -> float:
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if rising(middle) < level else (low, middle)
    return (low + high) / 2
