"""The equations as plain Python against the same in arrays: every support and effect, in the modes of random states.

Expressions of the equations: each once, those of parameters worked out apart, arithmetic as numbers have it.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.codegen import tracer as plain
from abu_calc.dynamics.codegen.tracer import Functions, Graph, Numbers, Symbol
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.rotor import Modes
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.switching.modes import settled, watched, watches
from abu_calc.foundation.errors import NotTrustworthyError
from tests.dynamics.effects.test_contract import taken
from tests.dynamics.examples import EXAMPLES
from tests.dynamics.random_scenes import random_scene
from tests.dynamics.scenes import ROTORS, SUPPORTS, scene_on, straight_grinder

ROUNDING = 1e-11
"""Relative to the largest part of the answer: sums are taken in another order."""


def both(equations: Equations, modes: Modes, t: float, y: np.ndarray) -> None:
    """Rates and watched numbers, plain and by arrays."""
    acting = equations.in_mode(modes)
    rates, numbers = plain.functions(equations, Numbers(equations), modes)
    expected = equations.rhs(np, t, y, acting) / equations.scales
    np.testing.assert_allclose(rates(t, y) / np.array(equations.scales), expected, 1e-9, ROUNDING * np.ptp(expected))
    if watches(equations):
        values = np.array(watched(t, y, acting))
        np.testing.assert_allclose(numbers(t, y), values, 1e-9, ROUNDING * np.abs(values).max())


def everywhere(scene: Scene, count: int = 5) -> None:
    """At random states about the start, where the effects can settle on modes."""
    equations, rng = assemble(scene), np.random.default_rng(3)
    for _ in range(count):
        t = float(rng.uniform(0, scene.revolution))
        y = np.array(equations.initial) + 0.1 * rng.normal(size=len(equations.states)) * np.array(equations.scales)
        try:
            y, modes = settled(equations, t, y, equations.first_modes)
        except NotTrustworthyError:  # balls anywhere may overlap
            modes = equations.first_modes
        both(equations, modes, t, y)


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("way", ROTORS)
def test_every_support_and_rotor(support, way):
    everywhere(scene_on(support, *ROTORS[way]))


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("name", EXAMPLES)
def test_every_effect(support, name):
    scene = taken(support, name)
    if scene is None:
        pytest.skip("such a support has no such effect")
    everywhere(scene)


@pytest.mark.parametrize("seed", range(0, 60, 3))
def test_random_scenes(seed):
    everywhere(random_scene(seed), 2)


def test_written_once_for_all_designs_of_a_structure(monkeypatch):
    plain._makers.clear()
    written = []
    write = plain._write
    monkeypatch.setattr(plain, "_write", lambda *parts: written.append(1) or write(*parts))
    scene = straight_grinder()
    for speed in (400.0, 500.0):
        everywhere(replace(scene, speed=speed), 2)
    assert len(written) == 1


def test_what_is_no_number_is_told_as_one():
    """Plain Python would raise where arrays go on with NaN."""
    equations = assemble(straight_grinder())
    rates, _ = plain.functions(equations, Numbers(equations), equations.first_modes)
    y = np.array(equations.initial)
    y[4] = math.inf
    assert all(math.isnan(value) for value in rates(0.0, y))


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
