"""Trace of the equations of a scene as straight-line code, and plain Python on numbers made of it.

One trace serves all scenes of one structure and all their modes. The structure decides how the code looks: number of
balls, kind of support, effects, zero elements of matrices. All other numbers are parameters of the code. Equal
expressions stand in the code once.

SciPy's methods run on the plain Python. NumPy's calls cost a microsecond whatever they do, and an evaluation for a
handful of balls is all calls. For few balls plain Python is several times as fast as arrays.
"""

import copy
import math
from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any, TypeVar, cast

import numpy as np

from abu_calc.dynamics.codegen.graph import AnyArray, Functions, Graph, Symbol
from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.parameters import Acting, Modes, Parameters
from abu_calc.dynamics.switching.modes import watched, watches
from abu_calc.foundation.frozen import dataclass

MOST_KEPT = 32
"""Structures whose code this process holds at most."""

ZEROS: dict[str, int | None] = {"effects": 0, "modes": None}
"""Zeros of how many dimensions are structure: plain numbers of effects, which decide by them whether they act at all;
elsewhere those of matrices, which tell how the support is built."""


@dataclass(frozen=True)
class Traced:
    """Rates of the states and watched numbers as symbols."""

    rates: tuple[Symbol, ...]
    watched: tuple[Symbol, ...]


def trace(equations: Equations, acting: Acting, graph: Graph) -> Traced:
    """The equations in these modes as expressions of a graph, over t and y0, y1, …

    The graph's parameters are the numbers that `Numbers` finds, in its order.
    """
    symbolic, t, y = symbols(equations, acting, graph)
    rates = equations.rhs(Functions, t, y, symbolic)
    numbers = watched(t, y, symbolic, Functions) if watches(equations) else ()
    zero = Symbol(graph, [])
    return Traced(*(tuple(value + zero for value in values) for values in (rates, numbers)))


def symbols(equations: Equations, acting: Acting, graph: Graph) -> tuple[Acting, Any, AnyArray]:
    """The numbers of a scene as parameters of a graph, time and states."""
    symbolic = mapped(acting, lambda _, nonzero: graph.parameter(nonzero), lambda _: None)
    y = np.array([graph.variable(f"y{k}") for k in range(len(equations.states))])
    return symbolic, graph.variable("t"), y


class Numbers:
    """Structure that decides the code of a scene, and the numbers that it is run with, as modes change."""

    def __init__(self, equations: Equations) -> None:
        self._structure: list[Any] = [equations.rhs, len(equations.states), watches(equations)]
        self._numbers: list[float] = []
        mapped(equations.in_mode(()), lambda value, _: self._numbers.append(value), self._structure.append)

    def of(self, modes: Modes) -> tuple[tuple[Any, ...], list[float]]:
        """Structure and numbers in these modes, which come last among the parameters."""
        structure, numbers = self._structure.copy(), self._numbers.copy()
        for mode in modes:
            _flattened(mode, numbers, structure)
        return tuple(structure), numbers


def _flattened(mode: Any, numbers: list[float], structure: list[Any]) -> None:
    """Numbers and structure of a mode in the order of `mapped`; thousands of times in a run, so without its detours.

    A mode's numbers may all be anything, and what is not a number is compared as it stands.
    """
    if isinstance(mode, float):
        structure.append(float)
        numbers.append(mode)
    elif isinstance(mode, np.ndarray):
        structure.append(mode.shape)
        numbers.extend(mode.ravel().tolist())
    elif is_dataclass(mode) and not isinstance(mode, type):
        structure.append(type(mode))
        for part in fields(mode):
            _flattened(getattr(mode, part.name), numbers, structure)
    else:
        structure.append(mode)


@lru_cache(maxsize=8)
def numbers_of(equations: Equations) -> Numbers:
    """Numbers of equations that are integrated several times at different tolerances."""
    return Numbers(equations)


Code = TypeVar("Code")


def cached(cache: dict[Any, Code], structure: Any, make: Callable[[], Code]) -> Code:
    """The code for a structure, made unless the cache has it already."""
    if structure not in cache:
        if len(cache) >= MOST_KEPT:
            cache.pop(next(iter(cache)))
        cache[structure] = make()
    return cache[structure]


def mapped(
    value: Any, number: Callable[[float, bool], Any], fixed: Callable[[Any], None], zeros: int | None = 2
) -> Any:
    """The same with each number replaced by what `number` makes of it, and whether it is known not to be zero.

    `fixed` gets all else in it, in order.
    """
    if isinstance(value, float):
        if value == 0 and zeros == 0:
            fixed(0.0)
            return value
        fixed(float)
        return number(value, zeros == 0)
    if isinstance(value, np.ndarray):
        same = value == 0 if value.ndim == zeros else np.full(value.shape, value.dtype.kind != "f")
        fixed((value.shape, same.tobytes(), value[same].tobytes()))
        entries = value.astype(object)
        entries[~same] = [number(entry, False) for entry in value[~same].tolist()]
        return value if same.all() else entries
    if is_dataclass(value) and not isinstance(value, type):
        fixed(type(value))
        changed = copy.copy(value)
        for part in fields(value):  # past checks of values, which symbols would not stand
            of = ZEROS.get(part.name, zeros) if isinstance(value, Parameters | Acting) else zeros
            object.__setattr__(changed, part.name, mapped(getattr(value, part.name), number, fixed, of))
        return changed
    if isinstance(value, tuple):
        fixed(len(value))
        return tuple(mapped(element, number, fixed, zeros) for element in value)
    fixed(value)
    return value


MOST_BALLS, MOST_NUMBERS = 32, 1000
"""Beyond so many balls, or parameters (sixteen balls that touch), arrays are about as fast, and need not be written."""

Function = Callable[[float, AnyArray], Any]
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
