"""When the balls of a design count as balancing it: one definition for one run and for many."""

from abu_calc.analysis.response import Response
from abu_calc.formulas.motion import HARDLY, SETTLED
from abu_calc.sizing.design import Design

HALF = 0.5
"""Of the imbalance, that friction may leave."""

SLIPPING = 0.05
"""Of the rotor's speed: balls whose mean speed against the race stays above hang."""


def slip(response: Response, speed: float) -> float:
    """The largest mean speed of a ball against its race over the rotor's, at the end of a run."""
    return max(map(abs, response.final.ball_speeds), default=0.0) / speed


def allowed_imbalance(design: Design, moved: float) -> float:
    """What may be left [kg m]: a tenth of the imbalance, and what eccentricity and dry friction leave in any case.

    Friction at its worst arrangement, but with that no more than half the imbalance: less would be no balancing. In a
    design without worst arrangements it is that of balls fanned evenly: then what is allowed is the least that is.
    """
    one = design.autobalancer
    mass, budget = one.requirement.effective_mass, one.budget
    tenth = SETTLED * max(moved, HARDLY * one.static_moment) + mass * budget.race_eccentricity
    worst = max((each.rolling_friction for each in design.worst), default=0.0)
    return max(tenth + mass * budget.rolling_friction, min(tenth + mass * worst, HALF * moved))


def balances(left: float, allowed: float, slipping: float) -> bool:
    """Whether the balls are at rest in their race, and what they leave [kg m] is allowed."""
    return slipping <= SLIPPING and left <= allowed


def balanced_well(design: Design) -> bool:
    """Whether the imbalance is so small beside the balls that they hardly feel it."""
    one = design.autobalancer
    return design.imbalance.value * abs(one.requirement.plane_ratio) < HARDLY * one.static_moment
