"""Tables of the rig and of the rotor with its correction planes."""

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.inputs.reading.table import Name, Table, entry, problem, usual

SupportMass = Annotated[float, Field(ge=0, le=1e6, json_schema_extra=usual(0.05, 20000))]
SupportStiffness = Annotated[float, Field(gt=0, le=1e12, json_schema_extra=usual(1000, 1e9))]
Length = Annotated[float, Field(ge=-100, le=100)]
Radius = Annotated[float, Field(gt=0, le=1e5, json_schema_extra=usual(5, 5000))]
Place = Annotated[float, Field(ge=-360, le=360)]
Places = Annotated[tuple[Place, ...], Field(strict=False, min_length=2, max_length=72)]

LENGTHS: Final = (
    "left_end_to_left_plane_m",
    "left_plane_to_centre_m",
    "centre_to_right_plane_m",
    "right_plane_to_right_end_m",
)
OF_THE_RIG: Final = ("mass_kg", "transverse_inertia_kg_m2", *LENGTHS)
"""Data of the roll that the equations of the rig need."""
ALIKE: Final = 1e-9
"""Places that differ by less, as directions, are one [rad]."""


class Rig(Table):
    """The rig: two supports that move to and fro on springs, at the rotor's bearings. Without it every plane needs a
    trial run.
    """

    left_support_mass_kg: SupportMass = entry(example=18.0).means("M1, what moves of the left support [kg]; {range}.")
    right_support_mass_kg: SupportMass = entry(example=21.0).means("M2, what moves of the right support [kg]; {range}.")
    left_stiffness_N_per_m: SupportStiffness = entry(example=3e5).means(
        "C1, stiffness of the left support [N/m]; {range}."
    )
    right_stiffness_N_per_m: SupportStiffness = entry(example=3.6e5).means(
        "C2, stiffness of the right support [N/m]; {range}."
    )
    damping_ratio: float = entry(0.0, ge=0, le=0.5, usual=(0.001, 0.3)).means(
        "Damping ratio of each support with the roll on it, the other support held; {range}. Default: {default}."
    )


