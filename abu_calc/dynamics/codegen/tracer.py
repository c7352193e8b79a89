"""Trace of the equations of a scene as straight-line code, and plain Python on numbers made of it.

One trace serves all scenes of one structure and all their modes. The structure decides how the code looks: number of
balls, kind of support, effects, zero elements of matrices. All other numbers are parameters of the code. Equal
expressions stand in the code once.

SciPy's methods run on the plain Python. NumPy's calls cost a microsecond whatever they do, and an evaluation for a
handful of balls is all calls. For few balls plain Python is several times as fast as arrays.

Graph of all expressions of the equations, recorded while the one right-hand side runs on symbols.

Every expression stands in the graph once. Those of parameters alone are worked out once for each mode (`setup`); the
code of the equations finds them by their slots.

A symbol is a sum Σ cₖ eₖ: each c an expression of parameters alone, each e one of states and time, or 1. Sums multiply
as two single terms, so that coefficients of a state meet and become one parameter of the code.
"""

import copy
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.rotor import Acting, Modes, Parameters
from abu_calc.dynamics.switching.modes import watched, watches
from abu_calc.foundation.frozen import dataclass

AnyArray = NDArray[Any]

Entry = tuple[str, tuple[int, ...]]
"""A name or a number without operands, or a sign or function with the places of its operands."""

LONGEST = 200
"""Characters of an expression before it gets a name: nested too deep, no parser would take it."""

FOLDED: Mapping[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
}


class Graph:
    """Expressions by their places, in the order in which they were made; operands stand before what they make.

    `slot`: how the code of the equations writes the k-th expression of parameters that it uses.
    """

    def __init__(self, slot: str = "par[{}]") -> None:
        self.slot = slot
        self.entries: list[Entry] = []
        self.fixed: list[bool] = []
        """True for each expression that is made of parameters and numbers alone."""
        self._places: dict[Entry, int] = {}
        self._constants: dict[int, float] = {}
        self._parameters: list[str] = []
        self._slots: dict[int, int] = {}
        self.one, self.minus_one = self.constant(1.0), self.constant(-1.0)

    def _once(self, entry: Entry, fixed: bool) -> int:
        place = self._places.get(entry)
        if place is None:
            place = self._places[entry] = len(self.entries)
            self.entries.append(entry)
            self.fixed.append(fixed)
        return place

    def constant(self, value: float) -> int:
        """The place of a number."""
        value = float(value) + 0.0  # −0 is 0
        place = self._once((repr(value), ()), True)
        self._constants[place] = value
        return place

    def number(self, place: int) -> float | None:
        """The number at a place; None where there is another expression."""
        return self._constants.get(place)

    def parameter(self, nonzero: bool = False) -> "Symbol":
        """The next parameter; `nonzero` where the code is for such values alone."""
        name = f"n{len(self._parameters)}"
        self._parameters.append(name)
        return Symbol(self, [(self._once((name, ()), True), None)], nonzero)

    def variable(self, name: str) -> "Symbol":
        """A state, or time, by its name in the code."""
        return Symbol(self, [(self.one, self._once((name, ()), False))])

    def enter(self, sign: str, *operands: int) -> int:
        """The place of an operation's result; factors and divisors of 1 change nothing."""
        if sign == "*" and operands[0] == self.one:
            return operands[1]
        if sign in "*/" and operands[1] == self.one:
            return operands[0]
        ordered = tuple(sorted(operands)) if sign == "*" else operands
        return self._once((sign, ordered), all(self.fixed[place] for place in operands))

    def apply(self, sign: str, a: int, b: int) -> int:
        """Sum, product or quotient of two expressions of parameters; of two numbers, or with 0 or 1, it is simpler."""
        left, right = self.number(a), self.number(b)
        if left is not None and right is not None:
            return self.constant(FOLDED[sign](left, right))
        if sign == "*" and 0.0 in (left, right):
            return self.constant(0.0)
        neutral = 0.0 if sign == "+" else 1.0
        if right == neutral:
            return a
        if left == neutral and sign != "/":
            return b
        return self._once((sign, (a, b) if sign == "/" else (min(a, b), max(a, b))), True)

    def total(self, terms: Sequence[int]) -> int:
        """The sum of all terms, in their order."""
        if len(terms) == 1:
            return terms[0]
        return self._once(("+", tuple(terms)), all(self.fixed[place] for place in terms))

    def lines(self, results: Sequence[int]) -> tuple[list[str], list[str]]:
        """Assignments, and the results by what these name: an expression needed twice, or too long, gets a name."""
        return self._lines(results, slots=True)

    def setup(self) -> tuple[list[str], list[str], list[str]]:
        """Names of all parameters, assignments, and the contents of the slots: once all code is written."""
        lines, results = self._lines(list(self._slots), slots=False)
        return self._parameters, lines, results

    def operations(self, results: Sequence[int], most: float = math.inf) -> int:
        """The number of expressions that make the results, equal ones counted once; no more are counted than `most`."""
        counted, left = set[int](), list(results)
        while left and len(counted) <= most:
            place = left.pop()
            if place not in counted:
                counted.add(place)
                left += () if self._in_slot(place) else self.entries[place][1]
        return len(counted)

    def _lines(self, results: Sequence[int], slots: bool) -> tuple[list[str], list[str]]:
        """The code that makes the results; where `slots`, it takes expressions of parameters from their slots."""
        needed = self._needed(results, slots)
        lines: list[str] = []
        texts: dict[int, str] = {}
        for place in sorted(needed):
            sign, operands = self.entries[place]
            if slots and self._in_slot(place):
                text = self.slot.format(self._slots.setdefault(place, len(self._slots)))
            else:
                text = _text(sign, [texts[operand] for operand in operands])
                if operands and (needed[place] > 1 or len(text) > LONGEST):
                    lines.append(f"v{place} = {text}")
                    text = f"v{place}"
            texts[place] = text
        return lines, [texts[place] for place in results]

    def _needed(self, results: Sequence[int], slots: bool) -> dict[int, int]:
        """Number of times that each expression is used to make the results."""
        needed: dict[int, int] = {}
        left = list(results)
        while left:
            place = left.pop()
            if place not in needed and not (slots and self._in_slot(place)):
                left += self.entries[place][1]
            needed[place] = needed.get(place, 0) + 1
        return needed

    def _in_slot(self, place: int) -> bool:
        """True if the code takes an expression from a slot: it is made of parameters, and no mere number."""
        return self.fixed[place] and place not in self._constants


