"""Equations of one structure as functions of the compiled language: parameters, rates, and all that is watched.

    setup(numbers, par)           what the equations use of a scene's numbers and modes, once for each mode
    rates(t, y, par, dy)          y'
    watched(t, y, par, dy, w)     y', the watched numbers, and the criteria of the effects' rules
    apparent(t, y, par, w)        those watched numbers that cost next to nothing, such as a ball's speed

The one right-hand side is traced. All modes have one code: balls are always tied in chains, whose gaps are open (0) or
joined (1), and a push on each ball, 0 but in an impact, is among the numbers.

Balls are numbered round their races (`in_order`), so that one code serves whatever order they were given in.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import fields, replace
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.codegen.tracer import Functions, Graph, Symbol, symbols
from abu_calc.dynamics.effect import Effect, Kind
from abu_calc.dynamics.effects.ball_contact import Neighbours
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.equations.right_hand_side import accelerations, derivative, with_states
from abu_calc.dynamics.motion import Levers, Loads, Motion
from abu_calc.dynamics.rotor import Acting, Modes, Parameters, Race
from abu_calc.foundation.frozen import dataclass

EQUATIONS = ("setup", "rates", "watched", "apparent")
"""Functions of a structure, in the order in which `arrays` declares them."""

CHEAP = 1 / 20
"""Share of the operations of all watched numbers.

A number that takes fewer is worth a function without the others.
"""

STATE = re.compile(r"\by(\d+)\b")
"""A state in an expression."""


@dataclass(frozen=True)
class Push(Effect):
    """A force along the race on each ball, per ball mass: its mode."""

    name: ClassVar[str] = "push"
    kind: ClassVar[Kind] = "driven"

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Along the race."""
        loads.add(pull=mode)


def widened(equations: Equations, modes: Modes) -> Acting:
    """The numbers in these modes, with all that any mode may need."""
    p = equations.parameters
    modes = tuple(replace(mode, tied=True) if isinstance(mode, Neighbours) else mode for mode in modes)
    return Acting(replace(p, effects=(*p.effects, Push())), (*modes, np.zeros(p.balls)))


@dataclass(frozen=True)
class Program:
    """The text of all functions, and how many numbers they take and give."""

    text: str
    numbers: int
    parameters: int
    watched: tuple[int, ...]
    """Number of watched numbers of each effect, in order."""
    criteria: tuple[int, ...]
    """Number of values by which the rule of each effect chooses."""
    apparent: Mapping[int, tuple[int, ...]]
    """Watched numbers that cost next to nothing, and the states that they need."""

    @property
    def values(self) -> int:
        """Number of values that `watched` gives."""
        return sum(self.watched) + sum(self.criteria)


def program(equations: Equations, acting: Acting) -> Program:
    """The functions for a structure, from any of its modes."""
    graph = Graph()
    symbolic, t, y = symbols(equations, acting, graph)
    motion, loads, solved = accelerations(Functions, t, y, symbolic)
    rates = list(derivative(motion, solved, y, symbolic))
    p, parts = symbolic.parameters, with_states(y, symbolic)
    watched = [effect.watch(motion, mode, own, loads, solved, p) for effect, mode, own in parts]
    criteria = [effect.criteria(motion, mode, own, loads, solved, p) for effect, mode, own in parts]
    zero = Symbol(graph, [])
    dy, seen, chosen = (
        [(zero + value).expression() for row in rows for value in row] for rows in ([rates], watched, criteria)
    )
    most = CHEAP * graph.operations(seen)
    cheap = {k: place for k, place in enumerate(seen) if graph.operations([place], most) < most}
    given, rows = "t: float, y: Reals, par: Reals", {"dy": dict(enumerate(dy))}
    lines = [
        *_function("rates", f"{given}, dy: Reals", graph, rows),
        *_function("watched", f"{given}, dy: Reals, w: Reals", graph, rows | {"w": dict(enumerate([*seen, *chosen]))}),
        *_function("apparent", f"{given}, w: Reals", graph, {"w": cheap}),
    ]
    setup, numbers, parameters = _setup(graph)
    counts = [tuple(len(row) for row in rows) for rows in (watched, criteria)]
    apparent = {k: _states(graph.lines([place])) for k, place in cheap.items()}
    return Program("\n".join([*setup, *lines, ""]), numbers, parameters, counts[0], counts[1], apparent)


