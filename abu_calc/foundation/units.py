"""Conversions between the units that people write and read, and SI; there are no others.

A unit is named as in the keys of the files, so `imbalance_g_mm` is read with `to_si(value, "g_mm")`. The field's
levels are 20 lg(v / 5e-8 m/s), v rms (GOST 12.1.012, ISO 5349 practice); amplitudes are 0–peak.
"""

import math
from typing import Final

REFERENCE_VELOCITY: Final = 5e-8
"""Reference of vibration velocity levels [m/s rms]."""

GRAVITY: Final = 9.80665
"""Standard acceleration of free fall [m/s²] (ISO 80000-3)."""

SI_PER_UNIT: Final[dict[str, float]] = {
    "mm": 1e-3,
    "um": 1e-6,
    "m": 1.0,
    "g": 1e-3,
    "kg": 1.0,
    "g_mm": 1e-6,
    "rpm": math.pi / 30,
    "hz": 2 * math.pi,
    "deg": math.pi / 180,
    "mrad": 1e-3,
    "rad": 1.0,
    "s": 1.0,
    "min": 60.0,
    "h": 3600.0,
    "per_s": 1.0,
    "N": 1.0,
    "kN": 1e3,
    "kN_per_m": 1e3,
    "N_m": 1.0,
    "N_per_m": 1.0,
    "N_s_per_m": 1.0,
    "W": 1.0,
    "MPa": 1e6,
    "GPa": 1e9,
    "mm_per_s": 1e-3,
    "m_per_s": 1.0,
    "m_per_s2": 1.0,
    "kg_m2": 1.0,
    "K": 1.0,
    "mm2_per_s": 1e-6,
    "percent": 0.01,
}
"""SI value of one unit, by the suffix that keys carry (frequencies and speeds become rad/s)."""

SYMBOLS: Final[dict[str, str]] = {
    "um": "µm",
    "g_mm": "g·mm",
    "hz": "Hz",
    "deg": "°",
    "per_s": "1/s",
    "kN_per_m": "kN/m",
    "N_m": "N·m",
    "N_per_m": "N/m",
    "N_s_per_m": "N·s/m",
    "mm_per_s": "mm/s",
    "m_per_s": "m/s",
    "m_per_s2": "m/s²",
    "kg_m2": "kg·m²",
    "mm2_per_s": "mm²/s",
    "percent": "%",
    "db": "dB",
}
"""Form in which a unit is shown, if that differs from its suffix."""

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


def wrapped_deg(angle: float) -> float:
    """An angle [rad] in degrees in (−180, 180]."""
    degrees = math.remainder(math.degrees(angle), 360.0)
    return 180.0 if degrees == -180.0 else degrees
