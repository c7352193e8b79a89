"""Reading of a recorded motion from a CSV or a WAV file.

CSV: a column of time, and columns of a motion with their units, or of a voltage with the sensitivity of its sensor.
WAV: samples of whole numbers or floats, full scale ±1; a scale gives their quantity. The kind of a file and its faults
are told before it is looked into.
"""

import io
import math
import os
import struct
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import GRAVITY
from abu_calc.inputs.reading.sources import regular_file
from abu_calc.inputs.reading.values_with_units import found_as
from abu_calc.inputs.recording import LARGEST as LARGEST_SAMPLE
from abu_calc.inputs.recording import (
    MOST_AXES,
    RATE,
    Recording,
    RecordingOptions,
    chosen,
    flat_tops,
    recording,
    rises,
    timing,
)
from abu_calc.inputs.recording_columns import (
    MOTION,
    QUANTITIES,
    MotionQuantity,
    RecordingColumn,
    column_of,
    plain_unit,
)
from abu_calc.inputs.recording_table import Lines, decoded, table_of
from abu_calc.inputs.sensitivity import Sensitivity, sensitivities, sensitivity_of


def csv_recording(path: str, content: bytes, asked: RecordingOptions) -> Recording:
    """The recording of a CSV file."""
    remarks: list[str] = []
    table = table_of(path, decoded(path, content), remarks, asked.skip)
    columns = [column_of(name) for name in table.names]
    columns = [
        replace(column, is_time=False, unit=None)
        if column.is_time and not (k in table.clocks or rises(table, k))
        else column
        for k, column in enumerate(columns)
    ]
    times = timing(table, columns, asked, remarks)
    table = replace(table, values=table.values[: times.rows], numbers=table.numbers[: times.rows])
    simulated = {"x_mm", "y_mm", "ball1_deg"} <= set(table.names)
    others = [k for k in range(len(columns)) if k != times.column]
    picked = _picked(table, columns, others, asked, remarks, simulated=simulated)
    taken = [replace(columns[k], unit=None) if columns[k].is_time else columns[k] for k in picked]
    sensors = [_sensor(table, columns[k], others.index(k) + 1, asked) for k in picked]
    _all_used(path, asked, [column.name for column in taken], sensors, remarks)
    quantity = _quantity(path, taken, sensors, asked, remarks)
    handles = asked.handle_names() or _handles(table, taken, remarks)
    taken, assumed = _units(table, picked, taken, quantity, asked, remarks)
    with np.errstate(over="ignore", invalid="ignore"):  # samples that large are refused below
        axes = [
            (column.name, table.values[:, k] * _unit(column, sensor, asked, remarks))
            for k, column, sensor in zip(picked, taken, sensors, strict=True)
        ]
        clipped = [(name, _clipped(values)) for name, values in axes]
    for name, cut in clipped:
        if cut is not None:
            remarks.append(
                f"{name} stays at its largest value again and again, first on line {table.numbers[cut]}: a recording "
                "that is clipped reads too low."
            )
    for name, values in axes:
        strange = _spike(values)
        if strange is not None:
            remarks.append(
                f"{name}: the sample on line {table.numbers[strange]} alone makes a part of the level. Is the file at "
                "fault?"
            )
    cut_off = [name for name, cut in clipped if cut is not None]
    return recording(
        path, content, quantity, axes, times.rate, remarks,
        simulated=simulated, handles=handles, clipped=cut_off, assumed=assumed,
    )  # fmt: skip


def _spike(values: NDArray[np.float64]) -> int | None:
    """Index of a sample that alone makes a fiftieth of the power, far above all others; None without one."""
    largest = float(np.abs(values).max())
    if not 0 < largest <= LARGEST_SAMPLE:
        return None
    power = ((values - np.median(values)) / largest) ** 2
    k = int(np.argmax(power))
    return k if power[k] > max(0.02, 30 / len(power)) * float(power.sum()) else None


GRAVITIES: Final = ((1.0, GRAVITY, "g"), (GRAVITY, 1.0, "m/s²"), (1000.0, GRAVITY / 1000, "mg"),
                    (1000 * GRAVITY, 1e-3, "mm/s²"))  # fmt: skip
