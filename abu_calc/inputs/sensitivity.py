"""Sensitivity of a vibration sensor: volts per unit of motion, for columns and channels recorded as a voltage."""

import math
import re
from collections.abc import Mapping, Sequence
from typing import Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.recording_columns import MOTION, VOLTS, MotionQuantity, plain_unit

UNIT: Final = re.compile(r"(\S+?)\s*(?:/|\bper\b|_per_)\s*(.+)")
ALLOWED: Final = "a number above 0 in mV per m/s², or with its unit: 10.2 mV/(m/s²), 100 mV/g, 20 mV/(mm/s)"


@dataclass(frozen=True)
class Sensitivity:
    """Volts per unit of motion in SI of one channel; `channel` None: of every channel in volts."""

    channel: str | None
    quantity: MotionQuantity
    volts_per_unit: float
    text: str


def sensitivities(
    given: float | str | Sequence[float | str] | Mapping[str, float | str] | None,
) -> tuple[Sensitivity, ...]:
    """Sensitivities as people write them: a number [mV per m/s²], or a text with its unit, for all channels or by name.

    Raises InputError for what is no sensitivity, and for one channel named twice.

    >>> [one] = sensitivities(["ax_mV=100 mV/g"])
    >>> one.channel, one.quantity, round(one.volts_per_unit, 6)
    ('ax_mV', 'acceleration', 0.010197)
    """
    if given is None:
        return ()
    pairs: list[tuple[str | None, float | str]]
    if isinstance(given, Mapping):
        pairs = [(str(channel), value) for channel, value in given.items()]
    else:
        values = given if isinstance(given, Sequence) and not isinstance(given, str) else [given]
        pairs = [_pair(value) for value in values]
    made = tuple(_sensitivity(channel, value) for channel, value in pairs)
    names = [sensitivity.channel for sensitivity in made]
    for name in names:
        if names.count(name) > 1:
            raise InputError(
                "two sensitivities for the same channel", place=Place(key="sensitivity"), found=name or "two for all",
                remedy="Name the channel of each: --sensitivity CHANNEL=VALUE (Python: a dict).",
            )  # fmt: skip
    return made


def sensitivity_of(given: Sequence[Sensitivity], name: str, number: int) -> Sensitivity | None:
    """The sensitivity of a channel by its name or its number from 1; else that of all channels; None without one."""
    by_channel = {sensitivity.channel: sensitivity for sensitivity in given}
    return by_channel.get(name) or by_channel.get(str(number)) or by_channel.get(None)


def _pair(value: float | str) -> tuple[str | None, float | str]:
    if not isinstance(value, str):
        return None, value
    channel, equals, text = value.rpartition("=")
    return (channel.strip() if equals else None), text


def _sensitivity(channel: str | None, value: float | str) -> Sensitivity:
    text = value if isinstance(value, str) else f"{value:g}"
    match = re.fullmatch(r"\s*([-+0-9.eE]+|nan|inf)\s*(.*?)\s*", text)
    number = _number(match[1]) if match else None
    quantity, size = _unit(match[2]) if match else (None, 0.0)
    if match is None or number is None or quantity is None or not (math.isfinite(number) and number > 0):
        raise InputError(
            "not a sensitivity", place=Place(key="sensitivity"), found=f"{channel}={text}" if channel else text,
            allowed=ALLOWED,
            remedy='Write --sensitivity "CHANNEL=100 mV/g", with a decimal point (Python: sensitivity=).',
        )  # fmt: skip
    shown = f"{number:g} {match[2] or 'mV per m/s²'}"
    return Sensitivity(channel, quantity, number * size, shown)


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _unit(text: str) -> tuple[MotionQuantity | None, float]:
    """Quantity of a unit such as mV/(m/s²), and its value in volts per SI unit; mV per m/s² if there is none."""
    if not text:
        return "acceleration", 1e-3
    match = UNIT.fullmatch(text)
    if match is None:
        return None, 0.0
    motion, volts = plain_unit(match[2].strip().removeprefix("(").removesuffix(")")), match[1].replace("µ", "u")
    if volts not in VOLTS or motion not in MOTION:
        return None, 0.0
    quantity, size = MOTION[motion]
    return quantity, VOLTS[volts] / size
