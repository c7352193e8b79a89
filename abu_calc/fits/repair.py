"""Interference left in a worn seat, and the dimensions that a repair must restore."""

from typing import NamedTuple

from abu_calc.fits.interference import Interval
from abu_calc.fits.joint import Joint
from abu_calc.formula import formula
from abu_calc.standards.bearings import next_size
from abu_calc.standards.limits import Limits, part_limits


class Repair(NamedTuple):
    """Interference left, lasting losses taken off [m]; the field to restore, its limits from the nominal size [m];
    largest gap [m] that a bond must fill (0: none); seat [m] and bearing of the next size (None: not tabulated)."""

    grip_left: Interval
    restore: str
    limits: Limits
    gap: float
    next_seat: float | None
    next_bearing: str | None


@formula(
    "What a measured seat has left, and what a repair must restore",
    "measured interference − losses; gap = −(least interference)",
    "m",
    shown="um",
    where=(
        "A sleeve or sprayed metal is finished to the limits of the field to restore. A bond fills the largest gap of "
        "the loosest pair. The next size is the neighbour of the series: the next smaller bore of a shaft turned down, "
        "the next larger outside diameter of a housing bored out."
    ),
    assumed="limits about one nominal size, the rings new",
    source="derived from the limits of size",
)
def seat_repair(joint: Joint, restore: str, designation: str | None) -> Repair | None:
    if joint.measured is None:
        return None
    losses = joint.lasting_losses
    left = Interval(joint.interference.smallest - losses, joint.interference.largest - losses)
    neighbour = next_size(designation, joint.seat) if designation else None
    return Repair(
        grip_left=left,
        restore=restore,
        limits=part_limits(joint.seat, restore, joint.diameter),
        gap=max(-joint.interference.smallest, 0.0),
        next_seat=None if neighbour is None else neighbour.bore if joint.seat == "shaft" else neighbour.outer,
        next_bearing=neighbour.designation if neighbour else None,
    )
