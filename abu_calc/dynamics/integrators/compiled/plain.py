"""The same loop without a compiler: its text and the equations' are plain Python, run here as they stand.

Arrays are memory views, whose parts are views too and whose numbers are Python's own: half as slow as NumPy's.
"""

import __future__

import ast
import math
from collections.abc import Callable, Sequence
from functools import cached_property
from types import FunctionType, ModuleType
from typing import Any, Final

import numpy as np

from abu_calc.dynamics.integrators.compiled import arrays, contact, decide, friction, impact, locate, loop, method
from abu_calc.dynamics.integrators.compiled.program import Program
from abu_calc.dynamics.integrators.compiled.spared import FOLDED, spared

MODULES: Sequence[ModuleType] = (method, locate, friction, contact, impact, decide, loop)
"""In the order in which they import each other."""

NAMES_ALONE: Final = __future__.annotations.compiler_flag
"""Annotations are not looked up."""

PARAMETERS, LAYOUT = 2, 3
"""Arguments of `loop.go` of which no part is taken: lists are read in half the time."""


OFTEN, MOST = 60, 64
"""Times that modes come with the same zeros until functions of their own pay, and how many of these there are."""

MOST_KEPT = 256
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


class _Equations:
    """The functions of a structure, whole and without what is zero in modes that come often."""

    def __init__(self, program: Program) -> None:
        self._count, self._text = program.parameters, program.text
        self._whole = _compiled(program.text)
        self._seen: dict[Any, int] = {}
        self._made: dict[Any, tuple[Any, ...]] = {}

    @cached_property
    def _parts(self) -> dict[str, ast.FunctionDef]:
        return {one.name: one for one in ast.parse(self._text).body if isinstance(one, ast.FunctionDef)}

    def functions(self) -> dict[str, Callable[..., None]]:
        """By their names, as the loop calls them."""
        whole, setup = tuple(self._whole[name] for name in SPARED), self._whole["setup"]
        count, made = self._count, self._made
        kept: dict[bytes, tuple[list[float], tuple[float | None, ...]]] = {}

        def prepared(numbers: Any, par: Any) -> None:
            key = numbers.tobytes()
            known = kept.get(key)
            if known is None:
                setup(numbers, par)
                known = par[:count], tuple([one if one in FOLDED else None for one in par[:count]])
                if len(kept) >= MOST_KEPT:
                    kept.clear()
                kept[key] = known
            numbers_made, zeros = known
            par[:count], par[count:] = numbers_made, made.get(zeros) or self._often(zeros) or whole

        def rates(t: float, y: Any, par: Any, dy: Any) -> None:
            par[-2](t, y, par, dy)

        def watched(t: float, y: Any, par: Any, dy: Any, w: Any) -> None:
            par[-1](t, y, par, dy, w)

        return {"setup": prepared, "rates": rates, "watched": watched, "apparent": self._whole["apparent"]}

    def _often(self, zeros: tuple[float | None, ...]) -> tuple[Any, ...] | None:
        """Those for these zeros and ones, once they have come often enough."""
        self._seen[zeros] = self._seen.get(zeros, 0) + 1
        if self._seen[zeros] < OFTEN or len(self._made) >= MOST:
            return None
        known = {place: one for place, one in enumerate(zeros) if one is not None}
        found = _compiled("\n".join(ast.unparse(spared(self._parts[name], known)) for name in SPARED))
        self._made[zeros] = tuple(found[name] for name in SPARED)
        return self._made[zeros]


def _compiled(text: str) -> dict[str, Callable[..., None]]:
    """The functions of a text by their names; their annotations are those of a compiler.

    From text alone: trees of Python's own objects take longer to make than all else that is done here.
    """
    known: dict[str, Any] = {"nan": math.nan, "inf": math.inf, "sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    exec(compile(_guarded(text), "<equations>", "exec", NAMES_ALONE, dont_inherit=True), known)
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
