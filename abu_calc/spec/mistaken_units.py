"""Units that people write in place of the one a key stands for."""

import math
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from abu_calc.spec.text import unit_suffix
from abu_calc.spec.usual import Usual
from abu_calc.units import GRAVITY, REFERENCE_VELOCITY, SI_PER_UNIT, level_from_velocity, to_si
from abu_calc.validity import bounded

MISTAKEN: Final[dict[str | None, dict[str, float]]] = {
    "rpm": {"Hz": 2 * math.pi, "rad/s": 1.0},
    "hz": {"rpm": math.pi / 30, "rad/s": 1.0},
    "kg": {"g": 1e-3, "lb": 0.45359237, "t": 1e3},
    "mm": {"m": 1.0, "cm": 1e-2, "inch": 0.0254, "µm": 1e-6},
    "m": {"mm": 1e-3, "cm": 1e-2, "inch": 0.0254},
    "um": {"mm": 1e-3, "m": 1.0},
    "g_mm": {"g·m": 1e-3, "kg·mm": 1e-3, "g·cm": 1e-5, "kg·m": 1.0, "mg·mm": 1e-9},
    "mm_per_s": {"m/s": 1.0, "µm/s": 1e-6, "inch/s": 0.0254},
    "m_per_s2": {"g": GRAVITY, "mm/s²": 1e-3, "cm/s²": 1e-2},
    "N": {"kN": 1e3, "kgf": GRAVITY},
    "kN": {"N": 1.0, "kgf": GRAVITY},
    "N_m": {"N·mm": 1e-3, "N·cm": 1e-2, "kgf·m": GRAVITY},
    "MPa": {"Pa": 1.0, "GPa": 1e9, "kgf/mm²": 1e6 * GRAVITY},
    "N_per_m": {"N/mm": 1e3, "N/µm": 1e6},
    "N_s_per_m": {"N·s/mm": 1e3},
    "kg_m2": {"kg·cm²": 1e-4, "kg·mm²": 1e-6, "g·m²": 1e-3, "g·cm²": 1e-7, "g·mm²": 1e-9},
    "W": {"kW": 1e3, "hp": 745.69987},
    "s": {"ms": 1e-3, "min": 60.0},
    "min": {"s": 1.0, "h": 3600.0},
    "per_s": {"1/min": 1 / 60},
    "deg": {"rad": 1.0},
    "rad": {"mrad": 1e-3, "deg": math.pi / 180},
    None: {"%": 0.01},
}
"""Units written by mistake, by the unit in the key, with their values in SI.

Frequencies and speeds are in rad/s.
"""


MOST: Final = 3


class Guess(NamedTuple):
    """A unit, and what the numbers would be in the unit of the key."""

    unit: str
    values: tuple[float, ...]


def guesses(key: str, values: Sequence[float], usual: Usual, speed_rpm: float | None = None) -> list[Guess]:
    """The units in which every one of the numbers would be usual, the likeliest first, at most three.

    `speed_rpm`: that of the spindle, by which accelerations become levels; without it they are not thought of.

    >>> guesses("speed_rpm", [97.0], Usual(1000, 60000))
    [Guess(unit='Hz', values=(5820.0,))]
    """
    unit = unit_suffix(key)
    candidates = _levels(values, speed_rpm) if unit == "db" else _converted(unit, values)
    landing = [guess for guess in candidates if all(map(usual.holds, guess.values)) and guess.values[0] * values[0] > 0]
    if unit == "db":
        landing.sort(key=lambda guess: abs(guess.values[0] - (usual.low + usual.high) / 2))
    else:
        middle = math.sqrt(usual.low * usual.high)
        landing.sort(key=lambda guess: abs(math.log(abs(guess.values[0]) / middle)))
    return landing[:MOST]


def meant_in(guesses: Sequence[Guess], unit: str) -> str:
    """Guesses in words, `unit` as printed after a number; empty for none.

    >>> meant_in([Guess("Hz", (5820.0,)), Guess("rad/s", (926.28,))], " rpm")
    'meant in Hz (5820 rpm) or rad/s (926.3 rpm)'
    """
    words = (f"{guess.unit} ({', '.join(bounded(float(f'{v:.4g}')) for v in guess.values)}{unit})" for guess in guesses)
    return f"meant in {' or '.join(words)}" if guesses else ""


def _converted(unit: str | None, values: Sequence[float]) -> Iterator[Guess]:
    own = SI_PER_UNIT.get(unit, 1.0) if unit else 1.0
    for symbol, size in MISTAKEN.get(unit, {}).items():
        yield Guess(symbol, tuple(value * size / own for value in values))


def _levels(values: Sequence[float], speed_rpm: float | None) -> Iterator[Guess]:
    """Readings mistaken for a velocity level: rms acceleration or velocity, levels of other references."""
    positive = all(value > 0 for value in values)
    if speed_rpm is not None and positive:
        speed = to_si(speed_rpm, "rpm")
        yield Guess("m/s²", tuple(level_from_velocity(value / speed) for value in values))
    if positive:
        yield Guess("mm/s", tuple(level_from_velocity(to_si(value, "mm_per_s")) for value in values))
    # ISO 1683 takes 1e-9 m/s and 1e-6 m/s².
    yield Guess("dB re 1e-9 m/s", tuple(value + 20 * math.log10(1e-9 / REFERENCE_VELOCITY) for value in values))
    if speed_rpm is not None:
        unit = level_from_velocity(1e-6 / to_si(speed_rpm, "rpm"))
        yield Guess("dB re 1e-6 m/s²", tuple(value + unit for value in values))