def _setup(graph: Graph) -> tuple[list[str], int, int]:
    """The function that fills the slots from the numbers, once all other code is written; how many of each."""
    names, lines, results = graph.setup()
    text = ["def setup(numbers: Reals, par: Reals) -> None:"]
    text += [f" {name} = numbers[{k}]" for k, name in enumerate(names)] + [f" {line}" for line in lines]
    text += [f" par[{k}] = {result}" for k, result in enumerate(results)] or [" pass"]
    return text, len(names), len(results)


def _function(name: str, arguments: str, graph: Graph, results: Mapping[str, Mapping[int, int]]) -> list[str]:
    """One function that stores its results at their places in arrays."""
    lines, texts = graph.lines([place for row in results.values() for place in row.values()])
    lines = [*(f"y{k} = y[{k}]" for k in _states((lines, texts))), *lines]  # each is read once
    text = [f"def {name}({arguments}) -> None:", *(f" {line}" for line in lines)]
    places = [f"{array}[{k}]" for array, row in results.items() for k in row]
    return [*text, *(f" {place} = {text}" for place, text in zip(places, texts, strict=True)), " return"]


def _states(texts: tuple[list[str], list[str]]) -> tuple[int, ...]:
    """Indices of the states that occur in assignments and results."""
    return tuple(sorted({int(index) for rows in texts for text in rows for index in STATE.findall(text)}))


def places(modes: Modes) -> list[dict[str, int]]:
    """Places of each effect's mode numbers, by field ("" if the mode is a number or an array itself).

    Counted from the end of all numbers, where they stand in the order in which `Numbers` flattens them.
    """
    rows: list[dict[str, int]] = []
    place = 0
    for mode in modes:
        row: dict[str, int] = {}
        parts = {"": mode}
        if mode is not None and not isinstance(mode, float | np.ndarray):
            parts = {part.name: getattr(mode, part.name) for part in fields(mode)}
        for name, value in parts.items():
            if isinstance(value, float | np.ndarray):
                row[name] = place
                place += int(np.size(value))
        rows.append(row)
    return [{name: at - place for name, at in row.items()} for row in rows]


Places = NDArray[np.intp]


@lru_cache(maxsize=8)
def in_order(equations: Equations) -> tuple[Equations, Places]:
    """The same scene with its balls numbered round each race, and where each of its states stood."""
    scene = equations.scene
    orders = [_order(race) for race in scene.races]
    places = _places(equations, np.concatenate([np.array([], dtype=np.intp), *_shifted(orders)]))
    if np.array_equal(places, np.arange(len(places))):
        return equations, places
    races = tuple(_renumbered(race, order) for race, order in zip(scene.races, orders, strict=True))
    initial = tuple(np.array(equations.initial)[places].tolist())
    reordered = assemble(replace(scene, races=races))
    return replace(reordered, initial=initial, longest_step=equations.longest_step, breaks=equations.breaks), places


def _order(race: Race) -> Places:
    """The balls of a race as they stand round it."""
    return np.argsort(np.array(race.start_angles) % (2 * math.pi), kind="stable")


def _shifted(orders: list[Places]) -> list[Places]:
    """Counted over all races."""
    firsts = np.cumsum([0, *map(len, orders)])
    return [order + first for order, first in zip(orders, firsts, strict=False)]


def _renumbered(race: Race, order: Places) -> Race:
    masses, angles, speeds = (
        tuple(values[k] for k in order) for values in (race.ball_masses, race.start_angles, race.start_speeds)
    )
    return replace(race, ball_masses=masses, start_angles=angles, start_speeds=speeds)


def _places(equations: Equations, balls: Places) -> Places:
    """Places of all states: support, angles, speeds and further states of the balls, rotor."""
    p = equations.parameters
    first, blocks = 2 * p.size, 2 + len(equations.scene.ball_states)
    places = np.arange(len(equations.states))
    for block in range(blocks if p.balls else 0):
        start = first + block * p.balls
        places[start : start + p.balls] = start + balls
    return places
