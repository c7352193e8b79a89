"""A scene file: one simulation given outright, the rules between its tables, and its reading.

`read_any` reads a file that may hold either a scene or a machine.
"""

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Literal, Self

from pydantic import Field, model_validator

from abu_calc.foundation.frozen import dataclass
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
from abu_calc.inputs.reading.table import Table, entry, problem
from abu_calc.inputs.reading.text import Part
from abu_calc.inputs.scene_effects import Effects
from abu_calc.inputs.scene_parts import (
    Body,
    DampingPair,
    SceneRace,
    SceneSwingArm,
    StiffnessPair,
    Tilting,
    refuse_overlap,
)
from abu_calc.inputs.variation import Sweep

if TYPE_CHECKING:
    from abu_calc.inputs.reading.overrides import Override

__all__ = ["Body", "Effects", "Initial", "SceneFile", "SceneRace", "SceneSwingArm", "SceneTable", "Tilting"]

Place = Annotated[float, Field(ge=-1e6, le=1e6)]
Velocity = Annotated[float, Field(ge=-1e9, le=1e9)]

SPRINGS: Final = ("stiffness_N_per_m", "damping_N_s_per_m")
NEEDED: Final = {
    "planar": ("mass_kg", *SPRINGS),
    "tilting": ("mass_kg", "tilting"),
    "swing-arm": ("swing_arm",),
}
REFUSED: Final = {
    "planar": ("tilting", "swing_arm"),
    "tilting": (*SPRINGS, "swing_arm", "body"),
    "swing-arm": (*SPRINGS, "tilting", "body"),
}
EXAMPLES: Final = {
    "mass_kg": "1.0",
    "stiffness_N_per_m": "[1.0, 1.0]",
    "damping_N_s_per_m": "[0.02, 0.02]",
}


class Initial(Table):
    """Position and velocity of the axis at t = 0; on a tilting support at its centre of mass. A swing arm starts
    at rest.
    """

    x_mm: Place = Field(default=0.0, description="Place along x [mm]; {range}. Default: {default}.")
    y_mm: Place = Field(default=0.0, description="Place along y [mm]; {range}. Default: {default}.")
    vx_mm_per_s: Velocity = Field(default=0.0, description="Velocity along x [mm/s]; {range}. Default: {default}.")
    vy_mm_per_s: Velocity = Field(default=0.0, description="Velocity along y [mm/s]; {range}. Default: {default}.")


class SceneTable(Table):
    """One simulation: the rotor, its support, its speed, how long and from where."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"mass_kg", *SPRINGS, "rolling_inertia"})

    support: Literal["planar", "tilting", "swing-arm"] = entry("planar").means(
        "Support of the rotor: planar (springs along x and y), tilting (a rigid rotor on bearings, [scene.tilting]) or "
        "swing-arm ([scene.swing_arm]). Default: {default}."
    )
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
    race: Annotated[tuple[SceneRace, ...], Field(strict=False, min_length=1, max_length=10)] = entry().means(
        "Races and their balls: [[scene.race]], one or more."
    )
    body: Body | None = None
    tilting: Tilting | None = None
    swing_arm: SceneSwingArm | None = None
    effects: Effects = Field(default_factory=Effects)

    @model_validator(mode="after")
    def _support_has_its_numbers(self) -> Self:
        for key in NEEDED[self.support]:
            if getattr(self, key) is None:
                given = f"{key} = …, such as {EXAMPLES[key]}" if key in EXAMPLES else f"[scene.{key}]"
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
            for name, radius in self.effects.ball_radii_mm.items():
                if radius >= race.pitch_radius_mm:
                    raise problem(
                        f"the balls are larger than race[{index}]",
                        *("effects", name, "ball_radius_mm"),
                        found=f"{radius:g} mm",
                        allowed=f"below pitch_radius_mm, {race.pitch_radius_mm:g} mm",
                    )
                if race.ball_radius_mm not in (None, radius):
                    raise problem(
                        "a ball has one radius",
                        *("race", index, "ball_radius_mm"),
                        found=f"{race.ball_radius_mm:g} mm, and {radius:g} mm in {name}",
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

    def changed(self, values: Mapping[str, object]) -> "SceneDescription":
        """The scene with entries of its file replaced, by key path: `changed({"scene.speed_rpm": 5800.0})`.

        Checked as if the file said so; raises InputError with key, what was found, and what is allowed.
        """
        from abu_calc.inputs.reading.overrides import following, overrides_of

        return scene_from(self.document, following(self.overrides, overrides_of(values), SceneFile))


def read_scene(
    source: str | os.PathLike[str] | Mapping[str, object], overrides: Sequence[str] = ()
) -> SceneDescription:
    """Reads a scene (a file, a TOML text, tables as a dictionary) with entries overridden (`scene.key=value`).

    Raises InputError for whatever is wrong, with file, line, key and remedy; several faults come as SpecErrors.
    """
    with document_from(source) as document:
        return scene_from(document, parsed_overrides(overrides))


def read_any(source: str, overrides: Sequence[str] = ()) -> Machine | SceneDescription:
    """Reads a scene file, or a machine file, or a machine preset by its name: whichever it is."""
    document, replaced = open_document(source), parsed_overrides(overrides)
    if kind_of(document.content).name == "scene":
        return scene_from(document, replaced)
    return machine_from(document, replaced)


def scene_from(document: Document, overrides: "Sequence[Override]" = ()) -> SceneDescription:
    """The scene of a document that is open already; raises as `read_scene` does."""
    refuse_others(document, "scene")
    file, reading = validate(document, overrides, SceneFile, lambda _: SceneFile)
    return SceneDescription(**vars(reading), scene=file.scene, sweep=file.sweep)
