"""Graph of all expressions of the equations, recorded while the one right-hand side runs on symbols.

Every expression stands in the graph once. Those of parameters alone are worked out once for each mode (`setup`); the
code of the equations finds them by their slots.

A symbol is a sum Σ cₖ eₖ: each c an expression of parameters alone, each e one of states and time, or 1. Sums multiply
as two single terms, so that coefficients of a state meet and become one parameter of the code.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
