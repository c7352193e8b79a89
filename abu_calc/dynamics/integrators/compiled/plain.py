"""The compiled loop without a compiler: its text and the equations' are plain Python, run here as they stand.

Arrays are memory views. Their parts are views too and their numbers are Python's own: half as slow as NumPy's.
"""

import __future__

import math
from collections.abc import Callable
from types import FunctionType
from typing import Any, Final

import numpy as np

from abu_calc.dynamics.integrators.compiled.arrays import Run
from abu_calc.dynamics.integrators.compiled.kernels import Method, kernels
from abu_calc.dynamics.integrators.compiled.program import EQUATIONS, Program

NAMES_ALONE: Final = __future__.annotations.compiler_flag
"""Annotations are not looked up."""

PARAMETERS, LAYOUT = (Run._fields.index(name) for name in ("par", "lay"))
"""Arrays of a run of which no part is taken: lists are read in half the time."""


class Plain:
    """A structure's equations, and the loop through their motion by one method, as `Code` has them."""

    def __init__(self, functions: Program, method: Method) -> None:
        self.program, self._go = functions, _loop(functions, method)

    def go(self, *given: np.ndarray) -> int:
        """`loop.go` on these arrays."""
        views: list[Any] = [array.reshape(-1).data for array in given]
        # Parameters of this run alone: runs of one structure may go side by side.
        views[PARAMETERS] = [0.0] * self.program.parameters
        views[LAYOUT] = views[LAYOUT].tolist()
        arrays = len(Run._fields)
        return int(self._go(Run(*views[:arrays]), *views[arrays:]))


def _loop(program: Program, method: Method) -> Callable[..., Any]:
    """`loop.go`, all of whose functions call these equations; the method's names come before those of `dopri5`."""
    names: dict[str, Any] = {}
    for module in kernels(method):
        for name, value in vars(module).items():
            own = isinstance(value, FunctionType) and value.__module__ == module.__name__
            names[name] = FunctionType(value.__code__, names, name) if own else names.get(name, value)
    equations = _equations(program)
    names.update({name: equations[name] for name in EQUATIONS})
    return names["go"]  # type: ignore[no-any-return]


def _equations(program: Program) -> dict[str, Any]:
    """The functions of a structure by their names; their annotations are those of a compiler."""
    known: dict[str, Any] = {"nan": math.nan, "inf": math.inf, "sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    exec(compile(_guarded(program.text), "<equations>", "exec", NAMES_ALONE, dont_inherit=True), known)
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
