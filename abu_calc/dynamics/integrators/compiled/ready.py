"""Readiness of compiled code: whether it runs here, and whether that of a scene is ready to run."""

import warnings

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled import code, trial
from abu_calc.dynamics.integrators.compiled.kernels import Method
from abu_calc.dynamics.integrators.compiled.machine import CompilerError
from abu_calc.dynamics.integrators.compiled.order import in_order
from abu_calc.dynamics.integrators.compiled.run import described, prepared

NOT_INSTALLED = "llvmlite is not installed"

_failures: list[str] = []


def missing() -> str | None:
    """Why no compiled code runs here; None where it runs, as far as is known."""
    if not code.installed():
        return NOT_INSTALLED
    return f"compiled code does not run here ({_failures[0]})" if _failures else None


def loaded(equations: Equations, method: Method) -> bool:
    """True if this process has the code of a scene."""
    _, structure, _ = described(in_order(equations)[0])
    return code.known(structure, method)


def load(equations: Equations, method: Method) -> bool:
    """Make the code of a scene. False, with a warning once, where compiled code does not run on this machine."""
    if not _failures and code.installed():
        try:
            trial.passed()
            prepared(in_order(equations)[0], method)
        except CompilerError as error:
            _failures.append(str(error))
            warnings.warn(f"compiled code is not used: {error}", RuntimeWarning, stacklevel=3)
    elif not _failures:
        warnings.warn(
            f"compiled code would be some ten times faster, with the same numbers, but {NOT_INSTALLED}: run "
            "pip install llvmlite, where it has a wheel for this system",
            RuntimeWarning,
            stacklevel=3,
        )
    return missing() is None
