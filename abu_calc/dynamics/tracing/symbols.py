"""Symbols that stand for states and parameters while the equations are traced for heyoka.

A symbol is a sum Σ cₖ eₖ: each c a number made of parameters alone, each e an expression of states and time, or 1.
So what is made of parameters alone is computed once per run and not in every step; sums stay flat; signs and factors
collect in the coefficients. A composed right-hand side then costs nearly what one written by hand does.
"""

import math
import operator
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np

from abu_calc.dynamics.motion import Array

SIGNS = {operator.add: "+", operator.mul: "*", operator.truediv: "/"}
"""Operations on numbers, as Python writes them."""


class Tape:
    """Numbers that depend on parameters alone: parameters (None), constants, and operations on earlier entries.

    `library` is heyoka, handed in since it is optional.
    """

    def __init__(self, library: Any) -> None:
        self.library = library
        self.entries: list[Any] = []
        self._known: dict[Any, int] = {}
        self._slots: dict[int, int] = {}
        self._products: dict[tuple[int, int], tuple[Any, Any, Any]] = {}
        self.one = self.constant(1.0)

    def _enter(self, entry: Any) -> int:
        self.entries.append(entry)
        return len(self.entries) - 1

    def constant(self, value: float) -> int:
        """Where a constant stands."""
        return self._known[value] if value in self._known else self._known.setdefault(value, self._enter(value))

    def parameter(self, nonzero: bool = False) -> "Symbol":
        """The next parameter; `nonzero` where the code is for such values alone."""
        return Symbol(self, [(self._enter(None), None)], nonzero)

    def variable(self, expression: Any) -> "Symbol":
        """A state, or time."""
        return Symbol(self, [(self.one, expression)])

    def apply(self, operation: Callable[[Any, Any], Any], a: int, b: int) -> int:
        """Where the outcome of an operation stands, entered unless it is there or is one of its operands."""
        left, right = self.entries[a], self.entries[b]
        if isinstance(left, float) and isinstance(right, float):
            return self.constant(operation(left, right))
        if operation is operator.mul and 0.0 in (left, right):
            return self.constant(0.0)
        neutral = 0.0 if operation is operator.add else 1.0
        if right == neutral:
            return a
        if left == neutral and operation is not operator.truediv:
            return b
        key = (operation, a, b) if operation is operator.truediv else (operation, *sorted((a, b)))
        return self._known[key] if key in self._known else self._known.setdefault(key, self._enter(key))

    def values(self) -> "Callable[[Sequence[float]], list[float]]":
        """The function from parameters, in the order in which these were made, to heyoka's par[i].

        As plain Python, for it runs whenever a mode changes. To be asked for when all expressions are made.
        """
        named, lines, results = self.lines()
        text = ["def values(numbers):", f" [{', '.join(named)}] = numbers", *(f" {line}" for line in lines)]
        scope: dict[str, Any] = {"inf": math.inf}
        exec(compile("\n".join([*text, f" return [{', '.join(results)}]"]), "<parameters>", "exec"), scope)
        return cast("Callable[[Sequence[float]], list[float]]", scope["values"])

    def lines(self) -> tuple[list[str], list[str], list[str]]:
        """Names for the parameters, assignments, and the results, heyoka's par[i], by what these name."""
        named = [f"n{k}" for k, entry in enumerate(self.entries) if entry is None]
        texts, lines = {}, []
        for place, entry in enumerate(self.entries):
            texts[place] = f"n{place}" if entry is None else f"v{place}" if isinstance(entry, tuple) else repr(entry)
            if isinstance(entry, tuple):
                operation, a, b = entry
                lines.append(f"{texts[place]} = {texts[a]} {SIGNS[operation]} {texts[b]}")
        return named, lines, [texts[place] for place in self._slots]

    @property
    def used(self) -> int:
        """How many of them there are, as far as expressions have asked for them."""
        return len(self._slots)

    @property
    def products(self) -> int:
        """How many products of expressions there are: how much work the equations are."""
        return len(self._products)

    def product(self, a: Any, b: Any) -> Any:
        """a · b, the same expression whichever comes first."""
        key = (min(id(a), id(b)), max(id(a), id(b)))
        # References to the factors, so that no other object takes their ids.
        return self._products.setdefault(key, (a, b, a * b))[2]

    def times(self, place: int, expression: Any) -> Any:
        """A number of the tape times an expression, for heyoka."""
        entry = self.entries[place]
        if isinstance(entry, float):
            return self.library.expression(entry) if expression is None else entry * expression
        par = self.library.par[self._slots.setdefault(place, len(self._slots))]
        return par if expression is None else par * expression


