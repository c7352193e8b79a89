"""Work of integrating a scene, estimated from the decay and oscillation rates of its motion at the start.

An integrator has to follow these rates, or to step over them. Work is counted in evaluations and nothing is timed, so
that a scene has one answer on every machine.
"""

import math
from functools import lru_cache

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations, jacobian
from abu_calc.dynamics.switching.modes import starting, watches
from abu_calc.foundation.frozen import dataclass

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


def stiff(equations: Equations) -> bool:
    """True if the fastest decay at the start calls for an implicit method."""
    decay, fastest = rates(equations)
    return decay > STIFF * fastest


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


EVALUATIONS, ORDER = 35.0, 8
"""Evaluations of DOP853 per revolution at a tolerance of 1e-6, and the order by which they grow.

They are counted per cycle of any faster oscillation. Four balls on a soft planar support took 18, 33,
78 and 183 at 2e-4, 1e-6, 1e-9 and 1e-12.
"""

SWITCHING_EVALUATIONS, SWITCHING_ORDER = 45.0, 5
"""Likewise of the loop's method of order 5 through scenes that switch, at a tolerance of 2e-4."""

SHAKEN, LOOSE = 2.0, 0.2
"""Events per revolution and ball in a scene that switches, with gravity across the race, which stops and starts balls
twice in each revolution, and without."""

RUNS = 2
"""A result is trusted when two tolerances agree."""


@dataclass(frozen=True)
class Counts:
    """Two runs of a scene: evaluations of SciPy's methods and of the loop without those of events, and events."""

    scipy: float
    loop: float
    events: float


def counts(equations: Equations, tolerance: float) -> Counts:
    """About how many there are.

    Of 30 runs of the presets none was overestimated by more than a third; a swing arm, whose balls are caught again and
    again, takes up to five times as many.
    """
    scene, waves = equations.scene, RUNS * cycles(equations)
    smooth = waves * EVALUATIONS * (1e-6 / tolerance) ** (1 / ORDER)
    if not watches(equations):
        return Counts(scipy=smooth, loop=smooth, events=0.0)
    shaken = any(effect.kind == "conservative" for effect in scene.effects)
    turns = RUNS * scene.duration / scene.revolution
    return Counts(
        scipy=smooth,
        loop=waves * SWITCHING_EVALUATIONS * (2e-4 / tolerance) ** (1 / SWITCHING_ORDER),
        events=turns * len(scene.ball_masses) * (SHAKEN if shaken else LOOSE),
    )
