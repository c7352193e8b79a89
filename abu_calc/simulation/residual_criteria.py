"""Criteria by which the balls of a run count as balancing, as lingering, and a machine as staying quiet."""

from typing import Final

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.motion import HARDLY, SETTLED
from abu_calc.formulas.slow_motion import shaken_drag
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
    bands = (friction_band(arm, race.pitch_radius, radius, own) for race, own in scene.by_race(ball_angles))
    held = max(bands, default=0.0)
    return max(tenth, min(tenth + mass * held, HALF * scene.imbalance))


def balances(left: float, allowed: float, slipping: float) -> bool:
    """True if the balls are at rest in their race and the imbalance left [kg m] is allowed."""
    return slipping <= SLIPPING and left <= allowed


LINGERING: Final = 0.1
"""Share of the imbalance: if balls leave more beyond what they leave balanced, they are not balanced."""

MARGIN: Final = 1.0
"""Distance below the permitted level [dB]: a run that may come nearer does not end early."""


def felt_mass(design: Design, scene: Scene) -> float:
    """Effective mass [kg] for the balls: at the race of a machine in hand, or that of its arm, J_O/l²."""
    if not scene.name.startswith("swing-arm"):
        return design.autobalancer.requirement.effective_mass
    return scene.support.felt_mass + sum(scene.ball_masses)


def linger(design: Design, scene: Scene, imbalance: float) -> bool:
    """True if balls that friction does not hold leave an imbalance [kg m] as elsewhere than where they balance.

    Sooner or later they go there.

    On a horizontal spindle gravity shakes them loose, see `shaken_drag`.
    """
    held = _friction_arm(scene) > 0 and not _shaken(design, scene)
    return not held and abs(imbalance - abs(_balanced(design, scene))) > LINGERING * reference_imbalance(scene)


def kept_quiet(scene: Scene, velocity: float, louder: float) -> bool:
    """True if a machine of this velocity [m/s] stays quiet, by `MARGIN`, though its level rises by so much [dB]."""
    quiet = scene.quiet_velocity
    return quiet is None or velocity * 10 ** ((louder + MARGIN) / 20) <= quiet


def _balanced(design: Design, scene: Scene) -> complex:
    """Imbalance [kg m] that the balls leave where they balance."""
    eccentricity = scene.effect("race_eccentricity")
    offset = eccentricity.offset if isinstance(eccentricity, RaceEccentricityEffect) else 0j
    return felt_mass(design, scene) * offset


def _shaken(design: Design, scene: Scene) -> float:
    """Drag rate [1/s] that friction adds where gravity shakes the balls; 0 on a vertical spindle."""
    autobalancer = design.autobalancer
    if scene.effect("gravity") is None:
        return 0.0
    arm, radius = _friction_arm(scene), autobalancer.ball_diameter / 2
    return shaken_drag(arm, radius, autobalancer.pitch_radius, scene.speed, design.case.inertia_factor)


def _friction_arm(scene: Scene) -> float:
    """Lever arm of dry rolling friction [m]; 0 without it."""
    return float(getattr(scene.effect("dry_rolling_friction"), "lever_arm", 0.0))
