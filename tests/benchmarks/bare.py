"""What one evaluation of compiled equations costs by itself, called again and again from compiled code."""

import time

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled import arrays, code
from abu_calc.dynamics.integrators.compiled.program import in_order
from abu_calc.dynamics.integrators.compiled.run import prepared

AGAIN = 50_000

TEXT = """
def often_rates(y: Reals, par: Reals, dy: Reals, w: Reals, often: int) -> int:
    for _ in range(often):
        rates(0.01, y, par, dy)
    return 0


def often_watched(y: Reals, par: Reals, dy: Reals, w: Reals, often: int) -> int:
    for _ in range(often):
        watched(0.01, y, par, dy, w)
    return 0
"""
NAMES = ("often_rates", "often_watched")


def evaluation_times(equations: Equations) -> tuple[float, float]:
    """Of rates, and of rates with all that is watched [s], the best of a few."""
    ordered, _ = in_order(equations)
    found, numbers = prepared(ordered, "rk45")
    module = code._module([(TEXT, {})], NAMES, code._text(arrays))[0]
    module.function("connect", len(code.EQUATIONS))(*map(found._equations.address, code.EQUATIONS))
    y, par = np.array(ordered.initial, dtype=float), np.empty(found.program.parameters)
    found._equations.function("setup", 2)(numbers.ctypes.data, par.ctypes.data)
    held = y, par, np.empty(len(y)), np.empty(found.program.values)
    given = [one.ctypes.data for one in held]
    rates, watched = (_best(module.function(name, len(given) + 1), given) for name in NAMES)
    return rates, watched


def _best(function: object, given: list[int]) -> float:
    spent = []
    for _ in range(15):
        begun = time.process_time()
        function(*given, AGAIN)  # type: ignore[operator]
        spent.append(time.process_time() - begun)
    return min(spent) / AGAIN
