"""Options that several commands about scenes share; a parameter is called like the argument of the study it becomes."""

from typing import Annotated, Final

import typer

SCENES: Final = ("idle", "grinding", "run-up", "swing-arm-idle", "swing-arm-cutting")
"""Scenes of a machine; written out here so that `--help` loads no numerics."""

File = Annotated[
    str, typer.Argument(metavar="MACHINE|SCENE", help="A machine file, the name of a preset, or a scene file.")
]
WhichScene = Annotated[str | None, typer.Option("--scene", help=f"Of a machine: {', '.join(SCENES)}.")]
WhichStart = Annotated[
    str | None, typer.Option("--start", help="Balls: bunched (default), behind, spread, standstill, settled.")
]
Accuracy = Annotated[float, typer.Option("--accuracy", help="Accuracy asked of the results.")]
Duration = Annotated[float | None, typer.Option("--duration", metavar="S", help="Seconds to simulate.")]
With = Annotated[list[str] | None, typer.Option("--with", metavar="EFFECT", help="Take an effect in; repeatable.")]
Without = Annotated[list[str] | None, typer.Option("--without", metavar="EFFECT", help="Leave one out; repeatable.")]
