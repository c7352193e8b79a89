"""Clearance left in a deep groove ball bearing after mounting."""

import math
from typing import NamedTuple

from abu_calc.fits.bearing import Bearing
from abu_calc.fits.interference import Interval, probable_interference
from abu_calc.fits.joint import Joint
from abu_calc.fits.stress import inner_ring_diameter, outer_ring_diameter
from abu_calc.formula import formula
from abu_calc.standards.balls import seat_material
from abu_calc.standards.clearance import GROUPS, radial_clearance


class ClearanceLeft(NamedTuple):
    """Radial clearance [m] of a group before and after mounting, extreme and probable, the part that warmth takes, and
    the tightest group whose probable clearance stays above zero (None: no group)."""

    group: str
    initial: Interval
    mounted: Interval
    probable: Interval
    warmth: float
    group_to_choose: str | None


@formula(
    "Clearance that a bearing keeps",
    "initial − change of both raceways − α·(d₁+D₁)/2·ΔT",
    "m",
    where=(
        "The raceways change by the raceway change at the interference less the smoothing; a loose ring changes "
        "nothing. The extreme clearance takes all extremes together, the probable one mean ∓ √(Σ half ranges²) of the "
        "three parts. ΔT inner ring over outer ring [K], α of steel, d₁ and D₁ raceways."
    ),
    checked=("deep groove ball bearings",),
    assumed="rings as plain tubes",
    source="Lamé; ISO 5753-1:2009 for the groups",
)
def clearance_left(group: str, bearing: Bearing, shaft: Joint, housing: Joint) -> ClearanceLeft:
    bore, outer = bearing.inner.diameter, bearing.outer.diameter
    raceways = (inner_ring_diameter(bore, outer) + outer_ring_diameter(bore, outer)) / 2
    warmth = seat_material("steel").expansion * raceways * (bearing.service.inner_over_outer or 0.0)
    joints = (shaft, housing)
    extreme = [_change(joint, joint.interference) for joint in joints]
    likely = [_change(joint, probable_interference(*joint.male_and_female)) for joint in joints]

    def probable(other: str) -> Interval:
        start = Interval(*radial_clearance(other, bore))
        mean = _middle(start) - sum(map(_middle, likely)) - warmth
        half = math.hypot(*((one.largest - one.smallest) / 2 for one in (start, *likely)))
        return Interval(mean - half, mean + half)

    initial = Interval(*radial_clearance(group, bore))
    mounted = Interval(
        initial.smallest - sum(one.largest for one in extreme) - warmth,
        initial.largest - sum(one.smallest for one in extreme) - warmth,
    )
    choice = next((other for other in GROUPS if probable(other).smallest >= 0), None)
    return ClearanceLeft(group, initial, mounted, probable(group), warmth, choice)


def _change(joint: Joint, interference: Interval) -> Interval:
    smoothing = sum(loss.value for loss in joint.losses if loss.name == "smoothing")
    smallest, largest = (max(one - smoothing, 0.0) * joint.raceway_rate for one in interference)
    return Interval(smallest, largest)


def _middle(interval: Interval) -> float:
    return (interval.smallest + interval.largest) / 2
