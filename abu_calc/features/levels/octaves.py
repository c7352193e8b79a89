"""Rms values of recorded or simulated motion: by octaves as velocity, and weighted by W_h as acceleration.

A filter is that of SciPy as an analogue network, put on the spectrum of the record. There is no warping by the
sampling, and the edges of a band are exact. It is causal, so that only the start of a record has to be left out until
the filter is settled.
"""

import math
from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.standards.vibration import Octave, ThirdOctave, band_limits, hand_arm_response, high_pass, octaves

Array = NDArray[np.float64]

ORDER: Final = 12
"""Order of the Butterworth band pass.

It is within 0.01 dB over three quarters of an octave, and 78 dB down in the middle of the next one.
"""
SETTLED: Final = 28.0
"""Periods of a band's centre until its filter has settled to 0.01 dB."""
THIRD_ORDER: Final = 6
"""Order of the Butterworth band pass of a third octave: within 0.15 dB over three quarters of it, class 1."""
THIRD_SETTLED: Final = 43.0
"""Periods of a third octave's centre likewise: half the order, a third of the width."""
FADED: Final = 0.3
"""Share of that time over which the record is faded in: a jump at its start would ring longer."""
RAMP: Final = 4.0
"""Periods over which the mean begins, and over which it ends: parts of periods then count for nothing."""
WIDE_PERIOD: Final = 1 / 50
"""Period [s] that times of the filters over all octaves are counted in."""
LEAST: Final = SETTLED + 2 * RAMP
"""Periods of an octave's centre that a record must last."""
SHARE_OF_NYQUIST: Final = 0.9
"""Share of half the sampling rate up to which a record is trusted."""
BLOCK: Final = 2**18
"""Samples that are filtered at once."""


@dataclass(frozen=True)
class Filter:
    """A band: `period` [s] that its times are counted in, its edges [rad/s], its response to iω [rad/s].

    `settled`: periods until it has settled.
    """

    period: float
    low: float
    high: float
    response: Callable[[NDArray[np.complex128]], NDArray[np.complex128]]
    settled: float = SETTLED

    @property
    def least(self) -> float:
        """Periods that a record must last."""
        return self.settled + 2 * RAMP


@dataclass(frozen=True)
class AxisSignal:
    """Equally spaced samples of one axis [SI] from 0 s on; `derivative` of the velocity: −1 place, 0, 1 acceleration.

    `start` [s]: where means begin; what comes before only lets the filters settle. `whole`: a band may begin earlier
    where it has too little time from there, since the motion is steady.
    """

    samples: NDArray[np.float64]
    rate: float
    derivative: int
    start: float = 0.0
    whole: bool = False

    @property
    def duration(self) -> float:
        """Duration of the record [s]."""
        return len(self.samples) / self.rate


def octave_filter(band: Octave | ThirdOctave) -> Filter:
    """Butterworth, −3 dB at the edges of the band. Class 1 of IEC 61260-1:2014 with room to spare."""
    from scipy.signal import butter, freqs_zpk

    order, settled = (ORDER, SETTLED) if isinstance(band, Octave) else (THIRD_ORDER, THIRD_SETTLED)
    zeros, poles, gain = butter(order, [band.low, band.high], "bandpass", analog=True, output="zpk")

    def response(s: NDArray[np.complex128]) -> NDArray[np.complex128]:
        return np.asarray(freqs_zpk(zeros, poles, [gain], worN=s.imag)[1], dtype=np.complex128)

    return Filter(2 * math.pi / band.centre, band.low, band.high, response, settled)


def hand_arm_filter() -> Filter:
    """W_h of ISO 5349-1:2001 with its band limits, from a velocity to an acceleration."""
    return _wide(lambda s: s * hand_arm_response(s))


def place_filter() -> Filter:
    """The band limits of ISO 5349-1:2001, from a velocity to a place; the lower one twice: places drift."""
    return _wide(lambda s: high_pass(s) * band_limits(s) / s)


def acceleration_filter() -> Filter:
    """The band limits of ISO 5349-1:2001 alone, from a velocity to an acceleration."""
    return _wide(lambda s: s * band_limits(s))


def _wide(response: Callable[[NDArray[np.complex128]], Any]) -> Filter:
    """All octaves together; of low order, so that 20 ms stand for its period."""
    edges = octaves()[0].low, octaves()[-1].high
    return Filter(WIDE_PERIOD, *edges, lambda s: np.asarray(response(s), dtype=np.complex128))


def needed_rate(band: Filter) -> float:
    """Samples a second that a band asks for."""
    return from_si(band.high, "hz") * 2 / SHARE_OF_NYQUIST


