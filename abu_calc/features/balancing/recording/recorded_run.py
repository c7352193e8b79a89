"""A recorded run: its CSV file, and amplitude and phase of both sensors at the speed of rotation.

    x = Σ of offset, its drift, A·cos(θ − α) with a steady change of A, and the next harmonics, θ the rotor's angle

θ comes from the passages of the mark, so that a drifting speed smears nothing; the sum is fitted by least squares over
the whole revolutions between the first passage and the last, evenly sampled or not. Columns of the file: time, left,
right, mark.
"""

import io
import math
import re
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.balancing.recording.tachometer import LONGER, Edge, Passages, passages, smooth
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.inputs.reading.sources import regular_file

Array = NDArray[np.float64]


LARGEST: Final = 300_000_000
"""Bytes of the largest record that is read."""
COLUMNS: Final = ("time", "left", "right", "mark")
TIME: Final = re.compile(r"(time|t)\b|(time|t)[_ (\[]")
REMEDY: Final = "a header time,left,right,mark; then a row for each sample, time in seconds"


@dataclass(frozen=True)
class RigRecord:
    """Samples of a run: time [s], both sensors in the unit of the run's quantity, the mark in any unit."""

    time: Array
    left: Array
    right: Array
    mark: Array


def read_rig_record(path: Path) -> RigRecord:
    """Reads a record; columns go by their names, or without a header in the order of COLUMNS.

    Points or, between semicolons, commas as decimal signs. Raises InputError with file, line and remedy.
    """
    rows = [
        (line, row) for line, row in enumerate(_text(path).splitlines(), 1) if row.strip() and row.strip()[0] != "#"
    ]
    if not rows:
        raise InputError("the record is empty", place=Place(str(path)), allowed=REMEDY)
    separator = next((sign for sign in ";\t," if sign in rows[0][1]), None)
    if separator == ";":
        rows = [(line, row.replace(",", ".")) for line, row in rows]
    first = _split(rows[0][1], separator)
    columns, scale, skip = _columns(first, path, rows[0][0])
    table = _table(rows[skip:], separator, columns, path)
    _check(table, rows[skip:], path)
    return RigRecord(table[:, 0] * scale, table[:, 1], table[:, 2], table[:, 3])


def _text(path: Path) -> str:
    try:
        return regular_file(path, LARGEST).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError("the record is not UTF-8 text", place=Place(str(path)), remedy="export it as CSV") from None


def _split(row: str, separator: str | None) -> list[str]:
    return [cell.strip().strip('"') for cell in row.split(separator)]


def _columns(first: list[str], path: Path, line: int) -> tuple[tuple[int, ...], float, int]:
    """The places of the four columns, seconds per unit of time, and how many rows the header takes."""
    place = Place(str(path), line)
    if len(first) < len(COLUMNS):
        raise InputError("too few columns", place=place, found=str(len(first)), allowed=REMEDY)
    if _is_number(first[0]):
        return tuple(range(len(COLUMNS))), 1.0, 0
    names = [name.lower() for name in first]
    matches = [[k for k, name in enumerate(names) if _is(name, column)] for column in COLUMNS]
    if len(names) == len(COLUMNS) and not any(matches[1:]):
        matches = [[k] for k in range(len(COLUMNS))]  # names of another language: in the order asked for
    if any(len(each) != 1 for each in matches):
        raise InputError(
            "columns are not told apart by their names", place=place, found=", ".join(first), allowed=REMEDY
        )
    time = names[matches[0][0]]
    return tuple(each[0] for each in matches), 1e-3 if re.search(r"[_ (\[]ms\b", time) else 1.0, 1


def _is(name: str, column: str) -> bool:
    return bool(TIME.match(name)) if column == "time" else name.startswith(column)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _table(rows: list[tuple[int, str]], separator: str | None, columns: tuple[int, ...], path: Path) -> Array:
    if not rows:
        raise InputError("the record has no samples", place=Place(str(path)), allowed=REMEDY)
    text = io.StringIO("\n".join(row for _, row in rows))
    try:
        return np.loadtxt(text, delimiter=separator, usecols=columns, ndmin=2, dtype=np.float64)
    except ValueError:
        for line, row in rows:
            cells = _split(row, separator)
            wrong = next((k for k in columns if k >= len(cells) or not _is_number(cells[k])), None)
            if wrong is not None:
                entry = cells[wrong] if wrong < len(cells) else f"{len(cells)} columns"
                raise InputError(
                    "not a number", place=Place(str(path), line), found=entry or "nothing", allowed=REMEDY
                ) from None
        raise


