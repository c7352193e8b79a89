"""Clearance left in a deep groove ball bearing after mounting, by its joints on the shaft and in the housing."""

import math
from collections.abc import Callable
from typing import Final, NamedTuple

from abu_calc.features.seats.bearing import MatingPart, Ring, SeatedBearing
from abu_calc.features.seats.interference import Interval
from abu_calc.features.seats.joint import (
    CENTRIFUGAL,
    MEASURED,
    TEMPERATURE,
    InterferenceLoss,
    Joint,
    Tube,
    contact_pressure,
    inner_ring_diameter,
    inner_ring_stress,
    outer_ring_diameter,
    outer_ring_stress,
    raceway_change,
)
from abu_calc.features.seats.requirement import SERIES_FACTORS, centrifugal_loss, smoothing_loss, temperature_loss
from abu_calc.foundation.formula import formula
from abu_calc.standards.balls import seat_material, seat_strength
from abu_calc.standards.bearing_catalogue import GROUPS, radial_clearance
from abu_calc.standards.tolerance_classes import NORMAL_RATIO, MakerFits, Seat, maker_fits, ring_limits

ADVISED: Final = {"shaft": "k6", "housing": "H7"}
"""Classes that stand in until one is advised, where none is given."""


def shaft_joint(bearing: SeatedBearing) -> Joint:
    """The inner ring on the shaft."""
    part, service, bore = bearing.shaft, bearing.service, bearing.inner.diameter
    steel, own = seat_material("steel"), seat_material(part.material)
    ring_diameter, hollow = inner_ring_diameter(bore, bearing.outer.diameter), part.other or 0.0
    shaft, ring = Tube(hollow / bore, own), Tube(bore / ring_diameter, steel)
    losses = _smoothing(part.roughness)
    losses += _warmth(bore, warm_parts(bearing, "shaft"))
    if service.speed is not None:
        growth = centrifugal_loss(service.speed, bore, ring_diameter, hollow, steel)
        losses.append(InterferenceLoss(CENTRIFUGAL, growth, "(3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E)"))
    pressure = contact_pressure(1.0, bore, shaft, ring)
    # The core of a solid shaft is under the pressure itself; a hollow one has its hoop stress at the bore.
    stress_rate = inner_ring_stress(1.0, bore, shaft, ring)
    part_rate = pressure * (shaft.hoop_under_pressure_outside if hollow else 1.0)
    rates = (pressure, stress_rate, raceway_change(pressure, bore, ring), part_rate)
    return _joint("shaft", bearing, part, bearing.inner, tuple(losses), rates)


def housing_joint(bearing: SeatedBearing) -> Joint:
    """The outer ring in the housing."""
    part, outer = bearing.housing, bearing.outer.diameter
    steel, own = seat_material("steel"), seat_material(part.material)
    ring = Tube(outer_ring_diameter(bearing.inner.diameter, outer) / outer, steel)
    housing = Tube(0.0 if part.other is None else outer / part.other, own)
    losses = _smoothing(part.roughness)
    losses += _warmth(outer, warm_parts(bearing, "housing"))
    pressure = contact_pressure(1.0, outer, ring, housing)
    stress_rate = outer_ring_stress(1.0, outer, ring, housing)
    rates = (pressure, stress_rate, raceway_change(pressure, outer, ring), pressure * housing.hoop_at_bore)
    return _joint("housing", bearing, part, bearing.outer, tuple(losses), rates)


def makers_classes(bearing: SeatedBearing, seat: Seat) -> MakerFits | None:
    """The catalogue's classes of a seat; a type that is not told is taken as ball, a ratio not known as normal load."""
    ring, split = (bearing.inner, False) if seat == "shaft" else (bearing.outer, bearing.housing.split)
    ratio = NORMAL_RATIO if bearing.load_ratio is None else bearing.load_ratio
    return maker_fits(seat, bearing.kind or "ball", ring.load, ratio, ring.diameter, bearing.bearing_class, split)


def warm_parts(bearing: SeatedBearing, seat: Seat) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Expansion [1/K] and warmth above mounting [K] of the part around and of the part inside; None where no
    temperature is given. What is not told of the bearing's own warmth is taken as none."""
    service, steel = bearing.service, seat_material("steel").expansion
    other = service.ring_over_shaft if seat == "shaft" else service.housing_over_ring
    if other is None and service.over_mounting is None:
        return None
    rise = service.over_mounting or 0.0
    if seat == "shaft":
        return (steel, rise), (seat_material(bearing.shaft.material).expansion, rise - (other or 0.0))
    return (seat_material(bearing.housing.material).expansion, rise + (other or 0.0)), (steel, rise)


