"""`abu levels FILE.csv|.wav`, or MACHINE|SCENE: octave levels, weighted acceleration, daily exposure."""

from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.cli.command import Accuracy, Overrides, WhichStart, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.levels.study import LevelsResult

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
        option(
            "--quantity NAME",
            "Recorded quantity, if the file gives none: acceleration, velocity or displacement.",
            RECORDING,
        ),
    ] = None,
    scale: Annotated[
        float | None,
        option("--scale FACTOR", "SI value (m/s², m/s, m) of one unit of the file; for WAV, of full scale.", RECORDING),
    ] = None,
    channels: Annotated[str | None, option("--channels 1,2|NAMES", "Columns or channels to use.", RECORDING)] = None,
    from_s: Annotated[float | None, option("--from S", "Leave the first seconds out of the means.", RECORDING)] = None,
    rate_hz: Annotated[
        float | None, option("--rate HZ", "Samples a second of a file without times.", RECORDING)
    ] = None,
    time: Annotated[
        str | None,
        option("--time COLUMN[:UNIT]", "Column of times; unit s, ms, us, ns or min.", RECORDING),
    ] = None,
    skip: Annotated[int | None, option("--skip LINES", "Leave this many first lines out.", RECORDING)] = None,
    sensitivity: Annotated[
        list[str] | None,
        option(
            "--sensitivity [CHANNEL=]VALUE",
            'Sensitivity of a sensor in V or mV: mV per m/s², or "100 mV/g". Repeatable.',
            RECORDING,
        ),
    ] = None,
    full_scale_mv: Annotated[
        float | None,
        option("--full-scale-mV MV", "Voltage at full scale of a WAV file, with --sensitivity.", RECORDING),
    ] = None,
    handle: Annotated[
        list[str] | None, option("--handle NAME=1,2,3", "Columns or channels at a handle. Repeatable.", RECORDING)
    ] = None,
    third_octaves: Annotated[bool, option("--third-octaves", "Calculate third octaves beside octaves.")] = False,
    minutes: Annotated[float | None, option("--minutes MIN", "Minutes of work a day, for A(8).")] = None,
    scene: Annotated[str | None, option("--scene NAME", "Scene of a machine: idle (default) or grinding.")] = None,
    start: WhichStart = None,
    accuracy: Accuracy = 0.01,
    duration_s: Annotated[float | None, option("--duration S", "Simulate this many seconds.")] = None,
) -> Outcome:
    """Calculate octave-band levels, weighted acceleration, daily exposure.

    Levels are compared with their limits.
    """
    from abu_calc.features.levels.study import levels as study
    from abu_calc.foundation.errors import InputError, Place
    from abu_calc.inputs.recording_files import is_recording
    from abu_calc.simulation.scene_file import read_any

    recorded, handles = is_recording(source), _handles(handle)
    if recorded and set_:
        raise InputError("for machines and scenes only", place=Place(key="--set"), remedy="Leave it out.")
    with progress(how) as tell:
        result = study(
            source if recorded else read_any(source, set_ or ()),
            scene,
            quantity=quantity,
            scale=scale,
            channels=_channels(channels),
            sensitivity=sensitivity,
            handles=handles,
            full_scale_mV=full_scale_mv,
            third_octaves=third_octaves,
            minutes=minutes,
            from_s=from_s,
            rate_hz=rate_hz,
            time=time,
            skip=skip or 0,
            start=start,
            accuracy=accuracy,
            duration_s=duration_s,
            progress=tell,
        )
    return outcome_of(result)


def _channels(text: str | None) -> tuple[str, ...]:
    return tuple(part.strip() for part in (text or "").split(",") if part.strip())


def _handles(given: list[str] | None) -> dict[str, tuple[str, ...]] | None:
    """Channels by handle, of texts such as "front=1,2,3"; None without any."""
    from abu_calc.foundation.errors import InputError, Place

    handles: dict[str, tuple[str, ...]] = {}
    for text in given or ():
        name, equals, channels = text.partition("=")
        if not equals or name.strip() in handles:
            raise InputError(
                "the same handle twice" if equals else "a handle needs a name and its channels",
                place=Place(key="--handle"),
                found=text,
                remedy="--handle front=1,2,3 --handle rear=4,5,6",
            )
        handles[name.strip()] = _channels(channels)
    return handles or None


def outcome_of(result: "LevelsResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.levels.view import levels_blocks, levels_screen

    return Outcome.of(result, lambda: levels_blocks(result), lambda: levels_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "levels", levels, simulates=True)
