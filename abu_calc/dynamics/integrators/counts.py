"""About how much work a scene is, by counting: nothing is timed, so that a scene has one answer on every machine."""

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.rates import cycles
from abu_calc.dynamics.switching.modes import watches
from abu_calc.frozen import dataclass

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

STABLE, STEP = 3.3, 7
"""Step times decay that Dormand-Prince 5 bears, and evaluations of one of its steps."""

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


def held_by_decay(equations: Equations, decay: float) -> float:
    """Evaluations of the loop where stability, h·decay below 3.3 of Dormand-Prince 5, rules its steps."""
    return RUNS * equations.scene.duration * decay / STABLE * STEP
