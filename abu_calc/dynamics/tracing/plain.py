"""The equations of a scene as plain Python on numbers: for few balls, several times as fast as arrays.

NumPy's calls cost a microsecond whatever they do, and an evaluation for a handful of balls is all calls. The one
right-hand side is traced here as it is for heyoka; what comes out is straight-line code, equal expressions once.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.motion import Array
from abu_calc.dynamics.parameters import Acting, Modes
from abu_calc.dynamics.switching.modes import watched
from abu_calc.dynamics.tracing.traced import Numbers, cached, trace

MOST_BALLS, MOST_NUMBERS = 32, 1000
"""Beyond so many balls, or parameters (sixteen balls that touch), arrays are about as fast, and need not be written."""

LONGEST = 200
"""Characters of an expression before it gets a name: nested too deep, no parser would take it."""


ONE = ("1.0", ())
"""A factor that changes nothing."""


class Node:
    """An expression; arithmetic on it writes on."""

    __slots__ = ("place", "source")

    def __init__(self, source: "Source", place: int) -> None:
        self.source, self.place = source, place

    def __add__(self, other: Any) -> "Node":
        return self.source.enter("+", self, other)

    def __sub__(self, other: Any) -> "Node":
        return self.source.enter("-", self, other)

    def __mul__(self, other: Any) -> "Node":
        return self.source.enter("*", self, other)

    def __rmul__(self, other: Any) -> "Node":
        return self.source.enter("*", other, self)

    def __truediv__(self, other: Any) -> "Node":
        return self.source.enter("/", self, other)

    def __rtruediv__(self, other: Any) -> "Node":
        return self.source.enter("/", other, self)

    def __neg__(self) -> "Node":
        return self.source.enter("-", self)


class _Numbers:
    """Parameters by their places."""

    def __init__(self, source: "Source") -> None:
        self.source = source

    def __getitem__(self, place: int) -> Node:
        return self.source.name(f"p{place}")


class Source:
    """Expressions in the order in which they were made, each once: a name, or a sign with the places of its operands.

    It is to `Symbol` what heyoka is.
    """

    def __init__(self) -> None:
        self.entries: list[tuple[str, tuple[int, ...]]] = []
        self._known: dict[tuple[str, tuple[int, ...]], Node] = {}
        self.par: Any = _Numbers(self)
        self.time = self.name("t")

    def _once(self, entry: tuple[str, tuple[int, ...]]) -> Node:
        if entry not in self._known:
            self._known[entry] = Node(self, len(self.entries))
            self.entries.append(entry)
        return self._known[entry]

    def name(self, name: str) -> Node:
        """What has this name in the code."""
        return self._once((name, ()))

    def expression(self, value: float) -> Node:
        """A constant."""
        return self.name(repr(float(value)))

    def enter(self, sign: str, *operands: Any) -> Node:
        """What comes of an operation on expressions and numbers."""
        nodes = [one if isinstance(one, Node) else self.expression(one) for one in operands]
        if sign == "*" and self.entries[nodes[0].place] == ONE:
            return nodes[1]
        if sign in "*/" and len(nodes) == 2 and self.entries[nodes[1].place] == ONE:
            return nodes[0]
        places = tuple(node.place for node in nodes)
        return self._once((sign, tuple(sorted(places)) if sign == "*" else places))

    def sum(self, terms: Sequence[Node]) -> Node:
        """All of them together."""
        return terms[0] if len(terms) == 1 else self._once(("+", tuple(term.place for term in terms)))

    def sin(self, angle: Node) -> Node:
        """Of an expression."""
        return self.enter("sin", angle)

    def cos(self, angle: Node) -> Node:
        """Of an expression."""
        return self.enter("cos", angle)

    def sqrt(self, value: Node) -> Node:
        """Of an expression."""
        return self.enter("sqrt", value)

    def lines(self, results: Sequence[Node]) -> tuple[list[str], list[str]]:
        """Assignments, and the results by what these name: an expression needed twice, or too long, gets a name."""
        needed = self._needed([node.place for node in results])
        lines: list[str] = []
        texts: dict[int, str] = {}
        for place in sorted(needed):
            sign, operands = self.entries[place]
            text = _text(sign, [texts[one] for one in operands])
            if operands and (needed[place] > 1 or len(text) > LONGEST):
                lines.append(f"v{place} = {text}")
                text = f"v{place}"
            texts[place] = text
        return lines, [texts[node.place] for node in results]

    def operations(self, results: Sequence[Node]) -> int:
        """How many make the results, equal ones counted once."""
        return len(self._needed([node.place for node in results]))

    def _needed(self, results: Sequence[int]) -> dict[int, int]:
        """How often each expression is used to make the results."""
        needed: dict[int, int] = {}
        waiting = list(results)
        while waiting:
            place = waiting.pop()
            if place not in needed:
                waiting += self.entries[place][1]
            needed[place] = needed.get(place, 0) + 1
        return needed


def _text(sign: str, operands: Sequence[str]) -> str:
    if not operands:
        return sign if sign[0] != "-" else f"({sign})"
    if len(operands) == 1:
        return f"(-{operands[0]})" if sign == "-" else f"{sign}({operands[0]})"
    return "(" + f" {sign} ".join(operands) + ")"


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
    """Whether the equations with these parameters are few enough to be written out."""
    return 0 < equations.parameters.balls <= MOST_BALLS and len(values) <= MOST_NUMBERS


def _write(equations: Equations, acting: Acting) -> Maker:
    source, names = Source(), [f"y{k}" for k in range(len(equations.states))]
    traced = trace(equations, acting, source, [source.name(name) for name in names], scaled=False)
    bodies = {
        name: source.lines([symbol.expression() for symbol in symbols])
        for name, symbols in (("rates", traced.rates), ("watched", traced.watched))
    }
    text = ["def make(numbers):", f" [{', '.join(f'p{k}' for k in range(traced.tape.used))}] = values(numbers)"]
    for name, (lines, results) in bodies.items():
        text += [f" def {name}(t, y):", "  try:", "   t = float(t)", f"   [{', '.join(names)}] = y.tolist()"]
        text += [f"   {line}" for line in lines] + [f"   return [{', '.join(results)}]"]
        # Plain Python refuses what arrays answer with a number that is none; the integrator looks for those.
        text += ["  except (ArithmeticError, ValueError):", f"   return [nan] * {len(results)}"]
    scope: dict[str, Any] = {
        "sin": math.sin,
        "cos": math.cos,
        "sqrt": math.sqrt,
        "nan": math.nan,
        "values": traced.tape.values(),
    }
    exec(compile("\n".join([*text, " return rates, watched"]), "<equations>", "exec"), scope)
    return cast(Maker, scope["make"])