class Rotor(Table):
    """The rotor, roll or screw, with its two correction planes and the metal there. The four lengths go along it from
    the left bearing to the right one. An overhung rotor has negative ones.
    """

    shown_in_template: ClassVar[frozenset[str]] = frozenset(
        {*OF_THE_RIG, "left_correction_radius_mm", "right_correction_radius_mm"}
    )

    name: Name = Field(default="roll", description="Name, as reports print it. Default: {default}.", min_length=1)
    mass_kg: float | None = entry(None, gt=0, le=1e6, usual=(0.1, 50000), example=64.0).means(
        "M3, mass of the roll [kg]; {range}."
    )
    transverse_inertia_kg_m2: float | None = entry(None, gt=0, le=1e9, usual=(1e-4, 1e6), example=9.5).means(
        "J3, moment of inertia about a transverse axis through the centre of mass [kg·m²]; {range}."
    )
    left_end_to_left_plane_m: Length | None = entry(None, usual=(0.01, 20), example=0.15).means(
        "a, from the left bearing to the left plane [m]; {range}. Negative: the plane is outside."
    )
    left_plane_to_centre_m: Length | None = entry(None, usual=(0.01, 20), example=0.52).means(
        "b, from the left plane to the centre of mass [m]; {range}. Negative: the centre of mass is left of it."
    )
    centre_to_right_plane_m: Length | None = entry(None, usual=(0.01, 20), example=0.61).means(
        "c, from the centre of mass to the right plane [m]; {range}. Negative: the centre of mass is right of it."
    )
    right_plane_to_right_end_m: Length | None = entry(None, usual=(0.01, 20), example=0.2).means(
        "d, from the right plane to the right bearing [m]; {range}. Negative: the plane is outside."
    )
    left_correction_radius_mm: Radius | None = entry(None, example=120.0).means(
        "R1, radius at which mass is removed or added in the left plane [mm]; {range}. Not with [single_plane]."
    )
    right_correction_radius_mm: Radius | None = entry(None, example=150.0).means(
        "R2, likewise in the right plane [mm]; {range}. Not with [single_plane]."
    )
    angle_marks: Literal["against", "with"] = entry("against").means(
        "Direction in which the angle marks of the rotor count from its zero mark: against rotation or with it. It "
        "holds for trial masses, places and the angles of the answer. Default: {default}."
    )
    max_removable_g: float | None = entry(None, ge=0, le=1e6, usual=(0.1, 10000), example=50.0).means(
        "Largest mass that may be removed in a plane [g]; {range}. Beyond that, mass is added opposite."
    )
    left_places_deg: Places | None = entry(None, example=[0.0, 120.0, 240.0]).means(
        "Left plane: the places where there is metal, such as screw flights or bolt holes, from the zero mark by "
        "angle_marks [degrees]; two or more, each {range}. Without it: anywhere."
    )
    right_places_deg: Places | None = entry(None, example=[60.0, 180.0, 300.0]).means(
        "Right plane, likewise [degrees]; each {range}. Without it: anywhere."
    )
    turns_from_left: Literal["counterclockwise", "clockwise"] = entry("counterclockwise").means(
        "How the roll turns, to one who stands at its left end: counterclockwise or clockwise. For the drawing alone. "
        "Default: {default}."
    )
    first_bending_speed_rpm: float | None = entry(None, gt=0, le=1e7, usual=(100, 1e6), example=9000.0).means(
        "Lowest speed at which the roll itself bends [rpm]; {range}. Without it: that of a solid steel bar of its mass "
        "and length."
    )

    def contradictions(self) -> Iterator[tuple[tuple[str, ...], str]]:
        """More inertia than the mass could have between the ends."""
        ends = [getattr(self, key) for key in LENGTHS]
        if self.mass_kg is None or self.transverse_inertia_kg_m2 is None or None in ends:
            return
        arms = (ends[0] + ends[1], ends[2] + ends[3])
        most = self.mass_kg * arms[0] * arms[1]
        if min(arms) > 0 and self.transverse_inertia_kg_m2 > most:
            yield (
                ("transverse_inertia_kg_m2",),
                f"is unusual: all of mass_kg at the two ends would have {most:.3g} kg·m².",
            )

    @property
    def lengths(self) -> tuple[float, float, float, float] | None:
        """a, b, c and d [m]; None if one is missing."""
        a, b, c, d = (getattr(self, key) for key in LENGTHS)
        return None if a is None or b is None or c is None or d is None else (a, b, c, d)

    @model_validator(mode="after")
    def _has_two_planes(self) -> Self:
        b, c = self.left_plane_to_centre_m, self.centre_to_right_plane_m
        if b is not None and c is not None and b + c <= 0:
            same = b + c == 0
            raise problem(
                "the two planes coincide: they cannot be distinguished" if same else "the left plane is the right one",
                "centre_to_right_plane_m",
                found=f"b + c = {b + c:g} m",
                allowed="b + c above 0 m",
                remedy="a thin rotor is balanced in one plane: [single_plane]" if same else "exchange the planes",
            )
        if self.lengths is not None and sum(self.lengths) <= 0:
            raise problem(
                "the left bearing is not left of the right one", "right_plane_to_right_end_m",
                found=f"a + b + c + d = {sum(self.lengths):g} m", allowed="above 0 m", remedy="correct the lengths",
            )  # fmt: skip
        return self

    @model_validator(mode="after")
    def _places_span_the_plane(self) -> Self:
        for key in ("left_places_deg", "right_places_deg"):
            refuse_one_line(getattr(self, key), key)
        return self


def refuse_one_line(places: tuple[float, ...] | None, key: str) -> None:
    """Raise a problem if places lie on one line through the axis."""
    turned = [math.radians(2 * (place - places[0])) for place in places or ()] if places else []
    if places and all(abs(math.sin(angle / 2)) < ALIKE for angle in turned):
        raise problem(
            "the places lie on one line: a mass at any other angle cannot be split over them",
            key,
            found=", ".join(f"{place:g}°" for place in places),
            remedy="give places at two angles that are not opposite",
        )


class SinglePlane(Table):
    """One correction plane, for thin rotors such as fans and grinding wheels. It takes the place of the two planes of
    [rotor].
    """

    correction_radius_mm: Radius = entry(example=120.0).means("Radius at which mass is removed or added [mm]; {range}.")
    places_deg: Places | None = entry(None, example=[0.0, 120.0, 240.0]).means(
        "Places where there is metal, such as blades, from the zero mark by rotor.angle_marks [degrees]; two or more, "
        "each {range}. Without it: anywhere."
    )

    @model_validator(mode="after")
    def _places_span_the_plane(self) -> Self:
        refuse_one_line(self.places_deg, "places_deg")
        return self
