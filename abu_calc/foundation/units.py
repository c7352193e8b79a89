"""Conversions between the units that people write and read, and SI; there are no others.

A unit is named as in the keys of the files, so `imbalance_g_mm` is read with `to_si` by "g_mm". The field's
levels are 20 lg(v / 5e-8 m/s), v rms (GOST 12.1.012, ISO 5349 practice); amplitudes are 0–peak.
"""

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

REFERENCE_VELOCITY: Final = 5e-8
"""Reference of vibration velocity levels [m/s rms]."""

GRAVITY: Final = 9.80665
"""Standard acceleration of free fall [m/s²] (ISO 80000-3)."""

UNIT_BY_SUFFIX: Final[dict[str, tuple[float | None, str, str]]] = {
    "m": (1.0, "length", "m"),
    "mm": (1e-3, "length", "mm"),
    "um": (1e-6, "length", "µm"),
    "mil": (25.4e-6, "length", "mil"),
    "kg": (1.0, "mass", "kg"),
    "g": (1e-3, "mass", "g"),
    "g_mm": (1e-6, "imbalance", "g·mm"),
    "rpm": (math.pi / 30, "rotational speed", "rpm"),
    "hz": (2 * math.pi, "frequency", "Hz"),
    "deg": (math.pi / 180, "angle", "°"),
    "rad": (1.0, "angle", "rad"),
    "mrad": (1e-3, "angle", "mrad"),
    "s": (1.0, "time", "s"),
    "min": (60.0, "time", "min"),
    "h": (3600.0, "time", "h"),
    "per_s": (1.0, "rate", "1/s"),
    "N": (1.0, "force", "N"),
    "kN": (1e3, "force", "kN"),
    "N_m": (1.0, "torque", "N·m"),
    "N_per_m": (1.0, "stiffness", "N/m"),
    "kN_per_m": (1e3, "stiffness", "kN/m"),
    "N_s_per_m": (1.0, "damping", "N·s/m"),
    "W": (1.0, "power", "W"),
    "MPa": (1e6, "pressure", "MPa"),
    "GPa": (1e9, "pressure", "GPa"),
    "mm_per_s": (1e-3, "velocity", "mm/s"),
    "m_per_s": (1.0, "velocity", "m/s"),
    "ips": (25.4e-3, "velocity", "in/s"),
    "m_per_s2": (1.0, "acceleration", "m/s²"),
    "g_n": (GRAVITY, "acceleration", "g"),
    "kg_m2": (1.0, "moment of inertia", "kg·m²"),
    "mm2_per_s": (1e-6, "kinematic viscosity", "mm²/s"),
    "kg_per_m3": (None, "density", "kg/m³"),
    "ml": (None, "volume", "ml"),
    "mV": (None, "voltage", "mV"),
    "percent": (0.01, "share", "%"),
    "K": (1.0, "temperature difference", "K"),
    "C": (None, "temperature", "°C"),
    "db": (None, "level", "dB"),
    "HRC": (None, "hardness", "HRC"),
}
"""SI value of one unit, its quantity and its sign, by the suffix that keys carry; None: results have no such unit.

Frequencies and speeds become rad/s.
"""

SI_PER_UNIT: Final = {suffix: size for suffix, (size, _, _) in UNIT_BY_SUFFIX.items() if size is not None}
"""SI value of one unit, by the suffix that keys carry (frequencies and speeds become rad/s)."""

SYMBOLS: Final = {
    suffix: sign
    for suffix, (size, _, sign) in UNIT_BY_SUFFIX.items()
    if suffix == "db" or (size is not None and suffix not in (sign, "ips"))
}
"""Form in which a unit is shown, if that differs from its suffix; in/s is shown as in the trade, ips."""

SI_UNITS: Final = ("rad_per_s", "kg_m", "per_s2", "Pa", "per_K")
"""Suffixes of numbers that results give in SI, beside those of `SI_PER_UNIT`."""


