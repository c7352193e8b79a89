"""Advice that keeps the whole joint: grip and stress of both seats, and the clearance left between them."""

from typing import Final, NamedTuple

from abu_calc.errors import RangeError
from abu_calc.fits.advice import Rejected, Start, advised, looser_that_hold, neighbours
from abu_calc.fits.bearing import Bearing
from abu_calc.fits.clearance import Mounting
from abu_calc.fits.joint import Joint
from abu_calc.fits.pairing import makers_classes
from abu_calc.fits.words import of_all
from abu_calc.standards.clearance import GROUPS, radial_clearance

_USUAL_GROUP: Final = "CN"
SHARE_TO_ORDER: Final = 0.05
"""Share of bearings without clearance up to which a group is still the one to order; assumed. The makers' own js5 … j6
with CN stay below it, their k5, for which they ask for more clearance, lies above."""


class SeatAdvice(NamedTuple):
    """The joint with the field to write (None: no tabulated one will do), the next ones that will not do."""

    best: Joint | None
    rejected: tuple[Rejected, ...]


class Advice(NamedTuple):
    """Advice on both seats, and the clearance group to order with them.

    The group is None if the bearing is not a deep groove ball bearing, or if there is no group.
    """

    shaft: SeatAdvice
    housing: SeatAdvice
    group: str | None


def advice(bearing: Bearing, shaft: Joint, housing: Joint) -> Advice:
    """Fields that grip by the makers' rule and are borne, with the group of clearance that stays above zero in all but
    few bearings.

    Where the group given is jammed by the fields, a looser group is named in place of it; where none keeps its
    clearance, the shaft's field is loosened as far as its mean allows.
    """
    start: Start = (bearing.service.seat_friction, bearing.service.starting_torque)
    inner = advised(shaft, start, makers_classes(bearing, "shaft"))
    outer = advised(housing, start, makers_classes(bearing, "housing"))
    group = None
    if _has_groups(bearing) and inner is not None and outer is not None:
        for candidate in (inner, *looser_that_hold(inner, start)):
            group = _group(bearing, candidate, outer)
            if group is not None:
                inner = candidate
                break
    return Advice(
        _with_neighbours(bearing, inner, outer, start, group),
        _with_neighbours(bearing, outer, inner, start, group),
        group,
    )


def _with_neighbours(
    bearing: Bearing, best: Joint | None, other: Joint | None, start: Start, group: str | None
) -> SeatAdvice:
    def jams(joint: Joint) -> str | None:
        if group is None or other is None:
            return None
        pair = (joint, other) if joint.seat == "shaft" else (other, joint)
        share = Mounting(bearing, *pair).share_below(group)
        return f"jams, {of_all(share, 'bearings')} of {group} keep no clearance" if share > SHARE_TO_ORDER else None

    return SeatAdvice(best, neighbours(best, start, jams) if best else ())


def _has_groups(bearing: Bearing) -> bool:
    if bearing.kind != "ball":
        return False
    try:
        radial_clearance(_USUAL_GROUP, bearing.inner.diameter)
    except RangeError:
        return False
    return True


def _group(bearing: Bearing, shaft: Joint, housing: Joint) -> str | None:
    """The group given or a looser one, the usual one or a looser where none is given: the first that keeps."""
    mounting = Mounting(bearing, shaft, housing)
    first = GROUPS.index(bearing.internal_clearance or _USUAL_GROUP)
    return next((group for group in GROUPS[first:] if mounting.share_below(group) <= SHARE_TO_ORDER), None)
