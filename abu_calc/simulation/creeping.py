"""Whether balls linger on their slow way to where they balance, and whether what they leave changes a verdict."""

from typing import Final

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.formulas.slow_motion import shaken_drag
from abu_calc.simulation.ensemble_results import StartOutcome
from abu_calc.sizing.design import Design

LINGERING: Final = 0.1
"""Share of the imbalance: if balls leave more beyond what they leave balanced, they are not balanced."""

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
