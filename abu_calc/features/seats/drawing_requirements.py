"""Requirements for the drawing of a seat (tolerance class, form, roughness, shoulder, hardness), and its repair.

A repair starts from the interference left in a worn seat and gives the dimensions to restore.
"""

from collections.abc import Sequence
from typing import NamedTuple

from abu_calc.features.seats.interference import Interval
from abu_calc.features.seats.joint import Joint
from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import from_si, to_si
from abu_calc.standards.bearing_catalogue import next_size
from abu_calc.standards.tables import toml_table
from abu_calc.standards.tolerance_classes import DeviationLimits, part_limits, tolerance_classes

SMALL_SEAT = 0.080
"""Diameter [m] up to which the standard asks for the finer roughness."""
_WIDTH_ALONE = {"6X": "0"}
"""Classes of tapered bearings that differ from another one by their width alone (ISO 492)."""


class SeatRequirements(NamedTuple):
    """Field and limits [m] of the seat; roundness and profile [m], on the radius; Ra [m]; axial runout of the shoulder
    by its grade, and [m] where the grade is tabulated; hardness in words; where it is from. All but the field are
    unverified."""

    field: str
    limits: DeviationLimits
    form: float
    roughness_Ra: float
    shoulder_runout_grade: str
    shoulder_runout: float | None
    hardness: str
    source: str


@formula(
    "Requirements for a seat made to a tolerance class, for a bearing of an accuracy class",
    where=(
        "Roundness and longitudinal profile may take a share of the tolerance: ¼ for classes 0 and 6, ⅛ for 5 and 4, "
        "1/16 for 2."
    ),
    checked=("seats of 3 … 500 mm",),
    source="GOST 3325-85; unverified",
)
def seat_requirements(joint: Joint, tolerance_class: str, bearing_class: str) -> SeatRequirements:
    table = toml_table("seat_requirements")
    own, limits = table[joint.seat], part_limits(joint.seat, tolerance_class, joint.diameter)
    bearing_class = _WIDTH_ALONE.get(bearing_class, bearing_class)
    grade = own["shoulder"][bearing_class]
    basic = f"{'h' if joint.seat == 'shaft' else 'H'}{grade}"
    known = basic in tolerance_classes(joint.seat)
    return SeatRequirements(
        field=tolerance_class,
        limits=limits,
        form=limits.tolerance * table["form_share"][bearing_class],
        roughness_Ra=to_si(own["roughness"][bearing_class][joint.diameter > SMALL_SEAT + 1e-9], "um"),
        shoulder_runout_grade=f"IT{grade}",
        shoulder_runout=part_limits(joint.seat, basic, joint.diameter).tolerance if known else None,
        hardness=table["hardness"][joint.seat],
        source=f"{table['source']}, unverified",
    )


class SeatForm(NamedTuple):
    """What a drawing of a seat states, by a maker: cylindricity and total axial runout of the shoulder [m], Ra [m]."""

    cylindricity: float
    shoulder_runout: float
    roughness_Ra: float
    source: str


@formula(
    "Form and roughness of a seat by a maker's catalogue",
    where=(
        "The cylindricity is half of IT5 for class 0, of IT3 for 6, of IT2 for finer ones. The total axial runout of "
        "the shoulder is that grade. Ra depends on the grade of the diameter and on the size."
    ),
    checked=("ground seats of 0.6 … 500 mm",),
    source="SKF General Catalogue, 2006, tables 10 to 12",
)
def seat_form(joint: Joint, tolerance_class: str, bearing_class: str) -> SeatForm:
    table = toml_table("seat_form")
    size = round(from_si(joint.diameter, "mm"), 6)
    bearing_class = _WIDTH_ALONE.get(bearing_class, bearing_class)
    grade = to_si(_row(table["it"]["rows"], size)[table["grade"][bearing_class] - 2], "um")
    smooth = _row(table["roughness"]["rows"], size)
    own = int(tolerance_class.lstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ") or 6)
    return SeatForm(grade / 2, grade, to_si(smooth[min(max(7 - own, 0), 2)], "um"), table["source"])


def _row(rows: Sequence[Sequence[float]], size: float) -> Sequence[float]:
    """Figures of the first row whose upper end holds a size [mm]."""
    return next(row[1:] for row in rows if size <= row[0])


class SeatRepair(NamedTuple):
    """Interference left, lasting losses taken off [m]; the field to restore, its limits from the nominal size [m];
    largest gap [m] that a bond must fill (0: none); seat [m] and bearing of the next size (None: not tabulated)."""

    grip_left: Interval
    restore_fit: str
    restore_limits: DeviationLimits
    bonding_gap: float
    next_seat: float | None
    next_bearing: str | None


@formula(
    "Interference left in a measured seat, and gap that a repair must fill",
    "measured interference − losses; gap = −(least interference)",
    "m",
    shown="um",
    where=(
        "A sleeve or sprayed metal is finished to the limits of the tolerance class to restore. A bond fills the "
        "largest gap of the loosest pair. The next size is a neighbour in the series of bearings. A shaft is turned "
        "down to the next smaller bore. A housing is bored out to the next larger outside diameter."
    ),
    assumed="both limits refer to one nominal size, new rings",
    source="derived from the limits of size",
)
def seat_repair(joint: Joint, restore: str, designation: str | None) -> SeatRepair | None:
    if joint.measured is None:
        return None
    losses = joint.lasting_losses
    left = Interval(joint.interference.smallest - losses, joint.interference.largest - losses)
    neighbour = next_size(designation, joint.seat) if designation else None
    return SeatRepair(
        grip_left=left,
        restore_fit=restore,
        restore_limits=part_limits(joint.seat, restore, joint.diameter),
        bonding_gap=max(-joint.interference.smallest, 0.0),
        next_seat=None if neighbour is None else neighbour.bore if joint.seat == "shaft" else neighbour.outer,
        next_bearing=neighbour.designation if neighbour else None,
    )
