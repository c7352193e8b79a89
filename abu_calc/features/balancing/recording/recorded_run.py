"""A recorded run: its CSV file, and amplitude and phase of both sensors at the speed of rotation.

    x = Σ of offset, its drift, A·cos(θ − α) with a steady change of A, and the next harmonics, θ the rotor's angle

θ comes from the passages of the mark, so that a drifting speed smears nothing; the sum is fitted by least squares over
the whole revolutions between the first passage and the last, evenly sampled or not. Columns of the file: time, left,
right, mark.
"""

import math
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.balancing.recording.tachometer import LONGER, Edge, Passages, passages, smooth
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown
from abu_calc.inputs.recording_columns import column_of
from abu_calc.inputs.recording_files import content_of
from abu_calc.inputs.recording_table import decoded, table_of

Array = NDArray[np.float64]


COLUMNS: Final = ("time", "left", "right", "mark")
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
    table = table_of(str(path), decoded(*content_of(path)), [])
    place = Place(str(path), table.head)
    if len(table.names) < len(COLUMNS):
        raise InputError("too few columns", place=place, found=str(len(table.names)), allowed=REMEDY)
    names, times = [name.lower() for name in table.names], [column_of(name) for name in table.names]
    matches = [
        [k for k, name in enumerate(names) if (times[k].is_time if column == "time" else name.startswith(column))]
        for column in COLUMNS
    ]
    if not table.named or (len(names) == len(COLUMNS) and not any(matches[1:])):
        matches = [[k] for k in range(len(COLUMNS))]  # names of another language: in the order asked for
    if any(len(each) != 1 for each in matches):
        raise InputError(
            "columns are not told apart by their names", place=place, found=", ".join(table.names), allowed=REMEDY
        )
    time, left, right, mark = (table.values[:, each[0]] for each in matches)
    back = np.flatnonzero(np.diff(time) <= 0)
    if back.size:
        k = int(back[0]) + 1
        raise InputError(
            "time does not go on", place=Place(str(path), table.numbers[k]),
            found=f"{time[k]:.9g} after {time[k - 1]:.9g}", remedy="write time with more digits, if it stands still",
        )  # fmt: skip
    return RigRecord(time * (times[matches[0][0]].unit or 1.0), left, right, mark)


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
        "the marks tell another speed", found=f"{shown(measured, 'rpm', '.1f')} by the marks",
        allowed=f"{shown(given, 'rpm', 'g')} ± {SPEED_AGREES:.0%}", remedy=remedy,
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
