"""How long a scene of a machine lasts: until what dies out last is gone, within bounds of work."""

import math

import numpy as np

from abu_calc.dynamics.race import Race, balls_of
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.swing_arm import SwingArm
from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate
from abu_calc.sizing.design import Design

DECAY_TIMES = 7.0
LONGEST_REVOLUTIONS = 400.0
LEAST_REVOLUTIONS = 40.0
MOST_CYCLES = 4000.0
"""Of the speed or of the support, whichever is faster: a few seconds of work."""


def settling_duration(design: Design, support: Support, race: Race, ball_rate: float) -> float:
    """Seven decay times [s] of whatever dies out last at full speed, the balls, at their rate [1/s], or the support.

    At least 40 revolutions; at most 400, or three times the settling time permitted.
    """
    case = design.case
    revolution = 2 * math.pi / case.speed
    sway, fastest = free_rates(support, race, case.speed)
    wanted = max(DECAY_TIMES / rate if rate > 0 else math.inf for rate in (ball_rate, sway))
    longest = max(LONGEST_REVOLUTIONS * revolution, 3 * case.table.limits.settling_time_s)
    cap = max(MOST_CYCLES * 2 * math.pi / max(case.speed, fastest), 2 * revolution)
    return min(max(wanted, LEAST_REVOLUTIONS * revolution), longest, cap)


def free_rates(support: Support, race: Race, speed: float) -> tuple[float, float]:
    """Slowest decay rate and largest rate [1/s] of a support's free motion, with the balls' mass in the race."""
    values = np.linalg.eigvals(support.small_motion(speed).carrying(balls_of([race])).motion)
    return -float(values.real.max()), float(np.abs(values).max())


def ball_rate_on_arm(design: Design, arm: SwingArm) -> float:
    """Slowest decay rate of the balls' slow motion [1/s] on an arm.

    There the rotor moves along one axis alone, so that half the stiffness of the slow motion is left.
    """
    case, one = design.case, design.autobalancer
    mass = arm.felt_mass + one.ball_count * one.ball_mass
    natural = math.sqrt(max(arm.stiffness, 0.0) / mass)
    kappa = ball_stiffness(one.ball_mass, mass, case.speed, (natural, natural)) / 2
    return decay_rate((kappa,) * one.ball_count, one.budget.resting_angles, case.drag, case.inertia_factor)
