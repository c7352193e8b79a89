"""The integrator for scenes that are many and alike: chosen once, its code made once, nothing estimated anew."""

from typing import Final, Literal

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.choice import LOOP_WORK, integrate_with, unfit, untraceable
from abu_calc.dynamics.integrators.rates import stiff_decay
from abu_calc.dynamics.integrators.run import Array
from abu_calc.dynamics.switching.modes import watches
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import NotTrustworthyError

Way = Literal["loop", "heyoka", "compiled", "scipy-dop853", "scipy-radau"]
"""loop: through scenes that switch, compiled where it can be, else plain Python with the same numbers."""

SHARE: Final[dict[Way, float]] = {"loop": LOOP_WORK, "compiled": LOOP_WORK}
"""Work of one evaluation, SciPy's being one."""


def way_for(equations: Equations) -> Way:
    """The quickest one for many scenes like this, by what is installed: that compiling takes a second is no matter."""
    from abu_calc.dynamics.integrators.compiled import waiting

    if stiff_decay(equations) is not None:
        return "scipy-radau"
    if watches(equations) and not untraceable(equations):
        return "loop"
    if not unfit(equations):
        return "heyoka"
    return "scipy-dop853" if waiting.unfit(equations) or not waiting.load(equations) else "compiled"


def integrate(equations: Equations, way: Way, tolerance: float, sample_times: Array, work: int) -> Trajectory:
    """The motion by that way, within so many of SciPy's evaluations; by Radau IIA where it fails as it is stiff.

    Raises NotTrustworthyError.
    """
    most = int(work / SHARE.get(way, 1.0))
    try:
        return integrate_with(_name(equations, way), equations, tolerance, sample_times, most)
    except NotTrustworthyError:
        if way == "scipy-radau" or stiff_decay(equations) is None:
            raise
        return integrate_with("scipy-radau", equations, tolerance, sample_times, work)


def _name(equations: Equations, way: Way) -> str:
    """The integrator's."""
    if way != "loop":
        return way
    from abu_calc.dynamics.integrators.compiled import waiting

    return "compiled" if waiting.unfit(equations) is None and waiting.load(equations) else "plain-rk45"
