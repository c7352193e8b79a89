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

from abu_calc.dynamics.integrators.compiled import arrays, contact, decide, friction, impact, locate, loop, method
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
        self.program = functions
        self._go = _bound(_Equations(functions).functions())

    def go(self, *given: np.ndarray) -> int:
        """`loop.go` on these arrays."""
        views: list[Any] = [one.reshape(-1).data for one in given]
        # Its own: runs of one structure may go side by side; the loop fills it at its start.
        views[PARAMETERS] = [0.0] * self.program.parameters + [None] * len(SPARED)
        views[LAYOUT] = views[LAYOUT].tolist()
        return int(self._go(*views))


SPARED = ("rates", "watched")
"""Functions that are made anew for modes that come often; a run has those of its modes behind its parameters."""


@dataclass
class _Kind:
    """Modes with the same zeros and ones among their parameters; how often they came, and functions without these."""

    known: dict[int, float]
    came: int = 0
    made: tuple[Callable[..., None], ...] | None = None


class _Equations:
    """The functions of a structure, whole and without what is zero in modes that come often."""

    def __init__(self, program: Program) -> None:
        self._count, self._text = program.parameters, _guarded(program.text)
        self._whole = _compiled(self._text)
        self._kinds: dict[tuple[tuple[int, float], ...], _Kind] = {}
        self._left = MOST

    @cached_property
    def _watched(self) -> ast.FunctionDef:
        """The function that gives rates as well."""
        functions = (one for one in ast.parse(self._text).body if isinstance(one, ast.FunctionDef))
        return next(one for one in functions if one.name == "watched")

    def functions(self) -> dict[str, Callable[..., None]]:
        """By their names, as the loop calls them."""
        whole, setup, count = tuple(self._whole[name] for name in SPARED), self._whole["setup"], self._count
        kept: dict[bytes, tuple[list[float], _Kind]] = {}

        def prepared(numbers: Any, par: Any) -> None:
            key = numbers.tobytes()
            known = kept.get(key)
            if known is None:
                setup(numbers, par)
                if len(kept) >= MOST_KEPT:
                    kept.clear()
                known = kept[key] = par[:count], self._kind(par[:count])
            par[:count], kind = known
            par[count:] = kind.made or self._often(kind) or whole

        def rates(t: float, y: Any, par: Any, dy: Any) -> None:
            par[-2](t, y, par, dy)

        def watched(t: float, y: Any, par: Any, dy: Any, w: Any) -> None:
            par[-1](t, y, par, dy, w)

        return {"setup": prepared, "rates": rates, "watched": watched, "apparent": self._whole["apparent"]}

    def _kind(self, parameters: Sequence[float]) -> _Kind:
        known = {place: one for place, one in enumerate(parameters) if one in FOLDED}
        return self._kinds.setdefault(tuple(known.items()), _Kind(known))

    def _often(self, kind: _Kind) -> tuple[Callable[..., None], ...] | None:
        """Functions of its own, once it has come often enough."""
        kind.came += 1
        if kind.came < OFTEN or self._left <= 0:
            return None
        self._left -= 1
        less = spared(self._watched, kind.known)
        found = _compiled(ast.Module([without(less, "w", "rates"), less], []))
        kind.made = tuple(found[name] for name in SPARED)
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


def _bound(equations: dict[str, Callable[..., None]]) -> Callable[..., Any]:
    """The loop, all of whose functions call these equations."""
    made: dict[Any, Any] = {getattr(arrays, name): function for name, function in equations.items()}
    for module in MODULES:
        names = {name: made.get(value, value) if callable(value) else value for name, value in vars(module).items()}
        for name, value in vars(module).items():
            if isinstance(value, FunctionType) and value.__module__ == module.__name__:
                names[name] = made[value] = FunctionType(value.__code__, names, name)
    return made[loop.go]  # type: ignore[no-any-return]