"""What three axes at rest show of gravity, by the unit [SI] of their numbers."""
NEAR: Final = 0.06
"""Share by which a sensor's gravity may be off."""


def _units(
    table: Lines, picked: Sequence[int], columns: Sequence[RecordingColumn], quantity: MotionQuantity,
    asked: RecordingOptions, remarks: list[str],
) -> tuple[list[RecordingColumn], str]:  # fmt: skip
    """Columns, each with a unit: as named, else as gravity tells, else in SI; and what is assumed then.

    Refused are units that are not known, and a range of the sensor without a unit.
    """
    unnamed = [column for column in columns if column.unit is None and column.volts is None]
    if asked.scale is not None or not unnamed:
        return list(columns), ""
    names = ", ".join(column.name for column in unnamed)
    strange = next((column for column in unnamed if column.unknown_unit), None)
    if strange is not None:
        raise InputError(
            "a column with a unit that is not known", place=Place(table.path, table.head, strange.name),
            found=strange.unknown_unit, allowed="m/s², mm/s², g, mg, mm/s, m/s, µm, mm, mV, V and the like",
            remedy="Convert the column, or give --scale, SI per unit of the file, with --quantity if it is no "
            "acceleration (Python: scale=, quantity=).",
        )  # fmt: skip
    size, assumed, told_by = 1.0, "", MOTION.get(plain_unit(table.unit))
    pull = math.hypot(*(float(table.values[:, k].mean()) for k in picked)) if len(picked) == MOST_AXES else 0.0
    told = [each for each in GRAVITIES if quantity == "acceleration" and abs(pull / each[0] - 1) < NEAR]
    if told_by is not None and told_by[0] == quantity:
        size = told_by[1]
        remarks.append(f"{names} are taken in {table.unit}, as a line above tells.")
    elif told:
        [(_, size, unit)] = told
        remarks.append(f"{names} name no unit; their means are one gravity in {unit}, so they are taken in {unit}.")
    elif ranged := next((column for column in unnamed if column.range), None):
        raise InputError(
            "a column names the range of its sensor and no unit", place=Place(table.path, table.head, ranged.name),
            found=f"({ranged.range})", remedy="Say the unit: --scale 9.80665 for numbers in g, --scale 1 for m/s² "
            "(Python: scale=).",
        )  # fmt: skip
    else:
        unit = {"acceleration": "m/s²", "velocity": "m/s", "displacement": "m"}[quantity]
        verb = "names no unit and is" if len(unnamed) == 1 else "name no unit and are"
        assumed = f"{names} {verb} taken in {unit}; --scale says otherwise."
        remarks.append(assumed)
    return [replace(column, unit=size) if column in unnamed else column for column in columns], assumed


def _handles(table: Lines, columns: Sequence[RecordingColumn], remarks: list[str]) -> tuple[str, ...]:
    """Handle of each column by its name; empty if the names tell none. Refused if only some names tell one."""
    handles = tuple(column.place for column in columns)
    if len(set(handles)) == 1:  # a word that all have tells no place
        if len(columns) > 1 and not all(column.names_axis for column in columns):
            remarks.append(
                f"{', '.join(column.name for column in columns)} are taken for axes of one place; --handle says "
                "otherwise."
            )
        return ()
    if "" in handles:
        raise InputError(
            "columns with and without the name of a handle", place=Place(table.path, table.head),
            found=", ".join(column.name for column in columns),
            remedy="Say which belong together: --handle front=1,2,3 --handle rear=4,5,6 (Python: handles=).",
        )  # fmt: skip
    return handles


def _sensor(table: Lines, column: RecordingColumn, number: int, asked: RecordingOptions) -> Sensitivity | None:
    """Sensitivity of a column in volts; None for one in units of motion. Refused if it is missing or not asked for."""
    own = next((given for given in asked.sensitivities if given.channel in (column.name, str(number))), None)
    sensor = sensitivity_of(asked.sensitivities, column.name, number)
    if column.volts is None or asked.scale is not None:
        if own is not None:
            raise InputError(
                "a sensitivity for a column that is not in V or mV", place=Place(table.path, table.head, column.name),
                found=f"sensitivity {own.text}", remedy="Leave it out, or name the column's unit: ax_mV, ax [V].",
            )  # fmt: skip
        return None
    if sensor is None:
        raise InputError(
            "a column of a voltage without the sensitivity of its sensor",
            place=Place(table.path, table.head, column.name),
            remedy=f'Give it in mV per m/s², or with its unit: --sensitivity "{column.name}=100 mV/g" (Python: '
            "sensitivity=). If the column is no motion, leave it out: --channels.",
        )  # fmt: skip
    return sensor


