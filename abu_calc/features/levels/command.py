"""`abu levels FILE.csv|.wav`, or MACHINE|SCENE: octave levels, weighted acceleration, daily exposure."""

from typing import Annotated, Final

import typer

from abu_calc.cli.command import Accuracy, Overrides, WhichStart, add_command
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome

RECORDING: Final = "Recording"
"""Panel of the options about a recorded signal."""


def levels(
    how: Delivery,
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE.csv|FILE.wav|MACHINE|SCENE", help="Recorded signal, or machine or scene to simulate."
        ),
    ],
    set_: Overrides = None,
    quantity: Annotated[
        str | None,
        typer.Option(
            "--quantity",
            metavar="NAME",
            help="Recorded quantity, if the file gives none: acceleration, velocity or displacement.",
            rich_help_panel=RECORDING,
        ),
    ] = None,
    scale: Annotated[
        float | None,
        typer.Option(
            "--scale",
            metavar="FACTOR",
            help="SI value (m/s², m/s, m) of one unit of the file; for WAV, of full scale.",
            rich_help_panel=RECORDING,
        ),
    ] = None,
    channels: Annotated[
        str | None,
        typer.Option("--channels", metavar="1,2|NAMES", help="Columns or channels to use.", rich_help_panel=RECORDING),
    ] = None,
    from_s: Annotated[
        float | None,
        typer.Option(
            "--from", metavar="S", help="Leave this many first seconds out of the means.", rich_help_panel=RECORDING
        ),
    ] = None,
    minutes: Annotated[
        float | None, typer.Option("--minutes", metavar="MIN", help="Minutes of work a day, for A(8).")
    ] = None,
    scene: Annotated[
        str | None, typer.Option("--scene", metavar="NAME", help="Scene of a machine: idle (default) or grinding.")
    ] = None,
    start: WhichStart = None,
    accuracy: Accuracy = 0.01,
    duration_s: Annotated[
        float | None, typer.Option("--duration", metavar="S", help="Simulate this many seconds.")
    ] = None,
) -> Outcome:
    """Calculate octave-band levels, weighted acceleration, daily exposure.

    Levels are compared with their limits.
    """
    from abu_calc.features.levels.study import levels as study
    from abu_calc.features.levels.view import levels_blocks, levels_screen
    from abu_calc.foundation.errors import InputError, Place
    from abu_calc.inputs.recording_files import is_recording, read_recording
    from abu_calc.inputs.scene import read_any

    picked = tuple(part.strip() for part in (channels or "").split(",") if part.strip())
    if is_recording(source):
        if set_:
            raise InputError("for machines and scenes only", place=Place(key="--set"), remedy="Leave it out.")
        given = read_recording(source, quantity, scale, picked)
        result = study(given, scene, start=start, minutes=minutes, from_s=from_s, duration_s=duration_s)
    else:
        with progress(how) as tell:
            result = study(
                read_any(source, set_ or ()),
                scene,
                quantity=quantity,
                scale=scale,
                channels=picked,
                minutes=minutes,
                from_s=from_s,
                start=start,
                accuracy=accuracy,
                duration_s=duration_s,
                progress=tell,
            )
    return Outcome.of(result, lambda: levels_blocks(result), lambda: levels_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "levels", levels, simulates=True)