def unit_of(key: str) -> str:
    """The unit a key carries, as printed: the longest known suffix ("" for none).

    >>> unit_of("damping_limit_N_s_per_m"), unit_of("imbalance_g_mm"), unit_of("ball_count")
    ('N·s/m', 'g·mm', '')
    """
    parts = key.split("_")
    for start in range(1, len(parts)):
        suffix = "_".join(parts[start:])
        if suffix in SI_PER_UNIT or suffix in SYMBOLS:
            return SYMBOLS.get(suffix, suffix)
    return ""


def quantity_and_unit(key: str) -> tuple[str, str]:
    """The quantity that a key names, as SI has it, and the unit behind it ("" for none).

    >>> quantity_and_unit("race_radius_mm"), quantity_and_unit("speed_rad_per_s"), quantity_and_unit("ball_count")
    (('race_radius', 'mm'), ('speed', 'rad_per_s'), ('ball_count', ''))
    """
    parts = key.split("_")
    for start in range(1, len(parts)):
        suffix = "_".join(parts[start:])
        if suffix in SI_PER_UNIT or suffix in SYMBOLS or suffix in SI_UNITS:
            return "_".join(parts[:start]), suffix
    return key, ""


def to_si(value: float, unit: str) -> float:
    """A value in `unit` as SI.

    >>> round(to_si(5800, "rpm"), 4)
    607.3746
    """
    return value * SI_PER_UNIT[unit]


def from_si(value: float, unit: str) -> float:
    """An SI value in `unit`.

    >>> round(from_si(0.000183750, "g_mm"), 6)
    183.75
    """
    return value / SI_PER_UNIT[unit]


def in_file(key: str, value: float) -> tuple[str, float]:
    """The entry of a file that has an SI value, in the unit of its key.

    >>> in_file("autobalancer.race_radius_mm", 0.031)
    ('autobalancer.race_radius_mm', 31.0)
    """
    return key, from_si(value, quantity_and_unit(key)[1])


def in_units(columns: "Mapping[str, NDArray[np.float64]]") -> "dict[str, NDArray[np.float64]]":
    """Arrays in SI as columns of a table, each in the unit that its name carries."""
    return {name: from_si(1.0, quantity_and_unit(name)[1]) * values for name, values in columns.items()}


def shown(value: float | Iterable[float], unit: str, style: str = ".3g", between: str = " … ") -> str:
    """An SI value in `unit` with the unit's sign, as sentences have it; of several values the sign stands once.

    >>> shown(15.4e-6, "um"), shown(607.37461, "rpm", ".6g"), shown(0.0231, "mm", ".2f"), shown(math.pi, "deg")
    ('15.4 µm', '5800 rpm', '23.10 mm', '180°')
    >>> shown((0.0231, 0.0233), "mm"), shown((-4e-6, -2.1e-5), "um", "+.3g", "/")
    ('23.1 … 23.3 mm', '-4/-21 µm')
    """
    values = value if isinstance(value, Iterable) else (value,)
    sign = SYMBOLS.get(unit, unit)
    return between.join(f"{from_si(each, unit):{style}}" for each in values) + ("" if sign == "°" else " ") + sign


def microns(length: float) -> str:
    """A length in micrometres, without the unit.

    >>> microns(15.44e-6)
    '15.4'
    """
    return f"{from_si(length, 'um'):.3g}"


def level_from_velocity(velocity_rms: float) -> float:
    """Velocity level L = 20 lg(v/5e-8) [dB] of an rms velocity [m/s]; v > 0.

    >>> round(level_from_velocity(1.40919e-2), 3)
    109.0
    """
    return 20 * math.log10(velocity_rms / REFERENCE_VELOCITY)


def velocity_from_level(level: float) -> float:
    """The rms velocity [m/s] of a velocity level [dB], v = 5e-8 · 10^(L/20).

    >>> round(velocity_from_level(109), 7)
    0.0140919
    """
    return REFERENCE_VELOCITY * math.pow(10.0, level / 20)


def turned_deg(angle: float) -> float:
    """An angle [rad] in degrees in [0, 360)."""
    return from_si(angle, "deg") % 360


def wrapped_deg(angle: float) -> float:
    """An angle [rad] in degrees in (−180, 180]."""
    degrees = math.remainder(math.degrees(angle), 360.0)
    return 180.0 if degrees == -180.0 else degrees
