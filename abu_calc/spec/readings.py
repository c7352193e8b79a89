"""A file of readings: the rig, the roll on it, the runs, and what the balanced roll is held to."""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.spec.bearing_file import EXPECTED, Expected
from abu_calc.spec.readings_errors import Errors
from abu_calc.spec.readings_run import Reading, Run, Trial
from abu_calc.spec.table import Name, Table, problem
from abu_calc.spec.usual import usual
from abu_calc.spec.wheel import BalanceGrade

__all__ = ["Errors", "Reading", "ReadingsFile", "Rig", "Rotor", "Run", "Tolerance", "Trial"]

SupportMass = Annotated[float, Field(ge=0, le=1e6, json_schema_extra=usual(0.05, 20000))]
SupportStiffness = Annotated[float, Field(gt=0, le=1e12, json_schema_extra=usual(1000, 1e9))]
Length = Annotated[float, Field(ge=0, le=100)]
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
    """The rig: two supports that move to and fro on springs, at the roll's ends. Without it every plane needs a trial
    run.
    """

    left_support_mass_kg: SupportMass = Field(
        description="M1, what moves of the left support [kg]; {range}.", examples=[18.0]
    )
    right_support_mass_kg: SupportMass = Field(
        description="M2, what moves of the right support [kg]; {range}.", examples=[21.0]
    )
    left_stiffness_N_per_m: SupportStiffness = Field(
        description="C1, stiffness of the left support [N/m]; {range}.", examples=[3e5]
    )
    right_stiffness_N_per_m: SupportStiffness = Field(
        description="C2, stiffness of the right support [N/m]; {range}.", examples=[3.6e5]
    )
    damping_ratio: float = Field(
        default=0.0,
        description="Damping ratio of each support with the roll on it, the other support held; {range}. Default: "
        "{default}.",
        ge=0,
        le=0.5,
        json_schema_extra=usual(0.001, 0.3),
    )


