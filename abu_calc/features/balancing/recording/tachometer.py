"""Passages of the zero mark at its sensor: times of revolutions from pulses.

Pulses have either polarity and are square or rounded.
"""

from typing import Final, Literal

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass

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
