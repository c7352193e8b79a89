"""A recorded run: its CSV file, and amplitude and phase of both sensors at the speed of rotation.

    x = Σ of offset, its drift, A·cos(θ − α) with a steady change of A, and the next harmonics, θ the rotor's angle

θ comes from the passages of the mark, so that a drifting speed smears nothing; the sum is fitted by least squares over
the whole revolutions between the first passage and the last, evenly sampled or not. Columns of the file: time, left,
right, mark.

Passages of the zero mark at its sensor: times of revolutions from pulses.

Pulses have either polarity and are square or rounded.
"""

import math
from pathlib import Path
from typing import Final, Literal

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown
from abu_calc.inputs.recording_columns import column_of
from abu_calc.inputs.recording_files import content_of
from abu_calc.inputs.recording_table import decoded, table_of

Array = NDArray[np.float64]
Indices = NDArray[np.intp]
Edge = Literal["leading", "middle", "trailing"]

LOW: Final = 0.3
HIGH: Final = 0.7
"""Shares of a pulse's height: it begins above HIGH and ends below LOW, so that noise makes no pulse."""
ALIKE: Final = 0.1
"""Part of a revolution by which the mark must be longer up than down, or down than up."""
CLEAR: Final = 6.0
"""Least height of a pulse over the noise between pulses."""
BOTH_WAYS: Final = 0.5
"""A mark that goes this part of its height to the other side as well has no edge that is its passage."""
ROUNDED: Final = 0.2
"""Part of its height over which the top of a rounded pulse spreads, beyond its noise; that of a square one is flat."""
IN_STEP: Final = 0.9
"""Part of a sample within which passages are not told more closely: the sampling goes in step with the rotation."""


@dataclass(frozen=True)
class Passages:
    """Times of the mark's passages [s], one a pulse, by which edge, and how wide the pulses are [s]."""

    times: Array
    edge: Edge
    width: float
    square: bool
    step: float
    """Time between samples [s]."""
    unsure: float
    """Possible common error of all passages [s], limited by the sampling."""


def passages(time: Array, mark: Array, edge: Edge | None = None) -> Passages:
    """The passages of a mark. Raises InputError where there are no pulses one way.

    `edge`: what of a pulse counts; None: the leading edge of a square one, the middle of a rounded one.
    """
    signal, square = _upward(mark)
    rises, falls = _edges(signal)
    if len(rises) < 2:
        raise InputError("the mark has no pulses, or a single one", found=f"{len(rises)} pulses", remedy=LONGER)
    step = float(np.median(np.diff(time)))
    leading, trailing = (_crossings(time, signal, *ends) for ends in (rises.T, falls.T))
    width = float(np.median(trailing - leading))
    unsure = 0.0
    if square and np.median(rises[:, 1] - rises[:, 0]) <= 1:
        leading, unsure = _between_samples(time, *rises.T, first=_begins_at_the_mark(signal, rises, falls))
        trailing, _ = _between_samples(time, *falls.T, first=False)
    which: Edge = edge or ("leading" if square else "middle")
    times = {"leading": leading, "middle": (leading + trailing) / 2, "trailing": trailing}[which]
    return Passages(times, which, width, square, step, unsure)


LONGER: Final = "record several revolutions, with a mark that gives one pulse in each"


def _upward(mark: Array) -> tuple[Array, bool]:
    """The mark as pulses from 0 up to 1, whatever its polarity, and whether they are square."""
    middle = (mark.max() + mark.min()) / 2
    share = float(np.mean(mark > middle))
    if abs(share - 0.5) < ALIKE:
        raise InputError(
            "the mark is as long up as down, so that either edge may be its passage", found=f"{share:.0%} up",
            allowed=f"below {0.5 - ALIKE:.0%} or above {0.5 + ALIKE:.0%}", remedy="a shorter mark",
        )  # fmt: skip
    sign = 1.0 if share < 0.5 else -1.0
    up = sign * (mark - middle) > 0
    if not up.any():
        raise InputError("the mark has no pulses", found=f"{mark.min():g} throughout", remedy=LONGER)
    rest = mark[~up]
    signal = sign * (mark - np.median(rest))
    height = float(np.quantile(signal[up], 0.9))
    quiet = signal[~up]
    if -quiet.min() > BOTH_WAYS * height:
        raise InputError(
            "the mark swings to both sides of its rest, so that no edge is its passage",
            found=f"{-quiet.min() / height:.2f} of its height to the other side",
            allowed=f"at most {BOTH_WAYS:g}",
            remedy="record the trigger's output, pulses one way",
        )
    noise = float(np.median(np.abs(quiet - np.median(quiet)))) * 1.4826
    if height < CLEAR * noise:
        raise InputError(
            "the mark's pulses are lost in its noise", found=f"{height / noise:.1f} times the noise",
            allowed=f"at least {CLEAR:g} times",
        )  # fmt: skip
    low, high = np.quantile(signal[up], (0.1, 0.9))
    return signal / height, bool(high - low < ROUNDED * height + 3 * noise)


