"""All effects there are. A new one is a file beside this one, a line here, and its table in `spec.scene_effects`."""

from typing import Final

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.ball_contact import BallContact
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFriction
from abu_calc.dynamics.effects.gravity import Gravity
from abu_calc.dynamics.effects.grinding_contact import GrindingContact
from abu_calc.dynamics.effects.lift_off import LiftOff
from abu_calc.dynamics.effects.motor import Motor
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricity
from abu_calc.dynamics.effects.run_up import RunUp
from abu_calc.dynamics.effects.transverse_motion import TransverseMotion

REGISTRY: Final[tuple[tuple[str, type[Effect]], ...]] = (
    ("run_up", RunUp),
    ("motor", Motor),
    ("race_eccentricity", RaceEccentricity),
    ("transverse_motion", TransverseMotion),
    ("gravity", Gravity),
    ("grinding_contact", GrindingContact),
    ("lift_off", LiftOff),
    ("ball_contact", BallContact),
    ("dry_rolling_friction", DryRollingFriction),
)
"""Effects in the order in which a scene holds them.

Effects that move the rotor and the races come before those that act on the balls. Effects that decide
by all forces come last.
"""
