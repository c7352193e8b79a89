"""A recorded motion: equally spaced samples of up to three axes of each place.

Samples a second of a recording: from its column of times, from what its other lines tell, or as asked for.
"""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.recording_columns import TIME, MotionQuantity, RecordingColumn, plain_unit
from abu_calc.inputs.recording_table import Lines
from abu_calc.inputs.sensitivity import Sensitivity

LARGEST: Final = 1e9
"""Largest sample, in SI units: squares of much larger ones, and their sums, are infinite."""
MOST_AXES: Final = 3


@dataclass(frozen=True, eq=False)
class Recording:
    """Samples [SI] of a quantity at `rate` [1/s]: axis by axis, in their order in the file, with their names.

    `remarks`: facts that a reader must know of how the file was taken; `simulated`: whether a simulation made it.
    `handles`: the handle that each axis is measured at; "": the file names none. `assumed`: what is assumed of units
    that nothing in the file tells.
    """

    file: str
    sha256: str
    quantity: MotionQuantity
    names: tuple[str, ...]
    samples: tuple[NDArray[np.float64], ...]
    rate: float
    remarks: tuple[str, ...] = ()
    simulated: bool = False
    handles: tuple[str, ...] = ()
    clipped: tuple[str, ...] = ()
    assumed: str = ""

    @property
    def duration(self) -> float:
        """Duration of the record [s]."""
        return len(self.samples[0]) / self.rate

    @property
    def axes_by_handle(self) -> dict[str, tuple[int, ...]]:
        """Indices of the axes at each handle, in the order of the file; one key "" if the file names no handle."""
        return by_handle(self.handles or ("",) * len(self.samples))


def by_handle(handles: Sequence[str]) -> dict[str, tuple[int, ...]]:
    """Indices of equal names."""
    return {name: tuple(k for k, other in enumerate(handles) if other == name) for name in dict.fromkeys(handles)}


@dataclass(frozen=True)
class RecordingOptions:
    """Reading of a file: quantity, SI per unit, which columns or channels; None: as the file says.

    `sensitivities` of channels in volts; `handles`: name and channels of each; `full_scale` [V] of a WAV file; `rate`
    [1/s] of a table without times, `time`: its column of times with its unit, `skip`: lines that are left out above.
    """

    quantity: MotionQuantity | None = None
    scale: float | None = None
    channels: tuple[str, ...] = ()
    sensitivities: tuple[Sensitivity, ...] = ()
    handles: tuple[tuple[str, tuple[str, ...]], ...] = ()
    full_scale: float | None = None
    keep_clipped: bool = False
    rate: float | None = None
    time: str | None = None
    skip: int = 0

    @property
    def asked_channels(self) -> tuple[str, ...]:
        """Channels to read; empty: as the file says."""
        return self.channels or tuple(channel for _, channels in self.handles for channel in channels)

    def handle_names(self) -> tuple[str, ...]:
        """Handle of each of `asked_channels`; empty without handles."""
        return tuple(name for name, channels in self.handles for _ in channels)


