"""Registry of all effects.

A new effect is a file beside this one and a line here.
"""

from typing import Final

from abu_calc.dynamics.effect import STAGES, Effect
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.lift_off import LiftOffEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect

EFFECTS: Final[tuple[type[Effect], ...]] = (
    GravityEffect,
    DryRollingFrictionEffect,
    BallContactEffect,
    RaceEccentricityEffect,
    GrindingContactEffect,
    LiftOffEffect,
    RunUpEffect,
    MotorEffect,
    TransverseMotionEffect,
)
"""Effects in the order of scene files."""

REGISTRY: Final = tuple((kind.name, kind) for kind in sorted(EFFECTS, key=lambda kind: STAGES.index(kind.stage)))
"""Effects by their names, in the order in which a scene holds them: that of their stages."""
