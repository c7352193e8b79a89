"""`abu levels FILE.csv|.wav`, or MACHINE|SCENE: octave levels, weighted acceleration, daily exposure."""

from collections.abc import Sequence
from typing import Final

from abu_calc.cli.command import ACCURACY, DURATION, REQUIRED, SET, START, Command, Option
from abu_calc.foundation.errors import InputError, Place

RECORDING: Final = "Recording"
"""Panel of the options about a recorded signal."""


def _signal(source: str, overrides: Sequence[str]) -> object:
    """Name of a recording, or the machine or scene of a file."""
    from abu_calc.inputs.recording_files import is_recording
    from abu_calc.simulation.scene_file import read_any

    recorded = is_recording(source)
    if recorded and overrides:
        raise InputError("for machines and scenes only", place=Place(key="--set"), remedy="Leave it out.")
    return source if recorded else read_any(source, overrides)


def _channels(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(",") if part.strip())


def _handles(given: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Channels by handle, of texts such as "front=1,2,3"."""
    handles: dict[str, tuple[str, ...]] = {}
    for text in given:
        name, equals, channels = text.partition("=")
        if not equals or name.strip() in handles:
            raise InputError(
                "the same handle twice" if equals else "a handle needs a name and its channels",
                place=Place(key="--handle"),
                found=text,
                remedy="--handle front=1,2,3 --handle rear=4,5,6",
            )
        handles[name.strip()] = _channels(channels)
    return handles


COMMAND = Command(
    "levels.study:levels",
    (
        Option(
            "source",
            str,
            "FILE.csv|FILE.wav|MACHINE|SCENE",
            "Recorded signal, or machine or scene to simulate.",
            default=REQUIRED,
            reads=_signal,
        ),
        SET,
        Option(
            "quantity",
            str,
            "--quantity NAME",
            "Recorded quantity, if the file gives none: acceleration, velocity or displacement.",
            RECORDING,
        ),
        Option(
            "scale",
            float,
            "--scale FACTOR",
            "SI value (m/s², m/s, m) of one unit of the file; for WAV, of full scale.",
            RECORDING,
        ),
        Option("channels", str, "--channels 1,2|NAMES", "Columns or channels to use.", RECORDING, converts=_channels),
        Option("from_s", float, "--from S", "Leave the first seconds out of the means.", RECORDING),
        Option("rate_hz", float, "--rate HZ", "Samples a second of a file without times.", RECORDING),
        Option("time", str, "--time COLUMN[:UNIT]", "Column of times; unit s, ms, us, ns or min.", RECORDING),
        Option("skip", int, "--skip LINES", "Leave this many first lines out.", RECORDING),
        Option(
            "sensitivity",
            list[str],
            "--sensitivity [CHANNEL=]VALUE",
            'Sensitivity of a sensor in V or mV: mV per m/s², or "100 mV/g". Repeatable.',
            RECORDING,
        ),
        Option(
            "full_scale_mV",
            float,
            "--full-scale-mV MV",
            "Voltage at full scale of a WAV file, with --sensitivity.",
            RECORDING,
        ),
        Option(
            "handles",
            list[str],
            "--handle NAME=1,2,3",
            "Columns or channels at a handle. Repeatable.",
            RECORDING,
            converts=_handles,
        ),
        Option("third_octaves", bool, "--third-octaves", "Calculate third octaves beside octaves."),
        Option("minutes", float, "--minutes MIN", "Minutes of work a day, for A(8)."),
        Option("scene", str, "--scene NAME", "Scene of a machine: idle (default) or grinding."),
        *(START, ACCURACY, DURATION),
    ),
    "Levels are compared with their limits.",
    simulates=True,
)
