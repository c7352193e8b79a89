"""Vibration of hand-held machines: limits by octaves, weighting by third octaves, exposure.

Nothing is computed from them yet; the default limit of a file is held to them.
"""

import math
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from abu_calc.errors import RangeError
from abu_calc.units import from_si, to_si

_Band = TypeVar("_Band", "Octave", "ThirdOctave")


DATA = Path(__file__).parent / "data"


@cache
def toml_table(name: str) -> dict[str, Any]:
    """A data file of this folder."""
    return tomllib.loads((DATA / f"{name}.toml").read_text(encoding="utf-8"))


@dataclass(frozen=True)
class Limit:
    """A limit of vibration: rms velocity [m/s] and its level [dB re 5e-8 m/s], as the standard rounds them."""

    velocity: float
    level: float


@dataclass(frozen=True)
class Octave:
    """An octave from `low` up to, not including, `high` [rad/s]; `nominal` centre as printed [rad/s]."""

    nominal: float
    low: float
    high: float
    limit: Limit


@dataclass(frozen=True)
class ThirdOctave:
    """A third octave from `low` up to, not including, `high` [rad/s] and its factor W_h."""

    nominal: float
    low: float
    high: float
    weight: float


@cache
def octaves() -> tuple[Octave, ...]:
    """The octaves 8 … 1000 Hz with their limits; bounds f/√2 … f·√2 of the exact centre. Source: GOST 17770-86."""
    rows = toml_table("vibration_limits")["octaves"]
    return tuple(
        Octave(to_si(nominal, "hz"), to_si(f / math.sqrt(2), "hz"), to_si(f * math.sqrt(2), "hz"), Limit(v, level))
        for nominal, f, v, level in rows
    )


def octave(frequency: float) -> Octave:
    """The octave that a frequency [rad/s] lies in, with the limit there.

    Range: 5.52 … 1414 Hz, else RangeError. Source: GOST 17770-86.

    >>> found = octave(to_si(5800, "rpm"))
    >>> round(from_si(found.nominal, "hz")), round(from_si(found.low, "hz"), 1), found.limit.level
    (125, 88.4, 109)
    """
    return _band(frequency, octaves())


def corrected_limit() -> Limit:
    """The limit of the corrected total over all octaves. Source: GOST 17770-86.

    >>> corrected_limit()
    Limit(velocity=0.02, level=112)
    """
    return Limit(**toml_table("vibration_limits")["corrected"])


@cache
def third_octaves() -> tuple[ThirdOctave, ...]:
    """The third octaves 6.3 … 1250 Hz with W_h; bounds 10^((n ∓ ½)/10) Hz. Source: ISO 5349-1:2001, table A.2."""
    rows = toml_table("hand_arm_weighting")["bands"]
    bounds = [(nominal, 10 ** ((n - 0.5) / 10), 10 ** ((n + 0.5) / 10), weight) for nominal, n, weight in rows]
    return tuple(ThirdOctave(to_si(f, "hz"), to_si(low, "hz"), to_si(high, "hz"), w) for f, low, high, w in bounds)


def hand_arm_weight(frequency: float) -> float:
    """The factor W_h by which an rms acceleration at a frequency [rad/s] counts: that of its third octave.

    Range: 5.62 … 1413 Hz, else RangeError. Source: ISO 5349-1:2001, table A.2.

    >>> hand_arm_weight(to_si(5800, "rpm"))
    0.16
    """
    return _band(frequency, third_octaves()).weight


def exposure_action_value() -> float:
    """Daily exposure A(8) [m/s²] that calls for measures. Source: Directive 2002/44/EC."""
    return float(toml_table("hand_arm_weighting")["exposure"]["action"])


def exposure_limit_value() -> float:
    """Daily exposure A(8) [m/s²] not to be exceeded. Source: Directive 2002/44/EC."""
    return float(toml_table("hand_arm_weighting")["exposure"]["limit"])


def _band(frequency: float, bands: tuple[_Band, ...]) -> _Band:
    for band in bands:
        if band.low <= frequency < band.high:
            return band
    low, high = from_si(bands[0].low, "hz"), from_si(bands[-1].high, "hz")
    raise RangeError(
        "no band of the standard holds this frequency",
        found=f"{from_si(frequency, 'hz'):g} Hz",
        allowed=f"{low:.4g} … {high:.4g} Hz",
        remedy="The standard says nothing outside; judge such a frequency by other means.",
    )
