"""Registry of formulas and their symbols, the source of `abu explain`, `help()` and range checks.

The decorator of the function (or class) that computes a formula registers it. A symbol has one meaning in all of
abu-calc. Its unit is given as in files and in SI.
"""

import importlib
import inspect
import math
import re
import tomllib
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Final, NamedTuple, TypeVar

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import SI_PER_UNIT, SYMBOLS, from_si
from abu_calc.foundation.validity import Range, bounded

SI_NAMES: Final = {
    "mm": "m", "um": "m", "g": "kg", "g_mm": "kg m", "rpm": "rad/s", "hz": "rad/s", "deg": "rad", "mrad": "rad",
    "MPa": "Pa", "GPa": "Pa", "kN": "N", "kN_per_m": "N/m", "mm_per_s": "m/s",
    "min": "s",
}  # fmt: skip
"""SI unit of quantities that files give in another unit."""
IN_FILES: Final = {"m": "mm", "kg m": "g_mm", "Pa": "MPa", "rad": "deg", "rad/s": "rpm", "m/s": "mm_per_s"}
"""The inverse: unit of numbers in results."""
FUNCTIONS: Final = (
    "sin cos tan arcsin arccos arctan lg ln exp Re Im arg min max det e^ dε ds_w dx_s dz_o π Σ ᵀ °C MPa mm"
)
SHORT: Final = "at of by to so in an or and i j k"
"""Short words, the imaginary unit, indices."""
WORDS: Final = frozenset(f"{FUNCTIONS} {SHORT}".split())
"""Words of a formula that are not symbols."""


class Sign(NamedTuple):
    """Meaning of a symbol, and its unit: as keys of files name it, or as it is shown."""

    meaning: str
    unit: str = ""


@cache
def signs() -> dict[str, Sign]:
    """All symbols by name."""
    text = Path(__file__).with_name("symbols.toml").read_text(encoding="utf-8")
    return {name: Sign(*entry) for name, entry in tomllib.loads(text).items()}


@cache
def _pattern() -> re.Pattern[str]:
    known = sorted({*signs(), *WORDS}, key=len, reverse=True)
    return re.compile("|".join([r"[a-z]{3,}", *map(re.escape, known), r"[^\W\d_]"]))