def recording(
    path: str, content: bytes, quantity: MotionQuantity, axes: Sequence[tuple[str, NDArray[np.float64]]], rate: float,
    remarks: Sequence[str] = (), *, simulated: bool = False, handles: Sequence[str] = (), clipped: Sequence[str] = (),
    assumed: str = "",
) -> Recording:  # fmt: skip
    """Recording of the data read; refused with more than three axes at a place, two of one name, or one at rest."""
    names, samples = tuple(name for name, _ in axes), tuple(values for _, values in axes)
    for handle, members in by_handle(handles or ("",) * len(axes)).items():
        if len(members) > MOST_AXES:
            raise InputError(
                "a place moves along three axes at most", place=Place(path, key=handle or None),
                found=", ".join(names[k] for k in members),
                remedy="Say which to take: --channels 1,2,3, or their names (Python: channels=). For two handles: "
                "--handle front=1,2,3 --handle rear=4,5,6 (Python: handles=).",
            )  # fmt: skip
        doubled = sorted({names[k] for k in members if [names[j] for j in members].count(names[k]) > 1})
        if doubled:
            raise InputError(
                "two axes of a place with the same name", place=Place(path, key=doubled[0]),
                remedy="Name each column by its axis: ax_m_per_s2, ay_m_per_s2, az_m_per_s2.",
            )  # fmt: skip
    for name, values in axes:
        if (largest := float(np.abs(values).max())) > LARGEST:
            raise InputError(
                "a sample is larger than anything that vibrates", place=Place(path, key=name),
                found=f"{largest:g} in SI units", allowed=f"at most {LARGEST:g}",
                remedy="Correct the sample, the unit in the column's name or --scale (Python: scale=).",
            )  # fmt: skip
    still = [name for name, values in axes if float(np.ptp(values)) == 0]
    if still:
        raise InputError(
            "the signal is the same number from start to end", place=Place(path, key=still[0]),
            remedy="A sensor that is not connected? Leave the channel out: --channels (Python: channels=).",
        )  # fmt: skip
    digest = hashlib.sha256(content).hexdigest()
    return Recording(
        path, digest, quantity, names, samples, rate, tuple(remarks), simulated, tuple(handles), tuple(clipped), assumed
    )


def chosen(path: str, names: Sequence[str], channels: Sequence[str]) -> list[int]:
    """Indices of the columns or channels asked for, by name or by number from 1."""
    indices = []
    for asked in channels:
        counted = asked.isdecimal() and not all(name.isdecimal() for name in names)
        index = names.index(asked) if asked in names else int(asked) - 1 if counted else -1
        if not 0 <= index < len(names):
            raise InputError(
                "no such channel", place=Place(path), found=asked,
                allowed=", ".join(f"{k} ({name})" for k, name in enumerate(names, 1)),
                remedy="--channels and --handle take numbers or names (Python: channels=, handles=).",
            )  # fmt: skip
        if index in indices:
            raise InputError("the same channel twice", place=Place(path), found=asked)
        indices.append(index)
    return indices


def flat_tops(values: NDArray[np.float64], least_step: float, run: int = 3) -> int | None:
    """Index of the first run of equal samples at the largest or smallest value that is cut off, not rounded; or None.

    A crest that is only rounded falls off by a few steps beside such a run, one that is cut off falls steeply.
    """
    for extreme in (values.max(), values.min()):
        edges = np.flatnonzero(np.diff(np.concatenate([[False], values == extreme, [False]])))
        begins, ends = edges[::2], edges[1::2]
        before, behind = (values[np.clip(k, 0, len(values) - 1)] for k in (begins - 1, ends))
        steep = np.minimum(np.abs(before - extreme), np.abs(behind - extreme)) > 4 * least_step
        cut = begins[(ends - begins >= run) & steep]
        if len(cut):
            return int(cut[0])
    return None


EVEN: Final = 0.05
"""Share of a step by which times may stray from their grid: more is not the rounding of written times."""
WHOLE: Final = 0.95
"""Share of the rows before a gap that is enough to go on without the rest."""
FEWEST: Final = 200
"""Samples between the first change of coarse times and the last, at least: they tell the rate to one of them."""
SLOWEST: Final = 10.0
"""Samples a second below which times without a unit are hardly seconds."""
EPOCH: Final = (1e9, 4e9)
"""Seconds since 1970 between which recordings begin."""
DAYS: Final = (2e4, 8e5)
"""Days that spreadsheets count, since 1900 or the year 0, between which recordings begin."""
FASTEST: Final = 1e6
"""Samples a second above which such numbers are days, not seconds."""
AGREES: Final = 0.05
RISING: Final = 0.9
RATE: Final = Range("rate", 0.0, 1e7, "Hz", open_low=True, key="rate_hz")
REMEDY: Final = (
    "Give the samples a second: --rate HZ; or the column of times with its unit: --time COLUMN:ms (Python: rate_hz=, "
    "time=)."
)


class Timing(NamedTuple):
    """Samples a second, the column that is no motion since it tells times or numbers rows, and the rows that count."""

    rate: float
    column: int | None
    rows: int


