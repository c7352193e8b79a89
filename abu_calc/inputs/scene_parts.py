"""Tables of a scene: races with their balls, and supports of the rotor beyond springs in the plane."""

import math
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.inputs.duty import GRIP, SwingArm
from abu_calc.inputs.reading.table import Table, entry, problem

Mass = Annotated[float, Field(gt=0, le=1e12)]
Angle = Annotated[float, Field(ge=-1e6, le=1e6)]
BallSpeed = Annotated[float, Field(ge=-1e6, le=1e6)]

MOST_BALLS: Final = 100
TOUCHING: Final = 1e-6
"""Balls that overlap by less than this at the start [rad] touch."""


class SceneRace(Table):
    """A race and its balls; all angles are measured in the rotor, from its zero mark in the sense of rotation."""

    pitch_radius_mm: float = entry(gt=0, le=1e6, example=23.0).means(
        "Radius of the circle on which the balls' centres run [mm]; {range}."
    )
    plane_offset_mm: float = entry(0.0, ge=-1e5, le=1e5).means(
        "Tilting support: place of the race along +z from the centre of mass [mm]; {range}. Default: {default}."
    )
    ball_masses_g: Annotated[tuple[Mass, ...], Field(strict=False, max_length=MOST_BALLS)] = entry(
        example=[16.7, 16.7, 16.7, 16.7]
    ).means("Mass of each ball [g]; {range}, up to 100 balls, none for the rotor alone.")
    ball_radius_mm: float | None = entry(None, gt=0, le=1000, example=8.0).means(
        "Radius of a ball [mm]; {range}, smaller than pitch_radius_mm, the same as in the effects. Required for "
        "rolling balls of a rotor that changes its speed. Default: the radius of the effects. Without any radius, "
        "balls count as small, with a warning."
    )
    corrector: Literal["ball", "roller"] = entry("ball").means(
        "Rolling body in the race, with scene.rolling_inertia = true: ball (solid, inertia factor 7/5) or roller "
        "(3/2). Default: {default}."
    )
    rolling_drag_per_s: float = entry(ge=0, le=1e7, example=15.0).means(
        "Viscous drag h0: the torque on a ball is -m·R_p²·h0·(speed relative to the race) [1/s]; {range}, 0 switches "
        "it off."
    )
    start_angles_deg: Annotated[tuple[Angle, ...], Field(strict=False, max_length=MOST_BALLS)] = entry(
        example=[-41.5, -0.5, 40.5, 81.5]
    ).means("Angle of each ball at the start [degrees]; {range}.")
    start_speeds_rpm: Annotated[tuple[BallSpeed, ...], Field(strict=False, max_length=MOST_BALLS)] | None = entry(
        None, example=[0.0, 0.0, 0.0, 0.0]
    ).means("Speed of each ball at the start, relative to the race [rpm]; {range}. Without it: at rest in the race.")

    @property
    def start_speeds(self) -> tuple[float, ...]:
        """Speed of each ball at the start [rpm], whether given or not."""
        return self.start_speeds_rpm if self.start_speeds_rpm is not None else (0.0,) * len(self.ball_masses_g)

    def own_defaults(self) -> dict[str, object]:
        """The speeds of the balls are the one default as long as another list."""
        derived = {} if self.start_speeds_rpm is not None else {"start_speeds_rpm": self.start_speeds}
        return {**super().own_defaults(), **derived}

    @model_validator(mode="after")
    def _lists_are_of_one_length(self) -> Self:
        balls = len(self.ball_masses_g)
        for key in ("start_angles_deg", "start_speeds_rpm"):
            given = getattr(self, key)
            if given is not None and len(given) != balls:
                message = "one value for each ball of ball_masses_g"
                raise problem(message, key, found=str(len(given)), allowed=str(balls))
        return self

    @model_validator(mode="after")
    def _balls_are_smaller_than_the_race(self) -> Self:
        if self.ball_radius_mm is not None and self.ball_radius_mm >= self.pitch_radius_mm:
            raise problem(
                "the balls are larger than their race",
                "ball_radius_mm",
                found=f"{self.ball_radius_mm:g} mm",
                allowed=f"below pitch_radius_mm, {self.pitch_radius_mm:g} mm",
            )
        return self


