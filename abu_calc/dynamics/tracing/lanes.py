"""The equations as straight-line code on arrays: derivatives at many times in the calls of one.

NumPy's calls cost the same for a state as for a hundred, so all times and all directions go through the code together.
"""

from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.equations.jacobian import STEP, jacobian
from abu_calc.dynamics.motion import Array
from abu_calc.dynamics.tracing.graph import Graph
from abu_calc.dynamics.tracing.plain import handful, made_of_parameters
from abu_calc.dynamics.tracing.traced import Numbers, cached, trace

Rates = Callable[[Array, Any], list[Any]]
"""(t, y) to y', each state an array of as many numbers as are asked for at once."""

Maker = Callable[[Sequence[float]], Rates]

_makers: dict[Any, Maker] = {}


def jacobians(equations: Equations, times: Array, states: Array) -> Array:
    """∂(rhs)/∂y, [time, row, column], at these times and the state of each, in the first modes; see `jacobian`."""
    structure, values = Numbers(equations).of(equations.first_modes)
    if not handful(equations, values):
        return np.array([jacobian(equations, float(t), y) for t, y in zip(times, states, strict=True)])
    rates = cached(_makers, structure, lambda: _write(equations))(values)
    moved = states.T[:, :, None] + 1j * STEP * np.eye(states.shape[1])[:, None, :]
    found = [np.broadcast_to(np.asarray(one).imag, moved.shape[1:]) for one in rates(times[:, None], moved)]
    return np.stack(found, axis=1) / STEP


def _write(equations: Equations) -> Maker:
    graph = Graph("p{}")
    traced = trace(equations, equations.acting, graph)
    lines, results = graph.lines([symbol.expression() for symbol in traced.rates])
    text = [*made_of_parameters(graph), " def rates(t, y):"]
    text += [f"  [{', '.join(f'y{k}' for k in range(len(equations.states)))}] = y", *(f"  {line}" for line in lines)]
    text += [f"  return [{', '.join(results)}]", " return rates"]
    scope: dict[str, Any] = {"sin": np.sin, "cos": np.cos, "sqrt": np.sqrt, "inf": np.inf}
    exec(compile("\n".join(text), "<equations of many states>", "exec"), scope)
    return cast(Maker, scope["make"])
