"""What a study of a scene works on: the scene of a scene file, or one of a machine that is sized."""

from dataclasses import dataclass
from pathlib import Path

from abu_calc.dynamics.scene import Scene
from abu_calc.errors import InputError, Place
from abu_calc.scenes.from_design import STARTS, contact_half_angle, scene_of_design
from abu_calc.scenes.from_scene import scene_from
from abu_calc.sizing import size
from abu_calc.spec.read import Machine
from abu_calc.spec.read_scene import SceneDescription


@dataclass(frozen=True)
class Subject:
    """A scene with all effects there is data for, and where it comes from.

    `half_angle` of touching balls [rad], 0 without size; `start`: how the balls start, in words.
    """

    title: str
    source: Machine | SceneDescription
    scene: Scene
    start: str
    half_angle: float
    warnings: tuple[str, ...]


def subject_of(source: Machine | SceneDescription, scene: str | None = None, start: str | None = None) -> Subject:
    """The scene of a file; which one (`idle` unless said) and how the balls start are asked of machines only."""
    if isinstance(source, Machine):
        return _of_machine(source, scene or "idle", start or "bunched")
    for option, value in (("--scene", scene), ("--start", start)):
        if value is not None:
            raise InputError(
                f"{option} is for machines; {source.file} holds one scene, given outright",
                remedy=f"Leave {option} out.",
            )
    return _of_scene(source)


def _of_machine(machine: Machine, scene: str, start: str) -> Subject:
    tables = machine.whole("simulate")
    if start not in STARTS:
        raise InputError(
            "not one of the known starts", place=Place(key="start"), found=start, allowed=", ".join(STARTS)
        )
    chosen = next(each for each in STARTS if each == start)
    with machine.located():
        design = size(tables)
        full = scene_of_design(design, scene, chosen)
    return Subject(
        title=tables.machine.name,
        source=machine,
        scene=full,
        start=STARTS[chosen],
        half_angle=contact_half_angle(design),
        warnings=(*machine.warnings, *design.warnings),
    )


def _of_scene(description: SceneDescription) -> Subject:
    with description.located():
        scene = scene_from(description.scene)
    return Subject(
        title=Path(description.file).name,
        source=description,
        scene=scene,
        start="as the file says",
        half_angle=0.0,
        warnings=description.warnings,
    )
