"""The same loop without a compiler: its text and the equations' are plain Python, run here as they stand.

Arrays are memory views, whose parts are views too and whose numbers are Python's own: half as slow as NumPy's.
"""

import ast
import math
from collections.abc import Callable, Sequence
from copy import copy
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from abu_calc.dynamics.integrators.compiled import arrays, contact, decide, friction, impact, locate, loop, method
from abu_calc.dynamics.integrators.compiled.program import EQUATIONS, Program
from abu_calc.dynamics.integrators.compiled.spared import FOLDED, spared

MODULES: Sequence[ModuleType] = (method, locate, friction, contact, impact, decide, loop)
"""In the order in which they import each other."""

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
        self._count = program.parameters
        tree = ast.parse(program.text)
        self._parts = {one.name: one for one in tree.body if isinstance(one, ast.FunctionDef)}
        self._whole = _compiled([self._parts[name] for name in EQUATIONS])
        self._seen: dict[Any, int] = {}
        self._made: dict[Any, tuple[Any, ...]] = {}

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
        found = _compiled([spared(self._parts[name], known) for name in SPARED])
        self._made[zeros] = tuple(found[name] for name in SPARED)
        return self._made[zeros]


def _compiled(functions: Sequence[ast.FunctionDef]) -> dict[str, Callable[..., None]]:
    """The functions of a structure by their names; their annotations are those of a compiler."""
    known: dict[str, Any] = {"nan": math.nan, "inf": math.inf, "sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    guarded = [_guarded(one) for one in functions]
    exec(compile(ast.fix_missing_locations(ast.Module(guarded, [])), "<equations>", "exec"), known)
    return {one.name: known[one.name] for one in functions}


def _guarded(function: ast.FunctionDef) -> ast.stmt:
    """The same, whose rates are no numbers, as compiled code gives them, where Python would raise.

    The step is then shortened.
    """
    rates = any(one.arg == "dy" for one in function.args.args)
    (guard,) = ast.parse(f"try: pass\nexcept (ArithmeticError, ValueError): {'dy[0] = nan' if rates else 'raise'}").body
    assert isinstance(guard, ast.Try)
    guard.body = function.body
    found = copy(function)
    arguments = [ast.arg(one.arg) for one in function.args.args]
    found.args = ast.arguments(posonlyargs=[], args=arguments, kwonlyargs=[], kw_defaults=[], defaults=[])
    found.body, found.returns = [guard], None
    return found


def _bound(equations: dict[str, Callable[..., None]]) -> Callable[..., Any]:
    """The loop, all of whose functions call these equations."""
    made: dict[Any, Any] = {getattr(arrays, name): function for name, function in equations.items()}
    for module in MODULES:
        names = {name: made.get(value, value) if callable(value) else value for name, value in vars(module).items()}
        for name, value in vars(module).items():
            if isinstance(value, FunctionType) and value.__module__ == module.__name__:
                names[name] = made[value] = FunctionType(value.__code__, names, name)
    return made[loop.go]  # type: ignore[no-any-return]
