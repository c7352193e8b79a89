"""Reading of a recorded motion from a CSV or a WAV file.

CSV: a column of time, and columns of acceleration, velocity or displacement with their units. WAV: samples of whole
numbers or floats, full scale ±1; a scale gives their quantity. The kind of a file and its faults are told before it is
looked into.
"""

import io
import os
import re
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.plain import found_as
from abu_calc.inputs.reading.sources import regular_file
from abu_calc.inputs.recording import (
    AXIS,
    QUANTITIES,
    MotionQuantity,
    Recording,
    RecordingColumn,
    RecordingOptions,
    chosen,
    column_of,
    flat_tops,
    recording,
)

EVEN: Final = 0.05
"""Share of a step by which times may stray from their grid: more is not the rounding of written times."""


@dataclass(frozen=True)
class Lines:
    """Rows of numbers with their line numbers, and the names above them."""

    path: str
    names: tuple[str, ...]
    numbers: tuple[int, ...]
    values: NDArray[np.float64]


def csv_recording(path: str, content: bytes, asked: RecordingOptions) -> Recording:
    """The recording of a CSV file."""
    remarks: list[str] = []
    table = _table(path, _text(path, content), remarks)
    columns = [column_of(name) for name in table.names]
    time = next((k for k, column in enumerate(columns) if column.is_time), None)
    if time is None:
        raise InputError(
            "no column of time", place=Place(path, table.numbers[0] - 1), found=", ".join(table.names),
            remedy='Name it "t_s" or "time [s]": equally spaced times are asked for.',
        )  # fmt: skip
    rate = _rate(table, time, columns[time])
    simulated = {"x_mm", "y_mm", "ball1_deg"} <= set(table.names)
    picked = _picked(table, columns, time, asked, simulated=simulated)
    quantity = _quantity(path, [columns[k] for k in picked], asked, remarks)
    with np.errstate(over="ignore", invalid="ignore"):  # samples that large are refused below
        axes = [(columns[k].name, table.values[:, k] * _unit(columns[k], quantity, asked, remarks)) for k in picked]
        clipped = [(name, _clipped(values)) for name, values in axes]
    for name, cut in clipped:
        if cut is not None:
            remarks.append(
                f"{name} stays at its largest value again and again, first on line {table.numbers[cut]}: a recording "
                "that is clipped reads too low."
            )
    return recording(path, content, quantity, axes, rate, remarks, simulated=simulated)


def _text(path: str, content: bytes) -> str:
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    if b"\0" in content[:4096]:
        raise InputError("neither a table of text nor a WAV file", place=Place(path))
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Two letters of the upper half side by side are a Cyrillic word of Windows; alone they are µ or ².
        return content.decode("cp1251" if re.search(rb"[\xc0-\xff]{2}", content[:4096]) else "latin-1", "replace")


def _table(path: str, text: str, remarks: list[str]) -> Lines:
    """Names and numbers; comments (#) and empty lines left out."""
    rows = [(k, line) for k, line in enumerate(text.splitlines(), 1) if line.strip() and not line.startswith("#")]
    first = next((k for k, (_, line) in enumerate(rows) if _numeric(line)), None)
    if first is None:
        raise InputError("no row of numbers", place=Place(path), remedy="Columns: time, and what moved.")
    if first > 2:
        raise InputError(
            "more lines above the numbers than names and units", place=Place(path, rows[0][0]),
            found=rows[0][1].strip()[:60], remedy="Keep one line of names, or begin the others with #.",
        )  # fmt: skip
    delimiter = _delimiter(rows[first][1])
    if delimiter and rows[first][1].rstrip().endswith(delimiter):  # every row ends so
        rows = [(number, line.rstrip().removesuffix(delimiter)) for number, line in rows]
    heads = [[cell.strip().strip('"') for cell in _cells(line, delimiter)] for _, line in rows[:first]]
    if delimiter != "," and "," in rows[first][1]:
        rows = [(number, _pointed(path, number, line) if k >= first else line) for k, (number, line) in enumerate(rows)]
        remarks.append("Commas are taken for decimal points.")
    width = len(_cells(rows[first][1], delimiter))
    for (number, _), head in zip(rows[:first], heads, strict=True):
        if len(head) != width:
            raise InputError(
                "another number of columns than the names above", place=Place(path, rows[first][0]),
                found=f"{width}, names on line {number}: {len(head)}",
                remedy="Are commas decimal points? Then put ; between the columns, or write points.",
            )  # fmt: skip
    names = [" ".join(parts) for parts in zip(*heads, strict=True)] if len(heads) == 1 else []
    if len(heads) == 2:
        names = [f"{name} [{unit.strip('[]()')}]" for name, unit in zip(*heads, strict=True)]
    names = names or ["t", *(f"column {k}" for k in range(2, width + 1))]
    numbers, lines = zip(*rows[first:], strict=True)
    return Lines(path, tuple(names), numbers, _values(path, names, numbers, lines, delimiter))


