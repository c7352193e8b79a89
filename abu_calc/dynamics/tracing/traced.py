"""The equations of a scene in another language: one trace serves all scenes of one structure and all their modes.

Structure is what decides how the code looks: number of balls, kind of support, effects, which matrix elements are zero.
All other numbers are parameters of the code.
"""

import copy
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, is_dataclass
from functools import lru_cache
from typing import Any, TypeVar

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.parameters import Acting, Modes, Parameters
from abu_calc.dynamics.switching.modes import watched, watches
from abu_calc.dynamics.tracing.symbols import Functions, Symbol, Tape

MOST_KEPT = 32
"""Structures whose code this process holds at most."""

ZEROS: dict[str, int | None] = {"effects": 0, "modes": None}
"""Zeros of how many dimensions are structure: plain numbers of effects, which decide by them whether they act at all;
elsewhere those of matrices, which tell how the support is built."""


@dataclass(frozen=True)
class Traced:
    """Rates of the states and watched numbers as symbols, and the tape that makes parameters of a scene's numbers."""

    tape: Tape
    t: Any
    units: tuple[Any, ...]
    rates: tuple[Any, ...]
    watched: tuple[Any, ...]


def trace(equations: Equations, acting: Acting, library: Any, states: Sequence[Any], scaled: bool) -> Traced:
    """The equations in these modes, in a library's expressions; where `scaled`, states come in units of their own.

    The tape's parameters are the units, then the numbers that `Numbers` finds.
    """
    tape = Tape(library)
    units = tuple(tape.parameter() for _ in states) if scaled else ()
    symbolic = mapped(acting, lambda _, nonzero: tape.parameter(nonzero), lambda _: None)
    y = [tape.variable(state) for state in states]
    if scaled:
        y = [unit * one for unit, one in zip(units, y, strict=True)]
    t: Any = tape.variable(library.time)
    rates = equations.rhs(Functions, t, np.array(y), symbolic)
    numbers = watched(t, np.array(y), symbolic, Functions) if watches(equations) else ()
    return Traced(tape, t, units, tuple(rates), tuple(_symbol(tape, value) for value in numbers))


def _symbol(tape: Tape, value: Any) -> Symbol:
    """A watched number may be a constant."""
    symbol: Symbol = value + Symbol(tape, [])
    return symbol


class Numbers:
    """What decides how the code of a scene looks, and the numbers that it is run with, as modes change."""

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
    """Those of some equations, which are integrated several times at different tolerances."""
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
        found = value.astype(object)
        found[~same] = [number(one, False) for one in value[~same].tolist()]
        return value if same.all() else found
    if is_dataclass(value) and not isinstance(value, type):
        fixed(type(value))
        changed = copy.copy(value)
        for part in fields(value):  # past checks of values, which symbols would not stand
            of = ZEROS.get(part.name, zeros) if isinstance(value, Parameters | Acting) else zeros
            object.__setattr__(changed, part.name, mapped(getattr(value, part.name), number, fixed, of))
        return changed
    if isinstance(value, tuple):
        fixed(len(value))
        return tuple(mapped(one, number, fixed, zeros) for one in value)
    fixed(value)
    return value