def _all_used(
    path: str, asked: RecordingOptions, names: Sequence[str], sensors: Sequence[Sensitivity | None], remarks: list[str]
) -> None:
    """Refuse a sensitivity that no channel takes; remark which channels take the others."""
    for given in asked.sensitivities:
        if given not in sensors:
            what = "no column that is read is in V or mV" if given.channel is None else "no such channel is read"
            raise InputError(
                f"a sensitivity without use: {what}", place=Place(path, key="sensitivity"),
                found=f"{given.channel}={given.text}" if given.channel else given.text,
                remedy="Omit --sensitivity, or name a column in V or mV.",
            )  # fmt: skip
        own = [name for name, sensor in zip(names, sensors, strict=True) if sensor == given]
        remarks.append(f"Sensitivity {given.text}: {', '.join(own)}.")


def _picked(
    table: Lines, columns: Sequence[RecordingColumn], others: Sequence[int], asked: RecordingOptions,
    remarks: list[str], *, simulated: bool,
) -> list[int]:  # fmt: skip
    """Columns to read of those beside the times: those asked for, else x and y of a trajectory, else what may move."""
    if asked.asked_channels:
        # Columns without names are told by their number in the file.
        names = [columns[k].name if table.named else f"{k + 1}" for k in others]
        picked = [others[k] for k in chosen(table.path, names, asked.asked_channels)]
        if blank := [columns[k].name for k in picked if k in table.empty | table.clocks]:
            raise InputError("a channel holds no numbers", place=Place(table.path, table.head, blank[0]))
        return picked
    if simulated:
        return [table.names.index("x_mm"), table.names.index("y_mm")]
    axes = [k for k in others if not (columns[k].is_time or columns[k].numbers_rows)
            and k not in table.empty | table.clocks]  # fmt: skip
    resultants = [k for k in axes if columns[k].is_resultant or _is_length(table.values, k, axes)]
    moved = [k for k in axes if k not in resultants]
    known = [k for k in moved if columns[k].quantity is not None or columns[k].volts is not None]
    wanted = [k for k in known if asked.quantity in (None, columns[k].quantity) or columns[k].volts is not None]
    if known and not wanted:
        raise InputError(
            f"no column of {asked.quantity}", place=Place(table.path, key="quantity"),
            found=", ".join(columns[k].name for k in known),
        )  # fmt: skip
    if not axes:
        raise InputError("no column beside the time", place=Place(table.path), remedy="Columns: time, what moved.")
    if not moved:
        raise InputError(
            "only the length of a vector is recorded, which has no sign", place=Place(table.path, table.head),
            found=", ".join(columns[k].name for k in resultants),
            remedy="Record the axes. --channels takes such a column as an axis (Python: channels=).",
        )  # fmt: skip
    unsaid = [k for k in moved if wanted and k not in wanted]
    for left_out, why in ((resultants, "the resultant of the axes"), (unsaid, "no unit of the motion")):
        if left_out:
            remarks.append(f"{', '.join(columns[k].name for k in left_out)}: {why}, left out.")
    axes = wanted or [k for k in moved if not columns[k].unknown_unit] or moved
    strange = [columns[k].name for k in axes if not columns[k].may_be_axis]
    if not wanted and len(axes) > 1 and strange:
        raise InputError(
            "which columns are the motion is not clear", place=Place(table.path), found=", ".join(strange),
            remedy="Name their units (a_m_per_s2, v [mm/s]), or say --channels (Python: channels=).",
        )  # fmt: skip
    return axes


