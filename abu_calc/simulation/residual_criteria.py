"""Criteria by which the balls of a run count as balancing, for one run and for many."""

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


def balances(left: float, allowed: float, slipping: float) -> bool:
    """True if the balls are at rest in their race and the imbalance left [kg m] is allowed."""
    return slipping <= SLIPPING and left <= allowed


def balanced_well(design: Design) -> bool:
    """True if the imbalance is so small relative to the balls that they hardly react to it."""
    autobalancer = design.autobalancer
    return design.imbalance.value * abs(autobalancer.requirement.plane_ratio) < HARDLY * autobalancer.static_moment