def _numeric(line: str) -> bool:
    """True if the first cell of a line is a number.

    A comma before a digit may be a decimal point, or end the cell.
    """
    cell = re.split(r"[;\t]|,(?!\d)|\s", line.strip())[0].strip('"')
    return re.fullmatch(r"[-+]?(\d+([.,]\d*)*|[.,]\d+)([eE][-+]?\d+(,.*)?)?", cell) is not None


def _delimiter(line: str) -> str | None:
    """Delimiter of the cells in a row of numbers; None: blanks."""
    return next((sign for sign in (";", "\t", ",") if sign in line), None)


def _cells(line: str, delimiter: str | None) -> list[str]:
    return line.strip().split(delimiter)


def _pointed(path: str, number: int, line: str) -> str:
    if "." in line:
        raise InputError("points and commas both stand for decimals", place=Place(path, number), found=line.strip())
    return line.replace(",", ".")


def _values(
    path: str, names: Sequence[str], numbers: Sequence[int], lines: Sequence[str], delimiter: str | None
) -> NDArray[np.float64]:
    """Numbers, row by row; the first cell that is none is told with its line and column."""
    plain = [line.strip().replace('"', "") for line in lines]
    try:
        array = np.loadtxt(plain, delimiter=delimiter, ndmin=2, comments=None)
        if np.isfinite(array).all() and array.shape[1] == len(names):
            return np.asarray(array, dtype=float)
    except ValueError:
        pass
    for number, line in zip(numbers, plain, strict=True):
        cells = line.split(delimiter)
        if len(cells) != len(names):
            raise InputError(
                "another number of columns than before", place=Place(path, number),
                found=f"{len(cells)}", allowed=f"{len(names)}",
                remedy="A row that was cut off, or commas as decimal points: put ; between the columns then.",
            )  # fmt: skip
        for name, cell in zip(names, cells, strict=True):
            _check_cell(Place(path, number, name), cell.strip())
    raise InputError("the numbers cannot be read", place=Place(path, numbers[0]))


def _check_cell(place: Place, cell: str) -> None:
    try:
        good = bool(np.isfinite(float(cell)))
    except ValueError:
        good = False
    if not good:
        raise InputError("not a number", place=place, found=cell or "nothing", remedy="Every row needs every number.")


def _rate(table: Lines, time: int, column: RecordingColumn) -> float:
    """Samples a second of times that are equally spaced but for the rounding of their digits."""
    t, path, count = table.values[:, time], table.path, len(table.values)

    def place(row: int) -> Place:
        return Place(path, table.numbers[row], column.name)

    if count < 3:
        raise InputError("too few rows", place=Place(path), found=f"{count}")
    steps = np.diff(t)
    back = np.flatnonzero(steps <= 0)
    if len(back):
        k = int(back[0]) + 1
        raise InputError("the times do not ascend", place=place(k), found=f"{t[k]:.12g} after {t[k - 1]:.12g}")
    usual = float(t[-1] - t[0]) / (count - 1)
    stray = float(np.abs(t - np.linspace(t[0], t[-1], count)).max())
    rounded = stray <= 1.01 * _resolution(t) <= 1.01 * usual and not _gaps(steps)
    if stray > EVEN * usual and not rounded:
        raise _uneven(steps, place)
    return 1 / (usual * (column.unit or 1.0))


