"""List of the modules that make up the compiled loop, for either method of its steps."""

from types import ModuleType
from typing import Final, Literal

from abu_calc.dynamics.integrators.compiled import dop853, dopri5, impact, locate, loop, mode_transitions

Method = Literal["rk45", "dop853"]

METHODS: Final[dict[Method, ModuleType]] = {"rk45": dopri5, "dop853": dop853}

STEP_NAMES: Final = ("METHOD_ORDER", "EXPONENT", "STAGES", "EXTRA", "KEPT", "LAST", "BETWEEN")
"""Numbers of a method, which other modules know as those of `dopri5`."""


def kernels(method: Method) -> tuple[ModuleType, ...]:
    """Modules of the compiled loop, in the order in which they import each other."""
    return (METHODS[method], locate, impact, mode_transitions, loop)


def step_numbers(method: Method) -> dict[str, float]:
    """Numbers of a method by their names, which take the place of those of `dopri5` in the other modules."""
    return {name: getattr(METHODS[method], name) for name in STEP_NAMES}