def _is_length(values: NDArray[np.float64], k: int, columns: Sequence[int]) -> bool:
    """True for a column that is the root of the sum of the squares of two or three others."""
    length = values[:, k]
    if length.min() < 0 or len(columns) < MOST_AXES:
        return False
    others = [j for j in columns if j != k]
    with np.errstate(over="ignore", invalid="ignore"):
        return any(
            float(np.abs(np.sqrt((values[:, each] ** 2).sum(axis=1)) - length).max()) <= 5e-3 * float(length.max())
            and all(float(np.ptp(values[:, j])) > 0 for j in each)
            for each in (list(group) for many in (2, 3) for group in combinations(others, many))
        )


def _quantity(
    path: str, columns: Sequence[RecordingColumn], sensors: Sequence[Sensitivity | None], asked: RecordingOptions,
    remarks: list[str],
) -> MotionQuantity:  # fmt: skip
    given = [*(sensor.quantity for sensor in sensors if sensor is not None), *(column.quantity for column in columns)]
    quantities = list(dict.fromkeys(quantity for quantity in given if quantity is not None))
    if asked.quantity is not None and quantities in ([], [asked.quantity]):
        return asked.quantity
    if asked.quantity is not None or len(quantities) > 1:
        raise InputError(
            "the columns are of several quantities", place=Place(path), found=", ".join(axis.name for axis in columns),
            remedy="Say which: --quantity acceleration or velocity, --channels (Python: quantity=, channels=).",
        )  # fmt: skip
    if not quantities:
        remarks.append(
            f'{columns[0].name} is taken for an acceleration; name its unit ("a_m_per_s2", "v [mm/s]"), or say '
            "--quantity velocity."
        )
    return quantities[0] if quantities else "acceleration"


def _unit(column: RecordingColumn, sensor: Sensitivity | None, asked: RecordingOptions, remarks: list[str]) -> float:
    """SI per unit of a column."""
    if sensor is not None and column.volts is not None:
        return column.volts / sensor.volts_per_unit
    if asked.scale is None:
        return column.unit or 1.0
    if column.unit is not None:
        remarks.append(f"The scale takes the place of the unit in {column.name}.")
    return asked.scale


def _clipped(values: NDArray[np.float64]) -> int | None:
    spread = float(np.ptp(values))
    return None if spread == 0 else flat_tops(values, spread / 400, run=4)


WHOLE: Final = {"uint8": (128.0, 128.0), "int16": (0.0, 32768.0), "int32": (0.0, 2.0**31), "int64": (0.0, 2.0**63)}
"""Zero and full scale of samples that are whole numbers."""


def wav_recording(path: str, content: bytes, asked: RecordingOptions) -> Recording:
    """The recording of a WAV file; its scale, or full scale and sensitivities, must be given."""
    if asked.scale is None and not (asked.sensitivities and asked.full_scale is not None):
        raise InputError(
            "a WAV file does not say what its samples stand for", place=Place(path),
            remedy="Give --scale S: m/s² at full scale (with --quantity velocity m/s); Python: scale=. Or give "
            "--full-scale-mV and --sensitivity (Python: full_scale_mV=, sensitivity=).",
        )  # fmt: skip
    remarks: list[str] = []
    rate, data = _read(path, _with_lengths(content, remarks))
    columns = data.reshape(len(data), -1).T
    names = [f"channel {k}" for k in range(1, len(columns) + 1)]
    picked = chosen(path, names, asked.asked_channels) if asked.asked_channels else list(range(len(columns)))
    described = [RecordingColumn(names[k], None, False, None, asked.full_scale) for k in picked]
    table = Lines(path, tuple(names), (), data)
    sensors = [_sensor(table, column, k + 1, asked) for k, column in zip(picked, described, strict=True)]
    _all_used(path, asked, [column.name for column in described], sensors, remarks)
    quantity = _quantity(path, described, sensors, asked, [])
    if asked.quantity is None and asked.scale is not None:
        remarks.append("The samples are taken for accelerations; --quantity velocity says otherwise.")
    if len(picked) > 1 and not asked.handles:
        remarks.append(f"The {len(picked)} channels are taken for axes of one place.")
    clipped = list[str]()
    axes = [
        (
            column.name,
            _full_scale(path, column.name, columns[k], rate, clipped if asked.keep_clipped else None)
            * _unit(column, sensor, asked, remarks),
        )
        for k, column, sensor in zip(picked, described, sensors, strict=True)
    ]
    return recording(path, content, quantity, axes, float(rate), remarks, handles=asked.handle_names(), clipped=clipped)


