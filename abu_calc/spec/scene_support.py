"""Supports of a scene's rotor beyond springs in the plane."""

from typing import Annotated, ClassVar, Final, Self

from pydantic import Field, model_validator

from abu_calc.spec.duty import GRIP, SwingArm
from abu_calc.spec.table import Table, problem
from abu_calc.spec.usual import usual

Stiffness = Annotated[float, Field(ge=0, le=1e15)]
Damping = Annotated[float, Field(ge=0, le=1e12)]
StiffnessPair = Annotated[tuple[Stiffness, ...], Field(strict=False, min_length=2, max_length=2)]
DampingPair = Annotated[tuple[Damping, ...], Field(strict=False, min_length=2, max_length=2)]
Position = Annotated[float, Field(ge=-1e5, le=1e5)]

PER_BEARING: Final = ("bearing_stiffness_N_per_m", "bearing_damping_N_s_per_m")


class Body(Table):
    """Planar support: a further body that hangs on the rotor by a spring and a damper, such as a casing or a handle. It
    starts at rest at its place.
    """

    mass_kg: float = Field(description="Mass of the body [kg]; {range}.", examples=[0.5], gt=0, le=1e9)
    stiffness_N_per_m: StiffnessPair = Field(
        description="Stiffness between rotor and body along x and y [N/m]; {range}.", examples=[[20000.0, 20000.0]]
    )
    damping_N_s_per_m: DampingPair = Field(
        description="Damping between rotor and body along x and y [N·s/m]; {range}.", examples=[[5.0, 5.0]]
    )


class CoupleImbalance(Table):
    """Couple imbalance: the polar principal axis of inertia leans against the axis of rotation."""

    magnitude_rad: float = Field(
        description="Angle between the polar principal axis and the axis of rotation [rad]; {range}.",
        examples=[6.8e-5],
        ge=0,
        le=0.1,
        json_schema_extra=usual(1e-7, 5e-3),
    )
    angle_deg: float = Field(
        default=0.0,
        description="Where the +z end of the principal axis leans to, from the zero mark [degrees]; {range}. "
        "Default: {default}.",
        ge=-360,
        le=360,
    )


class Tilting(Table):
    """A rigid rotor on bearings, which moves in its plane and tilts: support = "tilting"."""

    transverse_inertia_kg_m2: float = Field(
        description="Moment of inertia about an axis across the spindle through the centre of mass, without balls "
        "[kg·m²]; {range}.",
        examples=[0.0138],
        gt=0,
        le=1e9,
    )
    polar_inertia_kg_m2: float = Field(
        description="Moment of inertia of what rotates about the spindle, without balls [kg·m²]; {range}, at most "
        "twice the transverse one.",
        examples=[0.00124],
        ge=0,
        le=1e9,
    )
    bearing_positions_mm: Annotated[tuple[Position, ...], Field(strict=False, min_length=1, max_length=20)] = Field(
        description="Places of the bearings along +z, from the centre of mass [mm]; {range}, one or more.",
        examples=[[110.0, -150.0]],
    )
    bearing_stiffness_N_per_m: Annotated[tuple[StiffnessPair, ...], Field(strict=False, max_length=20)] = Field(
        description="Stiffness of each bearing along x and y [N/m]; {range}.",
        examples=[[[21500.0, 15800.0], [21500.0, 15800.0]]],
    )
    bearing_damping_N_s_per_m: Annotated[tuple[DampingPair, ...], Field(strict=False, max_length=20)] = Field(
        description="Damping of each bearing along x and y [N·s/m]; {range}.",
        examples=[[[5.375, 3.95], [5.375, 3.95]]],
    )
    couple_imbalance_angle: CoupleImbalance | None = None
    ball_tilt_inertia: bool = Field(
        default=True,
        description="Whether balls move axially with the race as it tilts: true or false. Default: {default}.",
    )

    @model_validator(mode="after")
    def _numbers_for_each_bearing(self) -> Self:
        bearings = len(self.bearing_positions_mm)
        for key in PER_BEARING:
            given = len(getattr(self, key))
            if given != bearings:
                raise problem(
                    "one pair [x, y] for each bearing of bearing_positions_mm",
                    key,
                    found=f"{given} of them",
                    allowed=f"{bearings}",
                )
        return self

    @model_validator(mode="after")
    def _inertia_of_a_body(self) -> Self:
        if self.polar_inertia_kg_m2 > 2 * self.transverse_inertia_kg_m2:
            raise problem(
                "no body has such moments of inertia",
                "polar_inertia_kg_m2",
                found=f"{self.polar_inertia_kg_m2:g} kg·m²",
                allowed=f"at most twice transverse_inertia_kg_m2, {2 * self.transverse_inertia_kg_m2:g} kg·m²",
            )
        return self


class SceneSwingArm(SwingArm):
    """The rotor at the end of a swing arm (Kovalenko 2010): support = "swing-arm". The defaults are an example."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"wheel_radius_mm"})

    wheel_radius_mm: float | None = Field(
        default=None,
        description="Radius of the wheel that cuts [mm]; {range}. With cutting = true.",
        examples=[115.0],
        gt=0,
        le=1e4,
    )
    cutting: bool = Field(
        default=False,
        description="Whether the wheel is pressed to the work: true or false. Default: {default}, idle.",
    )

    def unused(self) -> frozenset[str]:
        """Keys of the pressing to the workpiece, while the wheel is not pressed."""
        return frozenset() if self.cutting else frozenset({*GRIP, "wheel_radius_mm"})

    @model_validator(mode="after")
    def _cutting_needs_a_radius(self) -> Self:
        if self.cutting and self.wheel_radius_mm is None:
            raise problem("cutting = true needs wheel_radius_mm", "wheel_radius_mm", remedy="add wheel_radius_mm = …")
        return self
