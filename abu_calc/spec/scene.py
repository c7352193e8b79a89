# ruff: noqa: N815 - the fields are the keys of the file, and units keep their capital letters.
"""A scene file: one simulation given outright, and the rules between its tables."""

import math
from typing import Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.spec.scene_effects import Effects
from abu_calc.spec.scene_support import DampingPair, SceneSwingArm, StiffnessPair, Tilting
from abu_calc.spec.table import Table, problem

__all__ = ["Effects", "Initial", "SceneFile", "SceneRace", "SceneSwingArm", "SceneTable", "Tilting"]

Mass = Annotated[float, Field(gt=0, le=1e12)]
Angle = Annotated[float, Field(ge=-1e6, le=1e6)]
BallSpeed = Annotated[float, Field(ge=-1e6, le=1e6)]
Place = Annotated[float, Field(ge=-1e6, le=1e6)]
Velocity = Annotated[float, Field(ge=-1e9, le=1e9)]

MOST_BALLS: Final = 100
TOUCHING: Final = 1e-6
"""Balls that overlap by less than this at the start [rad] touch."""

SPRINGS: Final = ("stiffness_N_per_m", "damping_N_s_per_m")
NEEDED: Final = {
    "planar": ("mass_kg", *SPRINGS),
    "tilting": ("mass_kg", "tilting"),
    "swing-arm": ("swing_arm",),
}
REFUSED: Final = {
    "planar": ("tilting", "swing_arm"),
    "tilting": (*SPRINGS, "swing_arm"),
    "swing-arm": (*SPRINGS, "tilting"),
}
EXAMPLES: Final = {
    "mass_kg": "1.0",
    "stiffness_N_per_m": "[1.0, 1.0]",
    "damping_N_s_per_m": "[0.02, 0.02]",
}


class Initial(Table):
    """Where the axis is at t = 0, and how fast."""

    x_mm: Place = Field(default=0.0, description="Place along x [mm]; -1e6 … 1e6. Default: 0.")
    y_mm: Place = Field(default=0.0, description="Place along y [mm]; -1e6 … 1e6. Default: 0.")
    vx_mm_per_s: Velocity = Field(default=0.0, description="Velocity along x [mm/s]; -1e9 … 1e9. Default: 0.")
    vy_mm_per_s: Velocity = Field(default=0.0, description="Velocity along y [mm/s]; -1e9 … 1e9. Default: 0.")


class SceneRace(Table):
    """A race and its balls; all angles are measured in the rotor, from its zero mark in the sense of rotation."""

    pitch_radius_mm: float = Field(
        description="Radius of the circle on which the balls' centres run [mm]; above 0 … 1e6.",
        examples=[1000.0],
        gt=0,
        le=1e6,
    )
    plane_offset_mm: float = Field(
        default=0.0,
        description="Tilting support: place of the race along +z from the centre of mass [mm]; -100000 … 100000. "
        "Default: 0.",
        ge=-1e5,
        le=1e5,
    )
    ball_masses_g: Annotated[tuple[Mass, ...], Field(strict=False, max_length=MOST_BALLS)] = Field(
        description="Mass of each ball [g]; above 0 … 1e12, up to 100 balls, none for the rotor alone.",
        examples=[[50.0, 50.0]],
    )
    rolling_drag_per_s: float = Field(
        description="Viscous drag h0: the torque on a ball is -m·R_p²·h0·(speed relative to the race) [1/s]; 0 … 1e7, "
        "0 switches it off.",
        examples=[0.01],
        ge=0,
        le=1e7,
    )
    start_angles_deg: Annotated[tuple[Angle, ...], Field(strict=False, max_length=MOST_BALLS)] = Field(
        description="Angle of each ball at the start [degrees]; -1e6 … 1e6.", examples=[[90.0, -90.0]]
    )
    start_speeds_rpm: Annotated[tuple[BallSpeed, ...], Field(strict=False, max_length=MOST_BALLS)] | None = Field(
        default=None,
        description="Speed of each ball at the start, relative to the race [rpm]; -1e6 … 1e6. Without it: at rest in "
        "the race.",
        examples=[[0.0, 0.0]],
    )

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