UNKNOWN: Final = 0x7FFFF000
"""Least length that programs write into the header of a file whose end they do not know; others write 0."""


def _with_lengths(content: bytes, remarks: list[str]) -> bytes:
    """A WAV file with the lengths that its header leaves open, as of a stream: the samples last to the end."""
    order = {b"RIFF": "<I", b"RIFX": ">I"}.get(content[:4])
    place, frame = 12, 1
    while order and place + 8 <= len(content):
        name, (whole,) = content[place : place + 4], struct.unpack_from(order, content, 4)
        (size,) = struct.unpack_from(order, content, place + 4)
        if name == b"fmt " and place + 22 <= len(content):
            (frame,) = struct.unpack_from(f"{order[0]}H", content, place + 20)
        if name == b"data" and not any(0 < length < UNKNOWN for length in (whole, size)):
            rest = len(content) - place - 8
            rest -= rest % max(frame, 1)
            remarks.append("The file's header leaves its length open, as a stream does: it is read to its end.")
            head = content[:4] + struct.pack(order, place + rest) + content[8 : place + 4] + struct.pack(order, rest)
            return head + content[place + 8 : place + 8 + rest]
        place += 8 + size + size % 2
    return content


def _read(path: str, content: bytes) -> tuple[int, NDArray[Any]]:
    from scipy.io import wavfile

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message=".*not understood.*")
            rate, data = wavfile.read(io.BytesIO(content))
    except Exception as error:  # whatever the parser stumbles over
        raise InputError(f"not a WAV file that can be read: {error}", place=Place(path)) from None
    if rate <= 0 or len(data) < 2:
        raise InputError("the WAV file holds no samples", place=Place(path))
    return rate, np.asarray(data)


def _full_scale(
    path: str, name: str, values: NDArray[Any], rate: int, clipped: list[str] | None
) -> NDArray[np.float64]:
    """Samples as shares of full scale; refused where they are no numbers, or are cut off there.

    `clipped` takes the names of channels that are cut off; None: they are refused.
    """
    kind = str(values.dtype)
    zero, full = WHOLE.get(kind, (0.0, 1.0))
    samples = (values.astype(float) - zero) / full
    bad = np.flatnonzero(~np.isfinite(samples))
    if len(bad):
        raise InputError("a sample is no number", place=Place(path, key=name), found=f"at {bad[0] / rate:.6g} s")
    step = 1 / full if kind in WHOLE else 2.0**-23
    limit = 1 - 1.5 * step if kind in WHOLE else 1.0
    cut = flat_tops(samples, step) if float(np.abs(samples).max()) >= limit else None
    if cut is not None and clipped is not None:
        clipped.append(name)
    elif cut is not None:
        raise InputError(
            "the recording is clipped: the signal stays at full scale, so its levels would be too low",
            place=Place(path, key=name), found=f"first at {cut / rate:.6g} s", remedy="Record again with less gain.",
        )  # fmt: skip
    return samples


SUFFIXES: Final = (".csv", ".wav", ".txt", ".tsv", ".dat", ".lvm", ".asc", ".log", ".prn", ".xlsx", ".mat", ".tdms")
LARGEST: Final = 2**30
"""Bytes of a file that is read."""


