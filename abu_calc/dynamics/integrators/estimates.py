"""About how long each integrator takes for a scene [s], by counting: nothing is timed, so that a scene has one answer.

Figures from a machine of two cores; they decide between ways, a factor of two off either way costs little.
"""

from dataclasses import dataclass
from typing import Final

from abu_calc.dynamics.effect import ACROSS_RATE
from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.rates import cycles
from abu_calc.dynamics.switching.modes import watches

EVALUATIONS, ORDER = 35.0, 8
"""Of DOP853 per revolution, or per cycle of what oscillates faster, at a tolerance of 1e-6, and the order by which they
grow: four balls on a soft planar support took 18, 33, 78 and 183 at 2e-4, 1e-6, 1e-9 and 1e-12."""

EVALUATION, BALL = 6e-6, 0.6e-6
"""Time of an evaluation [s] with its share of the step, and of each ball in it: 8 µs for 2 to 4 balls, 15 for 16."""

EVENT: Final = 1.2e-3
"""Time of an event [s] that the general decision answers."""

LOOP_EVALUATIONS, LOOP_ORDER, LOOP_EVENT = 45.0, 5, 15.0
"""Of the loop through switching scenes, per revolution or cycle at a tolerance of 2e-4, its order, and of one event."""

PLAIN, PLAIN_BALL = 5e-6, 5e-6
"""Time of one of its evaluations in plain Python [s], and of each ball in it: 25 µs for 4 balls, 43 for 6."""

COMPILED = 1 / 50
"""The same in compiled code, of the plain time: 0.5 µs for 4 balls."""

SHAKEN, LOOSE = 2.0, 0.2
"""Events per revolution and ball in a scene that switches, with gravity across the race, which stops and starts balls
twice in each revolution, and without."""

STABLE, STEP = 3.3, 7
"""Step times decay that Dormand-Prince 5 bears, and evaluations of one of its steps."""

START = 0.25
"""Time [s] heyoka takes to be imported (0.05 to 0.13) and to load compiled code from disk (0.02 to 0.1), and some more:
what it gains has to be worth the compilation of the very first run (0.3 to 1)."""

RUNS = 2
"""A result is trusted when two tolerances agree."""


@dataclass(frozen=True)
class Seconds:
    """Two runs of a scene by SciPy and by the loop, what that takes to start left out."""

    scipy: float
    plain: float
    compiled: float
    switches: bool


def seconds(equations: Equations, tolerance: float) -> Seconds:
    """About how long each takes."""
    balls, counted, switches = len(equations.scene.ball_masses), counts(equations, tolerance), watches(equations)
    events, own = counted.events, counted.loop
    smooth = counted.scipy * (EVALUATION + BALL * balls)
    general = asks_python(equations)
    plain = (own + (0 if general else LOOP_EVENT * events)) * (PLAIN + PLAIN_BALL * balls)
    asked = EVENT * events
    return Seconds(
        scipy=smooth + asked,
        plain=plain + general * asked,
        compiled=COMPILED * plain + general * asked,
        switches=switches,
    )


@dataclass(frozen=True)
class Counts:
    """Two runs of a scene: evaluations of SciPy's and of the loop, events on their way left out, and these."""

    scipy: float
    loop: float
    events: float


def counts(equations: Equations, tolerance: float) -> Counts:
    """About how many there are.

    Of 30 runs of the presets none was overestimated by more than a third; a swing arm, whose balls are caught again and
    again, takes up to five times as many.
    """
    scene, balls, waves = equations.scene, len(equations.scene.ball_masses), RUNS * cycles(equations)
    turns = RUNS * scene.duration / scene.revolution
    shaken = any(effect.kind == "conservative" for effect in scene.effects)
    return Counts(
        scipy=waves * EVALUATIONS * (1e-6 / tolerance) ** (1 / ORDER),
        loop=waves * LOOP_EVALUATIONS * (2e-4 / tolerance) ** (1 / LOOP_ORDER),
        events=turns * balls * (SHAKEN if shaken else LOOSE) if watches(equations) else 0.0,
    )


def held_by_decay(equations: Equations, decay: float) -> float:
    """Time [s] of the compiled loop's steps where stability, h·decay below 3.3 of Dormand-Prince 5, rules them."""
    steps = RUNS * equations.scene.duration * decay / STABLE
    return steps * STEP * COMPILED * (PLAIN + PLAIN_BALL * len(equations.scene.ball_masses))


def asks_python(equations: Equations) -> bool:
    """Whether the loop leaves its decisions to Python: balls that move across their race, too, stick or touch."""
    effects = zip(equations.scene.effects, equations.first_modes, strict=True)
    rules = [effect.rule(mode) for effect, mode in effects]
    return ACROSS_RATE in equations.scene.ball_states and any(
        rule and rule.name != "one-sided contact" for rule in rules
    )
