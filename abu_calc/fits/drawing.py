"""Requirements for the drawing of a seat: tolerance class, form, roughness, shoulder, hardness."""

from typing import NamedTuple

from abu_calc.fits.joint import Joint
from abu_calc.formula import formula
from abu_calc.standards.limits import Limits, part_limits, tolerance_classes
from abu_calc.standards.tables import toml_table
from abu_calc.units import to_si

SMALL_SEAT = 0.080
"""Diameter [m] up to which the standard asks for the finer roughness."""


class Requirements(NamedTuple):
    """Field and limits [m] of the seat; roundness and profile [m], on the radius; Ra [m]; axial runout of the shoulder
    by its grade, and [m] where the grade is tabulated; hardness in words; where it is from. All but the field are
    unverified."""

    field: str
    limits: Limits
    form: float
    roughness: float
    shoulder_grade: str
    shoulder_runout: float | None
    hardness: str
    source: str


@formula(
    "Requirements of a seat made to a tolerance class, for a bearing of an accuracy class",
    where=(
        "Roundness and longitudinal profile: a share of the tolerance (¼ for classes 0 and 6, ⅛ for 5 and 4, 1/16 for "
        "2)."
    ),
    checked=("seats of 3 … 500 mm",),
    source="GOST 3325-85; unverified",
)
def seat_requirements(joint: Joint, tolerance_class: str, bearing_class: str) -> Requirements:
    table = toml_table("seat_requirements")
    own, limits = table[joint.seat], part_limits(joint.seat, tolerance_class, joint.diameter)
    grade = own["shoulder"][bearing_class]
    basic = f"{'h' if joint.seat == 'shaft' else 'H'}{grade}"
    known = basic in tolerance_classes(joint.seat)
    return Requirements(
        field=tolerance_class,
        limits=limits,
        form=limits.tolerance * table["form_share"][bearing_class],
        roughness=to_si(own["roughness"][bearing_class][joint.diameter > SMALL_SEAT + 1e-9], "um"),
        shoulder_grade=f"IT{grade}",
        shoulder_runout=part_limits(joint.seat, basic, joint.diameter).tolerance if known else None,
        hardness=table["hardness"][joint.seat],
        source=f"{table['source']}, unverified",
    )