def _resolution(t: NDArray[np.float64]) -> float:
    """One unit of the last digit that the times are written with, decimals; 0 for more than nine."""
    for digits in range(10):
        scaled = t * 10.0**digits
        if float(np.abs(scaled - np.round(scaled)).max()) < 1e-6 * max(1.0, float(np.abs(scaled).max()) * 1e-6):
            return float(10.0**-digits)
    return 0.0


def _gaps(steps: NDArray[np.float64]) -> list[int]:
    """Steps of time that are twice as wide as others or wider, if they are few."""
    wide = np.flatnonzero(steps > 1.9 * float(np.median(steps)))
    return [int(k) for k in wide] if len(wide) <= max(3, len(steps) // 1000) else []


def _uneven(steps: NDArray[np.float64], place: Callable[[int], Place]) -> InputError:
    """Fault in the steps of time: a gap, if they are alike but for few, or no fixed rate."""
    usual, gaps = float(np.median(steps)), _gaps(steps)
    if gaps:
        k = gaps[0]
        return InputError(
            "a gap in the times", place=place(k + 1), found=f"{steps[k]:.6g} after steps of {usual:.6g}",
            remedy="Cut the file there, and take its longest part.",
        )  # fmt: skip
    k = int(np.argmax(np.abs(steps - usual)))
    return InputError(
        "the times are not equally spaced", place=place(k + 1),
        found=f"a step of {steps[k]:.6g} among steps of {usual:.6g}",
        remedy="Record at a fixed rate, or write the times with more digits.",
    )  # fmt: skip


def _picked(
    table: Lines, columns: Sequence[RecordingColumn], time: int, asked: RecordingOptions, *, simulated: bool
) -> list[int]:
    """Columns to read: those asked for, else x and y of a trajectory, else all that may be the quantity."""
    others = [k for k in range(len(columns)) if k != time]
    if asked.channels:
        return [others[k] for k in chosen(table.path, [columns[k].name for k in others], asked.channels)]
    if simulated:
        return [table.names.index("x_mm"), table.names.index("y_mm")]
    known = [k for k in others if columns[k].quantity is not None]
    wanted = [k for k in known if asked.quantity in (None, columns[k].quantity)]
    if known and not wanted:
        raise InputError(
            f"no column of {asked.quantity}", place=Place(table.path, key="quantity"),
            found=", ".join(columns[k].name for k in known),
        )  # fmt: skip
    if not (wanted or others):
        raise InputError("no column beside the time", place=Place(table.path), remedy="Columns: time, what moved.")
    strange = [columns[k].name for k in others if not AXIS.fullmatch(columns[k].name)]
    if not wanted and len(others) > 1 and strange:
        raise InputError(
            "which columns are the motion is not clear", place=Place(table.path), found=", ".join(strange),
            remedy="Name their units (a_m_per_s2, v [mm/s]), or say --channels (Python: channels=).",
        )  # fmt: skip
    return wanted or others


def _quantity(
    path: str, columns: Sequence[RecordingColumn], asked: RecordingOptions, remarks: list[str]
) -> MotionQuantity:
    quantities = list(dict.fromkeys(column.quantity for column in columns if column.quantity is not None))
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


def _unit(column: RecordingColumn, quantity: MotionQuantity, asked: RecordingOptions, remarks: list[str]) -> float:
    """SI per unit of a column."""
    if asked.scale is not None:
        if column.unit is not None:
            remarks.append(f"The scale takes the place of the unit in {column.name}.")
        return asked.scale
    if column.unit is not None:
        return column.unit
    unit = {"acceleration": "m/s²", "velocity": "m/s", "displacement": "m"}[quantity]
    remarks.append(f"{column.name} names no unit and is taken in {unit}; --scale says otherwise.")
    return 1.0


def _clipped(values: NDArray[np.float64]) -> int | None:
    spread = float(np.ptp(values))
    return None if spread == 0 else flat_tops(values, spread / 400, run=4)


WHOLE: Final = {"uint8": (128.0, 128.0), "int16": (0.0, 32768.0), "int32": (0.0, 2.0**31), "int64": (0.0, 2.0**63)}
"""Zero and full scale of samples that are whole numbers."""


def wav_recording(path: str, content: bytes, asked: RecordingOptions) -> Recording:
    """The recording of a WAV file; its scale must be given."""
    if asked.scale is None:
        raise InputError(
            "a WAV file does not say what its samples stand for", place=Place(path),
            remedy="Give --scale S: m/s² at full scale (with --quantity velocity m/s); Python: scale=.",
        )  # fmt: skip
    rate, data = _read(path, content)
    remarks = []
    quantity = asked.quantity or "acceleration"
    if asked.quantity is None:
        remarks.append("The samples are taken for accelerations; --quantity velocity says otherwise.")
    columns = data.reshape(len(data), -1).T
    names = [f"channel {k}" for k in range(1, len(columns) + 1)]
    picked = chosen(path, names, asked.channels) if asked.channels else list(range(len(columns)))
    if len(picked) > 1:
        remarks.append(f"The {len(picked)} channels are taken for axes of one place.")
    axes = [(names[k], _full_scale(path, names[k], columns[k], rate) * asked.scale) for k in picked]
    return recording(path, content, quantity, axes, float(rate), remarks)


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


def _full_scale(path: str, name: str, values: NDArray[Any], rate: int) -> NDArray[np.float64]:
    """Samples as shares of full scale; refused where they are cut off there, or are no numbers."""
    kind = str(values.dtype)
    zero, full = WHOLE.get(kind, (0.0, 1.0))
    samples = (values.astype(float) - zero) / full
    bad = np.flatnonzero(~np.isfinite(samples))
    if len(bad):
        raise InputError("a sample is no number", place=Place(path, key=name), found=f"at {bad[0] / rate:.6g} s")
    step = 1 / full if kind in WHOLE else 2.0**-23
    limit = 1 - 1.5 * step if kind in WHOLE else 1.0
    cut = flat_tops(samples, step) if float(np.abs(samples).max()) >= limit else None
    if cut is not None:
        raise InputError(
            "the recording is clipped: the signal stays at full scale, so its levels would be too low",
            place=Place(path, key=name), found=f"first at {cut / rate:.6g} s", remedy="Record again with less gain.",
        )  # fmt: skip
    return samples


SUFFIXES: Final = (".csv", ".wav", ".txt", ".tsv", ".dat")
LARGEST: Final = 2**30
"""Bytes of a file that is read."""


def read_recording(
    file: str | os.PathLike[str], quantity: str | None = None, scale: float | None = None, channels: Sequence[str] = ()
) -> Recording:
    """Reads a CSV (time and up to three columns of a motion) or a WAV file.

    `scale`: m/s² (velocity: m/s, displacement: m) per unit of the file, for WAV per full scale. `channels`: names or
    numbers, from 1, of the columns or channels to take. Raises InputError with file, line and column for what is wrong.
    """
    path, content = _content(file)
    known = next((name for name in QUANTITIES if name == quantity), None)
    if quantity is not None and known is None:
        allowed = ", ".join(QUANTITIES)
        raise InputError("not a quantity of motion", place=Place(key="quantity"), found=quantity, allowed=allowed)
    if scale is not None and not (np.isfinite(scale) and scale > 0):
        raise InputError(
            "not a scale", place=Place(key="scale"), found=f"{scale:g}", allowed="a number above 0",
            remedy="SI per unit of the file: m/s² for accelerations, m/s for velocities.",
        )  # fmt: skip
    asked = RecordingOptions(known, scale, tuple(channels))
    if content[:4] in (b"RIFF", b"RIFX", b"RF64") or Path(path).suffix.lower() == ".wav":
        return wav_recording(path, content, asked)
    return csv_recording(path, content, asked)


def is_recording(file: str) -> bool:
    """True if a file's name is that of a recording; others hold machines or scenes, or are presets."""
    return Path(file).suffix.lower() in SUFFIXES


def _content(file: str | os.PathLike[str]) -> tuple[str, bytes]:
    """The name of a file as text, and its bytes."""
    if not isinstance(file, (str, os.PathLike)):
        raise InputError("not the name of a file", place=Place(key="source"), found=found_as(file))
    path = os.fspath(file)
    try:
        content = regular_file(Path(path), LARGEST)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", place=Place(path)) from None
    if len(content) > LARGEST:
        raise InputError("the file is too large", place=Place(path), allowed=f"at most {LARGEST} bytes")
    if not content.strip():
        raise InputError("the file is empty", place=Place(path))
    return path, content
