"""A scene file: one simulation given outright, the rules between its tables, and its reading.

Its effects and its support declare their own tables, see `dynamics.effects.registry` and `dynamics.supports.registry`.
`read_any` reads a file that may hold either a scene or a machine.
"""

import math
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Literal, Self

from pydantic import Field, create_model, model_validator

from abu_calc.dynamics.effects.registry import EFFECTS
from abu_calc.dynamics.supports.planar import DampingPair, StiffnessPair
from abu_calc.dynamics.supports.registry import SUPPORTS
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown
from abu_calc.inputs.read_machine import Machine, machine_from
from abu_calc.inputs.reading.document import (
    Document,
    FileReading,
    document_from,
    open_document,
    parsed_overrides,
    validate,
)
from abu_calc.inputs.reading.kinds import kind_of, refuse_others
from abu_calc.inputs.reading.table import Many, Table, entry, problem
from abu_calc.inputs.reading.text import Part
from abu_calc.inputs.variation import Sweep

if TYPE_CHECKING:
    from abu_calc.inputs.reading.overrides import Override

Mass = Annotated[float, Field(gt=0, le=1e12)]
Angle = Annotated[float, Field(ge=-1e6, le=1e6)]
BallSpeed = Annotated[float, Field(ge=-1e6, le=1e6)]
Place = Annotated[float, Field(ge=-1e6, le=1e6)]
Velocity = Annotated[float, Field(ge=-1e9, le=1e9)]

MOST_BALLS: Final = 100
TOUCHING: Final = 1e-6
"""Balls that overlap by less than this at the start [rad] touch."""

SPRINGS: Final = ("stiffness_N_per_m", "damping_N_s_per_m")
EXAMPLES: Final = {
    "mass_kg": "1.0",
    "stiffness_N_per_m": "[1.0, 1.0]",
    "damping_N_s_per_m": "[0.02, 0.02]",
}
KINDS: Final = {kind.kind: kind for kind in SUPPORTS}


class SceneRace(Table):
    """A race and its balls; all angles are measured in the rotor, from its zero mark in the sense of rotation."""

    pitch_radius_mm: float = entry(gt=0, le=1e6, example=23.0).means(
        "Radius of the circle on which the balls' centres run [mm]; {range}."
    )
    plane_offset_mm: float = entry(0.0, ge=-1e5, le=1e5).means(
        "Tilting support: place of the race along +z from the centre of mass [mm]; {range}. Default: {default}."
    )
    ball_masses_g: Many[Mass] = entry(example=[16.7, 16.7, 16.7, 16.7], max_length=MOST_BALLS).means(
        "Mass of each ball [g]; {range}, up to 100 balls, none for the rotor alone."
    )
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
    start_angles_deg: Many[Angle] = entry(example=[-41.5, -0.5, 40.5, 81.5], max_length=MOST_BALLS).means(
        "Angle of each ball at the start [degrees]; {range}."
    )
    start_speeds_rpm: Many[BallSpeed] | None = entry(None, example=[0.0, 0.0, 0.0, 0.0], max_length=MOST_BALLS).means(
        "Speed of each ball at the start, relative to the race [rpm]; {range}. Without it: at rest in the race."
    )

    def own_defaults(self) -> dict[str, object]:
        """The speeds of the balls are the one default as long as another list."""
        still = {} if self.start_speeds_rpm is not None else {"start_speeds_rpm": (0.0,) * len(self.ball_masses_g)}
        return {**super().own_defaults(), **still}

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


_TABLES: Final[dict[str, Any]] = {kind.name: (kind.keys | None, None) for kind in EFFECTS if kind.keys}


class Effects(create_model("_Effects", __base__=Table, **_TABLES)):  # type: ignore[misc]
    """The effects of the scene: an effect is on when its table is here."""

    @property
    def names(self) -> tuple[str, ...]:
        """The effects that are on, in the order of this list."""
        return tuple(name for name in type(self).model_fields if getattr(self, name) is not None)

    @property
    def ball_radii(self) -> dict[str, float]:
        """The ball's radius [m] as each effect that needs it gives it."""
        tables = {name: getattr(self, name) for name in self.names}
        return {name: table.ball_radius for name, table in tables.items() if hasattr(table, "ball_radius_mm")}

    @property
    def rotor_inertias(self) -> dict[str, float]:
        """The rotor's moment of inertia [kg·m²] as each effect that knows it gives it."""
        given = {name: getattr(getattr(self, name), "rotor_inertia_kg_m2", None) for name in self.names}
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
        radii = self.ball_radii
        for name, radius in radii.items():
            first, value = next(iter(radii.items()))
            if radius != value:
                raise problem(
                    "a ball has one radius",
                    name,
                    "ball_radius_mm",
                    found=f"{shown(radius, 'mm', 'g')}, and {shown(value, 'mm', 'g')} in {first}",
                    remedy="write the same radius in all effects",
                )
        return self


