"""The signs of formulas: each means one thing in all of abu-calc; its unit as files have it, and in SI."""

import math
import re
import tomllib
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Final, NamedTuple

from abu_calc.units import SI_PER_UNIT, SYMBOLS, from_si
from abu_calc.validity import Range, bounded

SI_NAMES: Final = {
    "mm": "m", "um": "m", "g": "kg", "g_mm": "kg m", "rpm": "rad/s", "hz": "rad/s", "deg": "rad", "mrad": "rad",
    "MPa": "Pa", "GPa": "Pa", "kN": "N", "kN_per_m": "N/m", "mm_per_s": "m/s",
    "min": "s",
}  # fmt: skip
"""SI unit of what files have in another."""
IN_FILES: Final = {"m": "mm", "kg m": "g_mm", "Pa": "MPa", "rad": "deg", "rad/s": "rpm", "m/s": "mm_per_s"}
"""The other way, as numbers of results have it."""
FUNCTIONS: Final = "sin cos tan arcsin arccos arctan lg ln exp Re Im arg min max det e^ dε ds_w dx_s π Σ ᵀ °C MPa mm"
SHORT: Final = "at of by to so in an or and i j k"
"""Short words, the imaginary unit, running numbers."""
WORDS: Final = frozenset(f"{FUNCTIONS} {SHORT}".split())
"""Words of a formula that are no symbols."""


class Sign(NamedTuple):
    """Meaning of a symbol, and its unit: as keys of files name it, or as it is shown."""

    meaning: str
    unit: str = ""


@cache
def signs() -> dict[str, Sign]:
    """All of them."""
    text = Path(__file__).with_name("signs.toml").read_text(encoding="utf-8")
    return {name: Sign(*entry) for name, entry in tomllib.loads(text).items()}


@cache
def _pattern() -> re.Pattern[str]:
    known = sorted({*signs(), *WORDS}, key=len, reverse=True)
    return re.compile("|".join([r"[a-z]{3,}", *map(re.escape, known), r"[^\W\d_]"]))


def signs_in(equation: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Signs of an equation in their order, and letters that are none.

    >>> signs_in("β = arcsin(r/(R−r)), qqq")
    (('β', 'r', 'R'), ())
    """
    plain = equation.replace("\u0304", "")
    names = [name for name in _pattern().findall(plain) if name not in WORDS and not re.fullmatch("[a-z]{3,}", name)]
    known = tuple(dict.fromkeys(name for name in names if name in signs()))
    return known, tuple(name for name in names if name not in signs() and name.isalpha())


def told(names: tuple[str, ...], *, si: bool) -> str:
    """Meaning of each of these symbols, with its unit."""
    return "; ".join(_told(name, signs()[name], si=si) for name in names)


def _told(name: str, sign: Sign, *, si: bool) -> str:
    unit = unit_name(sign.unit, si=si)
    return f"{name} {sign.meaning}{f' [{unit}]' if unit else ''}"


def unit_name(unit: str, *, si: bool) -> str:
    """A unit as it is printed: that of files, or that of SI.

    >>> unit_name("g_mm", si=False), unit_name("g_mm", si=True), unit_name("N_per_m", si=True)
    ('g·mm', 'kg m', 'N/m')
    """
    return SI_NAMES.get(unit, SYMBOLS.get(unit, unit)) if si else SYMBOLS.get(unit, unit)


def unit_in_files(unit: str) -> str:
    """The unit in which files and reports have what is in this unit of SI; itself where that is the same.

    >>> unit_in_files("kg m"), unit_in_files("rad/s"), unit_in_files("1/s")
    ('g_mm', 'rpm', '1/s')
    """
    return IN_FILES.get(unit, unit)


def in_files(limits: Range) -> str:
    """A range of a quantity in the unit that files have.

    >>> in_files(Range("speed", 0.0, 100.0, unit="rad/s"))
    '0 … 954.93 rpm'
    """
    unit = unit_in_files(limits.unit)
    if unit == limits.unit:
        return str(limits)
    low, high = (from_si(bound, unit) if math.isfinite(bound) else bound for bound in (limits.low, limits.high))
    return str(replace(limits, low=low, high=high, unit=SYMBOLS.get(unit, unit)))


def conversions(units: tuple[str, ...]) -> str:
    """Conversions from the units of files to SI, of those that differ.

    >>> conversions(("mm", "kg", "g"))
    '1 mm = 0.001 m, 1 g = 0.001 kg'
    """
    differ = [unit for unit in dict.fromkeys(units) if unit in SI_NAMES]
    sizes = [bounded(float(f"{SI_PER_UNIT[unit]:.4g}")) for unit in differ]
    pairs = zip(differ, sizes, strict=True)
    return ", ".join(f"1 {SYMBOLS.get(unit, unit)} = {size} {SI_NAMES[unit]}" for unit, size in pairs)