def _warmth(diameter: float, parts: tuple[tuple[float, float], tuple[float, float]] | None) -> list[InterferenceLoss]:
    return (
        []
        if parts is None
        else [InterferenceLoss(TEMPERATURE, temperature_loss(diameter, *parts), "d·(α₂·ΔT₂ − α₁·ΔT₁)")]
    )


def _joint(
    seat: Seat,
    bearing: SeatedBearing,
    part: MatingPart,
    ring: Ring,
    losses: tuple[InterferenceLoss, ...],
    rates: tuple[float, float, float, float],
) -> Joint:
    pressure, stress, raceway, own = rates
    return Joint(
        seat=seat,
        tolerance_class=part.fit or (MEASURED if part.measured else ADVISED[seat]),
        ring=ring,
        ring_limits=ring_limits(
            bearing.type, "inner" if seat == "shaft" else "outer", bearing.bearing_class, ring.diameter
        ),
        radial_load=bearing.service.radial_load,
        factor=SERIES_FACTORS[bearing.series],
        losses=losses,
        pressure_rate=pressure,
        stress_rate=stress,
        raceway_rate=raceway,
        part_rate=own,
        part_strength=part.strength or seat_strength(part.material),
        measured=part.measured,
        split=part.split,
        maker=makers_classes(bearing, seat) if bearing.load_ratio is not None and bearing.kind else None,
    )


def _smoothing(roughness: float | None) -> list[InterferenceLoss]:
    return (
        []
        if roughness is None
        else [InterferenceLoss("smoothing", smoothing_loss(roughness), "0.4·Rz (DIN 7190-1:2017)")]
    )


_TAIL: Final = 0.00135
"""Share beyond 3σ on one side of a normal law."""
_REACH: Final = 5.0
_PANELS: Final = 24
_HALVINGS: Final = 22

_Law = tuple[tuple[float, float], ...]
"""Losses of clearance by both seats [m], each with its share of bearings."""


class ClearanceLeft(NamedTuple):
    """Radial clearance [m] of a group before and after mounting: the extremes, the 0.135 % and 99.865 % ends and the
    mean of all bearings, the share below zero, the part that temperature takes, and the tightest group whose lower end
    stays above zero (None: no group)."""

    group: str
    initial: Interval
    mounted: Interval
    probable: Interval
    mean: float
    below_zero_probability: float
    by_temperature: float
    group_to_choose: str | None


class Mounting:
    """Effect of two seats on the clearance of their bearing, whatever its group."""

    def __init__(self, bearing: SeatedBearing, shaft: Joint, housing: Joint) -> None:
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
    "Operating clearance of a bearing",
    "initial − change of both raceways − α·(d_i+d_e)/2·ΔT",
    "m",
    shown="um",
    where=(
        "Each raceway changes by the raceway change at the interference less smoothing and temperature loss. A loose "
        "ring changes nothing. The extreme clearances combine all extreme values. The probable clearances are the "
        "0.135 % and 99.865 % quantiles of initial − Σ rate·max(interference, 0), integrated over the three normal "
        "laws."
    ),
    checked=("deep groove ball bearings",),
    assumed="rings as plain tubes; sizes and clearance independent and normal, half a tolerance zone = 3σ",
    source="Lamé; ISO 5753-1:2009 for the groups",
)
def clearance_left(group: str, bearing: SeatedBearing, shaft: Joint, housing: Joint) -> ClearanceLeft:
    mounting = Mounting(bearing, shaft, housing)
    start = Interval(*radial_clearance(group, bearing.inner.diameter))
    taken = sum(change * share for change, share in mounting.law)
    return ClearanceLeft(
        group=group,
        initial=start,
        mounted=Interval(*_extremes(mounting, group)),
        probable=Interval(mounting.end(group, _TAIL), mounting.end(group, 1 - _TAIL)),
        mean=(start.smallest + start.largest) / 2 - taken - mounting.warmth,
        below_zero_probability=mounting.share_below(group),
        by_temperature=mounting.warmth,
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