class Initial(Table):
    """Position and velocity of the axis at t = 0; on a tilting support at its centre of mass. A swing arm starts
    at rest.
    """

    x_mm: Place = Field(default=0.0, description="Place along x [mm]; {range}. Default: {default}.")
    y_mm: Place = Field(default=0.0, description="Place along y [mm]; {range}. Default: {default}.")
    vx_mm_per_s: Velocity = Field(default=0.0, description="Velocity along x [mm/s]; {range}. Default: {default}.")
    vy_mm_per_s: Velocity = Field(default=0.0, description="Velocity along y [mm/s]; {range}. Default: {default}.")


class _SceneKeys(Table):
    support: str
    mass_kg: float | None = entry(None, gt=0, le=1e9, example=6.37).means(
        "Mass of the rotor and what moves with it, WITHOUT balls [kg]; {range}. Planar and tilting supports need it; a "
        "swing arm holds it in its moment of inertia."
    )
    stiffness_N_per_m: StiffnessPair | None = entry(None, example=[1530.0, 1530.0]).means(
        "Stiffness of a planar support along x and y [N/m]; {range}."
    )
    damping_N_s_per_m: DampingPair | None = entry(None, example=[97.4, 97.4]).means(
        "Damping of a planar support along x and y [N·s/m]; {range}."
    )
    speed_rpm: float = entry(gt=0, le=1e6, example=5800.0).means("Speed of rotation, from +x to +y [rpm]; {range}.")
    imbalance_g_mm: float = entry(ge=0, le=1e15, example=256.0).means(
        "Imbalance of the rotor without balls [g·mm]; {range}."
    )
    imbalance_angle_deg: float = entry(0.0, ge=-1e6, le=1e6).means(
        "Angle of the imbalance from the zero mark [degrees]; {range}. Default: {default}."
    )
    duration_s: float = entry(gt=0, le=1e9, example=5.0).means(
        "Time to simulate [s]; at least one revolution, up to {most}."
    )
    rolling_inertia: bool = entry(False, example=True).means(
        "true: solid balls that roll, inertia factor 7/5 (rollers 3/2); false: points. Default: {default}."
    )
    initial: Initial = Field(default_factory=Initial)
    race: Many[SceneRace] = entry(min_length=1, max_length=10).means(
        "Races and their balls: [[scene.race]], one or more."
    )


*_FIRST, _LAST = (f"{kind} ({each.about})" for kind, each in KINDS.items())
_OF_SUPPORTS: Final[dict[str, Any]] = {
    "support": (
        Literal[tuple(KINDS)],
        entry("planar").means(f"Support of the rotor: {', '.join(_FIRST)} or {_LAST}. Default: {{default}}."),
    ),
    **{key: (table | None, None) for kind in SUPPORTS for key, table in kind.keys.items()},
}


