"""Tables of the effects of a scene: each effect is on when its table is there."""

from typing import Self

from pydantic import Field, model_validator

from abu_calc.inputs.duty import Grinding, Motor
from abu_calc.inputs.reading.table import Table, entry, problem

BALL_RADIUS = "Radius of a ball [mm]; {range}, the same in all effects."


class Gravity(Table):
    """Weight of the balls, toward -y; the axis is counted from static equilibrium. No keys."""


class DryRollingFriction(Table):
    """Dry rolling friction: a ball sticks until it is pulled harder than its normal force times k_r/r."""

    lever_arm_mm: float = entry(ge=0, le=1, example=0.002).means(
        "Lever arm of dry rolling friction [mm]; {range}, hard ground clean race 0.0005 … 0.005."
    )
    ball_radius_mm: float = Field(description=BALL_RADIUS, examples=[8.0], gt=0, le=1000)


class BallContact(Table):
    """Balls have a size: neighbours meet, press and part. Without it they pass through each other."""

    ball_radius_mm: float = Field(description=BALL_RADIUS, examples=[8.0], gt=0, le=1000)
    restitution: float = entry(0.5, ge=0, le=1).means(
        "Speed after an impact over the speed before it; {range}. Default: {default}, assumed."
    )


class RaceEccentricity(Table):
    """The race's centre stands off the axis of rotation."""

    magnitude_mm: float = entry(ge=0, le=100, example=0.01).means(
        "Distance of the race's centre from the axis of rotation [mm]; {range}, usually 0.005 … 0.020."
    )
    angle_deg: float = entry(0.0, ge=-360, le=360).means(
        "Angle of the centre of the race from the zero mark [degrees]; {range}. Default: {default}."
    )


class GrindingContact(Grinding):
    """Wheel and work under load."""

    runout_mm: float = entry(0.0, ge=0, le=10).means(
        "Eccentricity of the wheel's outer surface, half of what a dial gauge shows [mm]; {range}. Default: {default}, "
        "a true wheel."
    )
    runout_angle_deg: float = entry(0.0, ge=-360, le=360).means(
        "Angle of the high spot from the zero mark [degrees]; {range}. Default: {default}."
    )
    wheel_radius_mm: float | None = entry(None, gt=0, le=1e4, example=75.0).means(
        "Radius of the wheel [mm]; {range}. With it cutting brakes a rotor that a motor drives."
    )
    plane_offset_mm: float = entry(0.0, ge=-1e5, le=1e5).means(
        "Tilting support: place of the wheel along +z from the centre of mass [mm]; {range}. Default: {default}."
    )


class SceneRunUp(Table):
    """A speed that rises from 0 to speed_rpm, or falls from it to 0, at an even pace."""

    time_s: float | None = entry(None, gt=0, le=3600, example=1.0).means(
        "Time from standstill to speed_rpm [s]; {range}."
    )
    run_down_s: float | None = entry(None, gt=0, le=3600, example=3.0).means(
        "Time from speed_rpm to standstill, at the end of the run [s]; {range}."
    )
    rotor_inertia_kg_m2: float | None = entry(None, gt=0, le=1e6, example=2e-3).means(
        "Moment of inertia of all that turns, reduced to the spindle [kg·m²]; {range}. With it a swing arm feels what "
        "the change of speed takes; a motor has its own."
    )

    @model_validator(mode="after")
    def _up_or_down(self) -> Self:
        if self.time_s is None and self.run_down_s is None:
            raise problem(
                "the run-up has no time", "time_s", allowed="time_s, run_down_s or both", remedy="add time_s = 1.0"
            )
        return self


class TransverseMotion(Table):
    """Balls also move across the race, in its toroidal groove (Kladiev 1996, eq. (12))."""

    groove_radius_mm: float = entry(gt=0, le=1e4, example=24.4).means(
        "Radius of the groove across the race [mm]; above ball_radius_mm, up to {most}."
    )
    ball_radius_mm: float = Field(description=BALL_RADIUS, examples=[8.0], gt=0, le=1000)
    axial_runout_mm: float = entry(0.0, ge=0, le=10).means(
        "Axial runout of the race, 0-peak [mm]; {range}. Default: {default}."
    )
    free_spin: bool = entry(False).means(
        "Whether balls spin freely about the contact's normal: true or false. Default: {default}."
    )

    @model_validator(mode="after")
    def _groove_holds_the_ball(self) -> Self:
        if self.groove_radius_mm <= self.ball_radius_mm:
            raise problem(
                "the ball does not fit into the groove",
                "groove_radius_mm",
                found=f"{self.groove_radius_mm:g} mm",
                allowed=f"above ball_radius_mm, {self.ball_radius_mm:g} mm",
            )
        return self


class Effects(Table):
    """The effects of the scene: an effect is on when its table is here."""

    gravity: Gravity | None = None
    dry_rolling_friction: DryRollingFriction | None = None
    ball_contact: BallContact | None = None
    race_eccentricity: RaceEccentricity | None = None
    grinding_contact: GrindingContact | None = None
    run_up: SceneRunUp | None = None
    motor: Motor | None = None
    transverse_motion: TransverseMotion | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The effects that are on, in the order of this list."""
        return tuple(name for name in type(self).model_fields if getattr(self, name) is not None)

    @property
    def ball_radii_mm(self) -> dict[str, float]:
        """The ball's radius [mm] as each effect that needs it gives it."""
        tables = {name: getattr(self, name) for name in self.names}
        return {name: table.ball_radius_mm for name, table in tables.items() if hasattr(table, "ball_radius_mm")}

    @property
    def rotor_inertias(self) -> dict[str, float]:
        """The rotor's moment of inertia [kg·m²] as each effect that knows it gives it."""
        tables = {"run_up": self.run_up, "motor": self.motor}
        given = {name: table.rotor_inertia_kg_m2 for name, table in tables.items() if table}
        return {name: inertia for name, inertia in given.items() if inertia is not None}

    @model_validator(mode="after")
    def _one_rotor(self) -> Self:
        inertias = self.rotor_inertias
        if len(set(inertias.values())) > 1:
            raise problem(
                "a rotor has one moment of inertia",
                *("run_up", "rotor_inertia_kg_m2"),
                found=f"{inertias['run_up']:g} kg·m², and {inertias['motor']:g} kg·m² in motor",
                remedy="leave it out here: the motor's counts",
            )
        return self

    @model_validator(mode="after")
    def _one_ball_radius(self) -> Self:
        radii = self.ball_radii_mm
        for name, radius in radii.items():
            first, value = next(iter(radii.items()))
            if radius != value:
                raise problem(
                    "a ball has one radius",
                    name,
                    "ball_radius_mm",
                    found=f"{radius:g} mm, and {value:g} mm in {first}",
                    remedy="write the same radius in all effects",
                )
        return self
