"""Clearance left in a bearing, or in a pair, after mounting, by its joints on the shaft and in the housing.

That of angular contact bearings is axial and belongs to a pair; all others have radial clearance.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import Annotated, Final

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.interference import Interval, Pair, SeatRecord
from abu_calc.features.seats.joint import Joint, ThermalCase, inner_ring_diameter, outer_ring_diameter
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.standards.balls import seat_material
from abu_calc.standards.internal_clearance import (
    CONTACT_ANGLE,
    groups_of,
    internal_clearance,
    pair_preload,
    preload_limits,
)

PRELOADED: Final = groups_of("angular-contact")[:3]
"""Groups of pairs under preload, the heaviest first."""
MOST: Final = 0.5
"""Share of bearings without clearance from which on a group fails."""
AS_MOUNTED: Final = ThermalCase("mounting", 0.0, 0.0)
_TAIL: Final = 0.00135
"""Share beyond 3σ on one side of a normal law."""
_REACH: Final = 5.0
_PANELS: Final = 24
_HALVINGS: Final = 22

_Law = tuple[tuple[float, float], ...]
"""Losses of clearance by both seats [m], each with its share of bearings."""


@record
class Clearance(SeatRecord):
    """Clearance in the bearing, radial or axial of a pair; it belongs to both seats.

    The probable one spans the 0.135 % and 99.865 % ends of all bearings. The group to choose is the tightest whose
    lower end stays above zero, of a preloaded pair the heaviest below its limit.
    """

    group: Annotated[str, Quantity("group")]
    initial: Annotated[Interval, Quantity("before mounting", unit="um")]
    mounted: Annotated[Interval, Quantity("after mounting, extreme", unit="um")]
    probable: Annotated[Interval, Quantity("after mounting, probable", unit="um")]
    mean: Annotated[float, Quantity("mean after mounting", "", 3, unit="um")]
    axial: Annotated[bool, Quantity("whether it is the axial clearance of a pair")]
    preload: Annotated[Pair | None, Quantity("preload of the pair after mounting", "", 3, "least and most", unit="N")]
    below_zero_probability: Annotated[float, Quantity("share of bearings without clearance", "", 3)]
    by_temperature: Annotated[float, Quantity("taken by temperature", "", 3, unit="um")]
    group_to_choose: Annotated[str | None, Quantity("tightest group that passes")]


class Mounting:
    """Effect of two seats on the clearance of their bearing, whatever its group."""

    def __init__(self, bearing: SeatedBearing, shaft: Joint, housing: Joint) -> None:
        bore, outer = bearing.inner.diameter, bearing.outer.diameter
        raceways = (inner_ring_diameter(bore, outer) + outer_ring_diameter(bore, outer)) / 2
        self.bore, self.kind = bore, bearing.kind or "ball"
        self.axial = self.kind == "angular-contact"
        # A pair loses axially what a raceway changes radially over the tangent of the contact angle.
        self.lever = 1 / math.tan(math.radians(CONTACT_ANGLE)) if self.axial else 1.0
        self.joints = (shaft, housing)
        warm = seat_material("steel").expansion * raceways * (bearing.service.raceway_temperature_difference or 0.0)
        self.warmth = self.lever * warm

    @cached_property
    def law(self) -> _Law:
        """Losses of clearance by both seats, each with its share of bearings."""
        return _together(*(_growth(joint, self.lever) for joint in self.joints))

    @property
    def taken(self) -> float:
        """Clearance [m] that the mean pairs and warmth take."""
        return self.lever * sum(_change(joint, joint.mean) for joint in self.joints) + self.warmth

    def initial(self, group: str) -> Interval:
        """Clearance [m] of a group before mounting."""
        return Interval(*internal_clearance(self.kind, group, self.bore))

    def share_below(self, group: str, clearance: float = 0.0) -> float:
        """Share of bearings of a group that keep less than a clearance [m]."""
        start = self.initial(group)
        middle, sigma = (start.smallest + start.largest) / 2, (start.largest - start.smallest) / 6
        level, scale = clearance + self.warmth - middle, sigma * math.sqrt(2)
        return sum([share * 0.5 * math.erfc(-(level + taken) / scale) for taken, share in self.law])

    def keeps(self, group: str) -> bool:
        """True if all but 0.135 % of the bearings of a group keep clearance."""
        return self.share_below(group) <= _TAIL

    @property
    def group_to_choose(self) -> str | None:
        """The tightest group that keeps its clearance, None where none does."""
        return next((group for group in groups_of(self.kind) if self.keeps(group)), None)

    def end(self, group: str, share: float) -> float:
        """Clearance [m] that a share of the bearings of a group has not."""
        low, high = _extremes(self, group)
        spread = high - low
        return _where(lambda clearance: self.share_below(group, clearance), share, low - spread, high + spread)


def states(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> tuple[Mounting, Mounting, Mounting]:
    """The bearing cold, as mounted and hot; the inner ring is warmer than the outer one when hot alone."""
    alike = bearing.service.model_copy(update={"raceway_temperature_difference_K": None})
    even = replace(bearing, service=alike)
    return (
        Mounting(even, shaft.at(shaft.coldest), housing.at(housing.coldest)),
        Mounting(even, shaft.at(AS_MOUNTED), housing.at(AS_MOUNTED)),
        Mounting(bearing, shaft.at(shaft.hottest), housing.at(housing.hottest)),
    )


def tightest_state(bearing: SeatedBearing, shaft: Joint, housing: Joint) -> Mounting:
    """The bearing at work, or cold or as mounted if that takes more of its clearance.

    Differences of temperature within the bearing are there at work alone, and are meant by who gives them.
    """
    cold, mounted, _ = states(bearing, shaft, housing)
    at_work, service = Mounting(bearing, shaft, housing), bearing.service
    found = [at_work]
    if service.ring_temperature_difference is None and service.housing_temperature_difference is None:
        found += [cold, mounted]
    return max(found, key=lambda each: each.taken)


@formula(
    "Operating clearance of a bearing",
    "initial − change of both raceways − α·(d_i+d_e)/2·ΔT",
    "m",
    shown="um",
    where=(
        "Each raceway changes by the raceway change at the interference less smoothing and temperature loss. A loose "
        "ring changes nothing. The extreme clearances combine all extreme values. The probable clearances are the "
        "0.135 % and 99.865 % quantiles of initial − Σ rate·max(interference, 0), integrated over the three normal "
        "laws. Pairs of angular contact bearings lose the change of both raceways over tan 40° in the axial direction."
    ),
    checked=("ball and roller bearings; pairs of tapered bearings; pairs of angular contact bearings of 40°",),
    assumed="rings as plain tubes; sizes and clearance independent and normal, half a tolerance zone = 3σ",
    source="Lamé; ISO 5753-1:2009 for the groups; NSK and SKF for pairs",
)
def clearance_left(group: str, bearing: SeatedBearing, shaft: Joint, housing: Joint) -> Clearance:
    mounting = tightest_state(bearing, shaft, housing)
    start = mounting.initial(group)
    taken = sum(change * share for change, share in mounting.law)
    probable = Interval(mounting.end(group, _TAIL), mounting.end(group, 1 - _TAIL))
    return Clearance(
        group=group,
        initial=start,
        mounted=Interval(*_extremes(mounting, group)),
        probable=probable,
        mean=(start.smallest + start.largest) / 2 - taken - mounting.warmth,
        below_zero_probability=mounting.share_below(group),
        by_temperature=mounting.warmth,
        group_to_choose=lighter_group(mounting, group) if group in PRELOADED else mounting.group_to_choose,
        axial=mounting.axial,
        preload=_preload(mounting, probable) if mounting.axial else None,
    )


def fails(mounting: Mounting, group: str) -> bool:
    """True if most bearings of a group have no clearance left; of a preloaded pair, if its preload is far too high."""
    if group not in PRELOADED:
        return mounting.share_below(group) >= MOST
    most, limits = pair_preload(mounting.end(group, _TAIL), mounting.bore), preload_limits(group, mounting.bore)
    return most is not None and limits is not None and most > limits[1]


def lighter_group(mounting: Mounting, group: str) -> str | None:
    """The heaviest group of preload, lighter than a group, that stays below its limit; else one that keeps clearance.

    The group itself if it stays below.
    """
    for each in PRELOADED[PRELOADED.index(group) :]:
        most, limits = pair_preload(mounting.end(each, _TAIL), mounting.bore), preload_limits(each, mounting.bore)
        if most is not None and limits is not None and most <= limits[0]:
            return each
    return mounting.group_to_choose


def _preload(mounting: Mounting, probable: Interval) -> tuple[float, float] | None:
    """Preload [N] of a pair at its probable clearances, least first."""
    least, most = (pair_preload(end, mounting.bore) for end in (probable.largest, probable.smallest))
    return None if least is None or most is None else (least, most)


def _extremes(mounting: Mounting, group: str) -> tuple[float, float]:
    start = mounting.initial(group)
    most = mounting.lever * sum(_change(joint, joint.interference.largest) for joint in mounting.joints)
    least = mounting.lever * sum(_change(joint, joint.interference.smallest) for joint in mounting.joints)
    return start.smallest - most - mounting.warmth, start.largest - least - mounting.warmth


def _change(joint: Joint, interference: float) -> float:
    return max(interference - joint.mounted_losses, 0.0) * joint.raceway_rate


def _growth(joint: Joint, lever: float) -> _Law:
    """Loss of clearance by one seat, which the lever turns into an axial one.

    Loose pairs lose nothing. The others are summed by Simpson's rule over the normal law.
    """
    rate = joint.raceway_rate * lever
    male, female = joint.male_and_female
    sigma = math.hypot(male.tolerance, female.tolerance) / 6
    mean = male.middle - female.middle - joint.mounted_losses
    if sigma == 0 or mean <= -_REACH * sigma:  # a share of 3e-7 of all pairs is tight, by a hair
        return ((rate * max(mean, 0.0), 1.0),)
    low, high = max(0.0, mean - _REACH * sigma), mean + _REACH * sigma
    step = (high - low) / _PANELS
    points = [low + i * step for i in range(_PANELS + 1)]
    weights = [1 if i in (0, _PANELS) else 4 if i % 2 else 2 for i in range(_PANELS + 1)]
    shares = [weight * math.exp(-(((x - mean) / sigma) ** 2) / 2) for x, weight in zip(points, weights, strict=True)]
    tight = 0.5 * math.erfc(-mean / (sigma * math.sqrt(2)))
    scale = tight / sum(shares)
    return (
        (0.0, 1 - tight),
        *((rate * x, scale * share) for x, share in zip(points, shares, strict=True)),
    )


def _together(law: _Law, other: _Law) -> _Law:
    return tuple([(a + b, p * q) for a, p in law for b, q in other if p * q > 1e-10])


def _where(rising: Callable[[float], float], level: float, low: float, high: float) -> float:
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if rising(middle) < level else (low, middle)
    return (low + high) / 2