def read_recording(
    file: str | os.PathLike[str],
    quantity: str | None = None,
    scale: float | None = None,
    channels: Sequence[str] = (),
    *,
    sensitivity: float | str | Sequence[float | str] | Mapping[str, float | str] | None = None,
    handles: Mapping[str, Sequence[str]] | None = None,
    full_scale_mV: float | None = None,
    keep_clipped: bool = False,
    rate_hz: float | None = None,
    time: str | None = None,
    skip: int = 0,
) -> Recording:
    """Reads a CSV (time, and up to three columns of a motion for each handle) or a WAV file.

    `scale`: m/s² (velocity: m/s, displacement: m) per unit of the file, for WAV per full scale. `channels`: names or
    numbers, from 1, of the columns or channels to take. `sensitivity`: of sensors recorded in V or mV, in mV per m/s²
    or a text with its unit, for all or by channel. `handles`: the channels at each handle; without them columns such
    as "front_ax_m_per_s2" name their handle. `full_scale_mV`: of a WAV file with sensitivities. `keep_clipped`: a WAV
    file that is clipped is read, and `clipped` names its channels; without it the file is refused. `rate_hz`: samples a
    second of a table without times; `time`: its column of times, "COLUMN" or "COLUMN:ms"; `skip`: lines above the names
    to leave out. Raises InputError with file, line and column for what is wrong.
    """
    path, content = content_of(file)
    known = next((name for name in QUANTITIES if name == quantity), None)
    if quantity is not None and known is None:
        allowed = ", ".join(QUANTITIES)
        raise InputError("not a quantity of motion", place=Place(key="quantity"), found=quantity, allowed=allowed)
    for key, value in (("scale", scale), ("full_scale_mV", full_scale_mV)):
        if value is not None and not (np.isfinite(value) and value > 0):
            raise InputError(
                "not a scale", place=Place(key=key), found=f"{value:g}", allowed="a number above 0",
                remedy="SI per unit of the file: m/s² for accelerations, m/s for velocities."
                if key == "scale" else "The voltage at full scale in mV.",
            )  # fmt: skip
    if rate_hz is not None:
        RATE.check(rate_hz)
    if skip < 0:
        raise InputError("not a number of lines", place=Place(key="skip"), found=f"{skip}", allowed="0 or more")
    placed = tuple((name, tuple(axes)) for name, axes in (handles or {}).items())
    full_scale = None if full_scale_mV is None else full_scale_mV / 1000
    asked = RecordingOptions(
        known, scale, tuple(channels), sensitivities(sensitivity), placed, full_scale, keep_clipped, rate_hz, time, skip
    )
    is_wav = content[:4] in (b"RIFF", b"RIFX", b"RF64") or Path(path).suffix.lower() == ".wav"
    _options_agree(asked, is_wav=is_wav)
    return wav_recording(path, content, asked) if is_wav else csv_recording(path, content, asked)


def _options_agree(asked: RecordingOptions, *, is_wav: bool) -> None:
    """Refuse options that exclude each other, or that the kind of file has no use for."""
    faults = (
        ("channels", asked.channels and asked.handles, "both channels and handles", "Use --handle alone."),
        ("sensitivity", asked.sensitivities and asked.scale is not None, "both a scale and a sensitivity", "Give one."),
        ("full_scale_mV", asked.full_scale is not None and not is_wav, "a full scale, but no WAV file",
         "Omit --full-scale-mV."),
        ("full_scale_mV", asked.full_scale is not None and asked.scale is not None, "both a scale and a full scale",
         "Give one."),
        ("rate_hz", asked.rate is not None and asked.time is not None, "both a rate and times", "Give one."),
        ("rate_hz", asked.rate is not None and is_wav, "a rate, but no table", "A WAV file tells its rate."),
        ("time", asked.time is not None and is_wav, "a column of times, but no table", "A WAV file tells its rate."),
        ("skip", bool(asked.skip) and is_wav, "lines to leave out, but no table", "Omit --skip."),
    )  # fmt: skip
    for key, fault, message, remedy in faults:
        if fault:
            raise InputError(message, place=Place(key=key), remedy=remedy)
    for name, axes in asked.handles:
        if not name.strip() or not axes:
            raise InputError(
                "a handle needs a name and its channels", place=Place(key="handle"), found=f"{name}={','.join(axes)}",
                remedy="--handle front=1,2,3 (Python: handles=).",
            )  # fmt: skip


def is_recording(file: str) -> bool:
    """True if a file's name is that of a recording; others hold machines or scenes, or are presets."""
    return Path(file).suffix.lower() in SUFFIXES


def content_of(file: str | os.PathLike[str]) -> tuple[str, bytes]:
    """The name of a file as text, and its bytes."""
    if not isinstance(file, (str, os.PathLike)):
        raise InputError("not the name of a file", place=Place(key="source"), found=found_as(file))
    path = os.fspath(file)
    content = regular_file(Path(path), LARGEST)
    if not content.strip():
        raise InputError("the file is empty", place=Place(path))
    return path, content
