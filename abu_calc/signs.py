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
"""What is no sign."""


class Sign(NamedTuple):
    """What a sign means, and its unit: as keys of files name it, or as it is printed."""

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
    found = [one for one in _pattern().findall(plain) if one not in WORDS and not re.fullmatch("[a-z]{3,}", one)]
    known = tuple(dict.fromkeys(one for one in found if one in signs()))
    return known, tuple(one for one in found if one not in signs() and one.isalpha())


def told(names: tuple[str, ...], *, si: bool) -> str:
    """What each of these means, with its unit."""
    return "; ".join(_told(name, signs()[name], si=si) for name in names)


def _told(name: str, one: Sign, *, si: bool) -> str:
    unit = unit_name(one.unit, si=si)
    return f"{name} {one.meaning}{f' [{unit}]' if unit else ''}"


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
    low, high = (from_si(one, unit) if math.isfinite(one) else one for one in (limits.low, limits.high))
    return str(replace(limits, low=low, high=high, unit=SYMBOLS.get(unit, unit)))


def conversions(units: tuple[str, ...]) -> str:
    """How to come from the units of files to SI, of those that differ.

    >>> conversions(("mm", "kg", "g"))
    '1 mm = 0.001 m, 1 g = 0.001 kg'
    """
    differ = [one for one in dict.fromkeys(units) if one in SI_NAMES]
    sizes = [bounded(float(f"{SI_PER_UNIT[one]:.4g}")) for one in differ]
    pairs = zip(differ, sizes, strict=True)
    return ", ".join(f"1 {SYMBOLS.get(one, one)} = {size} {SI_NAMES[one]}" for one, size in pairs)
