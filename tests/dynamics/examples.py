"""Every effect of the registry by example, and how its numbers look in other units, turned, and in a mirror.

What the tests of all effects ask of a new one stands here.
"""

from dataclasses import replace

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

CONTACT = GrindingContact(0.7, 0.35, "compliant", 2.0, -1, 0.1, 0.8, 1.1)
EXAMPLES: dict[str, Effect] = {
    "run_up": RunUp(3.0, 2.0, 0.7),
    "motor": Motor(2.0, 3.0, 6.0),
    "race_eccentricity": RaceEccentricity(0.05, 0.3),
    "transverse_motion": TransverseMotion(0.7, 0.1, 0.02),
    "transverse_motion, free spin": TransverseMotion(0.7, 0.1, 0.02, free_spin=True),
    "gravity": Gravity(0.3),
    "grinding_contact": CONTACT,
    "grinding_contact, rigid": replace(CONTACT, contact="rigid", contact_stiffness=0.0),
    "grinding_contact, face": replace(CONTACT, contact="face", contact_stiffness=0.0),
    "lift_off": LiftOff(1.2, 1.3, 0.05, 0.06),
    "ball_contact": BallContact(0.1, 0.5),
    "dry_rolling_friction": DryRollingFriction(0.02, 0.1),
}
"""Numbers that fit `scene_on`, some effects in several ways."""

NOTHING: list[Effect] = [
    RaceEccentricity(0.0, 0.3),
    Gravity(0.0),
    replace(CONTACT, press_force=0.0, contact_stiffness=1e-300),
    replace(CONTACT, press_force=0.0, contact="face", contact_stiffness=0.0),
    BallContact(0.1, 0.5),
    DryRollingFriction(0.0, 0.1),
]
"""Effects without strength, or with nothing to act on, which need no states."""

UNITS: dict[str, tuple[int, int, int]] = {
    "magnitude": (1, 0, 0),
    "acceleration": (1, 0, -2),
    "up": (0, 0, 1),
    "down": (0, 0, 1),
    "stall_torque": (2, 1, -2),
    "no_load_speed": (0, 0, -1),
    "inertia": (2, 1, 0),
    "lever_arm": (1, 0, 0),
    "ball_radius": (1, 0, 0),
    "groove_radius": (1, 0, 0),
    "axial_runout": (1, 0, 0),
    "press_force": (1, 1, -2),
    "contact_stiffness": (0, 1, -2),
    "runout": (1, 0, 0),
    "wheel_radius": (1, 0, 0),
    "plane_offset": (1, 0, 0),
    "stiffness": (0, 1, -2),
    "length": (1, 0, 0),
}
"""Powers of length, mass and time in the fields of the effects that have units."""

HELD = ("gravity", "grinding_contact", "grinding_contact, rigid", "grinding_contact, face", "lift_off")
"""Effects whose direction in space cannot be told another."""


def turned_effect(effect: Effect, angle: float) -> Effect:
    """The effect's own direction turned; of one that has none, itself."""
    return replace(effect, angle=effect.angle + angle) if isinstance(effect, RaceEccentricity) else effect


def mirrored_effect(effect: Effect, whole: float) -> Effect:
    """An angle becomes `whole` less the angle; that is 0 where up and down change places."""
    if isinstance(effect, RaceEccentricity):
        return replace(effect, angle=whole - effect.angle)
    if isinstance(effect, Gravity) and whole == 0:
        return replace(effect, acceleration=-effect.acceleration)
    if isinstance(effect, LiftOff):
        return replace(effect, touch_angle=-effect.touch_angle, depth=-effect.depth)
    if isinstance(effect, Motor):
        return replace(effect, stall_torque=-effect.stall_torque, no_load_speed=-effect.no_load_speed)
    if isinstance(effect, GrindingContact):
        # The direction of rotation is told by s: T drives or brakes as before.
        return replace(effect, rotation_sense=-effect.rotation_sense, runout_angle=whole - effect.runout_angle)
    return effect
