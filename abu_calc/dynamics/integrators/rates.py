"""Decay and oscillation rates of a scene's motion at its start.

An integrator has to follow them, or to step over them.
"""

import math
from functools import lru_cache

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.equations.jacobian import jacobian
from abu_calc.dynamics.switching.modes import starting

STIFF = 50.0
"""Decay per radian of the fastest oscillation beyond which an explicit method spends its steps on what has died out."""

FAST = 10.0
"""Oscillations in a revolution that stand out: hard work on a grinder makes one or two."""


@lru_cache(maxsize=8)
def rates(equations: Equations) -> tuple[float, float]:
    """Fastest decay and fastest oscillation at the start [1/s, rad/s]; the rotor's turning counts as one."""
    state, modes = starting(equations)
    values = np.linalg.eigvals(jacobian(equations, 0.0, state, modes))
    return -float(values.real.min()), max(float(np.abs(values.imag).max()), equations.scene.speed)


def stiff_decay(equations: Equations) -> float | None:
    """The fastest decay at the start [1/s] where it calls for an implicit method; None: it does not."""
    decay, fastest = rates(equations)
    return decay if decay > STIFF * fastest else None


def cycles(equations: Equations) -> float:
    """Number of cycles of the fastest oscillation in a run.

    No explicit step may be longer than a part of one, however small the oscillation is.
    """
    return equations.scene.duration * rates(equations)[1] / (2 * math.pi)


def softer(equations: Equations) -> str:
    """The remedy where something oscillates far faster than the rotor turns; empty where nothing does."""
    fastest = rates(equations)[1]
    if fastest < FAST * equations.scene.speed:
        return ""
    return (
        f"it oscillates at {fastest / (2 * math.pi):.3g} Hz, {fastest / equations.scene.speed:.3g} times in a "
        "revolution: lower the stiffness of contact, joint, bearings or suspension, "
    )
