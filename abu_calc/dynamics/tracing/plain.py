"""The equations of a scene as plain Python on numbers: for few balls, several times as fast as arrays.

NumPy's calls cost a microsecond whatever they do, and an evaluation for a handful of balls is all calls. The one
right-hand side is traced; the result is straight-line code, equal expressions once. SciPy's methods run on it.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.motion import Array
from abu_calc.dynamics.parameters import Acting, Modes
from abu_calc.dynamics.switching.modes import watched
from abu_calc.dynamics.tracing.graph import Graph
from abu_calc.dynamics.tracing.traced import Numbers, cached, trace

MOST_BALLS, MOST_NUMBERS = 32, 1000
"""Beyond so many balls, or parameters (sixteen balls that touch), arrays are about as fast, and need not be written."""

Function = Callable[[float, Array], Any]
"""(t, y) to as many numbers."""


Maker = Callable[[Sequence[float]], tuple[Function, Function]]

_makers: dict[Any, Maker] = {}


def functions(equations: Equations, numbers: Numbers, modes: Modes) -> tuple[Function, Function]:
    """y'(t, y) and the watched numbers in these modes, plain where that is faster."""
    acting, (structure, values) = equations.in_mode(modes), numbers.of(modes)
    if not handful(equations, values):
        return lambda t, y: equations.rhs(np, t, y, acting), lambda t, y: watched(t, y, acting)
    return cached(_makers, structure, lambda: _write(equations, acting))(values)


def handful(equations: Equations, values: Sequence[float]) -> bool:
    """True if the equations with these parameters are few enough to be written out."""
    return 0 < equations.parameters.balls <= MOST_BALLS and len(values) <= MOST_NUMBERS


def _write(equations: Equations, acting: Acting) -> Maker:
    graph = Graph("p{}")
    names = [f"y{k}" for k in range(len(equations.states))]
    traced = trace(equations, acting, graph)
    bodies = {
        name: graph.lines([symbol.expression() for symbol in symbols])
        for name, symbols in (("rates", traced.rates), ("watched", traced.watched))
    }
    numbers, lines, slots = graph.setup()
    text = ["def make(numbers):", f" [{', '.join(numbers)}] = numbers", *(f" {line}" for line in lines)]
    text += [f" {graph.slot.format(k)} = {slot}" for k, slot in enumerate(slots)]
    for name, (lines, results) in bodies.items():
        text += [f" def {name}(t, y):", "  try:", "   t = float(t)", f"   [{', '.join(names)}] = y.tolist()"]
        text += [f"   {line}" for line in lines] + [f"   return [{', '.join(results)}]"]
        # Plain Python refuses what arrays answer with a number that is none; the integrator looks for those.
        text += ["  except (ArithmeticError, ValueError):", f"   return [nan] * {len(results)}"]
    scope: dict[str, Any] = {"sin": math.sin, "cos": math.cos, "sqrt": math.sqrt, "nan": math.nan, "inf": math.inf}
    exec(compile("\n".join([*text, " return rates, watched"]), "<equations>", "exec"), scope)
    return cast(Maker, scope["make"])