def _check(table: Array, rows: list[tuple[int, str]], path: Path) -> None:
    """Every number finite, time ascending."""
    wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if wrong.size:
        line, row = rows[int(wrong[0])]
        raise InputError("a finite number is expected", place=Place(str(path), line), found=row.strip()[:60])
    back = np.flatnonzero(np.diff(table[:, 0]) <= 0)
    if back.size:
        line, _ = rows[int(back[0]) + 1]
        times = " after ".join(f"{value:.9g}" for value in table[[back[0] + 1, back[0]], 0])
        remedy = "write time with more digits, if it stands still"
        raise InputError("time does not go on", place=Place(str(path), line), found=times, remedy=remedy)


LEAST_REVOLUTIONS: Final = 3
TREND_FROM: Final = 6
"""Revolutions from which a change of the amplitude and harmonics are fitted too."""
LEAST_SAMPLES: Final = 8
"""Least number of samples in a revolution."""
MOST_DRIFT: Final = 0.2
"""Largest relative drift of the speed over a record; beyond it the run is not at steady speed."""
SPEED_AGREES: Final = 0.05
UNEVEN: Final = 0.25
"""Part of a revolution by which two passages in a row may be off."""
HARMONICS: Final = (2, 3)
ROUGH: Final = 0.3
"""Share of a step between samples within which even revolutions must match the passages."""


@dataclass(frozen=True)
class Tone:
    """Signal of one sensor at the speed of rotation, in its unit: A·cos(θ − phase).

    `noise`: standard error of the amplitude, from the residual of the fit; `change`: of amplitude and phase
    together over the record, as a vector, relative; `share`: of the motion about its mean (rms) that it
    makes.
    """

    amplitude: float
    phase: float
    noise: float
    change: float
    share: float


@dataclass(frozen=True)
class RecordedRun:
    """Readings of a recorded run; `speed`: mean [rad/s], `drift`: of it over the record, relative."""

    speed: float
    left: Tone
    right: Tone
    revolutions: int
    drift: float
    marks: Passages

    @property
    def unsure(self) -> float:
        """Possible common error of all phases, limited by the sampling of the passages [rad]."""
        return self.speed * self.marks.unsure

    @property
    def pulse(self) -> float:
        """The angle that the rotor turns while a pulse lasts [rad]."""
        return self.speed * self.marks.width


def recorded_run(record: RigRecord, edge: Edge | None = None, speed: float | None = None) -> RecordedRun:
    """Readings from a record; `speed` [rad/s], if given, is held against that of the marks. Raises InputError."""
    marks = passages(record.time, record.mark, edge)
    counts = _counted(marks.times)
    revolutions = int(counts[-1])
    if revolutions < LEAST_REVOLUTIONS:
        raise InputError(
            "too few revolutions between the marks", found=str(revolutions), allowed=f"at least {LEAST_REVOLUTIONS}",
            remedy=LONGER,
        )  # fmt: skip
    mean = 2 * math.pi * revolutions / float(marks.times[-1] - marks.times[0])
    _check_speed(mean, speed)
    drift = _drift(marks.times, counts)
    inside = (record.time >= marks.times[0]) & (record.time <= marks.times[-1])
    if np.count_nonzero(inside) < LEAST_SAMPLES * revolutions:
        raise InputError(
            "too few samples in a revolution", found=f"{np.count_nonzero(inside) / revolutions:.1f}",
            allowed=f"at least {LEAST_SAMPLES}", remedy="sample faster",
        )  # fmt: skip
    angle = _angle(record.time[inside], marks, counts)
    terms = _terms(angle, revolutions)
    values = np.column_stack([record.left[inside], record.right[inside]])
    solution, *_ = np.linalg.lstsq(terms, values, rcond=None)
    left, right = (_tone(terms, solution[:, k], values[:, k], revolutions) for k in (0, 1))
    return RecordedRun(mean, left, right, revolutions, drift, marks)