def signs_in(equation: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Symbols of an equation in their order, and letters that are not symbols.

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
    """A unit as it is shown: that of files, or that of SI.

    >>> unit_name("g_mm", si=False), unit_name("g_mm", si=True), unit_name("N_per_m", si=True)
    ('g·mm', 'kg m', 'N/m')
    """
    return SI_NAMES.get(unit, SYMBOLS.get(unit, unit)) if si else SYMBOLS.get(unit, unit)


def unit_in_files(unit: str) -> str:
    """Unit of files and reports for an SI unit; the same unit if they do not differ.

    >>> unit_in_files("kg m"), unit_in_files("rad/s"), unit_in_files("1/s")
    ('g_mm', 'rpm', '1/s')
    """
    return IN_FILES.get(unit, unit)


def in_files(limits: Range) -> str:
    """A range in the unit of files.

    >>> in_files(Range("speed", 0.0, 100.0, unit="rad/s"))
    '0 … 954.93 rpm'
    """
    unit = unit_in_files(limits.unit)
    if unit == limits.unit:
        return str(limits)
    low, high = (from_si(bound, unit) if math.isfinite(bound) else bound for bound in (limits.low, limits.high))
    return str(replace(limits, low=low, high=high, unit=SYMBOLS.get(unit, unit)))


def conversions(units: tuple[str, ...]) -> str:
    """Conversions from units of files to SI, for units that differ.

    >>> conversions(("mm", "kg", "g"))
    '1 mm = 0.001 m, 1 g = 0.001 kg'
    """
    differ = [unit for unit in dict.fromkeys(units) if unit in SI_NAMES]
    sizes = [bounded(float(f"{SI_PER_UNIT[unit]:.4g}")) for unit in differ]
    pairs = zip(differ, sizes, strict=True)
    return ", ".join(f"1 {SYMBOLS.get(unit, unit)} = {size} {SI_NAMES[unit]}" for unit, size in pairs)


_PACKAGE: Final = "abu_calc."
_Computes = TypeVar("_Computes", bound=Callable[..., Any])


@dataclass(frozen=True)
class Formula:
    """Shown parts of a formula. Indented lines of `where` are equations, not wrapped.

    `checked` is the range outside which the code refuses to compute, `assumed` a condition that nothing checks.
    """

    key: str
    """`module:function`, without the package."""
    gives: str
    equation: str = ""
    unit: str = ""
    """Unit in SI."""
    where: str = ""
    checked: tuple[Range | str, ...] = ()
    assumed: str = ""
    source: str = ""
    published: str = ""
    """Differences and errors in the formula as published."""
    signs: str = ""
    """Symbols that are not in the equation, but in the text beside it."""
    shown: str = ""
    """Unit in which results have it, as keys name it, where that is not the usual one of files for `unit`."""
    own_units: bool = False
    """True if the equation does not take SI; equation or `where` then names its units."""

    @property
    def name(self) -> str:
        """The name in words.

        >>> Formula("formulas.rigid_body:RigidBody.effective_mass", "Effective mass at a place").name
        'effective mass'
        """
        return self.key.replace(":", ".").rsplit(".", 1)[-1].replace("_", " ")

    @property
    def paragraphs(self) -> tuple[str, ...]:
        """Texts in SI, one paragraph each: equation, symbols, explanation, range, source, errors as published."""
        unit = f" [{self.unit}]" if self.unit else ""
        limits = [f"{span.name} {span}" if isinstance(span, Range) else span for span in self.checked]
        return self._said(unit, limits, si=True)

    @property
    def for_users(self) -> tuple[str, ...]:
        """The same texts in the units of files and reports; `file_units` lists them."""
        unit = ", ".join(unit_name(single_unit, si=False) for single_unit in self._result_units)
        limits = [span if isinstance(span, str) else f"{span.name} {in_files(span)}" for span in self.checked]
        said = self._said(f" [{unit}]" if unit else "", limits, si=False)
        place = 1 + bool(self._names)
        return (*said[:place], *(["This equation takes these units, not SI."] if self.own_units else ()), *said[place:])

    @property
    def file_units(self) -> tuple[str, ...]:
        """Units of its numbers in files and reports, if the equation takes SI."""
        return () if self.own_units else (*self._result_units, *(signs()[name].unit for name in self._names))

    @property
    def _result_units(self) -> list[str]:
        return self.shown.split(", ") if self.shown else list(map(unit_in_files, filter(None, self.unit.split(", "))))

    def _said(self, unit: str, limits: list[str], *, si: bool) -> tuple[str, ...]:
        equation = f": {self.equation}" if self.equation else ""
        signs_told = f"{told(self._names, si=si)}." if self._names else ""
        labelled = (
            ("Range", f"{', '.join(limits)} (checked)" if limits else ""),
            ("Assumed", f"{self.assumed} (not checked)" if self.assumed else ""),
            ("Source", self.source),
            ("As published", self.published),
        )
        parts = (f"{self.gives}{equation}{unit}.", *([signs_told] if signs_told else ()), *self.where.splitlines())
        return (*parts, *(f"{name}: {text}." for name, text in labelled if text))

    @property
    def _names(self) -> tuple[str, ...]:
        known, _ = signs_in(self.equation)
        return tuple(dict.fromkeys((*known, *self.signs.split())))

    @property
    def text(self) -> str:
        """The paragraphs as one text.

        >>> print(Formula("a:b", "Time", "2·k", "s", checked=(Range("k", 0, 1),), source="derived").text)
        Time: 2·k [s].
        Range: k 0 … 1 (checked).
        Source: derived.
        """
        return "\n".join(self.paragraphs)


REGISTERED: Final[dict[str, Formula]] = {}
"""Formulas by key; a module registers its formulas when it is imported."""


def formula(
    gives: str, equation: str = "", unit: str = "", *, where: str = "", checked: tuple[Range | str, ...] = (),
    assumed: str = "", source: str = "", published: str = "", signs: str = "", shown: str = "", own_units: bool = False,
) -> Callable[[_Computes], _Computes]:  # fmt: skip
    """Decorator that registers a formula and puts its text before the examples in the docstring of its function."""

    def registered(computes: _Computes) -> _Computes:
        key = f"{computes.__module__}:{computes.__qualname__}".removeprefix(_PACKAGE)
        entry = register(
            Formula(key, gives, equation, unit, where, checked, assumed, source, published, signs, shown, own_units)
        )
        computes.__doc__ = "\n\n".join(filter(None, (entry.text, inspect.cleandoc(computes.__doc__ or ""))))
        return computes

    return registered


def register(entry: Formula) -> Formula:
    """Register a formula that no function of its module computes."""
    REGISTERED[entry.key] = entry
    return entry


def formula_of(key: str) -> Formula:
    """The formula registered by a key, `module:function`; its module is imported for it."""
    importlib.import_module(f"{_PACKAGE}{key.partition(':')[0]}")
    return REGISTERED[key]
