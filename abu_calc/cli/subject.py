"""What `abu simulate`, `stability`, `effects` work on: the scene of a scene file, or of a machine that is sized."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.errors import InputError, Place

if TYPE_CHECKING:
    from abu_calc.dynamics.scene import Scene
    from abu_calc.spec.document import Reading
    from abu_calc.spec.read import Loaded
    from abu_calc.spec.read_scene import LoadedScene

SCENES: Final = ("idle", "grinding", "run-up", "swing-arm-idle", "swing-arm-cutting")

File = Annotated[
    str, typer.Argument(metavar="MACHINE|SCENE", help="A machine file, the name of a preset, or a scene file.")
]
WhichScene = Annotated[str | None, typer.Option("--scene", help=f"Of a machine: {', '.join(SCENES)}.")]
WhichStart = Annotated[
    str | None, typer.Option("--start", help="Balls of a machine: bunched (default), spread, standstill.")
]


@dataclass(frozen=True)
class Subject:
    """A scene with all effects there is data for, and where it comes from.

    `half_angle` of touching balls [rad], 0 without size.
    """

    title: str
    source: "Reading"
    scene: "Scene"
    start: str
    half_angle: float
    warnings: tuple[str, ...]


def subject_of(
    file: str, overrides: Sequence[str] | None, scene: str | None = None, start: str | None = None
) -> Subject:
    """Read the file and make its scene; `scene` and `start` are for machines only."""
    from abu_calc.cli.load import load_any
    from abu_calc.scenes.from_design import STARTS
    from abu_calc.spec.read import Loaded

    one_of("--scene", scene, SCENES)
    one_of("--start", start, tuple(STARTS))
    loaded = load_any(file, overrides)
    if isinstance(loaded, Loaded):
        return _of_machine(loaded, scene or "idle", start or "bunched")
    for option, value in (("--scene", scene), ("--start", start)):
        if value is not None:
            raise InputError(
                f"{option} is for machines; {loaded.file} holds one scene, given outright",
                remedy=f"Leave {option} out.",
            )
    return _of_scene(loaded)


def one_of(option: str, value: str | None, allowed: Sequence[str]) -> None:
    """Refuse a word that is not allowed."""
    from abu_calc.spec.names import nearest

    if value is None or value in allowed:
        return
    close = nearest(value, list(allowed))
    remedy = f'The nearest is "{close}".' if close else None
    raise InputError(
        "not one of the known words", place=Place(key=option), found=value, allowed=", ".join(allowed), remedy=remedy
    )


def _of_machine(loaded: "Loaded", scene: str, start: str) -> Subject:
    from abu_calc.cli.load import located, machine_of
    from abu_calc.scenes.from_design import STARTS, contact_half_angle, scene_of_design
    from abu_calc.sizing import size

    machine = machine_of(loaded, "simulate")
    chosen = next(each for each in STARTS if each == start)
    with located(loaded):
        design = size(machine)
        full = scene_of_design(design, scene, chosen)
    return Subject(
        title=machine.machine.name,
        source=loaded,
        scene=full,
        start=STARTS[chosen],
        half_angle=contact_half_angle(design),
        warnings=(*loaded.warnings, *design.warnings),
    )


def _of_scene(loaded: "LoadedScene") -> Subject:
    from abu_calc.cli.load import located
    from abu_calc.scenes.from_scene import scene_from

    with located(loaded):
        scene = scene_from(loaded.scene)
    return Subject(
        title=Path(loaded.file).name,
        source=loaded,
        scene=scene,
        start="as the file says",
        half_angle=0.0,
        warnings=loaded.warnings,
    )