def _begins_at_the_mark(signal: Array, rises: Indices, falls: Indices) -> bool:
    """True if the record begins with a whole pulse at its first sample: the mark started the record."""
    length = int(np.median(falls[:, 1] - rises[:, 1]))
    return bool(signal[0] > HIGH) and int(np.argmax(signal < LOW)) == length


def _edges(signal: Array) -> tuple[Indices, Indices]:
    """Return the last sample before and the first after each whole pulse's rise, and likewise its fall."""
    high, low = signal > HIGH, signal < LOW
    places = np.arange(len(signal))
    last = np.maximum.accumulate(np.where(high | low, places, -1))
    known = last >= 0
    inside = np.where(known, high[np.maximum(last, 0)], False)
    turns = np.flatnonzero(np.diff(inside.astype(np.int8))) + 1
    ups = np.array([k for k in turns if inside[k] and known[k - 1]], dtype=np.intp)
    downs = np.array([k for k in turns if not inside[k]], dtype=np.intp)
    downs = downs[downs > ups[0]] if len(ups) else downs[:0]
    count = min(len(ups), len(downs))
    ups, downs = ups[:count], downs[:count]
    return (
        np.stack([last[ups - 1], ups], axis=1) if count else np.empty((0, 2), np.intp),
        np.stack([last[downs - 1], downs], axis=1) if count else np.empty((0, 2), np.intp),
    )


def _crossings(time: Array, signal: Array, before: Indices, after: Indices) -> Array:
    """Times at half height, by the straight line through the samples of each edge."""
    edge_times = []
    for first, last in zip(before, after, strict=True):
        times, heights = time[first : last + 1], signal[first : last + 1]
        spread = heights - heights.mean()
        slope = float(spread @ (times - times.mean()) / (spread @ spread))
        edge_times.append(times.mean() + slope * (0.5 - heights.mean()))
    return np.array(edge_times)


def _between_samples(time: Array, before: Indices, after: Indices, *, first: bool) -> tuple[Array, float]:
    """Times of edges that each fall between two samples, and by how much they may be off: all tell more than one.

    Even revolutions leave only so much room for all edges to lie between their samples: its middle. Sampling in
    step with the rotation gives no such help; `first`: the record was started by the mark, so that samples are at it.
    """
    middles = (time[before] + time[after]) / 2
    even = smooth(middles)
    lowest, highest = float(np.max(time[before] - even)), float(np.min(time[after] - even))
    step = float(np.median(time[after] - time[before]))
    room = highest - lowest
    if first and room > IN_STEP * step:
        return even + highest, 0.0
    return (even + (lowest + highest) / 2, max(room, 0.0) / 2) if room > -0.6 * step else (middles, 0.0)


def smooth(times: Array) -> Array:
    """Times of revolutions by the polynomial that describes them best for its degree."""
    counts = np.arange(len(times), dtype=np.float64)
    where = 2 * counts / max(len(times) - 1, 1) - 1
    best, least = times, np.inf
    for degree in range(1, min(6, len(times) - 2) + 1):
        fitted = np.asarray(polynomial.polyval(where, polynomial.polyfit(where, times, degree)), dtype=np.float64)
        error = float(np.mean((times - fitted) ** 2)) + (1e-9 * float(np.ptp(times))) ** 2
        worth = len(times) * np.log(error) + 2 * degree * np.log(len(times))
        if worth < least:
            best, least = fitted, worth
    return best


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
