"""What `abu simulate`, `stability`, `effects`, `accuracy` are asked of: options that several commands share."""

from collections.abc import Sequence
from typing import Annotated, Final

import typer

from abu_calc.errors import InputError, Place

SCENES: Final = ("idle", "grinding", "run-up", "swing-arm-idle", "swing-arm-cutting")

File = Annotated[
    str, typer.Argument(metavar="MACHINE|SCENE", help="A machine file, the name of a preset, or a scene file.")
]
WhichScene = Annotated[str | None, typer.Option("--scene", help=f"Of a machine: {', '.join(SCENES)}.")]
WhichStart = Annotated[
    str | None, typer.Option("--start", help="Balls of a machine: bunched (default), spread, standstill.")
]


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
