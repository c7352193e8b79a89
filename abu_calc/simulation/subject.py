"""Subject of a scene's study: a scene of a sized machine, of a scene file, or made in a script.

All keep every effect there is data for. The estimated influence of the effects decides which of them are simulated, see
`Subject.ledger`.
"""

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Final

from abu_calc.dynamics.scene import Scene
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown, to_si
from abu_calc.foundation.validity import Range
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.document import FileReading
from abu_calc.simulation.arguments import check_effects, one_of
from abu_calc.simulation.durations import lasting
from abu_calc.simulation.effect_selection import Ledger, chosen
from abu_calc.simulation.result import Provenance
from abu_calc.simulation.scene_file import SceneDescription
from abu_calc.simulation.scene_of_design import SCENES, STARTS, WORST, scene_of_design
from abu_calc.simulation.scene_of_file import scene_from
from abu_calc.sizing import size
from abu_calc.sizing.design import Design

RACE_CENTRE: Final = Range("angle of the race's centre from the imbalance", -360, 360, "deg", key="race_centre_deg")

Source = Machine | SceneDescription | Scene
"""A machine's file, a scene file, or a scene in SI."""


@dataclass(frozen=True)
class Subject:
    """A scene with all effects there is data for, and where it comes from.

    `half_angle` of touching balls [rad], 0 without size; `start`: how the balls start, in words; `reading`: the file,
    if there is one; `design`: that of a machine.
    """

    title: str
    reading: FileReading | None
    scene: Scene
    start: str
    half_angle: float = 0.0
    warnings: tuple[str, ...] = ()
    design: Design | None = None

    @property
    def provenance(self) -> Provenance:
        """Provenance of a result about it."""
        return Provenance.today() if self.reading is None else Provenance.of(self.reading)

    def located(self) -> AbstractContextManager[None]:
        """Gives errors that know only a key the file and the line they come from."""
        return nullcontext() if self.reading is None else self.reading.located()

    def lasting(self, duration_s: float | None) -> "Subject":
        """Subject with another duration, if one is given; refused if it is longer than can be integrated."""
        if duration_s is not None:
            return replace(self, scene=lasting(self.scene, duration_s, "duration_s"))
        with self.located():
            return replace(self, scene=lasting(self.scene, None, "scene.duration_s"))

    def ledger(self, accuracy: float, with_effects: Sequence[str] = (), without_effects: Sequence[str] = ()) -> Ledger:
        """The scene with the effects it calls for, and why."""
        present = [effect.name for effect in self.scene.effects]
        check_effects(present, with_effects, without_effects, machine=self.design is not None)
        with self.located():
            return chosen(self.scene, accuracy, with_effects, without_effects)


def checked_centre(race_centre_deg: float | None, usual: float) -> float:
    """Angle of the race's centre [rad]: the one asked for, else the usual one."""
    return usual if race_centre_deg is None else to_si(RACE_CENTRE.check(race_centre_deg), "deg")


def subject_of(
    source: Source, scene: str | None = None, start: str | None = None, *, race_centre_deg: float | None = None,
    command: str = "simulate",
) -> Subject:  # fmt: skip
    """Subject of a source; only machines take a scene (by default `idle`) and a start case of the balls.

    `race_centre_deg`: angle of the race's centre from the imbalance, for machines only, by default 180.
    `command`: the study that asks, as its command is called.
    """
    one_of("scene", scene, SCENES)
    one_of("start", start, STARTS)
    if isinstance(source, Machine):
        centre = checked_centre(race_centre_deg, WORST)
        return _of_machine(source, scene or "idle", start, centre, command)
    subject = _of_file(source) if isinstance(source, SceneDescription) else _of_script(source)
    for argument, value in (("scene", scene), ("start", start), ("race_centre_deg", race_centre_deg)):
        if value is not None:
            raise InputError(
                f"for machines only; {subject.title} is one scene, given outright",
                place=Place(key=argument),
                found=str(value),
                remedy="Leave it out.",
            )
    return subject


def _of_machine(machine: Machine, scene: str, start: str | None, race_centre: float, command: str) -> Subject:
    tables = machine.whole(command)
    usual = "bunched" if tables.start is None else "placed"
    chosen_start = next(each for each in STARTS if each == (start or usual))
    with machine.located():
        design = size(tables)
        full = scene_of_design(design, scene, chosen_start, race_centre)
    off = f"; centre of the race {shown(race_centre, 'deg', '.4g')} from the imbalance"
    return Subject(
        title=tables.machine.name,
        reading=machine,
        scene=full,
        start=STARTS[chosen_start] + (off if design.case.race_eccentricity else ""),
        half_angle=design.autobalancer.half_angle,
        warnings=(*machine.warnings, *design.warnings),
        design=design,
    )


def _of_file(description: SceneDescription) -> Subject:
    with description.located():
        scene = scene_from(description.scene)
    title, start = Path(description.file).name, "as the file says"
    return Subject(title, description, scene, start, warnings=description.warnings)


def _of_script(scene: Scene) -> Subject:
    return Subject(scene.name, None, scene, "as the scene says")
