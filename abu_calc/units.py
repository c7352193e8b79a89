"""Units of abu-calc for scripts: those that end the names of keys and results, SI, and numbers written with a unit.

    from abu_calc import units

    units.to_si(5800, "rpm")                 607.37… rad/s
    units.unit_of("damping_N_s_per_m")       "N·s/m"
    units.number("97 Hz", "speed_rpm")       5820.0
    units.level_from_velocity(1.4e-2)        108.9… dB re 5e-8 m/s

`allowed_units()` gives each quantity with the endings of its keys and the units that files take.
"""

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import (
    GRAVITY,
    REFERENCE_VELOCITY,
    SI_PER_UNIT,
    from_si,
    level_from_velocity,
    to_si,
    unit_of,
    velocity_from_level,
)
from abu_calc.foundation.written_units import WrittenUnitError, allowed_units, written_unit

__all__ = [
    "GRAVITY",
    "REFERENCE_VELOCITY",
    "SI_PER_UNIT",
    "allowed_units",
    "from_si",
    "level_from_velocity",
    "number",
    "to_si",
    "unit_of",
    "velocity_from_level",
]


def number(text: str, key: str) -> float:
    """The number of a text such as "5.6 kg" in the unit of a key such as mass_kg, as files take it.

    Raises InputError, with the units allowed, for any other text, and for a key without a unit.

    >>> number("5 in", "diameter_mm")
    127.0
    """
    unit = written_unit(key)
    if unit is None:
        raise InputError("the key has no unit", place=Place(key=key), remedy="End it with one, such as mass_kg.")
    try:
        return unit.value(text)
    except WrittenUnitError as error:
        raise InputError(error.fault, place=Place(key=key), found=str(text), allowed=error.allowed) from None
