"""Numbers that people write with a unit, "5.6 kg": the units of each quantity, and the conversion to that of a key.

A key says its unit by its suffix. The suffix gives the quantity, and the quantity the units that may stand behind a
number: no others are taken, and none is guessed. Conversions are exact but for angles in radians, and are rounded once.
"""

import math
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import cache
from typing import Final

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import UNIT_BY_SUFFIX

SUFFIXES: Final = {suffix: (quantity, sign) for suffix, (_, quantity, sign) in UNIT_BY_SUFFIX.items()}
"""Quantity and unit that the suffix of a key stands for."""

_RADIAN: Final = str(Fraction(180 / math.pi))
UNITS: Final[Mapping[str, Mapping[str, str]]] = {
    "length": {"m": "1", "cm": "1e-2", "mm": "1e-3", "µm": "1e-6", "in": "0.0254", "mil": "25.4e-6"},
    "mass": {"kg": "1", "g": "1e-3", "mg": "1e-6", "t": "1e3", "lb": "0.45359237", "oz": "0.028349523125"},
    "imbalance": {"g·mm": "1e-6", "g·cm": "1e-5", "g·m": "1e-3", "kg·mm": "1e-3", "kg·m": "1", "mg·mm": "1e-9",
                  "g·in": "25.4e-6", "oz·in": "7.2007788737500e-4"},
    "rotational speed": {"rpm": "1", "1/min": "1", "r/min": "1", "Hz": "60", "rad/s": str(Fraction(30 / math.pi))},
    "frequency": {"Hz": "1", "kHz": "1000", "rpm": "1/60", "1/min": "1/60", "rad/s": str(Fraction(0.5 / math.pi))},
    "angle": {"°": "1", "deg": "1", "rad": _RADIAN, "mrad": str(Fraction(_RADIAN) / 1000)},
    "time": {"s": "1", "ms": "1e-3", "min": "60", "h": "3600"},
    "rate": {"1/s": "1", "1/min": "1/60"},
    "force": {"N": "1", "kN": "1e3", "kgf": "9.80665", "lbf": "4.4482216152605"},
    "torque": {"N·m": "1", "N·cm": "1e-2", "N·mm": "1e-3", "kN·m": "1e3", "kgf·m": "9.80665", "kgf·cm": "0.0980665"},
    "stiffness": {"N/m": "1", "kN/m": "1e3", "N/mm": "1e3", "kN/mm": "1e6", "N/µm": "1e6", "kgf/mm": "9806.65"},
    "damping": {"N·s/m": "1", "kN·s/m": "1e3", "N·s/mm": "1e3"},
    "power": {"W": "1", "kW": "1e3"},
    "pressure": {"Pa": "1", "kPa": "1e3", "MPa": "1e6", "GPa": "1e9", "N/mm²": "1e6", "kgf/mm²": "9806650"},
    "velocity": {"m/s": "1", "cm/s": "1e-2", "mm/s": "1e-3", "µm/s": "1e-6", "in/s": "0.0254"},
    "acceleration": {"m/s²": "1", "mm/s²": "1e-3", "g": "9.80665"},
    "moment of inertia": {"kg·m²": "1", "kg·cm²": "1e-4", "kg·mm²": "1e-6", "g·m²": "1e-3", "g·cm²": "1e-7",
                          "g·mm²": "1e-9"},
    "kinematic viscosity": {"mm²/s": "1", "m²/s": "1e6", "cSt": "1", "St": "100"},
    "density": {"kg/m³": "1", "g/cm³": "1000"},
    "volume": {"ml": "1", "l": "1000", "cm³": "1", "mm³": "1e-3"},
    "voltage": {"mV": "1", "V": "1000"},
    "share": {"%": "1", "‰": "0.1"},
    "temperature difference": {"K": "1"},
    "temperature": {"°C": "1", "K": "1", "°F": "5/9"},
    "level": {"dB": "1"},
    "hardness": {"HRC": "1"},
}  # fmt: skip
"""Units of each quantity with their relative sizes, as text so that they are exact.

Acceleration in g is that of free fall, 9.80665 m/s²; a level is that of its key's reference.
"""

ZEROS: Final[Mapping[str, str]] = {"K": "-273.15", "°F": "-160/9"}
"""Temperature [°C] of zero in the units that begin elsewhere; a temperature difference has no such zero."""