def why_not(signal: AxisSignal, band: Filter) -> str | None:
    """Why a record does not tell a band's velocity, in words that suit several bands; None where it does."""
    if band.high > SHARE_OF_NYQUIST * math.pi * signal.rate:
        needed = f"{2 / SHARE_OF_NYQUIST:.2g} times its upper edge"
        return f"sampled too slowly, at {signal.rate:.5g} Hz: {needed} are needed"
    if signal.duration < band.least * band.period * (1 - 1e-9):
        needed = f"{band.least:g} of its periods"
        return f"the record is too short, {signal.duration:.3g} s: {needed} are needed"
    if not signal.whole and signal.duration - signal.start < 2 * RAMP * band.period:
        needed = f"{2 * RAMP:g} of its periods"
        left = signal.duration - signal.start
        return f"too little is left of the record, {left:.3g} s: {needed} are needed"
    return None


def band_rms(signal: AxisSignal, band: Filter) -> float:
    """Rms [SI] of what a filter makes of the velocity behind a signal, in the mean from its `start` on.

    A filter times s gives the acceleration of a velocity. Assumes `why_not` None. Exact for steady motion to 0.01 dB
    in the inner three quarters of a band; what jumps counts as it does in an instrument.
    """
    count = len(signal.samples)
    settled = band.settled * band.period
    start = min(signal.start, signal.duration - 2 * RAMP * band.period) if signal.whole else signal.start
    first = math.ceil(max(start, settled) * signal.rate)
    weights_of = _ramps(first, count, RAMP * band.period * signal.rate)
    power = total = 0.0
    for index, values in _filtered(signal, band, first):
        weights = weights_of(index)
        power += float(weights @ values**2)
        total += float(weights.sum())
    return math.sqrt(power / total)


def weighted_rms(values: Array, share: float) -> float:
    """Rms about the mean, weights rising and falling as sin² over a share of the values at either end."""
    weights = _ramps(0, len(values), share * len(values))(np.arange(len(values), dtype=float))
    mean = float(weights @ values) / float(weights.sum())
    return math.sqrt(float(weights @ (values - mean) ** 2) / float(weights.sum()))


def _ramps(first: int, count: int, length: float) -> Callable[[Array], Array]:
    """Weights of the samples from `first` on: they rise and fall as sin² over `length` samples."""
    length = max(min(length, (count - first) / 2), 1.0)

    def weights(index: Array) -> Array:
        inward = np.minimum(index - first + 0.5, count - index - 0.5) / length
        return np.asarray(np.sin(math.pi / 2 * np.clip(inward, 0.0, 1.0)) ** 2)

    return weights


def _filtered(signal: AxisSignal, band: Filter, first: int) -> Iterator[tuple[Array, Array]]:
    """Indices and filtered values from `first` on, block by block; each is led in by twice the time to settle."""
    from scipy.fft import irfft, next_fast_len, rfft, rfftfreq

    lead = math.ceil(2 * band.settled * band.period * signal.rate)
    mean, count = float(np.mean(signal.samples)), len(signal.samples)
    responses: dict[int, NDArray[np.complex128]] = {}
    for begin in range(first, count, max(BLOCK, 4 * lead)):
        end, early = min(begin + max(BLOCK, 4 * lead), count), max(begin - lead, 0)
        part = np.asarray(signal.samples[early:end], dtype=float) - mean
        faded = min(math.ceil(FADED * band.settled * band.period * signal.rate), len(part))
        part[:faded] *= np.sin(math.pi / 2 * np.arange(faded) / faded) ** 2
        # It goes on behind its end and fades, so that no jump rings; then room for what rings on.
        behind = min(math.ceil(RAMP * band.period * signal.rate), len(part) - 1)
        beyond = 2 * part[-1] - part[-2 : -2 - behind : -1]
        part = np.concatenate([part, beyond * np.cos(math.pi / 2 * np.arange(1, behind + 1) / (behind + 1)) ** 2])
        size = next_fast_len(len(part) + lead, real=True)
        if size not in responses:
            responses[size] = _response(signal, band, 2 * math.pi * rfftfreq(size, 1 / signal.rate))
        values = irfft(rfft(part, size) * responses[size], size)[begin - early : end - early]
        yield np.arange(begin, end, dtype=float), values


def _response(signal: AxisSignal, band: Filter, frequencies: Array) -> NDArray[np.complex128]:
    """Response of a filter to a signal at frequencies [rad/s].

    It is set to zero three octaves away, where it is 200 dB down.
    """
    response = np.zeros(len(frequencies), dtype=np.complex128)
    near = (frequencies > band.low / 8) & (frequencies < 8 * band.high)
    s = np.asarray(1j * frequencies[near], dtype=np.complex128)
    response[near] = band.response(s) * s ** (-signal.derivative)
    return response


def folded_share(signal: AxisSignal) -> float:
    """Share of the power of a signal above three quarters of half its sampling rate: much there tells of too slow
    sampling, which folds what is faster into the bands.
    """
    from scipy.signal import welch

    size = min(len(signal.samples), 4096)
    frequencies, power = welch(np.asarray(signal.samples[-(2**18) :], dtype=float), signal.rate, nperseg=size)
    whole = float(power.sum())
    return float(power[frequencies > 0.375 * signal.rate].sum()) / whole if whole > 0 else 0.0
