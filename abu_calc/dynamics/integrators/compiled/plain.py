"""The same loop without a compiler: its text and the equations' are plain Python, run here as they stand.

Arrays are memory views, whose parts are views too and whose numbers are Python's own: half as slow as NumPy's.
"""

import __future__

import ast
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import FunctionType, ModuleType
from typing import Any, Final

import numpy as np

from abu_calc.dynamics.integrators.compiled import contact, decide, friction, impact, locate, loop, method
from abu_calc.dynamics.integrators.compiled.program import Program
from abu_calc.dynamics.integrators.compiled.spared import FOLDED, spared, without

MODULES: Sequence[ModuleType] = (method, locate, friction, contact, impact, decide, loop)
"""In the order in which they import each other."""

NAMES_ALONE: Final = __future__.annotations.compiler_flag
"""Annotations are not looked up."""

PARAMETERS, LAYOUT = 2, 3
"""Arguments of `loop.go` of which no part is taken: lists are read in half the time."""


OFTEN, MOST = 60, 64
"""Times that modes come with the same zeros until functions of their own pay, and how many of these there are."""

MOST_KEPT = 2048
"""Parameters of modes that are kept: in a run the same come again and again."""


class Plain:
    """A structure's equations, and the loop through their motion, as `Code` has them."""

    def __init__(self, functions: Program) -> None:
        self.program, self._equations = functions, _Equations(functions)

    def go(self, *given: np.ndarray) -> int:
        """`loop.go` on these arrays."""
        views: list[Any] = [one.reshape(-1).data for one in given]
        # Its own, as the loop is: runs of one structure may go side by side.
        views[PARAMETERS] = [0.0] * self.program.parameters
        views[LAYOUT] = views[LAYOUT].tolist()
        return int(_loop(self._equations)(*views))


SPARED: Final = ("rates", "watched")
"""Functions that are made anew for modes that come often."""


@dataclass
class _Kind:
    """Modes with the same zeros and ones among their parameters; how often they came, and functions without these."""

    known: dict[int, float]
    came: int = 0
    made: dict[str, Callable[..., None]] | None = None


class _Equations:
    """The functions of a structure, whole and without what is zero in modes that come often."""

    def __init__(self, program: Program) -> None:
        self._text = _guarded(program.text)
        self._whole = _compiled(self._text)
        self._kinds: dict[bytes, _Kind] = {}
        self._kept: dict[bytes, tuple[list[float], _Kind]] = {}
        self._left = MOST

    @cached_property
    def _watched(self) -> ast.FunctionDef:
        """The function that gives rates as well."""
        functions = (one for one in ast.parse(self._text).body if isinstance(one, ast.FunctionDef))
        return next(one for one in functions if one.name == "watched")

    def put(self, names: dict[str, Any]) -> None:
        """Into the names of a loop; `setup` changes those of SPARED to functions for its modes."""
        kept, whole = self._kept, {name: self._whole[name] for name in SPARED}

        def setup(numbers: Any, par: Any) -> None:
            key = numbers.tobytes()
            known = kept.get(key)
            if known is None:
                self._whole["setup"](numbers, par)
                if len(kept) >= MOST_KEPT:
                    kept.clear()
                known = kept[key] = list(par), self._kind(par)
            par[:], kind = known
            names.update(kind.made or self._often(kind) or whole)

        names.update(whole, setup=setup, apparent=self._whole["apparent"])

    def _kind(self, parameters: Sequence[float]) -> _Kind:
        values = np.array(parameters)
        key = b"".join((values == one).tobytes() for one in FOLDED)
        if key not in self._kinds:
            self._kinds[key] = _Kind({place: one for place, one in enumerate(parameters) if one in FOLDED})
        return self._kinds[key]

    def _often(self, kind: _Kind) -> dict[str, Callable[..., None]] | None:
        """Functions of its own, once it has come often enough."""
        kind.came += 1
        if kind.came < OFTEN or self._left <= 0:
            return None
        self._left -= 1
        less = spared(self._watched, kind.known)
        found = _compiled(ast.Module([without(less, "w", "rates"), less], []))
        kind.made = {name: found[name] for name in SPARED}
        return kind.made


def _compiled(text: str | ast.Module) -> dict[str, Callable[..., None]]:
    """The functions of a text by their names; their annotations are those of a compiler."""
    known: dict[str, Any] = {"nan": math.nan, "inf": math.inf, "sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    exec(compile(text, "<equations>", "exec", NAMES_ALONE, dont_inherit=True), known)
    return known


def _guarded(text: str) -> str:
    """The same functions, whose rates are no numbers, as compiled code gives them, where Python would raise.

    The step is then shortened.
    """
    lines: list[str] = []
    rates = False
    for line in [*text.splitlines(), "def "]:
        if line.startswith("def "):
            lines += [" except (ArithmeticError, ValueError):", "  dy[0] = nan"] if rates else []
            rates = "dy: Reals" in line
            lines += [line, " try:"] if rates else [line]
        else:
            lines.append(f" {line}" if rates else line)
    return "\n".join(lines[:-1])


def _loop(equations: _Equations) -> Callable[..., Any]:
    """`loop.go`, all of whose functions call these equations."""
    names: dict[str, Any] = {}
    for module in MODULES:
        for name, value in vars(module).items():
            own = isinstance(value, FunctionType) and value.__module__ == module.__name__
            names[name] = FunctionType(value.__code__, names, name) if own else names.get(name, value)
    equations.put(names)
    return names["go"]  # type: ignore[no-any-return]
