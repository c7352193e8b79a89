"""Tables of a file of readings: the rig, the roll on it, the runs, and the tolerance of the balanced roll.

A run holds what was read, or the record it is taken from, and the trial masses that were on. `Errors` holds the errors
that readings and data of the rig may have.
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.inputs.bearing_file import EXPECTED, Expected
from abu_calc.inputs.reading.table import Name, Table, problem, usual
from abu_calc.inputs.wheel import BalanceGrade


class Errors(Table):
    """How far readings, masses put on and data of the rig may be off: one standard deviation each."""

    amplitude_percent: float = Field(
        default=1.0,
        description="Error of each amplitude [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 20),
    )
    phase_deg: float = Field(
        default=1.0,
        description="Error of each phase [degrees]; {range}. Default: {default}, assumed.",
        ge=0,
        le=90,
        json_schema_extra=usual(0.01, 20),
    )
    speed_percent: float = Field(
        default=0.1,
        description="Error of the speed [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=50,
        json_schema_extra=usual(0.001, 10),
    )
    support_mass_percent: float = Field(
        default=2.0,
        description="Error of the moving mass of each support [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    stiffness_percent: float = Field(
        default=2.0,
        description="Error of each stiffness [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    damping_ratio: float = Field(
        default=0.01,
        description="Error of rig.damping_ratio; {range}. Default: {default}, assumed.",
        ge=0,
        le=0.5,
        json_schema_extra=usual(0.0001, 0.2),
    )
    rotor_mass_percent: float = Field(
        default=0.5,
        description="Error of the roll's mass [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    inertia_percent: float = Field(
        default=2.0,
        description="Error of the roll's inertia [%]; {range}. Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    length_mm: float = Field(
        default=1.0,
        description="Error of each of the four lengths [mm]; {range}. Default: {default}, assumed.",
        ge=0,
        le=1000,
        json_schema_extra=usual(0.01, 100),
    )
    placed_mass_percent: float = Field(
        default=1.0,
        description="Error of each mass added or removed, trial or correction [%]; {range}. "
        "Default: {default}, assumed.",
        ge=0,
        le=100,
        json_schema_extra=usual(0.01, 50),
    )
    placed_angle_deg: float = Field(
        default=1.0,
        description="Error of the angle of each mass [degrees]; {range}. Default: {default}, assumed.",
        ge=0,
        le=90,
        json_schema_extra=usual(0.01, 20),
    )


Quantity = Literal["displacement", "velocity", "acceleration"]
Plane = Literal["left", "right"]
MarkEdge = Literal["leading", "middle", "trailing"]


class Reading(Table):
    """Reading of one sensor."""

    inline: ClassVar[bool] = True

    amplitude: float = Field(
        description="Amplitude at the speed of rotation, 0–peak, in the unit of quantity; {range}.",
        examples=[0.038109],
        ge=0,
        le=1e6,
    )
    phase_deg: float = Field(
        description="Phase [degrees], of A·cos(ωt − phase), t from the passage of the zero mark; {range}.",
        examples=[18.7489],
        ge=-360,
        le=360,
    )


class Trial(Table):
    """A known mass that was on in this run."""

    inline: ClassVar[bool] = True

    plane: Plane = Field(description="The correction plane it was in: left or right.", examples=["left"])
    mass_g: float = Field(
        description="Its mass [g]; {range}, negative: metal that was taken off.",
        examples=[10.0],
        ge=-1e6,
        le=1e6,
        json_schema_extra=usual(0.01, 5000),
    )
    angle_deg: float = Field(
        description="Angle from the zero mark AGAINST rotation [degrees]; {range}.",
        examples=[0.0],
        ge=-360,
        le=360,
    )
    radius_mm: float | None = Field(
        default=None,
        description="Radius it was at [mm]; {range}. Without it: the correction radius of its plane.",
        examples=[120.0],
        gt=0,
        le=1e5,
        json_schema_extra=usual(5, 5000),
    )

    @model_validator(mode="after")
    def _is_a_mass(self) -> Self:
        if self.mass_g == 0:
            raise problem("a trial mass of nothing", "mass_g", remedy="leave trial out, or give the mass")
        return self


def _listed(value: object) -> object:
    """A single table as a list of one."""
    return [value] if isinstance(value, dict) else value


class Run(Table):
    """A run on the rig at steady speed; several are averaged as vectors."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"speed_rpm", "left", "right"})

    speed_rpm: float | None = Field(
        default=None,
        description="Speed of rotation [rpm]; {range}. With file it may be left out: the marks tell it.",
        examples=[3000.0],
        gt=0,
        le=1e6,
        json_schema_extra=usual(60, 60000),
    )
    quantity: Quantity = Field(
        description="Quantity that the sensors read: displacement (mm), velocity (mm/s) or acceleration (m/s²), all "
        "0–peak. The quantity decides the side: an acceleration points opposite to the displacement.",
        examples=["displacement"],
    )
    left: Reading | None = Field(
        default=None,
        description="Left support, x = A·cos(ωt − phase), t from the passage of the zero mark at its sensor.",
    )
    right: Reading | None = Field(
        default=None, description="Right support, likewise.", examples=[{"amplitude": 0.031642, "phase_deg": 152.7485}]
    )
    file: str | None = Field(
        default=None,
        description="A recorded run in place of left and right: a CSV file beside this one. Its columns are "
        "time (s), left, right (in the unit of quantity) and mark (pulses, either polarity).",
        examples=["run1.csv"],
        min_length=1,
    )
    mark_edge: MarkEdge | None = Field(
        default=None,
        description="With file: what of a pulse is the mark's passage: its leading edge, its middle or its trailing "
        "edge. Without it: the leading edge of a square pulse, the middle of a rounded one.",
        examples=["leading"],
    )
    sensor_to_mark_deg: float = Field(
        default=0.0,
        description="Place of the zero-mark sensor from the vibration sensors, in the sense of rotation [degrees]; "
        "{range}. Default: {default}, in line with them.",
        ge=-360,
        le=360,
    )
    trial: Annotated[
        tuple[Trial, ...],
        Field(strict=False, max_length=20),
        BeforeValidator(_listed, json_schema_input_type=Trial | Annotated[tuple[Trial, ...], Field(max_length=20)]),
    ] = Field(
        default=(),
        description="Known masses that were on, one table or a list of them: plane, mass_g, angle_deg. For influence "
        "coefficients.",
    )

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """A record takes the place of readings, and they of it."""
        if key == "file":
            return ("left", "right")
        return ("file", "mark_edge") if key in ("left", "right") else ()

    @model_validator(mode="after")
    def _read_or_recorded(self) -> Self:
        if self.file is None:
            for key in ("speed_rpm", "left", "right"):
                if getattr(self, key) is None:
                    example = "3000.0" if key == "speed_rpm" else "{ amplitude = …, phase_deg = … }"
                    raise problem("the key is missing", key, remedy=f"add {key} = {example}, or file, a recorded run")
            if self.mark_edge is not None:
                raise problem("mark_edge goes with file only", "mark_edge", remedy="leave mark_edge out")
        for key in ("left", "right"):
            if self.file is not None and getattr(self, key) is not None:
                raise problem("a run is read or recorded, not both", key, remedy=f"leave {key} out, or file")
        return self


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
        description="R1, radius at which mass is removed or added in the left plane [mm]; {range}.", examples=[120.0]
    )
    right_correction_radius_mm: Radius = Field(
        description="R2, likewise in the right plane [mm]; {range}.", examples=[150.0]
    )
    max_removable_g: float | None = Field(
        default=None,
        description="Largest mass that may be removed in a plane [g]; {range}. Beyond that, mass is added opposite.",
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
                "the two planes coincide: they cannot be distinguished",
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
    """Limits of the balanced roll."""

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
