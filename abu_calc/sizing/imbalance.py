"""Step 2: the wheel's imbalance, from any of its sources.

One rotating imbalance as instruments show it: velocity, displacement, acceleration, weighted, per axis.
"""

import math
from statistics import fmean
from typing import Annotated, ClassVar

from abu_calc.formulas.rigid_body import Vector
from abu_calc.formulas.suspension import resonance_factor
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, level_from_velocity, quantity_and_unit, to_si, velocity_from_level
from abu_calc.inputs.wheel import Shown
from abu_calc.sizing.case import Case
from abu_calc.standards.vibration import hand_arm_weight, permissible_imbalance

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


NODE_SHARE = 0.05
"""A handle that moves by less than this share of a point mass's motion says nothing of the imbalance."""


@dataclass(frozen=True)
class Imbalance:
    """m₀e [kg m] of the wheel with its source in words."""

    value: float
    source: str


@formula(
    "Imbalance that causes a given vibration velocity at a place",
    "m₀e = √2·v/(Ω·I_a·k_Ω)",
    "kg m",
    signs="M D_x",
    where="I_a is the inertance from wheel to place, 1/M for a point mass; k_Ω = MΩ²/|D_x|.",
    assumed="one harmonic at Ω, above the natural frequencies of the suspension",
    source="Kladiev 1996, for a point mass √2·v·M/Ω·|1−(ω₀/Ω)²|; the rigid body is derived here",
)
def imbalance_from_level(velocity_rms: float, speed: float, inertance: float, resonance: float = 1.0) -> float:
    """
    >>> v = velocity_from_level(109)
    >>> round(1e6 * imbalance_from_level(v, 5800 * math.pi / 30, 1 / 5.6), 2)
    183.75
    """
    return math.sqrt(2) * velocity_rms / (speed * abs(inertance) * resonance)


def find_imbalance(case: Case) -> Imbalance:
    """The imbalance from the one source that the file gives."""
    wheel = case.table.wheel
    if wheel.imbalance_g_mm is not None:
        return Imbalance(wheel.imbalance, "given")
    if wheel.balance_grade is not None:
        value = permissible_imbalance(wheel.balance_grade, wheel.mass_kg, case.speed)
        return Imbalance(value, f"{wheel.balance_grade} of ISO 21940-11 for the wheel at the rated speed")
    return _measured(case)


def _measured(case: Case) -> Imbalance:
    shown = case.table.wheel.shown
    if shown is None:  # the table would not have been read
        raise InputError("no imbalance is known", place=Place(key="wheel.imbalance_g_mm"))
    velocity = measured_velocity(shown, case.speed, "wheel")
    background = case.background_level
    if background is not None:
        velocity = _without_background(velocity, background)
    place = next((handle.place for handle in case.handles if handle.name == shown.at), case.body.wheel)
    inertance = motion_shown(case, place, shown)
    if inertance < NODE_SHARE / case.body.mass:
        raise InputError(
            "the handle is near a node: it hardly moves, whatever the imbalance",
            place=Place(key="wheel.measured_at"),
            remedy="Measure at another handle, or near the wheel.",
        )
    resonance = resonance_factor(case.suspension, case.speed, case.body.effective_mass())
    value = imbalance_from_level(velocity, case.speed, inertance, resonance)
    return Imbalance(value, f"measured {in_words(shown)} idle, without autobalancer")


def motion_shown(case: Case, place: Vector, shown: Shown) -> float:
    """Motion of the axis that an instrument shows per imbalance at the wheel [1/kg].

    Three axes: the vector total over √2, as `velocity_shown` has it; else the loudest axis.
    """
    if shown.axes == 3 and case.body.in_space:
        return math.hypot(*case.body.axes(place)) / math.sqrt(2)
    return case.body.loudest_axis(place)


def measured_velocity(shown: Shown, speed: float, table: str) -> float:
    """Rms velocity of one axis [m/s] from a table's measured value; refused, by its key, where W_h is not defined."""
    try:
        return velocity_shown(shown, speed)
    except InputError as error:
        raise error.at(Place(key=f"{table}.measured_weighting")) from None


def _without_background(velocity: float, background_level: float) -> float:
    background = velocity_from_level(background_level)
    if background >= velocity:
        raise InputError(
            "the background is not below the measured level, so nothing is left for the imbalance",
            place=Place(key="machine.background_level_db"),
            found=f"{background_level:g} dB",
            allowed=f"below {level_from_velocity(velocity):.1f} dB",
            remedy="Give the level with a balanced wheel, or leave the key out.",
        )
    return math.sqrt(velocity**2 - background**2)
