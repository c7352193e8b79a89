"""Guesses for error messages: the intended meaning of an unknown key, and units that people write by mistake."""

import difflib
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from typing import Final, NamedTuple

from abu_calc.foundation.units import GRAVITY, REFERENCE_VELOCITY, SI_PER_UNIT, level_from_velocity, to_si
from abu_calc.foundation.validity import bounded
from abu_calc.inputs.reading.table import Table, Usual, all_tables, is_array, subtable
from abu_calc.inputs.reading.text import UNITS, Part, key_path, unit_suffix

_OTHER_UNITS: Final = frozenset(
    {*UNITS, "g_cm", "kg_mm", "t", "lb", "lbs", "oz", "gram", "grams", "cm", "in", "inch", "hp", "ms", "min"}
)


_NUMBERED: Final = re.compile(r"([A-Za-z]*) *(\d+(?:\.\d+)?)")
"""Letters and a number, as the name of a balance grade."""


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word nearest to one, whatever its case.

    >>> nearest("Mass-KG", ["mass_kg", "name"])
    'mass_kg'
    """
    folded = {name.lower(): name for name in known}
    close = difflib.get_close_matches(word.lower(), folded, n=1)
    return folded[close[0]] if close else None


def nearest_numbered(word: str, known: Iterable[str]) -> str | None:
    """Return the known word whose number is nearest in ratio, if all known words are the same letters and a number.

    >>> nearest_numbered("G17", ["G16", "G6.3", "G1"]), nearest_numbered("17", ["G16", "G6.3"])
    ('G16', 'G16')
    >>> nearest_numbered("wire", ["G16", "G6.3"]), nearest_numbered("G1", ["ball", "G2"])
    (None, None)
    """
    parts = {name: _NUMBERED.fullmatch(name) for name in known}
    given = _NUMBERED.fullmatch(word)
    letters = {part[1].lower() for part in parts.values() if part is not None}
    if given is None or len(letters) != 1 or None in parts.values() or given[1].lower() not in {"", *letters}:
        return None
    wanted, sizes = float(given[2]), {name: float(part[2]) for name, part in parts.items() if part is not None}
    if not wanted > 0:
        return None
    return min(sizes, key=lambda name: abs(math.log(sizes[name] / wanted)) if sizes[name] > 0 else math.inf)


def other_unit(key: str, known: Iterable[str]) -> str | None:
    """The known key that says the same in another unit, or with none written.

    >>> other_unit("mass_g", ["mass_kg"]), other_unit("mass", ["mass_kg"]), other_unit("name", ["mass_kg"])
    ('mass_kg', 'mass_kg', None)
    """
    for name in known:
        unit = unit_suffix(name)
        stem = name.removesuffix(f"_{unit}") if unit else None
        if stem and (key == stem or (key.startswith(f"{stem}_") and key.removeprefix(f"{stem}_") in _OTHER_UNITS)):
            return name
    return None


def header(root: type[Table], path: tuple[Part, ...]) -> str:
    """The header of a table, as the file writes it."""
    names = tuple(part for part in path if isinstance(part, str))
    model, array = root, False
    for name in names:
        array = is_array(model, name)
        model = subtable(model, name) or model
    return f"[[{key_path(names)}]]" if array else f"[{key_path(names)}]"


def meant_table(root: type[Table], name: str, value: object) -> tuple[str | None, str | None]:
    """The table an unknown name at the top of a file stands for, if any, and the remedy."""
    if not isinstance(value, (dict, list)) and (homes := _homes(root, name)):
        return None, f"{name} belongs in {homes}"
    tables = [key for key in root.model_fields if subtable(root, key) or key == "expected"]
    if (meant := nearest(name, tables)) and isinstance(value, (dict, list)):
        return meant, f"the nearest known table is {header(root, (meant,))}"
    if not isinstance(value, (dict, list)):
        return None, "every key belongs in a table: write its [table] above it"
    return None, "known tables: " + ", ".join(tables)


def meant_key(root: type[Table], path: tuple[Part, ...], table: type[Table], key: str) -> tuple[str | None, str]:
    """The key of a table that an unknown one stands for, if any, and the remedy."""
    known = list(table.model_fields)
    if homes := _homes(root, key):
        return None, f"{key} belongs in {homes}"
    if meant := other_unit(key, known):
        unit = key.removeprefix(meant.removesuffix(f"_{unit_suffix(meant)}")).strip("_")
        unit_note = f"in {unit_suffix(meant)} instead of {unit}" if unit else "the unit stands in the key"
        return meant, f"write {meant}, {unit_note}"
    if meant := nearest(key, known):
        return meant, f"the nearest known key is {meant}"
    elsewhere = _all_homes(root)
    if far := other_unit(key, elsewhere) or nearest(key, elsewhere):
        return None, f"the nearest known key is {far} of {elsewhere[far]}"
    return None, f"known keys of {header(root, path)}: {', '.join(known)}"


@cache
def _all_homes(root: type[Table]) -> dict[str, str]:
    """Every key, and the tables that know it."""
    return {
        name: homes for _, other in all_tables(root) for name in other.model_fields if (homes := _homes(root, name))
    }


def _homes(root: type[Table], key: str) -> str:
    """The headers of the tables that know a key, "[machine] or [wheel]"; empty for none."""
    return " or ".join(
        header(root, path)
        for path, table in all_tables(root)
        if key in table.model_fields and key not in ("name", "handle")
    )


MISTAKEN: Final[dict[str | None, dict[str, float]]] = {
    "rpm": {"Hz": 2 * math.pi, "rad/s": 1.0},
    "hz": {"rpm": math.pi / 30, "rad/s": 1.0},
    "kg": {"g": 1e-3, "lb": 0.45359237, "t": 1e3},
    "mm": {"m": 1.0, "cm": 1e-2, "inch": 0.0254, "µm": 1e-6},
    "m": {"mm": 1e-3, "cm": 1e-2, "inch": 0.0254},
    "um": {"mm": 1e-3, "m": 1.0},
    "g_mm": {"g·m": 1e-3, "kg·mm": 1e-3, "g·cm": 1e-5, "kg·m": 1.0, "mg·mm": 1e-9},
    "m_per_s": {"mm/s": 1e-3, "km/h": 1 / 3.6},
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
    "h": {"min": 60.0, "d": 86_400.0},
    "mm2_per_s": {"m²/s": 1.0, "St": 1e-4},
    "percent": {"1": 1.0, "‰": 1e-3},
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
    speed = None if speed_rpm is None else to_si(speed_rpm, "rpm")
    if speed is not None and positive:
        yield Guess("m/s²", tuple(level_from_velocity(value / speed) for value in values))
    if positive:
        yield Guess("mm/s", tuple(level_from_velocity(to_si(value, "mm_per_s")) for value in values))
    # ISO 1683 takes 1e-9 m/s and 1e-6 m/s².
    yield Guess("dB re 1e-9 m/s", tuple(value + 20 * math.log10(1e-9 / REFERENCE_VELOCITY) for value in values))
    if speed is not None:
        unit = level_from_velocity(1e-6 / speed)
        yield Guess("dB re 1e-6 m/s²", tuple(value + unit for value in values))