def timing(table: Lines, columns: Sequence[RecordingColumn], asked: RecordingOptions, remarks: list[str]) -> Timing:
    """Times of a table: as asked for, else by the names of its columns, else by what its other lines tell.

    Raises InputError where nothing tells them, or they are not equally spaced.
    """
    column = _column(table, columns, asked)
    if column is not None and column[0] in table.empty:
        raise InputError(
            "the column of times holds no numbers",
            place=Place(table.path, table.numbers[0], column[1].name),
            remedy=REMEDY,
        )
    rates = {told.rate: told.line for told in table.told if told.rate > 0}
    if asked.rate is not None:
        return Timing(asked.rate, column and column[0], len(table.values))
    if column is not None and not column[1].numbers_rows:
        per_unit, rows = rate_of(table, *column, remarks)
        rate = per_unit / _unit(table, *column, per_unit, rates, remarks)
        for other, line in rates.items():
            if abs(rate / other - 1) > AGREES:
                remarks.append(f"The times tell {rate:.4g} samples a second, line {line} {other:g}: the times count.")
        return Timing(rate, column[0], rows)
    if len(rates) != 1:
        raise InputError(
            "no column of time", place=Place(table.path, table.head),
            found=f"rates on several lines: {', '.join(f'{rate:g}' for rate in rates)}" if rates
            else ", ".join(table.names), remedy=REMEDY,
        )  # fmt: skip
    [(rate, line)] = rates.items()
    remarks.append(f"{rate:g} samples a second, as line {line} tells.")
    return Timing(rate, column and column[0], len(table.values))


def _column(
    table: Lines, columns: Sequence[RecordingColumn], asked: RecordingOptions
) -> tuple[int, RecordingColumn] | None:
    """The column of times, else that of sample numbers; None without either."""
    if asked.time is not None:
        name, _, unit = (asked.time, "", "") if asked.time in table.names else asked.time.rpartition(":")
        if name and unit and plain_unit(unit) not in TIME:
            allowed = "COLUMN, or COLUMN:UNIT with s, ms, us, ns or min"
            raise InputError("not a unit of time", place=Place(key="time"), found=asked.time, allowed=allowed)
        [index] = chosen(table.path, table.names, [name or unit])
        size = TIME[plain_unit(unit)] if name and unit else columns[index].unit
        return index, replace(columns[index], is_time=True, unit=size, numbers_rows=False)
    times = [k for k, column in enumerate(columns) if (column.is_time or k in table.clocks) and rises(table, k)]
    if not times and table.names[0].lower() == "x_value" and not {"Y_Value", "Y_value"} & set(table.names):
        return 0, replace(columns[0], is_time=True, unit=1.0)
    if times:
        index = next((k for k in times if columns[k].unit is not None), times[0])
        return index, columns[index]
    t = table.values[:, 0]
    rising = len(t) > 1 and bool((np.diff(t) > 0).all()) and 0 not in table.empty
    numbered = next((k for k, column in enumerate(columns) if column.numbers_rows), None)
    if numbered is not None:
        return numbered, columns[numbered]
    if table.named or asked.rate is not None or not rising:
        return None
    return 0, replace(columns[0], is_time=True, numbers_rows=bool((np.diff(t) == 1).all()))


def rises(table: Lines, index: int) -> bool:
    """True for a column whose numbers hardly ever fall, as times do."""
    return index not in table.empty and float(np.mean(np.diff(table.values[:, index]) >= 0)) > RISING