class SceneTable(create_model("_Scene", __base__=_SceneKeys, **_OF_SUPPORTS)):  # type: ignore[misc]
    """One simulation: the rotor, its support, its speed, how long and from where."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"mass_kg", *SPRINGS, "rolling_inertia"})

    effects: Effects = Field(default_factory=Effects)

    @model_validator(mode="after")
    def _support_has_its_numbers(self) -> Self:
        own = KINDS[self.support]
        for key in own.needs:
            if getattr(self, key) is None:
                given = f"{key} = …, such as {EXAMPLES[key]}" if key in EXAMPLES else f"[scene.{key}]"
                raise problem(f'support = "{self.support}" needs {key}', key, remedy=f"add {given}")
        for key in (*SPRINGS, *(key for kind in SUPPORTS for key in kind.keys)):
            if key not in own.needs and key not in own.keys and getattr(self, key) is not None:
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
    def _lasts_the_run_up(self) -> Self:
        if run_up := self.effects.run_up:
            needed = (run_up.time_s or 0.0) + (run_up.run_down_s or 0.0)
            if needed > self.duration_s:
                raise problem(
                    "the scene ends before the run-up and the run-down do",
                    "duration_s",
                    found=f"{self.duration_s:g} s",
                    allowed=f"at least {needed:g} s",
                )
        return self

    @model_validator(mode="after")
    def _only_a_spindle_that_tilts_has_places(self) -> Self:
        places: list[tuple[tuple[Part, ...], float]] = [
            (("race", index), race.plane_offset_mm) for index, race in enumerate(self.race)
        ]
        if contact := self.effects.grinding_contact:
            places.append((("effects", "grinding_contact"), contact.plane_offset_mm))
        for path, place in places:
            if place != 0 and self.support != "tilting":
                raise problem(
                    f'support = "{self.support}" knows no places along the spindle',
                    *(*path, "plane_offset_mm"),
                    found=f"{place:g} mm",
                    remedy='leave plane_offset_mm out, or use support = "tilting"',
                )
        return self

    @model_validator(mode="after")
    def _an_arm_has_its_own_start_and_contact(self) -> Self:
        if self.support != "swing-arm":
            return self
        for key in type(self.initial).model_fields:
            if getattr(self.initial, key) != 0:
                raise problem("a swing arm starts at rest where it stands", "initial", key, remedy=f"leave {key} out")
        arm = self.swing_arm
        for name, inertia in self.effects.rotor_inertias.items():
            if arm and inertia >= arm.moment_of_inertia_kg_m2:
                raise problem(
                    "the rotor has more inertia than the arm that carries it",
                    *("effects", name, "rotor_inertia_kg_m2"),
                    found=f"{inertia:g} kg·m²",
                    allowed=f"below swing_arm.moment_of_inertia_kg_m2, {arm.moment_of_inertia_kg_m2:g} kg·m²",
                )
        if self.effects.grinding_contact:
            raise problem(
                "a swing arm has its own contact with the work",
                *("effects", "grinding_contact"),
                remedy="write cutting = true in [scene.swing_arm] instead",
            )
        return self

    @model_validator(mode="after")
    def _balls_fit_their_race(self) -> Self:
        for index, race in enumerate(self.race):
            for name, radius in self.effects.ball_radii.items():
                if radius >= race.pitch_radius:
                    raise problem(
                        f"the balls are larger than race[{index}]",
                        *("effects", name, "ball_radius_mm"),
                        found=shown(radius, "mm", "g"),
                        allowed=f"below pitch_radius_mm, {race.pitch_radius_mm:g} mm",
                    )
                if race.ball_radius not in (None, radius):
                    raise problem(
                        "a ball has one radius",
                        *("race", index, "ball_radius_mm"),
                        found=f"{race.ball_radius_mm:g} mm, and {shown(radius, 'mm', 'g')} in {name}",
                        remedy="write the same radius, or leave it out here",
                    )
            if contact := self.effects.ball_contact:
                refuse_overlap(index, race, contact.ball_radius_mm)
        return self

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
    sweep: Sweep | None = None


@dataclass(frozen=True)
class SceneDescription(FileReading):
    """A scene file; `scene` is what stands in it, in the units people wrote."""

    __repr__ = FileReading.__repr__

    scene: SceneTable
    sweep: "Sweep | None" = None


def read_scene(
    source: str | os.PathLike[str] | Mapping[str, object], overrides: Sequence[str] = ()
) -> SceneDescription:
    """Reads a scene (a file, a TOML text, tables as a dictionary) with entries overridden (`scene.key=value`).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    with document_from(source) as document:
        return described_scene(document, parsed_overrides(overrides))


def read_any(source: str, overrides: Sequence[str] = ()) -> Machine | SceneDescription:
    """Reads a scene file, or a machine file, or a machine preset by its name: whichever it is."""
    document, replaced = open_document(source), parsed_overrides(overrides)
    if kind_of(document.content).name == "scene":
        return described_scene(document, replaced)
    return machine_from(document, replaced)


def described_scene(document: Document, overrides: "Sequence[Override]" = ()) -> SceneDescription:
    """The scene of a document that is open already; raises as `read_scene` does."""
    refuse_others(document, "scene")
    file, reading = validate(document, overrides, SceneFile, lambda _: SceneFile)
    return SceneDescription(**vars(reading), scene=file.scene, sweep=file.sweep)
