"""The same loop without a compiler: its text and the equations' are plain Python, run here as they stand.

Arrays are memory views, whose parts are views too and whose numbers are Python's own: half as slow as NumPy's.
"""

import math
from collections.abc import Callable, Sequence
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from abu_calc.dynamics.integrators.compiled import arrays, contact, decide, friction, impact, locate, loop, method
from abu_calc.dynamics.integrators.compiled.program import EQUATIONS, Program

MODULES: Sequence[ModuleType] = (method, locate, friction, contact, impact, decide, loop)
"""In the order in which they import each other."""

PARAMETERS, LAYOUT = 2, 3
"""Arguments of `loop.go` of which no part is taken: lists are read in half the time."""


class Plain:
    """A structure's equations, and the loop through their motion, as `Code` has them."""

    def __init__(self, functions: Program) -> None:
        self.program = functions
        self._go = _bound(_equations(functions.text))

    def go(self, *given: np.ndarray) -> int:
        """`loop.go` on these arrays."""
        views: list[Any] = [one.reshape(-1).data for one in given]
        # Its own: runs of one structure may go side by side; the loop fills it at its start.
        views[PARAMETERS], views[LAYOUT] = [0.0] * self.program.parameters, views[LAYOUT].tolist()
        return int(self._go(*views))


def _equations(text: str) -> dict[str, Callable[..., None]]:
    """The functions of a structure by their names."""
    known: dict[str, Any] = {"nan": math.nan, "inf": math.inf, "sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    exec(compile(_guarded(text), "<equations>", "exec"), known)
    return {name: known[name] for name in EQUATIONS}


def _guarded(text: str) -> str:
    """The same text, whose rates are no numbers, as compiled code gives them, where Python would raise.

    The step is then shortened.
    """
    first, *others = text.split("\ndef ")
    parts = ["from __future__ import annotations", first]
    for head, _, body in (other.partition("\n") for other in others):
        parts += [f"def {head}", " try:", *(f" {line}" for line in body.splitlines())]
        parts += [" except (ArithmeticError, ValueError):", "  dy[0] = nan"]
    return "\n".join([*parts, ""])


def _bound(equations: dict[str, Callable[..., None]]) -> Callable[..., Any]:
    """The loop, all of whose functions call these equations."""
    made: dict[Any, Any] = {getattr(arrays, name): function for name, function in equations.items()}
    for module in MODULES:
        names = {name: made.get(value, value) if callable(value) else value for name, value in vars(module).items()}
        for name, value in vars(module).items():
            if isinstance(value, FunctionType) and value.__module__ == module.__name__:
                names[name] = made[value] = FunctionType(value.__code__, names, name)
    return made[loop.go]  # type: ignore[no-any-return]