class Rotor(Table):
    """The roll or screw, its two correction planes, and what may be done there."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({*OF_THE_RIG})

    name: Name = Field(default="roll", description="Name, as reports print it. Default: {default}.", min_length=1)
    mass_kg: float | None = Field(
        default=None,
        description="M3, mass of the roll [kg]; {range}.",
        examples=[64.0],
        gt=0,
        le=1e6,
        json_schema_extra=usual(0.1, 50000),
    )
    transverse_inertia_kg_m2: float | None = Field(
        default=None,
        description="J3, moment of inertia about a transverse axis through the centre of mass [kg·m²]; {range}.",
        examples=[9.5],
        gt=0,
        le=1e9,
        json_schema_extra=usual(1e-4, 1e6),
    )
    left_end_to_left_plane_m: Length | None = Field(
        default=None,
        description="a, from the left support to the left plane [m]; {range}.",
        examples=[0.15],
        json_schema_extra=usual(0.01, 20),
    )
    left_plane_to_centre_m: Length | None = Field(
        default=None,
        description="b, from the left plane to the centre of mass [m]; {range}.",
        examples=[0.52],
        json_schema_extra=usual(0.01, 20),
    )
    centre_to_right_plane_m: Length | None = Field(
        default=None,
        description="c, from the centre of mass to the right plane [m]; {range}.",
        examples=[0.61],
        json_schema_extra=usual(0.01, 20),
    )
    right_plane_to_right_end_m: Length | None = Field(
        default=None,
        description="d, from the right plane to the right support [m]; {range}.",
        examples=[0.2],
        json_schema_extra=usual(0.01, 20),
    )
    left_correction_radius_mm: Radius = Field(
        description="R1, where mass is taken off or put on in the left plane [mm]; {range}.", examples=[120.0]
    )
    right_correction_radius_mm: Radius = Field(
        description="R2, likewise in the right plane [mm]; {range}.", examples=[150.0]
    )
    max_removable_g: float | None = Field(
        default=None,
        description="Most that may be taken off in a plane [g]; {range}. Beyond it mass is put on, opposite.",
        examples=[50.0],
        ge=0,
        le=1e6,
        json_schema_extra=usual(0.1, 10000),
    )
    left_places_deg: Places | None = Field(
        default=None,
        description="Left plane: the places where there is metal, such as screw flights, from the zero mark AGAINST "
        "rotation [degrees]; two or more, each {range}. Without it: anywhere.",
        examples=[[0.0, 120.0, 240.0]],
    )
    right_places_deg: Places | None = Field(
        default=None,
        description="Right plane, likewise [degrees]; each {range}. Without it: anywhere.",
        examples=[[60.0, 180.0, 300.0]],
    )
    turns_from_left: Literal["counterclockwise", "clockwise"] = Field(
        default="counterclockwise",
        description="How the roll turns, to one who stands at its left end: counterclockwise or clockwise. For the "
        "drawing alone. Default: {default}.",
    )
    first_bending_speed_rpm: float | None = Field(
        default=None,
        description="Lowest speed at which the roll itself bends [rpm]; {range}. Without it: that of a solid steel bar "
        "of its mass and length.",
        examples=[9000.0],
        gt=0,
        le=1e7,
        json_schema_extra=usual(100, 1e6),
    )

    def contradictions(self) -> Iterator[tuple[tuple[str, ...], str]]:
        """More inertia than the mass could have between the ends."""
        ends = [getattr(self, key) for key in LENGTHS]
        if self.mass_kg is None or self.transverse_inertia_kg_m2 is None or None in ends:
            return
        arms = (ends[0] + ends[1], ends[2] + ends[3])
        most = self.mass_kg * arms[0] * arms[1]
        if self.transverse_inertia_kg_m2 > most:
            yield (
                ("transverse_inertia_kg_m2",),
                f"is unusual: all of mass_kg at the two ends would have {most:.3g} kg·m².",
            )

    @model_validator(mode="after")
    def _has_two_planes(self) -> Self:
        b, c = self.left_plane_to_centre_m, self.centre_to_right_plane_m
        if b is not None and c is not None and b + c == 0:
            raise problem(
                "the two planes are one: they cannot be told apart",
                "centre_to_right_plane_m",
                found="b + c = 0 m",
                allowed="b + c above 0 m",
                remedy="a thin roll is balanced in one plane",
            )
        return self

    @model_validator(mode="after")
    def _places_span_the_plane(self) -> Self:
        import math

        for key in ("left_places_deg", "right_places_deg"):
            places = getattr(self, key)
            turned = [math.radians(2 * (place - places[0])) for place in places or ()]
            if places and all(abs(math.sin(angle / 2)) < ALIKE for angle in turned):
                raise problem(
                    "the places lie on one line: a mass at any other angle cannot be split over them",
                    key,
                    found=", ".join(f"{place:g}°" for place in places),
                    remedy="give places at two angles that are not opposite",
                )
        return self


class Tolerance(Table):
    """What the balanced roll is held to."""

    balance_grade: BalanceGrade | None = Field(
        default=None,
        description="Balance quality grade by ISO 21940-11, of rotor.mass_kg at service_speed_rpm: G4000 … G0.4.",
        examples=["G6.3"],
    )
    service_speed_rpm: float | None = Field(
        default=None,
        description="Highest speed in service [rpm]; {range}. Without it: the highest of the runs.",
        examples=[3000.0],
        gt=0,
        le=1e6,
        json_schema_extra=usual(10, 60000),
    )


class ReadingsFile(Table):
    """Readings of a roll on a rig, for balancing in two planes."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"rig", "errors"})

    rig: Rig | None = None
    rotor: Rotor
    run: Annotated[tuple[Run, ...], Field(strict=False, min_length=1, max_length=1000)] = Field(
        description="Runs on the rig: [[run]], one or more."
    )
    errors: Errors = Field(default_factory=Errors)
    tolerance: Tolerance = Field(default_factory=Tolerance)
    expected: Expected = Field(default_factory=dict, description=EXPECTED)

    @model_validator(mode="after")
    def _the_rig_has_its_roll(self) -> Self:
        for key in OF_THE_RIG if self.rig is not None else ():
            if getattr(self.rotor, key) is None:
                raise problem("[rig] needs the key", "rotor", key, remedy=f"add {key} = …, or leave [rig] out")
        if self.tolerance.balance_grade is not None and self.rotor.mass_kg is None:
            raise problem("a balance grade needs the key", "rotor", "mass_kg", remedy="add mass_kg = …")
        if self.rig is None and not any(run.trial for run in self.run):
            raise problem(
                "without [rig] the rig is not known",
                "run",
                remedy="add [rig], or a run with a trial mass in each plane: trial = { plane, mass_g, angle_deg }",
            )
        return self