class Symbol:
    """Σ cₖ eₖ; arithmetic with symbols, numbers and, through numpy, arrays of both."""

    __slots__ = ("_whole", "nonzero", "tape", "terms")

    def __init__(self, tape: Tape, terms: list[tuple[int, Any]], nonzero: bool = False) -> None:
        self.tape, self.terms, self.nonzero = tape, terms, nonzero
        self._whole: Any = None

    def expression(self) -> Any:
        """As an expression of heyoka's."""
        if self._whole is None:
            total, negative = self.tape.library.sum, self.tape.constant(-1.0)
            minus = [e for c, e in self.terms if c == negative and e is not None]
            plus = [self.tape.times(c, e) for c, e in self.terms if c != negative or e is None]
            if minus:
                self._whole = total(plus) - total(minus) if plus else -total(minus)
            else:
                self._whole = total(plus or [self.tape.library.expression(0.0)])
        return self._whole

    def _single(self) -> tuple[int, Any]:
        """As one term."""
        return self.terms[0] if len(self.terms) == 1 else (self.tape.one, self.expression())

    def _other(self, value: Any) -> "Symbol | None":
        if isinstance(value, Symbol):
            return value
        if isinstance(value, int | float | np.generic):
            place = self.tape.constant(float(value))
            return Symbol(self.tape, [(place, None)] if value else [])
        return None

    def __add__(self, other: Any) -> Any:
        more = self._other(other)
        if more is None:
            return NotImplemented
        terms = [term for term in (*self.terms, *more.terms) if term[1] is not None]
        numbers = [c for c, e in (*self.terms, *more.terms) if e is None]
        if numbers:
            total = numbers[0] if len(numbers) == 1 else self.tape.apply(operator.add, *numbers)
            terms.append((total, None))
        return Symbol(self.tape, terms)

    def __neg__(self) -> "Symbol":
        negative = self.tape.constant(-1.0)
        return Symbol(self.tape, [(self.tape.apply(operator.mul, c, negative), e) for c, e in self.terms])

    def __pos__(self) -> "Symbol":
        """The same as one expression: what it is multiplied with does not take its coefficient anew each time."""
        return Symbol(self.tape, [(self.tape.one, self.expression())])

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
            return Symbol(self.tape, [])
        (a, e), (b, f) = self._single(), more._single()
        base = f if e is None else e if f is None else self.tape.product(e, f)
        place = self.tape.apply(operator.mul, a, b)
        return Symbol(self.tape, [(place, base)] if self.tape.entries[place] != 0.0 else [])

    def __truediv__(self, other: Any) -> Any:
        more = self._other(other)
        if more is None:
            return NotImplemented
        if not self.terms:
            return self
        (a, e), (b, f) = self._single(), more._single()
        base = e if f is None else (1.0 if e is None else e) / f
        return Symbol(self.tape, [(self.tape.apply(operator.truediv, a, b), base)])

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


class Functions:
    """The functions that right-hand sides may use."""

    @staticmethod
    def sin(angle: Any) -> Any:
        """Of a symbol, or of an array of them."""
        return _each("sin", angle)

    @staticmethod
    def cos(angle: Any) -> Any:
        """Likewise."""
        return _each("cos", angle)

    @staticmethod
    def sqrt(value: Any) -> Any:
        """Likewise."""
        return _each("sqrt", value)


def _each(name: str, angle: Any) -> Any:
    if not isinstance(angle, Symbol):
        values: Array = np.array([_each(name, value) for value in angle], dtype=object)
        return values
    return angle.tape.variable(getattr(angle.tape.library, name)(angle.expression()))