def _text(sign: str, operands: Sequence[str]) -> str:
    if not operands:
        return sign if sign[0] != "-" else f"({sign})"
    if len(operands) == 1:
        return f"(-{operands[0]})" if sign == "-" else f"{sign}({operands[0]})"
    return "(" + f" {sign} ".join(operands) + ")"


class Symbol:
    """Σ cₖ eₖ; arithmetic with symbols, numbers and, through NumPy, arrays of both.

    `terms`: places of c and e in the graph, None for e = 1.
    """

    __slots__ = ("_whole", "graph", "nonzero", "terms")

    def __init__(self, graph: Graph, terms: list[tuple[int, int | None]], nonzero: bool = False) -> None:
        self.graph, self.terms, self.nonzero = graph, terms, nonzero
        self._whole: int | None = None

    def expression(self) -> int:
        """The place of the whole sum."""
        if self._whole is None:
            graph = self.graph
            minus = [e for c, e in self.terms if c == graph.minus_one and e is not None]
            plus = [_product(graph, c, e) for c, e in self.terms if c != graph.minus_one or e is None]
            if minus and plus:
                self._whole = graph.enter("-", graph.total(plus), graph.total(minus))
            elif minus:
                self._whole = graph.enter("-", graph.total(minus))
            else:
                self._whole = graph.total(plus or [graph.constant(0.0)])
        return self._whole

    def _single(self) -> tuple[int, int | None]:
        """The sum as one term."""
        return self.terms[0] if len(self.terms) == 1 else (self.graph.one, self.expression())

    def _other(self, value: Any) -> "Symbol | None":
        if isinstance(value, Symbol):
            return value
        if isinstance(value, int | float | np.generic):
            return Symbol(self.graph, [(self.graph.constant(float(value)), None)] if value else [])
        return None

    def __add__(self, other: Any) -> Any:
        more = self._other(other)
        if more is None:
            return NotImplemented
        terms = [term for term in (*self.terms, *more.terms) if term[1] is not None]
        numbers = [c for c, e in (*self.terms, *more.terms) if e is None]
        if numbers:
            total = numbers[0] if len(numbers) == 1 else self.graph.apply("+", *numbers)
            terms.append((total, None))
        return Symbol(self.graph, terms)

    def __neg__(self) -> "Symbol":
        graph = self.graph
        return Symbol(graph, [(graph.apply("*", c, graph.minus_one), e) for c, e in self.terms])

    def __pos__(self) -> "Symbol":
        """The same as one expression: what it is multiplied with does not take its coefficient anew each time."""
        return Symbol(self.graph, [(self.graph.one, self.expression())])

    def __sub__(self, other: Any) -> Any:
        more = self._other(other)
        return NotImplemented if more is None else self + -more

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        more = self._other(other)
        if more is None:
            return NotImplemented
        if not self.terms or not more.terms:
            return Symbol(self.graph, [])
        (a, e), (b, f) = self._single(), more._single()
        base = f if e is None else e if f is None else self.graph.enter("*", e, f)
        place = self.graph.apply("*", a, b)
        return Symbol(self.graph, [(place, base)] if self.graph.number(place) != 0.0 else [])

    def __truediv__(self, other: Any) -> Any:
        more = self._other(other)
        if more is None:
            return NotImplemented
        if not self.terms:
            return self
        (a, e), (b, f) = self._single(), more._single()
        base = e if f is None else self.graph.enter("/", self.graph.one if e is None else e, f)
        return Symbol(self.graph, [(self.graph.apply("/", a, b), base)])

    def __rtruediv__(self, other: Any) -> Any:
        more = self._other(other)
        return NotImplemented if more is None else more / self

    def __pow__(self, power: int) -> Any:
        if power != 2:
            raise TypeError("the equations know no power but the square")
        return self * self

    __radd__, __rmul__ = __add__, __mul__

    def __bool__(self) -> bool:
        if self.nonzero:
            return True
        raise TypeError("the equations must not decide by values")


def _product(graph: Graph, coefficient: int, expression: int | None) -> int:
    return coefficient if expression is None else graph.enter("*", coefficient, expression)


class Functions:
    """The functions that right-hand sides may use, of a symbol or of an array of them."""

    @staticmethod
    def sin(angle: Any) -> Any:
        """Sine."""
        return _each("sin", angle)

    @staticmethod
    def cos(angle: Any) -> Any:
        """Cosine."""
        return _each("cos", angle)

    @staticmethod
    def sqrt(value: Any) -> Any:
        """Square root."""
        return _each("sqrt", value)


def _each(name: str, value: Any) -> Any:
    if not isinstance(value, Symbol):
        values: AnyArray = np.array([_each(name, element) for element in value], dtype=object)
        return values
    graph = value.graph
    return Symbol(graph, [(graph.one, graph.enter(name, value.expression()))])


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
