"""The same loop without a compiler: its text and the equations' are plain Python, run here as they stand.

Arrays are memory views, whose parts are views too and whose numbers are Python's own: half as slow as NumPy's.
"""

import math
from collections.abc import Callable, Sequence
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from abu_calc.dynamics.integrators.compiled import arrays, contact, decide, friction, impact, locate, loop, method
from abu_calc.dynamics.integrators.compiled.program import Program

MODULES: Sequence[ModuleType] = (method, locate, friction, contact, impact, decide, loop)
"""In the order in which they import each other."""

PARAMETERS, LAYOUT = 2, 3
"""Arguments of `loop.go` of which no part is taken: lists are read in half the time."""


class Plain:
    """A structure's equations, and the loop through their motion, as `Code` has them."""

    def __init__(self, functions: Program) -> None:
        self.program = functions
        self._go = _bound(_equations(functions.text))
        self._parameters = [0.0] * functions.parameters

    def go(self, *given: np.ndarray) -> int:
        """`loop.go` on these arrays."""
        views: list[Any] = [one.reshape(-1).data for one in given]
        views[PARAMETERS], views[LAYOUT] = self._parameters, views[LAYOUT].tolist()
        return int(self._go(*views))


def _equations(text: str) -> dict[str, Callable[..., None]]:
    """The functions of a structure by their names."""
    known: dict[str, Any] = {"inf": math.inf, "sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    exec(compile(f"from __future__ import annotations\n{text}", "<equations>", "exec"), known)
    return {"setup": known["setup"], "rates": _guarded(known["rates"]), "watched": _guarded(known["watched"])}


def _guarded(function: Callable[..., None]) -> Callable[..., None]:
    """Rates that are no numbers, as compiled code gives them, where Python would raise: the step is then shortened."""

    def guarded(t: float, y: Any, par: Any, dy: Any, *watched: Any) -> None:
        try:
            function(t, y, par, dy, *watched)
        except (ArithmeticError, ValueError):
            dy[0] = math.nan

    return guarded


def _bound(equations: dict[str, Callable[..., None]]) -> Callable[..., Any]:
    """The loop, all of whose functions call these equations."""
    made: dict[Any, Any] = {getattr(arrays, name): function for name, function in equations.items()}
    for module in MODULES:
        names = {name: made.get(value, value) if callable(value) else value for name, value in vars(module).items()}
        for name, value in vars(module).items():
            if isinstance(value, FunctionType) and value.__module__ == module.__name__:
                names[name] = made[value] = FunctionType(value.__code__, names, name)
    return made[loop.go]  # type: ignore[no-any-return]
