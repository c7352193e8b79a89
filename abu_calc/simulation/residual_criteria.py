"""Criteria by which the balls of a run count as balancing, for one run and for many."""

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.motion import HARDLY, SETTLED
from abu_calc.simulation.response import Response
from abu_calc.sizing.design import Design

HALF = 0.5
"""Share of the imbalance that friction may leave."""

SLIPPING = 0.05
"""Share of the rotor's speed: balls stall if their mean speed against the race stays above it."""


def slip(response: Response, speed: float) -> float:
    """The largest mean speed of a ball against its race over the rotor's, at the end of a run."""
    return max(map(abs, response.final.ball_speeds), default=0.0) / speed


def allowed_imbalance(design: Design, moved: float, felt: float | None = None) -> float:
    """Allowed residual imbalance [kg m]: a tenth of the imbalance, plus unavoidable shares.

    Eccentricity and dry friction leave some imbalance in any case. Dry friction counts in its worst
    arrangement, as on a vertical spindle: on a horizontal one gravity shakes balls free, but slowly. With
    it at most half the imbalance is allowed: leaving more would be no balancing. A design without worst
    arrangements takes the friction of evenly spread balls: the least that is allowed.

    `felt`: effective mass for the balls [kg]; None: that of the machine in hand.
    """
    autobalancer = design.autobalancer
    mass, budget = felt or autobalancer.requirement.effective_mass, autobalancer.budget
    tenth = SETTLED * max(moved, HARDLY * autobalancer.static_moment) + mass * budget.race_eccentricity
    worst = max((each.upright.rolling_friction for each in design.worst), default=0.0)
    return max(tenth + mass * budget.rolling_friction, min(tenth + mass * worst, HALF * moved))


def allowed_of_scene(scene: Scene, ball_angles: tuple[float, ...]) -> float:
    """Allowed residual imbalance [kg m] of a scene given outright, for balls that rest at these angles [rad].

    A tenth of the imbalance, and what eccentricity and dry friction leave; with friction at most half of it.
    """
    mass = scene.support.felt_mass
    eccentric, rolling = scene.effect("race_eccentricity"), scene.effect("dry_rolling_friction")
    tenth = SETTLED * reference_imbalance(scene) + mass * getattr(eccentric, "magnitude", 0.0)
    if rolling is None:
        return tenth
    arm, radius = getattr(rolling, "lever_arm", 0.0), getattr(rolling, "ball_radius", 1.0)
    first, held = 0, 0.0
    for race in scene.races:
        angles = ball_angles[first : first + len(race.ball_masses)]
        held, first = max(held, friction_band(arm, race.pitch_radius, radius, angles)), first + len(angles)
    return max(tenth, min(tenth + mass * held, HALF * scene.imbalance))


def balances(left: float, allowed: float, slipping: float) -> bool:
    """True if the balls are at rest in their race and the imbalance left [kg m] is allowed."""
    return slipping <= SLIPPING and left <= allowed
