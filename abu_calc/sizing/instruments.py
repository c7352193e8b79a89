"""One rotating imbalance as instruments show it: velocity, displacement, acceleration, weighted, per axis."""

import math
from statistics import fmean
from typing import Annotated, ClassVar

from abu_calc.foundation.errors import InputError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, level_from_velocity, quantity_and_unit, to_si, velocity_from_level
from abu_calc.inputs.wheel import Shown
from abu_calc.standards.vibration import hand_arm_weight

UNITS = {
    "measured_level_db": "dB",
    "measured_velocity_mm_per_s": "mm/s",
    "measured_displacement_um": "µm",
    "measured_acceleration_m_per_s2": "m/s²",
}
"""Units of instrument readings, as shown."""


@record
class InstrumentReadings(Record):
    """One level as instruments show it, all rms; weighted values are null where W_h is not defined."""

    schema_title: ClassVar[str] = "Readings"

    velocity: Annotated[float, Quantity("velocity", "v", unit="mm_per_s")]
    displacement: Annotated[float, Quantity("displacement", "s_v", unit="um")]
    acceleration: Annotated[float, Quantity("acceleration", "a", unit="m_per_s2")]
    weighted: Annotated[float | None, Quantity("weighted, one axis", "a_h", 3, unit="m_per_s2")]
    total: Annotated[float | None, Quantity("weighted, three axes", "a_hv", 3, unit="m_per_s2")]


@formula(
    "Readings of instruments for a velocity at the spindle's frequency",
    "s_v = v/Ω, a = Ω·v, a_h = W_h(Ω)·a, a_hv = √2·a_h",
    "m, m/s², m/s², m/s²",
    shown="um, m/s², m/s², m/s²",
    where="One spinning imbalance moves two axes alike, and hardly moves the third, along the spindle: hence √2.",
    assumed="one harmonic at Ω; two axes alike",
    source="ISO 5349-1:2001 for W_h",
)
def readings(velocity: float, speed: float) -> InstrumentReadings:
    """
    >>> found = readings(velocity_from_level(111), 5800 * math.pi / 30)
    >>> [round(each, 2) for each in (1e6 * found.displacement, found.acceleration, found.weighted, found.total)]
    [29.21, 10.78, 1.79, 2.53]
    """
    acceleration = velocity * speed
    try:
        weighted = acceleration * hand_arm_weight(speed)
    except InputError:
        weighted = None
    return InstrumentReadings(
        velocity=velocity,
        displacement=velocity / speed,
        acceleration=acceleration,
        weighted=weighted,
        total=None if weighted is None else math.sqrt(2) * weighted,
    )


@formula(
    "Rms velocity of one axis from a reading of an instrument; from a list, the mean of its velocities",
    "v = Ω·s_v = a/Ω = a_h/(W_h·Ω) = a_hv/(√2·W_h·Ω)",
    "m/s",
    where="This is the inverse of the formula of the readings.",
    checked=("W_h at 5.62 … 1413 Hz",),
    assumed="one harmonic at Ω; in a total of three axes two are alike and the third is zero",
    source="ISO 5349-1:2001 for W_h; Kladiev 1996 averages its octaves likewise",
)
def velocity_shown(shown: Shown, speed: float) -> float:
    """
    >>> one = velocity_shown(Shown("measured_acceleration_m_per_s2", (10.78,), "none", 1, None), 5800 * math.pi / 30)
    >>> round(one, 5)
    0.01775
    >>> both = velocity_shown(Shown("measured_level_db", (100.0, 110.0), "none", 1, None), 1.0)
    >>> round(level_from_velocity(both), 3)
    106.366
    """
    return fmean(_velocity(shown, value, speed) for value in shown.values) / (math.sqrt(2) if shown.axes == 3 else 1.0)


def _velocity(shown: Shown, value: float, speed: float) -> float:
    if shown.key == "measured_level_db":
        return velocity_from_level(value)
    value = to_si(value, quantity_and_unit(shown.key)[1])
    if shown.key == "measured_velocity_mm_per_s":
        return value
    if shown.key == "measured_displacement_um":
        return value * speed
    return value / speed / (hand_arm_weight(speed) if shown.weighting == "Wh" else 1.0)


def in_words(shown: Shown) -> str:
    """Reading in words, with its unit and the way it was taken.

    >>> in_words(Shown("measured_acceleration_m_per_s2", (2.5, 2.7), "Wh", 3, "front"))
    '2.5, 2.7 m/s² (W_h, vector sum of three axes) at "front"'
    """
    how = [text for text, said in (("W_h", shown.weighting == "Wh"), ("vector sum of three axes", shown.axes == 3))
           if said]  # fmt: skip
    values = ", ".join(f"{value:g}" for value in shown.values)
    place = "" if shown.at is None else f' at "{shown.at}"'
    within = f" ({', '.join(how)})" if how else ""
    return f"{values} {UNITS[shown.key]}{within}{place}"


def as_shown(shown: Shown, velocity: float, speed: float) -> float | None:
    """An rms velocity of one axis [m/s] in the unit, the weighting and the axes of what was shown; None without W_h."""
    reading = readings(velocity, speed)
    many = math.sqrt(2) if shown.axes == 3 else 1.0
    if shown.key == "measured_level_db":
        return level_from_velocity(many * velocity)
    value = reading.weighted if shown.weighting == "Wh" else reading.acceleration
    if shown.key == "measured_velocity_mm_per_s":
        value = velocity
    elif shown.key == "measured_displacement_um":
        value = reading.displacement
    return None if value is None else from_si(many * value, quantity_and_unit(shown.key)[1])