class SceneTable(Table):
    """One simulation: the rotor, its support, its speed, how long and from where."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"mass_kg", *SPRINGS})

    support: Literal["planar", "tilting", "swing-arm"] = Field(
        default="planar",
        description="What the rotor hangs on: planar (springs along x and y), tilting (a rigid rotor on bearings, "
        "[scene.tilting]) or swing-arm ([scene.swing_arm]). Default: planar.",
    )
    mass_kg: float | None = Field(
        default=None,
        description="Mass of the rotor and what moves with it, WITHOUT balls [kg]; above 0 … 1e9. Planar and tilting "
        "supports need it; a swing arm holds it in its moment of inertia.",
        examples=[1.0],
        gt=0,
        le=1e9,
    )
    stiffness_N_per_m: StiffnessPair | None = Field(
        default=None,
        description="Stiffness of a planar support along x and y [N/m]; 0 … 1e15.",
        examples=[[1.0, 1.0]],
    )
    damping_N_s_per_m: DampingPair | None = Field(
        default=None,
        description="Damping of a planar support along x and y [N·s/m]; 0 … 1e12.",
        examples=[[0.02, 0.02]],
    )
    speed_rpm: float = Field(
        description="Speed of rotation, from +x to +y [rpm]; above 0 … 1e6.", examples=[19.0985931710274], gt=0, le=1e6
    )
    imbalance_g_mm: float = Field(
        description="Imbalance of the rotor without balls [g·mm]; 0 … 1e15.", examples=[10000.0], ge=0, le=1e15
    )
    imbalance_angle_deg: float = Field(
        default=0.0,
        description="Where the imbalance stands, from the zero mark [degrees]; -1e6 … 1e6. Default: 0.",
        ge=-1e6,
        le=1e6,
    )
    duration_s: float = Field(
        description="Time to simulate [s]; at least one revolution, up to 1e9.", examples=[700.0], gt=0, le=1e9
    )
    rolling_inertia: bool = Field(
        default=False,
        description="true: solid rolling balls, inertia factor 7/5; false: points. Default: false.",
    )
    initial: Initial = Field(default_factory=Initial)
    race: Annotated[tuple[SceneRace, ...], Field(strict=False, min_length=1, max_length=10)] = Field(
        description="Races and their balls: [[scene.race]], one or more."
    )
    tilting: Tilting | None = None
    swing_arm: SceneSwingArm | None = None
    effects: Effects = Field(default_factory=Effects)

    @model_validator(mode="after")
    def _support_has_its_numbers(self) -> Self:
        for key in NEEDED[self.support]:
            if getattr(self, key) is None:
                given = f"{key} = {EXAMPLES[key]}, with your own value" if key in EXAMPLES else f"[scene.{key}]"
                raise problem(f'support = "{self.support}" needs {key}', key, remedy=f"add {given}")
        for key in REFUSED[self.support]:
            if getattr(self, key) is not None:
                raise problem(
                    f'support = "{self.support}" takes no {key}', key, remedy=f"leave {key} out, or change support"
                )
        return self

    @model_validator(mode="after")
    def _lasts_a_revolution(self) -> Self:
        if self.duration_s * self.speed_rpm < 60 * (1 - 1e-12):
            raise problem(
                "the scene is shorter than one revolution, over which results are means",
                "duration_s",
                found=f"{self.duration_s:g} s",
                allowed=f"at least {60 / self.speed_rpm:.6g} s at {self.speed_rpm:g} rpm",
            )
        return self

    @model_validator(mode="after")
    def _planar_races_lie_in_the_plane(self) -> Self:
        for index, race in enumerate(self.race):
            if race.plane_offset_mm != 0 and self.support != "tilting":
                raise problem(
                    f'support = "{self.support}" knows no places along the spindle',
                    *("race", index, "plane_offset_mm"),
                    found=f"{race.plane_offset_mm:g} mm",
                    remedy='leave plane_offset_mm out, or use support = "tilting"',
                )
        return self

    @model_validator(mode="after")
    def _balls_fit_their_race(self) -> Self:
        for index, race in enumerate(self.race):
            for name, radius in self.effects.ball_radii_mm.items():
                if radius >= race.pitch_radius_mm:
                    raise problem(
                        f"the balls are larger than race[{index}]",
                        *("effects", name, "ball_radius_mm"),
                        found=f"{radius:g} mm",
                        allowed=f"below pitch_radius_mm, {race.pitch_radius_mm:g} mm",
                    )
            if contact := self.effects.ball_contact:
                self._refuse_overlap(index, race, math.asin(contact.ball_radius_mm / race.pitch_radius_mm))
        return self

    def _refuse_overlap(self, index: int, race: SceneRace, half_angle: float) -> None:
        """Balls that have a size cannot start in one place."""
        order = sorted(range(len(race.start_angles_deg)), key=lambda k: race.start_angles_deg[k] % 360)
        angles = [math.radians(race.start_angles_deg[k] % 360) for k in order]
        # A ball alone on its race is its own neighbour, a whole turn away.
        for place, angle in enumerate(angles):
            gap = (angles[(place + 1) % len(angles)] - angle) % math.tau or math.tau * (len(angles) == 1)
            if gap < 2 * half_angle - TOUCHING:
                one, other = sorted((order[place] + 1, order[(place + 1) % len(angles)] + 1))
                raise problem(
                    f"balls {one} and {other} overlap at the start",
                    *("race", index, "start_angles_deg"),
                    found=f"{math.degrees(gap):.6g}° apart",
                    allowed=f"at least {math.degrees(2 * half_angle):.6g}°",
                    remedy="part them, or leave [scene.effects.ball_contact] out",
                )

    @model_validator(mode="after")
    def _motor_reaches_speed(self) -> Self:
        motor = self.effects.motor
        if motor is not None and motor.no_load_speed_rpm < self.speed_rpm:
            raise problem(
                "the motor cannot reach scene.speed_rpm",
                *("effects", "motor", "no_load_speed_rpm"),
                found=f"{motor.no_load_speed_rpm:g} rpm",
                allowed=f"at least {self.speed_rpm:g} rpm",
            )
        return self


class SceneFile(Table):
    """A simulation given outright, without sizing."""

    scene: SceneTable