_TEXT: Final = re.compile(r"([+-]?[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]{1,3})?)(?: ?(?![0-9 ])(.+)| (1/.+))?", re.DOTALL)
_SIGNS: Final = str.maketrans({"⋅": "·", "*": "·", " ": "·", "μ": "µ"})
_WORDS: Final = {
    "um": "µm", "um/s": "µm/s", "N/um": "N/µm", "inch": "in", "mL": "ml", "L": "l", "degC": "°C",
}  # fmt: skip
"""Other spellings of some units."""
LONGEST: Final = 60


class WrittenUnitError(ValueError):
    """A text that is no number with a unit of its quantity: the fault, and what is allowed."""

    def __init__(self, fault: str, allowed: str) -> None:
        super().__init__(fault)
        self.fault, self.allowed = fault, allowed


@dataclass(frozen=True)
class WrittenUnit:
    """The unit that a key carries: the key without it, the suffix, its quantity and its unit as printed."""

    stem: str
    suffix: str
    quantity: str
    unit: str

    @property
    def allowed(self) -> tuple[str, ...]:
        """Units that a value of this quantity may have, that of the key first."""
        return (self.unit, *(unit for unit in UNITS[self.quantity] if unit != self.unit))

    def value(self, text: str) -> float:
        """The number of a text in the unit of the key. Raises WrittenUnitError.

        >>> written_unit("speed_rpm").value("97 Hz"), written_unit("diameter_mm").value("5 in")
        (5820.0, 127.0)
        """
        if len(text) > LONGEST or not (parts := _TEXT.fullmatch(text)):
            raise WrittenUnitError(_fault(text, self.quantity), self._example())
        number, spelled = parts[1], parts[2] or parts[3] or ""
        units, unit = UNITS[self.quantity], _named(spelled)
        if unit not in units:
            raise WrittenUnitError(_fault(text, self.quantity, spelled), self._example())
        size, own = Fraction(units[unit]), Fraction(units[self.unit])
        zero, own_zero = (self._zero(each) for each in (unit, self.unit))
        try:
            value = float((Fraction(number) * size + zero - own_zero) / own)
        except OverflowError:
            value = math.inf
        if not math.isfinite(value):
            raise WrittenUnitError("the number is too large", self._example())
        return value

    def _zero(self, unit: str) -> Fraction:
        return Fraction(ZEROS.get(unit, "0")) if self.quantity == "temperature" else Fraction(0)

    def _example(self) -> str:
        return f"a number with {'one of ' if len(self.allowed) > 1 else ''}{', '.join(self.allowed)}"


@cache
def written_unit(key: str) -> WrittenUnit | None:
    """The unit that a key ends in; None if it has none. The longest suffix counts: N_s_per_m before m."""
    parts = key.split("_")
    for start in range(1, len(parts)):
        suffix = "_".join(parts[start:])
        if suffix in SUFFIXES:
            return WrittenUnit("_".join(parts[:start]), suffix, *SUFFIXES[suffix])
    return None


def allowed_units() -> Iterator[tuple[str, tuple[str, ...], tuple[str, ...]]]:
    """Each quantity with the suffixes of its keys and its units, for the documentation."""
    for quantity, units in UNITS.items():
        yield quantity, tuple(suffix for suffix, (name, _) in SUFFIXES.items() if name == quantity), tuple(units)


def _named(spelled: str) -> str:
    """A unit as the table has it: signs of products, powers and micro may be typed in other ways."""
    unit = _WORDS.get(spelled, spelled)
    if unit.startswith(("·", " ", "*")) or unit.endswith(("·", " ", "*")):
        return ""
    unit = unit.translate(_SIGNS)
    unit = re.sub(r"(?<=[a-zA-Z])\^?2(?![\d.])", "²", unit)
    return re.sub(r"(?<=[a-zA-Z])\^?3(?![\d.])", "³", unit)


def _fault(text: str, quantity: str, spelled: str | None = None) -> str:
    """The fault of a text; `spelled`: what stands behind its number, None if it does not begin with one."""
    if re.match(r"[+-]?[0-9]+,[0-9]", text.strip()):
        return "a decimal comma: the decimal sign is a point"
    if text.strip() != text:
        return "blanks around the value"
    if spelled is None:
        return "not a number with a unit"
    return f"not a unit of {quantity}" if spelled else "the unit is missing"
