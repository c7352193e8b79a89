"""Registry of all effects.

A new effect is a file beside this one, a line here, and its table in `inputs.scene_effects`.
"""

from typing import Final

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.lift_off import LiftOffEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect

REGISTRY: Final[tuple[tuple[str, type[Effect]], ...]] = (
    ("run_up", RunUpEffect),
    ("motor", MotorEffect),
    ("race_eccentricity", RaceEccentricityEffect),
    ("transverse_motion", TransverseMotionEffect),
    ("gravity", GravityEffect),
    ("grinding_contact", GrindingContactEffect),
    ("lift_off", LiftOffEffect),
    ("ball_contact", BallContactEffect),
    ("dry_rolling_friction", DryRollingFrictionEffect),
)
"""Effects in the order in which a scene holds them.

Effects that move the rotor and the races come before those that act on the balls. Effects that decide
by all forces come last.
"""