def refuse_overlap(index: int, race: SceneRace, ball_radius: float) -> None:
    """Balls that have a size [mm] cannot start in one place, and need room to move."""
    half_angle = math.asin(ball_radius / race.pitch_radius_mm)
    order = sorted(range(len(race.start_angles_deg)), key=lambda k: race.start_angles_deg[k] % 360)
    angles = [math.radians(race.start_angles_deg[k] % 360) for k in order]
    if 2 * half_angle * len(angles) > math.tau - TOUCHING:
        raise problem(
            "the balls fill their race and cannot move against each other",
            *("race", index, "ball_masses_g"),
            found=f"{len(angles)} balls",
            allowed=f"at most {int((math.pi - TOUCHING) / half_angle)} of ball_radius_mm = {ball_radius:g}",
            remedy="fewer or smaller balls, or leave [scene.effects.ball_contact] out",
        )
    # A ball alone on its race is its own neighbour, a whole turn away.
    for place, angle in enumerate(angles):
        gap = (angles[(place + 1) % len(angles)] - angle) % math.tau or math.tau * (len(angles) == 1)
        if gap < 2 * half_angle - TOUCHING:
            first_ball, other = sorted((order[place] + 1, order[(place + 1) % len(angles)] + 1))
            raise problem(
                f"balls {first_ball} and {other} overlap at the start",
                *("race", index, "start_angles_deg"),
                found=f"{math.degrees(gap):.6g}° apart",
                allowed=f"at least {math.degrees(2 * half_angle):.6g}°",
                remedy="part them, or leave [scene.effects.ball_contact] out",
            )


Stiffness = Annotated[float, Field(ge=0, le=1e15)]
Damping = Annotated[float, Field(ge=0, le=1e12)]
StiffnessPair = Annotated[tuple[Stiffness, ...], Field(strict=False, min_length=2, max_length=2)]
DampingPair = Annotated[tuple[Damping, ...], Field(strict=False, min_length=2, max_length=2)]
Position = Annotated[float, Field(ge=-1e5, le=1e5)]

PER_BEARING: Final = ("bearing_stiffness_N_per_m", "bearing_damping_N_s_per_m")


class Body(Table):
    """Planar support: a further body on the rotor by a spring and a damper, such as a casing or a handle. It starts
    at rest at its place.
    """

    mass_kg: float = Field(description="Mass of the body [kg]; {range}.", examples=[0.5], gt=0, le=1e9)
    stiffness_N_per_m: StiffnessPair = entry(example=[20000.0, 20000.0]).means(
        "Stiffness between rotor and body along x and y [N/m]; {range}."
    )
    damping_N_s_per_m: DampingPair = entry(example=[5.0, 5.0]).means(
        "Damping between rotor and body along x and y [N·s/m]; {range}."
    )


class CoupleImbalance(Table):
    """Couple imbalance: the polar principal axis of inertia leans against the axis of rotation."""

    magnitude_rad: float = entry(ge=0, le=0.1, usual=(1e-7, 5e-3), example=6.8e-5).means(
        "Angle between the polar principal axis and the axis of rotation [rad]; {range}."
    )
    angle_deg: float = entry(0.0, ge=-360, le=360).means(
        "Angle to which the +z end of the principal axis leans, from the zero mark [degrees]; {range}. Default: "
        "{default}."
    )


class Tilting(Table):
    """A rigid rotor on bearings, which moves in its plane and tilts: support = "tilting"."""

    transverse_inertia_kg_m2: float = entry(gt=0, le=1e9, example=0.0138).means(
        "Moment of inertia about an axis across the spindle through the centre of mass, without balls [kg·m²]; {range}."
    )
    polar_inertia_kg_m2: float = entry(ge=0, le=1e9, example=0.00124).means(
        "Moment of inertia of what rotates about the spindle, without balls [kg·m²]; {range}, at most twice the "
        "transverse one."
    )
    bearing_positions_mm: Annotated[tuple[Position, ...], Field(strict=False, min_length=1, max_length=20)] = entry(
        example=[110.0, -150.0]
    ).means("Places of the bearings along +z, from the centre of mass [mm]; {range}, one or more.")
    bearing_stiffness_N_per_m: Annotated[tuple[StiffnessPair, ...], Field(strict=False, max_length=20)] = entry(
        example=[[21500.0, 15800.0], [21500.0, 15800.0]]
    ).means("Stiffness of each bearing along x and y [N/m]; {range}.")
    bearing_damping_N_s_per_m: Annotated[tuple[DampingPair, ...], Field(strict=False, max_length=20)] = entry(
        example=[[5.375, 3.95], [5.375, 3.95]]
    ).means("Damping of each bearing along x and y [N·s/m]; {range}.")
    couple_imbalance_angle: CoupleImbalance | None = None
    ball_tilt_inertia: bool = entry(True).means(
        "Whether balls move axially with the race as it tilts: true or false. Default: {default}."
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

    wheel_radius_mm: float | None = entry(None, gt=0, le=1e4, example=115.0).means(
        "Radius of the wheel that cuts [mm]; {range}. With cutting = true."
    )
    cutting: bool = entry(False).means(
        "Whether the wheel is pressed to the work: true or false. Default: {default}, idle."
    )

    def unused(self) -> frozenset[str]:
        """Keys of the pressing to the workpiece, while the wheel is not pressed."""
        return frozenset() if self.cutting else frozenset({*GRIP, "wheel_radius_mm"})

    @model_validator(mode="after")
    def _cutting_needs_a_radius(self) -> Self:
        if self.cutting and self.wheel_radius_mm is None:
            raise problem("cutting = true needs wheel_radius_mm", "wheel_radius_mm", remedy="add wheel_radius_mm = …")
        return self
