"""Requirements for the drawing of a seat (tolerance class, form, roughness, shoulder, hardness), and its repair.

A repair starts from the interference left in a worn seat and gives the dimensions to restore.
"""

from collections.abc import Mapping, Sequence
from typing import Annotated, ClassVar

from abu_calc.features.seats.interference import Interval, SeatRecord
from abu_calc.features.seats.joint import Joint
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import to_si
from abu_calc.standards.bearing_catalogue import next_size
from abu_calc.standards.tables import millimetres, toml_table
from abu_calc.standards.tolerance_classes import DeviationLimits, part_limits, tolerance_classes

SMALL_SEAT = 0.080
"""Diameter [m] up to which the standard asks for the finer roughness."""
_WIDTH_ALONE = {"6X": "0"}
"""Classes of tapered bearings that differ from another one by their width alone (ISO 492)."""


@record
class Requirements(SeatRecord):
    """Requirements that the drawing of the seat must state. All but the tolerance class are unverified."""

    field: Annotated[str, Quantity("tolerance class")]
    limits: Annotated[DeviationLimits, Quantity("limits of the tolerance class", unit="um")]
    roundness: Annotated[float, Quantity("roundness", "", 2, unit="um")]
    profile: Annotated[float, Quantity("longitudinal profile", "", 2, unit="um")]
    roughness_Ra: Annotated[float, Quantity("roughness", "Ra", unit="um")]
    shoulder_runout_grade: Annotated[str, Quantity("grade of the shoulder's runout")]
    shoulder_runout: Annotated[
        float | None, Quantity("shoulder runout", "", 4, "None where it is not tabulated", unit="um")
    ]
    hardness: Annotated[str, Quantity("hardness at least")]
    source: Annotated[str, Quantity("source")]


@formula(
    "Requirements for a seat made to a tolerance class, for a bearing of an accuracy class",
    where=(
        "Roundness and longitudinal profile may take a share of the tolerance: ¼ for classes 0 and 6, ⅛ for 5 and 4, "
        "1/16 for 2."
    ),
    checked=("seats of 3 … 500 mm",),
    source="GOST 3325-85; unverified",
)
def seat_requirements(joint: Joint, tolerance_class: str, bearing_class: str) -> Requirements:
    table = toml_table("seat_requirements")
    own, limits = table[joint.seat], part_limits(joint.seat, tolerance_class, joint.diameter)
    bearing_class = _WIDTH_ALONE.get(bearing_class, bearing_class)
    grade = own["shoulder"][bearing_class]
    basic = f"{'h' if joint.seat == 'shaft' else 'H'}{grade}"
    known = basic in tolerance_classes(joint.seat)
    form = limits.tolerance * table["form_share"][bearing_class]
    return Requirements(
        field=tolerance_class,
        limits=limits,
        roundness=form,
        profile=form,
        roughness_Ra=to_si(own["roughness"][bearing_class][joint.diameter > SMALL_SEAT + 1e-9], "um"),
        shoulder_runout_grade=f"IT{grade}",
        shoulder_runout=part_limits(joint.seat, basic, joint.diameter).tolerance if known else None,
        hardness=table["hardness"][joint.seat],
        source=f"{table['source']}, unverified",
    )


@record
class DrawnForm(SeatRecord):
    """Form and roughness that the drawing of a seat states, by a maker's catalogue."""

    cylindricity: Annotated[float, Quantity("cylindricity", "", 2, unit="um")]
    shoulder_runout: Annotated[float, Quantity("total axial runout of the shoulder", "", 3, unit="um")]
    roughness_Ra: Annotated[float, Quantity("roughness", "Ra", unit="um")]
    source: Annotated[str, Quantity("source")]


@formula(
    "Form and roughness of a seat by a maker's catalogue",
    where=(
        "The cylindricity is half of IT5 for class 0, of IT3 for 6, of IT2 for finer ones. The total axial runout of "
        "the shoulder is that grade. Ra depends on the grade of the diameter and on the size."
    ),
    checked=("ground seats of 0.6 … 500 mm",),
    source="SKF General Catalogue, 2006, tables 10 to 12",
)
def seat_form(joint: Joint, tolerance_class: str, bearing_class: str) -> DrawnForm:
    table = toml_table("seat_form")
    size = millimetres(joint.diameter)
    bearing_class = _WIDTH_ALONE.get(bearing_class, bearing_class)
    grade = _row(table["it"]["rows"], size)[table["grade"][bearing_class] - 2]
    smooth = _row(table["roughness"]["rows"], size)
    own = int(tolerance_class.lstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ") or 6)
    ra = smooth[min(max(7 - own, 0), 2)]
    return DrawnForm(cylindricity=grade / 2, shoulder_runout=grade, roughness_Ra=ra, source=table["source"])


def _row(rows: Sequence[Sequence[float]], size: float) -> Sequence[float]:
    """Figures [m] of the first row whose upper end holds a size [mm]."""
    return next([to_si(figure, "um") for figure in row[1:]] for row in rows if size <= row[0])


@record
class Repair(Record):
    """Interference left in a seat whose limits are measured, and the limits that a repair must restore."""

    decimals: ClassVar[Mapping[str, int]] = {"um": 6, "mm": 6}

    grip_left: Annotated[Interval, Quantity("interference left", "", 4, "after losses", unit="um")]
    restore_fit: Annotated[str, Quantity("tolerance class to restore")]
    restore_limits: Annotated[DeviationLimits, Quantity("limits to restore", unit="um")]
    bonding_gap: Annotated[float, Quantity("gap that a bond must fill", "", 4, "of the loosest pair", unit="um")]
    next_seat: Annotated[float | None, Quantity("seat of the next size", unit="mm")]
    next_bearing: Annotated[str | None, Quantity("bearing of the next size")]


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
def seat_repair(joint: Joint, restore: str, designation: str | None) -> Repair | None:
    if joint.measured is None:
        return None
    losses = joint.lasting_losses
    left = Interval(joint.interference.smallest - losses, joint.interference.largest - losses)
    neighbour = next_size(designation, joint.seat) if designation else None
    return Repair(
        grip_left=left,
        restore_fit=restore,
        restore_limits=part_limits(joint.seat, restore, joint.diameter),
        bonding_gap=max(-joint.interference.smallest, 0.0),
        next_seat=None if neighbour is None else neighbour.bore if joint.seat == "shaft" else neighbour.outer,
        next_bearing=neighbour.designation if neighbour else None,
    )
