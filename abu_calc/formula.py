"""Formulas as registered data: what `abu explain` shows, `help()` says, and the code checks, each written once.

A formula is registered where it stands, by the decorator of the function (or class) that computes it.
"""

import importlib
import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, TypeVar

from abu_calc.validity import Range

_PACKAGE: Final = "abu_calc."
_Computes = TypeVar("_Computes", bound=Callable[..., Any])


@dataclass(frozen=True)
class Formula:
    """What is shown of a formula. Indented lines of `where` are equations, not wrapped.

    `checked` is the range that the code refuses to leave, `assumed` the part of it that nothing checks.
    """

    key: str
    """`module:function`, without the package."""
    gives: str
    equation: str = ""
    unit: str = ""
    where: str = ""
    checked: tuple[Range | str, ...] = ()
    assumed: str = ""
    source: str = ""
    printed: str = ""
    """Where the print of the source differs."""

    @property
    def name(self) -> str:
        """The name in words.

        >>> Formula("sizing.body:Body.effective_mass", "Mass felt at a place").name
        'effective mass'
        """
        return self.key.replace(":", ".").rsplit(".", 1)[-1].replace("_", " ")

    @property
    def paragraphs(self) -> tuple[str, ...]:
        """All it says, a paragraph each: what it gives, symbols, range, source, print."""
        unit, equation = f" [{self.unit}]" if self.unit else "", f": {self.equation}" if self.equation else ""
        limits = [f"{one.name} {one}" if isinstance(one, Range) else one for one in self.checked]
        ranges = [f"{', '.join(limits)} (checked)"] if limits else []
        ranges += [f"{self.assumed} (not checked)"] if self.assumed else []
        labelled = (("Range", "; ".join(ranges)), ("Source", self.source), ("Printed", self.printed))
        parts = (f"{self.gives}{equation}{unit}.", *self.where.splitlines())
        return (*parts, *(f"{name}: {text}." for name, text in labelled if text))

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
"""By key; a module registers its formulas when it is imported."""


def formula(
    gives: str, equation: str = "", unit: str = "", *, where: str = "", checked: tuple[Range | str, ...] = (),
    assumed: str = "", source: str = "", printed: str = "",
) -> Callable[[_Computes], _Computes]:  # fmt: skip
    """Decorates what computes a formula: registers it, and lets `help()` say it before the docstring's examples."""

    def registered(computes: _Computes) -> _Computes:
        key = f"{computes.__module__}:{computes.__qualname__}".removeprefix(_PACKAGE)
        found = register(Formula(key, gives, equation, unit, where, checked, assumed, source, printed))
        computes.__doc__ = "\n\n".join(filter(None, (found.text, inspect.cleandoc(computes.__doc__ or ""))))
        return computes

    return registered


def register(found: Formula) -> Formula:
    """Registers a formula that no function of its module computes."""
    REGISTERED[found.key] = found
    return found


def formula_of(key: str) -> Formula:
    """The formula registered by a key, `module:function`; its module is imported for it."""
    importlib.import_module(f"{_PACKAGE}{key.partition(':')[0]}")
    return REGISTERED[key]
