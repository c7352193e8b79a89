"""Velocity levels of a motion by octaves, its corrected total, and its weighted acceleration, axis by axis."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from abu_calc.analysis.octaves import Signal, band_rms, hand_arm_filter, octave_filter, why_not
from abu_calc.standards.vibration import Octave, octaves
from abu_calc.units import level_from_velocity


@dataclass(frozen=True)
class Band:
    """Rms velocity [m/s] in an octave; None with the reason why it is not known."""

    octave: Octave
    velocity: float | None
    reason: str | None = None


@dataclass(frozen=True)
class AxisLevels:
    """One axis of a place: rms velocity of the whole motion [m/s], by octaves, and weighted acceleration a_h [m/s²]."""

    name: str
    velocity: float | None
    bands: tuple[Band, ...]
    weighted: float | None
    weighted_reason: str | None = None

    @property
    def corrected(self) -> float | None:
        """Corrected rms velocity [m/s] of the octaves that are known; None where none is."""
        parts = [band.octave.share * band.velocity for band in self.bands if band.velocity is not None]
        return math.hypot(*parts) if parts else None


@dataclass(frozen=True)
class PlaceLevels:
    """The axes of one place."""

    name: str
    axes: tuple[AxisLevels, ...]

    @property
    def velocity(self) -> float | None:
        """Rms of the louder axis [m/s]."""
        return largest(axis.velocity for axis in self.axes)

    @property
    def corrected(self) -> float | None:
        """Of the axis where it is largest [m/s]."""
        return largest(axis.corrected for axis in self.axes)

    @property
    def total(self) -> float | None:
        """a_hv [m/s²]: vector sum of the weighted accelerations of the axes that there are."""
        parts = [axis.weighted for axis in self.axes if axis.weighted is not None]
        return math.hypot(*parts) if len(parts) == len(self.axes) else None

    @property
    def complete(self) -> bool:
        """Whether every octave is known."""
        return all(band.velocity is not None for axis in self.axes for band in axis.bands)

    def loudest(self, index: int) -> Band:
        """An octave on the axis where it is loudest."""
        return max((axis.bands[index] for axis in self.axes), key=lambda band: band.velocity or -1.0)


def largest(values: Iterable[float | None]) -> float | None:
    """Of those that are known."""
    return max((value for value in values if value is not None), default=None)


def level(velocity: float | None) -> float | None:
    """The level [dB] of an rms velocity; None where there is none."""
    return level_from_velocity(velocity) if velocity else None


def axis_levels(name: str, signal: Signal) -> AxisLevels:
    """Of a signal. Its whole velocity: rms about the mean from its start on, of accelerations that of the octaves."""
    bands = tuple(_band(signal, octave) for octave in octaves())
    weighting = hand_arm_filter()
    reason = why_not(signal, weighting)
    weighted = band_rms(signal, weighting) if reason is None else None
    return AxisLevels(name, _whole(signal, bands), bands, weighted, reason)


def _band(signal: Signal, octave: Octave) -> Band:
    band = octave_filter(octave)
    reason = why_not(signal, band)
    return Band(octave, band_rms(signal, band) if reason is None else None, reason)


def _whole(signal: Signal, bands: Sequence[Band]) -> float | None:
    """Rms velocity [m/s]; of places by a spline of the fifth degree, its slope within 0.1 % at 8 samples a turn."""
    first = min(math.ceil(signal.start * signal.rate), len(signal.samples) - 2)
    if signal.derivative == 1:
        known = [band.velocity for band in bands if band.velocity is not None]
        return math.hypot(*known) if known else None
    values = np.asarray(signal.samples, dtype=float)
    if signal.derivative == -1:
        if len(values) < 8:
            return None
        from scipy.interpolate import make_interp_spline

        values = make_interp_spline(np.arange(len(values)), values, k=5).derivative()(np.arange(len(values)))
        values = values * signal.rate
    return float(np.std(values[first:]))


def halves_differ(signal: Signal) -> float | None:
    """By how much the second half of what is averaged is louder than the first [dB]; None where one is silent."""
    values = np.asarray(signal.samples[math.ceil(signal.start * signal.rate) :], dtype=float)
    first, second = (float(np.std(half)) for half in np.array_split(values, 2))
    return 20 * math.log10(second / first) if first > 0 and second > 0 else None


def carried(place: PlaceLevels, name: str, share: float) -> PlaceLevels:
    """The levels of another place, which moves `share` times as much."""
    axes = tuple(
        AxisLevels(
            axis.name,
            None if axis.velocity is None else share * axis.velocity,
            tuple(
                Band(band.octave, None if band.velocity is None else share * band.velocity, band.reason)
                for band in axis.bands
            ),
            None if axis.weighted is None else share * axis.weighted,
            axis.weighted_reason,
        )
        for axis in place.axes
    )
    return PlaceLevels(name, axes)


def with_tone(place: PlaceLevels, velocity: float, weighted: float, frequency: float) -> PlaceLevels:
    """The levels with a tone of a frequency [rad/s] added as energy to every axis: rms velocity and weighted one."""

    def added(value: float | None, more: float) -> float | None:
        return None if value is None else math.hypot(value, more)

    axes = tuple(
        AxisLevels(
            axis.name,
            added(axis.velocity, velocity),
            tuple(
                Band(
                    band.octave,
                    added(band.velocity, velocity if band.octave.low <= frequency < band.octave.high else 0.0),
                    band.reason,
                )
                for band in axis.bands
            ),
            added(axis.weighted, weighted),
            axis.weighted_reason,
        )
        for axis in place.axes
    )
    return PlaceLevels(place.name, axes)
