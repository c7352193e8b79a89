"""Whether compiled code can go through a scene, and how long one waits for it."""

import warnings

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled import code, trial
from abu_calc.dynamics.integrators.compiled.machine import CompilerError
from abu_calc.dynamics.integrators.compiled.order import in_order
from abu_calc.dynamics.integrators.compiled.run import described, prepared

LEAST = 0.1
"""Time [s] until compiled code runs that is on disk: llvmlite is imported, the equations are traced."""

COMPILING = 0.8e-5
"""Time [s] of compilation per character of the equations' text: 0.2 s for four balls with friction and contact, 1 for
sixteen. The loop itself, compiled once for all scenes (0.7 s), is left out."""

_broken: list[str] = []


def unfit(equations: Equations) -> tuple[str, str] | None:
    """Why there is no compiled way through a scene, and the remedy; None where there is."""
    if not code.installed():
        return "llvmlite is not installed", 'pip install "abu-calc[fast]", or use scipy'
    if _broken:
        return f"compiled code does not run here ({_broken[0]})", "use scipy"
    for effect in equations.scene.effects:
        if not effect.traceable:
            return f"the effect {effect.name} cannot be traced", "use scipy, or leave the effect out"
    return None


def waiting(equations: Equations) -> float:
    """About how long until compiled code runs [s], by counting: 0.1 s where the structure was compiled before.

    Infinite where it cannot run.
    """
    ordered, _ = in_order(equations)
    wide, structure, _ = described(ordered)
    if code.known(structure):
        return 0.0
    try:
        return LEAST if code.on_disk(code.text(structure, ordered, wide)) else compiling(equations)
    except CompilerError as error:
        _give_up(error)
        return float("inf")


def compiling(equations: Equations) -> float:
    """About how long until compiled code runs for the very first time [s], by counting."""
    ordered, _ = in_order(equations)
    wide, structure, _ = described(ordered)
    return LEAST + COMPILING * len(code.text(structure, ordered, wide).text)


def load(equations: Equations) -> bool:
    """Make the code of a scene. False, with a warning once, where compiled code does not run on this machine."""
    if not _broken:
        try:
            trial.passed()
            prepared(in_order(equations)[0])
        except CompilerError as error:
            _give_up(error)
    return not _broken


def _give_up(error: CompilerError) -> None:
    _broken.append(str(error))
    warnings.warn(f"compiled code is not used: {error}", RuntimeWarning, stacklevel=3)