def _unit(
    table: Lines, index: int, column: RecordingColumn, per_unit: float, rates: Mapping[float, int], remarks: list[str]
) -> float:
    """Seconds of one unit of the times. Refused where the name tells none and they are hardly seconds."""
    if column.unit is not None or index in table.clocks:
        return column.unit or 1.0
    first = float(table.values[0, index])
    since = next((size for size in (1.0, 1e-3, 1e-6, 1e-9) if EPOCH[0] < first * size < EPOCH[1]), None)
    if since is None and DAYS[0] < first < DAYS[1] and per_unit > FASTEST:
        remarks.append(f"{column.name} counts days, as spreadsheets do.")
        return 86400.0
    if since is not None:
        remarks.append(f"{column.name} counts units of {since:g} s since 1970.")
        return since
    if per_unit < SLOWEST:
        if len(rates) == 1:
            [(rate, line)] = rates.items()
            remarks.append(f"{column.name} names no unit: {rate:g} samples a second, as line {line} tells.")
            return per_unit / rate
        raise InputError(
            "the unit of the times is not named", place=Place(table.path, table.head, column.name),
            found=f"{per_unit:.4g} samples a second, if they are seconds", remedy=f'Name it, such as --time "'
            f'{column.name}:ms", or give the samples a second: --rate HZ (Python: time=, rate_hz=).',
        )  # fmt: skip
    return 1.0


def rate_of(table: Lines, time: int, column: RecordingColumn, remarks: list[str]) -> tuple[float, int]:
    """Samples per unit of times that are equally spaced but for the rounding of their digits, and how many rows count.

    Times end before a gap that few rows follow. Raises InputError with the line of what is uneven.
    """
    t, path, count = table.values[:, time], table.path, len(table.values)

    def place(row: int) -> Place:
        return Place(path, table.numbers[row], column.name)

    if count < 3:
        raise InputError("too few rows", place=Place(path), found=f"{count}")
    gaps = _gaps(np.diff(t))
    if gaps and gaps[0] + 1 >= WHOLE * count:
        left = count - gaps[0] - 1
        count, t = gaps[0] + 1, t[: gaps[0] + 1]
        remarks.append(
            f"{column.name} has a gap before line {table.numbers[count]}: "
            f"{'the row' if left == 1 else f'the {left} rows'} from there on {'is' if left == 1 else 'are'} left out."
        )
    steps, fine = np.diff(t), _resolution(t)
    usual = float(t[-1] - t[0]) / (count - 1)
    coarse = 0 < 1.01 * usual < fine
    back = np.flatnonzero(steps < 0 if coarse else steps <= 0)
    if len(back):
        k = int(back[0]) + 1
        raise InputError(
            "the times do not ascend", place=place(k), found=f"{t[k]:.12g} after {t[k - 1]:.12g}",
            remedy="Another column: --time NAME. Without the times: --rate HZ (Python: time=, rate_hz=).",
        )  # fmt: skip
    if coarse:
        return _coarse_rate(table, column, t, fine, remarks), count
    stray = float(np.abs(t - np.linspace(t[0], t[-1], count)).max())
    rounded = stray <= 1.01 * fine <= 1.01 * usual and not _gaps(steps)
    if stray > EVEN * usual and not rounded:
        raise _uneven(steps, place)
    return 1 / usual, count


def _coarse_rate(
    table: Lines, column: RecordingColumn, t: NDArray[np.float64], fine: float, remarks: list[str]
) -> float:
    """Samples per unit of times that several samples share, from where they change first and last."""
    changes = np.flatnonzero(np.diff(t) > 0) + 1
    first, last = int(changes[0]), int(changes[-1])
    rate = (last - first) / float(t[last] - t[first]) if last > first else 0.0
    if last - first < FEWEST or float(np.abs(t - t[first] - (np.arange(len(t)) - first) / rate).max()) > 1.01 * fine:
        raise InputError(
            "the times are too coarse to tell the rate", place=Place(table.path, table.numbers[0], column.name),
            found=f"steps of {fine:g}", remedy="Give them: --rate HZ (Python: rate_hz=).",
        )  # fmt: skip
    remarks.append(f"{column.name} is too coarse to tell every sample: they are taken for equally spaced.")
    return rate


def _resolution(t: NDArray[np.float64]) -> float:
    """One unit of the last digit that the times are written with, decimals; 0 for more than twelve."""
    for digits in range(13):
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
        remedy="Record at a fixed rate, or write more digits. If the rate was fixed: --rate HZ (Python: rate_hz=).",
    )  # fmt: skip
