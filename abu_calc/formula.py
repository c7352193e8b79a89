"""Formulas as registered data: what `abu explain` shows, `help()` says, and the code checks, each written once.

A formula is registered where it stands, by the decorator of the function (or class) that computes it.
"""

import importlib
import inspect
from collections.abc import Callable
from typing import Any, Final, TypeVar

from abu_calc.frozen import dataclass
from abu_calc.signs import conversions, in_files, signs, signs_in, told, unit_in_files, unit_name
from abu_calc.validity import Range

_PACKAGE: Final = "abu_calc."
_Computes = TypeVar("_Computes", bound=Callable[..., Any])


@dataclass(frozen=True)
class Formula:
    """Shown parts of a formula. Indented lines of `where` are equations, not wrapped.

    `checked` is the range that the code refuses to leave, `assumed` the part of it that nothing checks.
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
    printed: str = ""
    """Differences in the source's formula as published."""
    signs: str = ""
    """Symbols that are not in the equation, but in the text beside it."""
    shown: str = ""
    """Unit in which results have it, as keys name it, where that is not the usual one of files for `unit`."""
    own_units: bool = False
    """The equation takes no SI: it, or what is said beside it, names its units."""

    @property
    def name(self) -> str:
        """The name in words.

        >>> Formula("sizing.body:Body.effective_mass", "Mass felt at a place").name
        'effective mass'
        """
        return self.key.replace(":", ".").rsplit(".", 1)[-1].replace("_", " ")

    @property
    def paragraphs(self) -> tuple[str, ...]:
        """All it says, a paragraph each: what it gives, signs with their units in SI, range, source, print."""
        unit = f" [{self.unit}]" if self.unit else ""
        ranges = self._ranges([f"{span.name} {span}" if isinstance(span, Range) else span for span in self.checked])
        return self._said(unit, ranges, si=True)

    @property
    def for_users(self) -> tuple[str, ...]:
        """The same in the units of files and reports, and how to come from them to SI, which equations take."""
        units = self.shown.split(", ") if self.shown else list(map(unit_in_files, filter(None, self.unit.split(", "))))
        unit = ", ".join(unit_name(single_unit, si=False) for single_unit in units)
        limits = [span if isinstance(span, str) else f"{span.name} {in_files(span)}" for span in self.checked]
        said = self._said(f" [{unit}]" if unit else "", self._ranges(limits), si=False)
        differ = "" if self.own_units else conversions((*units, *(signs()[name].unit for name in self._names)))
        place = 1 + bool(self._names)
        return (*said[:place], *([f"Equations take SI: {differ}."] if differ else ()), *said[place:])

    def _said(self, unit: str, ranges: str, *, si: bool) -> tuple[str, ...]:
        equation = f": {self.equation}" if self.equation else ""
        signs_told = f"{told(self._names, si=si)}." if self._names else ""
        labelled = (("Range", ranges), ("Source", self.source), ("Printed", self.printed))
        parts = (f"{self.gives}{equation}{unit}.", *([signs_told] if signs_told else ()), *self.where.splitlines())
        return (*parts, *(f"{name}: {text}." for name, text in labelled if text))

    def _ranges(self, limits: list[str]) -> str:
        checked = [f"{', '.join(limits)} (checked)"] if limits else []
        return "; ".join([*checked, *([f"{self.assumed} (not checked)"] if self.assumed else [])])

    @property
    def _names(self) -> tuple[str, ...]:
        known, _ = signs_in(self.equation)
        return tuple(dict.fromkeys((*known, *self.signs.split())))

    @property
    def text(self) -> str:
        """The same in one piece.

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
    assumed: str = "", source: str = "", printed: str = "", signs: str = "", shown: str = "", own_units: bool = False,
) -> Callable[[_Computes], _Computes]:  # fmt: skip
    """Decorates what computes a formula: registers it, and lets `help()` say it before the docstring's examples."""

    def registered(computes: _Computes) -> _Computes:
        key = f"{computes.__module__}:{computes.__qualname__}".removeprefix(_PACKAGE)
        entry = register(
            Formula(key, gives, equation, unit, where, checked, assumed, source, printed, signs, shown, own_units)
        )
        computes.__doc__ = "\n\n".join(filter(None, (entry.text, inspect.cleandoc(computes.__doc__ or ""))))
        return computes

    return registered


def register(entry: Formula) -> Formula:
    """Registers a formula that no function of its module computes."""
    REGISTERED[entry.key] = entry
    return entry


def formula_of(key: str) -> Formula:
    """The formula registered by a key, `module:function`; its module is imported for it."""
    importlib.import_module(f"{_PACKAGE}{key.partition(':')[0]}")
    return REGISTERED[key]
