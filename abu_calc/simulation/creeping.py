"""Slow motion of balls to where they balance: whether they linger on it, and whether it can still change a verdict.

    U_b = M Δ e^{iφ}: what balls leave where they balance, as the race's centre then stands still
    |U| ≤ ½(|U + U_b| + |U − U_b|) on the way from U to U_b if drag overdamps it, else |U| ≤ |U_b| + |U − U_b|

Averaged over a revolution, the support drives each ball down the slope of |U − U_b|². That distance falls all the time,
which is the second bound. Without inertia both components of U − U_b along the axes of Σ t tᵀ (t: directions along the
race) fall, each by itself. Then U stays within the circle whose diameter is the way, which is the first bound. Derived
by averaging, for the axes of one moment; paths of random starts kept within it by 2 % of the imbalance.
"""

import math
from collections.abc import Callable
from typing import Final

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.formulas.motion import SETTLED
from abu_calc.formulas.slow_motion import shaken_drag
from abu_calc.simulation.early_stopping import BalancePath
from abu_calc.simulation.ensemble_results import StartOutcome
from abu_calc.simulation.residual_criteria import balances
from abu_calc.sizing.design import Design

LINGERING: Final = 0.1
"""Share of the imbalance: if balls leave more beyond what they leave balanced, they are not balanced."""

SOON: Final = 0.5
"""Share of the permitted settling time: balls that settled later are followed, so that their time is known."""

MARGIN: Final = 1.0
"""Distance below the permitted level [dB]: a run that may come nearer does not end early."""


def felt_mass(design: Design, scene: Scene) -> float:
    """Effective mass [kg] for the balls: at the race of a machine in hand, or that of its arm, J_O/l²."""
    if not scene.name.startswith("swing-arm"):
        return design.autobalancer.requirement.effective_mass
    return scene.support.felt_mass + sum(scene.ball_masses)


def linger(design: Design, scene: Scene, outcome: StartOutcome) -> bool:
    """True if balls that friction does not hold stand elsewhere than where they balance; sooner or later they leave.

    On a horizontal spindle gravity shakes them loose, see `shaken_drag`.
    """
    held = design.case.friction_arm > 0 and not _shaken(design, scene)
    return not held and abs(outcome.imbalance - abs(_balanced(design, scene))) > LINGERING * reference_imbalance(scene)


def harmless_way(
    design: Design, scene: Scene, left: complex, outcome_at: Callable[[float], StartOutcome]
) -> BalancePath | None:
    """Path of |U| from what is `left` [kg m] to where the balls balance, if no verdict can change on it; else None.

    On the way |U| stays below what is allowed and below |U_b| + `SETTLED` of the imbalance, so that balls do not
    unsettle, and the level stays 1 dB below its limit. `outcome_at(creep)`: outcome of a start whose imbalance left
    may yet fall by `creep` [kg m]. Its settling time, then the latest possible one, is within half of that permitted.
    """
    case, autobalancer, balanced = design.case, design.autobalancer, _balanced(design, scene)
    drag = case.drag + _shaken(design, scene)
    stiffness = autobalancer.ball_count * (design.track.ball_stiffness or math.inf)
    overdamped = drag**2 >= 4 * case.inertia_factor * stiffness
    most = abs(balanced) + abs(left - balanced)
    if overdamped:
        most = (abs(left + balanced) + abs(left - balanced)) / 2
    if not left or most > abs(balanced) + SETTLED * reference_imbalance(scene):
        return None
    least = max(abs(left + balanced) / 2 - abs(left - balanced) / 2, 0.0)
    way = BalancePath(abs(left) - least, most - abs(left))
    outcome = outcome_at(way.down)
    kept = (
        outcome.quiet_time_or_inf <= SOON * case.table.limits.longest_quiet_time
        and balances(most, outcome.allowed, outcome.slip)
        and outcome.level + 20 * math.log10(most / abs(left)) <= case.level_limit - MARGIN
        and kept_quiet(scene, outcome, 20 * math.log10(most / abs(left)))
    )
    return way if kept else None


def kept_quiet(scene: Scene, outcome: StartOutcome, louder: float) -> bool:
    """True if the machine stays quiet, by `MARGIN`, though its level rises by so much [dB]."""
    quiet = scene.quiet_velocity
    return quiet is None or outcome.velocity * 10 ** ((louder + MARGIN) / 20) <= quiet


def _balanced(design: Design, scene: Scene) -> complex:
    """Imbalance [kg m] that the balls leave where they balance."""
    eccentricity = scene.effect("race_eccentricity")
    offset = eccentricity.offset if isinstance(eccentricity, RaceEccentricityEffect) else 0j
    return felt_mass(design, scene) * offset


def _shaken(design: Design, scene: Scene) -> float:
    """Drag rate [1/s] that friction adds where gravity shakes the balls; 0 on a vertical spindle."""
    case, autobalancer = design.case, design.autobalancer
    if case.table.machine.spindle_axis != "horizontal":
        return 0.0
    radius = autobalancer.ball_diameter / 2
    return shaken_drag(case.friction_arm, radius, autobalancer.pitch_radius, scene.speed, case.inertia_factor)