def _counted(times: Array) -> Array:
    """Revolutions at each passage; a mark that was missed leaves a gap of whole revolutions."""
    steps = np.diff(times)
    usual = np.array([np.median(steps[max(0, k - 2) : k + 3]) for k in range(len(steps))])
    turns = np.maximum(np.rint(steps / usual), 1.0)
    off = np.abs(steps / usual - turns)
    if len(steps) and off.max() > UNEVEN:
        raise InputError(
            "the marks do not come once a revolution", found=f"{off.max():.2f} of a revolution off",
            allowed=f"at most {UNEVEN:g}", remedy="one pulse a revolution, and no false ones between",
        )  # fmt: skip
    return np.concatenate([[0.0], np.cumsum(turns)])


def _check_speed(measured: float, given: float | None) -> None:
    if given is None or abs(measured / given - 1) <= SPEED_AGREES:
        return
    ratio = measured / given
    twice = next((n for n in (2, 3, 4) if abs(ratio / n - 1) < SPEED_AGREES), None)
    remedy = f"{twice} pulses a revolution? One is needed." if twice else "correct speed_rpm, or leave it out"
    raise InputError(
        "the marks tell another speed", found=f"{from_si(measured, 'rpm'):.1f} rpm by the marks",
        allowed=f"{from_si(given, 'rpm'):g} rpm ± {SPEED_AGREES:.0%}", remedy=remedy,
    )  # fmt: skip


def _drift(times: Array, counts: Array) -> float:
    """Change of the speed over the record, relative, by the curve through the passages. Refuses a run-up."""
    if len(times) < 4:
        return 0.0
    even = smooth(times) if len(times) == int(counts[-1]) + 1 else times
    speeds = np.diff(counts) / np.diff(even)
    edge = max(1, len(speeds) // 10)
    drift = float((speeds[-edge:].mean() - speeds[:edge].mean()) / speeds.mean())
    if abs(drift) > MOST_DRIFT:
        raise InputError(
            "the speed is not steady", found=f"{drift:+.0%} over the record", allowed=f"at most {MOST_DRIFT:.0%}",
            remedy="cut the record to its steady part",
        )  # fmt: skip
    return drift


def _angle(time: Array, marks: Passages, counts: Array) -> Array:
    """The rotor's angle since the first passage [rad], by even revolutions where they tell the passages well enough."""
    times = marks.times
    if len(times) == int(counts[-1]) + 1 and len(times) > 3:
        even = smooth(times)
        if float(np.std(times - even)) < ROUGH * marks.step + 1e-4 * float(np.median(np.diff(times))):
            times = even
    # Between passages the speed changes, too: a curve through three neighbours instead of a straight line.
    return 2 * math.pi * _curved(time, times, counts)


def _curved(time: Array, times: Array, counts: Array) -> Array:
    """Counts between passages, by the mean of the parabolas through each passage and its neighbours."""
    slopes = np.gradient(counts, times, edge_order=2 if len(times) > 2 else 1)
    place = np.clip(np.searchsorted(times, time, side="right") - 1, 0, len(times) - 2)
    step = times[place + 1] - times[place]
    s = (time - times[place]) / step
    return np.asarray(
        counts[place] * (1 + 2 * s) * (1 - s) ** 2 + counts[place + 1] * s**2 * (3 - 2 * s)
        + step * (slopes[place] * s * (1 - s) ** 2 - slopes[place + 1] * s**2 * (1 - s))
    )  # fmt: skip


def _terms(angle: Array, revolutions: int) -> Array:
    """Columns of the fit: cosine and sine first, then trend and harmonics."""
    along = 2 * angle / angle[-1] - 1
    fundamental = np.cos(angle), np.sin(angle)
    rest = [np.ones_like(angle), along]
    if revolutions >= TREND_FROM:
        rest += [along**2, along * fundamental[0], along * fundamental[1]]
        rest += [wave(k * angle) for k in HARMONICS for wave in (np.cos, np.sin)]
    return np.column_stack([*fundamental, *rest])


def _tone(terms: Array, solution: Array, values: Array, revolutions: int) -> Tone:
    """The tone of fitted terms, cosine and sine first."""
    left = values - terms @ solution
    amplitude = math.hypot(solution[0], solution[1])
    spread = float(np.std(values - np.polyval(np.polyfit(terms[:, 3], values, 1), terms[:, 3])))
    change = math.hypot(solution[5], solution[6]) * 2 / amplitude if revolutions >= TREND_FROM and amplitude else 0.0
    noise = float(np.std(left)) * math.sqrt(2 / len(values))
    share = min(1.0, amplitude / math.sqrt(2) / spread) if spread > 0 else 0.0
    return Tone(amplitude, math.atan2(solution[1], solution[0]), noise, change, share)
