"""How long a scene of a machine lasts: until what dies out last is gone, within bounds of work."""

import math

import numpy as np

from abu_calc.dynamics.supports.kinds import Support, SwingArm
from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate
from abu_calc.sizing.design import Design

DECAY_TIMES = 7.0
LONGEST_REVOLUTIONS = 400.0
LEAST_REVOLUTIONS = 40.0
MOST_CYCLES = 4000.0
"""Of the speed or of the support, whichever is faster: a few seconds of work."""


def settling_duration(design: Design, support: Support) -> float:
    """Seven decay times [s] of whatever dies out last at full speed, the balls or the support's own sway.

    At least 40 revolutions; at most 400, or three times the settling time permitted.
    """
    case, one = design.case, design.autobalancer
    revolution = 2 * math.pi / case.speed
    sway, fastest = _rates(support, one.ball_count * one.ball_mass)
    wanted = max(DECAY_TIMES / rate if rate > 0 else math.inf for rate in (_ball_rate(design, support), sway))
    longest = max(LONGEST_REVOLUTIONS * revolution, 3 * case.table.limits.settling_time_s)
    cap = max(MOST_CYCLES * 2 * math.pi / max(case.speed, fastest), 2 * revolution)
    return min(max(wanted, LEAST_REVOLUTIONS * revolution), longest, cap)


def _rates(support: Support, balls: float) -> tuple[float, float]:
    """Slowest decay rate and largest rate [1/s] of the support's free motion, with that mass [kg] in its races."""
    if isinstance(support, SwingArm):
        square = support.length**2
        M = np.array([[support.inertia + balls * square]])
        K, C = np.array([[support.stiffness * square]]), np.array([[support.damping * square]])
    else:
        P = np.array(support.race_map)
        M = np.array(support.mass) + balls * P.T @ P
        K, C = np.array(support.stiffness), np.array(support.damping)
    unit = np.eye(len(M))
    values = np.linalg.eigvals(np.block([[0 * unit, unit], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]]))
    return -float(values.real.max()), float(np.abs(values).max())


def _ball_rate(design: Design, support: Support) -> float:
    """Slowest decay rate of the balls' slow motion [1/s].

    On an arm the rotor moves along one axis alone, so that half the stiffness of the slow motion is left.
    """
    if not isinstance(support, SwingArm):
        return design.track.decay_rates[0][1]
    case, one = design.case, design.autobalancer
    mass = support.inertia / support.length**2 + one.ball_count * one.ball_mass
    natural = math.sqrt(max(support.stiffness, 0.0) / mass)
    kappa = ball_stiffness(one.ball_mass, mass, case.speed, (natural, natural)) / 2
    return decay_rate((kappa,) * one.ball_count, one.budget.resting_angles, case.drag, case.inertia_factor)
