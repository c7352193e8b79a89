"""Worst residual displacement: friction holds the axis farthest off, and all parts are in line."""

import math
from functools import lru_cache

from abu_calc.formulas.suspension import dynamic_stiffness
from abu_calc.formulas.worst_friction import worst_friction
from abu_calc.frozen import dataclass
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import accuracy_budget, judged_speeds
from abu_calc.sizing.case import Case

_friction = lru_cache(maxsize=64)(worst_friction)
"""Worst friction, cached: races that differ only in their eccentricity have the same."""


@dataclass(frozen=True)
class WorstResidual:
    """Displacements 0–peak at the wheel [m] at one speed [rad/s]; `angles`: where the balls then stand [rad]."""

    speed: float
    rolling_friction: float
    angles: tuple[float, ...]
    residual: float


def worst_residuals(case: Case, imbalance: float, candidate: Candidate) -> tuple[WorstResidual, ...]:
    """Worst residual displacements at each of the judged speeds, in their order."""
    return tuple(_worst(case, imbalance, candidate, speed) for speed in judged_speeds(case))


def _worst(case: Case, imbalance: float, candidate: Candidate, speed: float) -> WorstResidual:
    """Plain sum of the parts, the race made oval by all balls in two opposite groups."""
    balls, need = candidate.balls, candidate.requirement
    usual = accuracy_budget(case, imbalance, need, balls, candidate.budget.resting_angles, speed)
    mass, carried = case.body.effective_mass(candidate.mass, case.race_place), imbalance * abs(need.plane_ratio)
    flexible = [speed**2 / dynamic_stiffness(case.suspension, axis, speed, mass) for axis in (0, 1)]
    band = case.friction_arm * balls.pitch_radius / balls.radius
    held = _friction(balls.count, balls.moment, band, carried, sum(flexible) / 2)
    friction = max(held.displacement, usual.rolling_friction)
    parts = usual.race_eccentricity, friction, balls.count / 2 * usual.race_ovality, usual.plane_offset
    return WorstResidual(speed, friction, held.angles, math.fsum(parts) + usual.shortfall)
