"""Expressions of the equations: each once, those of parameters worked out apart, arithmetic as numbers have it."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.codegen.tracer import Functions, Graph, Symbol


def value_of(expression: Callable[..., Any], *values: float, parameters: tuple[float, ...] = ()) -> float:
    """What the code of an expression of states gives, its slots filled from the parameters."""
    graph = Graph("p{}")
    known = [graph.parameter() for _ in parameters]
    states = [graph.variable(f"y{k}") for k in range(len(values))]
    whole: Symbol = expression(*states, *known) + Symbol(graph, [])
    lines, results = graph.lines([whole.expression()])
    names, setup, slots = graph.setup()
    scope: dict[str, Any] = {"sin": math.sin, "cos": math.cos, "sqrt": math.sqrt, "inf": math.inf}
    scope |= {f"y{k}": value for k, value in enumerate(values)} | dict(zip(names, parameters, strict=True))
    code = [*setup, *(f"p{k} = {text}" for k, text in enumerate(slots)), *lines, f"result = {results[0]}"]
    exec("\n".join(code), scope)
    return float(scope["result"])


@pytest.mark.parametrize(
    "expression",
    [
        lambda y, z, a, b: 3.0 - y,
        lambda y, z, a, b: a * y + b * y - a * z,
        lambda y, z, a, b: (2 - (1 + y - y)) / (1 / y),
        lambda y, z, a, b: -np.float64(2.0) * y**2 / 2,
        lambda y, z, a, b: -(y - 0.5) - (0.5 - z) * 0.5,
        lambda y, z, a, b: (a + b) * (y - z) / (a * y),
        lambda y, z, a, b: +(a * y + z) * (b - 1.0) * 0.0 + y,
        lambda y, z, a, b: -a * -y - b,
    ],
)
def test_symbols_are_arithmetic(expression: Callable[..., Any]) -> None:
    given = 0.7, -1.3, 2.5, 0.4
    assert value_of(expression, *given[:2], parameters=given[2:]) == pytest.approx(expression(*given), rel=1e-14)


def test_functions_take_symbols_and_arrays_of_them() -> None:
    def length(y: Any, z: Any, a: Any) -> Any:
        return Functions.sqrt(Functions.sin(np.array([y, z])) @ np.array([a, a])) * Functions.cos(y)

    expected = math.sqrt(1.5 * (math.sin(0.3) + math.sin(0.8))) * math.cos(0.3)
    assert value_of(length, 0.3, 0.8, parameters=(1.5,)) == pytest.approx(expected, rel=1e-14)


def test_equal_expressions_stand_once() -> None:
    graph = Graph()
    x, y = graph.variable("x"), graph.variable("y")
    product = (x * y).expression()
    assert product == (y * x).expression()
    both = Functions.sin(x * y) + Functions.cos(y * x)
    lines, results = graph.lines([both.expression(), (-(x / y)).expression()])
    assert lines == [f"v{product} = (x * y)"]
    assert results == [f"(sin(v{product}) + cos(v{product}))", "(-(x / y))"]


def test_parameters_are_worked_out_once_for_each_mode() -> None:
    """Products, quotients, sums and functions of parameters alone leave one slot for the code of the equations."""
    graph = Graph()
    a, b, y = graph.parameter(), graph.parameter(), graph.variable("y")
    whole = (a * b / 2.0) * y * Functions.sqrt(a + b)
    lines, results = graph.lines([whole.expression()])
    _, setup, slots = graph.setup()
    assert not any("sqrt" in text for text in (*lines, *results)) and any("sqrt" in text for text in (*setup, *slots))
    assert graph.operations([whole.expression()]) == len(slots) + 1 + len(slots)


def test_decisions_by_values_are_refused() -> None:
    """A right-hand side that asks for the sign of a state cannot be code; a silent branch would be wrong."""
    graph = Graph()
    with pytest.raises(TypeError, match="decide"):
        bool(graph.variable("y"))
    assert graph.parameter(nonzero=True)
