"""What `abu simulate` and `abu stability` work on: the scene of a scene file, or of a machine that is sized first."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.errors import InputError, Place

if TYPE_CHECKING:
    from abu_calc.analysis.idle import LeftOut
    from abu_calc.analysis.response import Response
    from abu_calc.dynamics.scene import Scene
    from abu_calc.spec.document import Reading
    from abu_calc.spec.read import Loaded
    from abu_calc.spec.read_scene import LoadedScene

SCENES: Final = ("idle", "grinding", "run-up", "swing-arm-idle", "swing-arm-cutting")
SIMULATED: Final = ("idle",)

File = Annotated[
    str, typer.Argument(metavar="MACHINE|SCENE", help="A machine file, the name of a preset, or a scene file.")
]


@dataclass(frozen=True)
class Subject:
    """A scene, where it comes from, and what it leaves out; `half_angle` of touching balls [rad], 0 without size."""

    title: str
    source: "Reading"
    scene: "Scene"
    start: str
    half_angle: float
    left_out: "Callable[[Response], tuple[LeftOut, ...]]"
    warnings: tuple[str, ...]


def subject_of(
    file: str, overrides: Sequence[str] | None, scene: str | None = None, start: str | None = None
) -> Subject:
    """Read the file and make its scene; `scene` and `start` are for machines only."""
    from abu_calc.cli.load import load_any
    from abu_calc.dynamics.from_design import STARTS
    from abu_calc.spec.read import Loaded

    one_of("--scene", scene, SIMULATED, SCENES)
    one_of("--start", start, tuple(STARTS))
    loaded = load_any(file, overrides)
    if isinstance(loaded, Loaded):
        return _of_machine(loaded, start or "bunched")
    for option, value in (("--scene", scene), ("--start", start)):
        if value is not None:
            raise InputError(
                f"{option} is for machines; {loaded.file} holds one scene, given outright",
                remedy=f"Leave {option} out.",
            )
    return _of_scene(loaded)


def one_of(option: str, value: str | None, allowed: Sequence[str], later: Sequence[str] = ()) -> None:
    """Refuse a word that is not allowed; one of `later` is known, but not simulated yet."""
    from abu_calc.spec.names import nearest

    if value is None or value in allowed:
        return
    close = nearest(value, [*allowed, *later])
    message = f"{value} is not simulated in this version" if value in later else "not one of the known words"
    remedy = f'The nearest is "{close}".' if close and close != value else None
    raise InputError(message, place=Place(key=option), found=value, allowed=", ".join(allowed), remedy=remedy)


def _of_machine(loaded: "Loaded", start: str) -> Subject:
    from abu_calc.analysis.idle import left_out
    from abu_calc.cli.load import located, machine_of
    from abu_calc.dynamics.from_design import STARTS, contact_half_angle, idle_scene
    from abu_calc.sizing import size

    machine = machine_of(loaded, "simulate")
    chosen = next(each for each in STARTS if each == start)
    with located(loaded):
        design = size(machine)
        scene = idle_scene(design, chosen)
        if scene is None:
            raise InputError(
                "the scene idle is not simulated on this suspension in this version",
                place=Place(key="suspension.model"),
                found=machine.suspension.model,
                allowed="springs",
            )
    return Subject(
        title=machine.machine.name,
        source=loaded,
        scene=scene,
        start=STARTS[chosen],
        half_angle=contact_half_angle(design),
        left_out=lambda response: left_out(design, response),
        warnings=(*loaded.warnings, *design.warnings),
    )


def _of_scene(loaded: "LoadedScene") -> Subject:
    from abu_calc.analysis.idle import LeftOut
    from abu_calc.cli.load import located
    from abu_calc.dynamics.from_scene import scene_from

    with located(loaded):
        scene = scene_from(loaded.scene)
    names = loaded.scene.effects.names
    absent = tuple(LeftOut(name, None, "not simulated in this version") for name in names)
    told = f"Not simulated in this version, though the file asks for it: {', '.join(names)}."
    return Subject(
        title=Path(loaded.file).name,
        source=loaded,
        scene=scene,
        start="as the file says",
        half_angle=0.0,
        left_out=lambda _: absent,
        warnings=(*loaded.warnings, *([told] if names else [])),
    )
