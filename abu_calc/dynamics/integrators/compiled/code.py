"""Machine code for all scenes of one structure: compiled once, kept in this process and on disk."""

import contextlib
import hashlib
import importlib.util
import math
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from abu_calc.dynamics.codegen.tracer import cached
from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.equations.right_hand_side import rhs
from abu_calc.dynamics.integrators.compiled import arrays, llvm_engine, llvm_text, translator
from abu_calc.dynamics.integrators.compiled.kernels import Method, kernels, step_numbers
from abu_calc.dynamics.integrators.compiled.llvm_engine import CompilerError, LoadedModule
from abu_calc.dynamics.integrators.compiled.program import EQUATIONS, Program, program
from abu_calc.dynamics.rotor import Acting
from abu_calc.foundation.disk_cache import Cache
from abu_calc.version import __version__

TRANSLATOR: tuple[ModuleType, ...] = (translator, llvm_text, llvm_engine, arrays)

NAMES = {"inf": math.inf}
"""Names that the compiled texts know besides their own."""

POINTERS = len(arrays.RunArrays._fields) + 3
"""Arguments of `loop.go`: the arrays of a run, times and rows of samples, room."""

ROUNDING = 1e-8
"""Compiled and plain equations may differ by this much, relatively."""

_codes: dict[object, "Code"] = {}
_texts: dict[object, Program] = {}
_loops: dict[Method, bytes] = {}


class Code:
    """A structure's equations, and the loop through their motion by one method. Raises CompilerError."""

    def __init__(self, functions: Program, method: Method) -> None:
        self.program = functions
        self._equations = _module([(functions.text, NAMES)], EQUATIONS)[0]
        self._loop = _loop(method)
        self._loop.function("connect", len(EQUATIONS))(*map(self._equations.address, EQUATIONS))
        self._call = self._loop.function("go", POINTERS)

    def go(self, *given: np.ndarray) -> int:
        """`loop.go` on these arrays."""
        return self._call(*[array.ctypes.data for array in given])

    def check(self, equations: Equations, acting: Acting, numbers: np.ndarray) -> None:
        """Raise CompilerError unless it gives the rates of the plain equations, at a place that is not special."""
        y = np.array(equations.initial) + np.array(equations.scales) * np.cos(np.arange(len(equations.initial)))
        par, rates = np.empty(self.program.parameters), np.empty(len(y))
        self._equations.function("setup", 2)(numbers.ctypes.data, par.ctypes.data)
        self._equations.rates("rates", 3)(0.0, y.ctypes.data, par.ctypes.data, rates.ctypes.data)
        true = np.asarray(rhs(np, 0.0, y, acting), dtype=float)
        if not np.allclose(rates, true, rtol=ROUNDING, atol=ROUNDING * float(np.abs(true).max(initial=0.0))):
            raise CompilerError("compiled code does not give what the equations do")


def code(structure: object, equations: Equations, acting: Acting, numbers: np.ndarray, method: Method) -> Code:
    """Code of a structure; `acting` and `numbers` of any scene that has it. Raises CompilerError."""

    def make() -> Code:
        """Compile, and compare the rates with those of the plain equations."""
        made = Code(text(structure, equations, acting), method)
        with np.errstate(all="ignore"):
            made.check(equations, acting, numbers)
        return made

    return cached(_codes, (structure, method), make)


def text(structure: object, equations: Equations, acting: Acting) -> Program:
    """The functions of a structure."""
    return cached(_texts, structure, lambda: program(equations, acting))


def known(structure: object, method: Method) -> bool:
    """True if this process has the code of a structure."""
    return (structure, method) in _codes


def installed() -> bool:
    """True if there is a compiler."""
    return importlib.util.find_spec("llvmlite") is not None


@cache
def _text(module: ModuleType) -> str:
    return Path(str(module.__file__)).read_text(encoding="utf-8")


def _key(parts: list[translator.Part]) -> str:
    """Key of all that the machine code depends on: texts, the numbers they name, translator, processor."""
    rules: list[Any] = [__version__, llvm_engine.described(), *map(_text, TRANSLATOR)]
    rules += [(text, sorted(translator.numbers(names).items())) for text, names in parts]
    return hashlib.sha256(repr(rules).encode()).hexdigest()


def _loop(method: Method) -> LoadedModule:
    """The loop, of which each structure has its own, from the same machine code."""
    if method in _loops:
        return LoadedModule(_loops[method])
    numbers = step_numbers(method)
    parts: list[translator.Part] = [(_text(kernel), vars(kernel) | numbers) for kernel in kernels(method)]
    module, _loops[method] = _module(parts, ("go",), _text(arrays))
    return module


def _module(parts: list[translator.Part], exported: tuple[str, ...], given: str = "") -> tuple[LoadedModule, bytes]:
    """Machine code for some texts, loaded: from disk where it is there and whole."""
    folder, key = Cache.own(), _key(parts)
    kept = folder.read(key)
    if kept is not None:
        with contextlib.suppress(CompilerError):  # what cannot be loaded is made anew
            return LoadedModule(kept), kept
    made = llvm_engine.compiled(translator.translated(parts, exported, given))
    folder.write(key, made)
    return LoadedModule(made), made
