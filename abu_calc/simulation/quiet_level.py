"""The velocity up to which a machine is quiet: the limit of its level, or the level without balls if that is less."""

import math

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude
from abu_calc.formulas.suspension import resonance_factor
from abu_calc.foundation.units import velocity_from_level
from abu_calc.sizing.design import Design
from abu_calc.sizing.handles import total_of
from abu_calc.sizing.places import level_at_loudest, settled_levels


def level_without(design: Design) -> float:
    """Level [dB] at the loudest limited place of the machine without an autobalancer, idle at its speed."""
    case, mass = design.case, design.case.body.effective_mass()
    whirl = design.imbalance.value / mass * resonance_factor(case.suspension, case.speed, mass)
    without = settled_levels(case, whirl, None, design.imbalance.value, 0.0).worst.before
    return math.inf if without is None else without


def quiet_velocity(design: Design, scene: Scene) -> float:
    """Rms velocity [m/s] of the axis at the race up to which the machine is quiet, idle at its speed.

    That has min(limit, level without an autobalancer at the imbalance of the file) at the loudest place: under a high
    limit, too, the balls must make the machine less loud than it was. On an arm its motion without balls counts.
    """
    limit = design.case.level_limit
    if scene.name.startswith("swing-arm"):
        without = unbalanced_amplitude(scene) * scene.speed / math.sqrt(2)
        return min(velocity_of_level(design, limit), without)
    return velocity_of_level(design, min(limit, level_without(design)))


def velocity_of_level(design: Design, wanted: float) -> float:
    """Rms velocity [m/s] of the axis at the race with that level [dB] at the loudest place, or with the limit of a_hv;
    0 if it is louder at rest.

    Found by bisection of its logarithm: the level rises with the velocity, whatever place is loudest.
    """
    case = design.case

    most = case.table.limits.a_hv_m_per_s2

    def louder(velocity: float) -> bool:
        """Whether a velocity has more than the level wanted, or than the acceleration permitted at the handles."""
        moved = math.sqrt(2) * velocity / case.speed
        if level_at_loudest(case, design.autobalancer, moved) > wanted:
            return True
        return most is not None and total_of(case, design.imbalance.value, design.autobalancer, moved) > most

    low, high = -30.0, math.log(1e3 * velocity_from_level(wanted))
    if louder(math.exp(low)):
        return 0.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if louder(math.exp(middle)) else (middle, high)
    return math.exp(low)
