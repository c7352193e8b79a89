"""Every effect of the registry by example, and how its numbers look in other units, turned, and in a mirror.

What the tests of all effects ask of a new one stands here.
"""

from dataclasses import replace

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

CONTACT = GrindingContactEffect(0.7, 0.35, "compliant", 2.0, -1, 0.1, 0.8, 1.1)
EXAMPLES: dict[str, Effect] = {
    "run_up": RunUpEffect(3.0, 2.0, 0.7),
    "motor": MotorEffect(2.0, 3.0, 6.0),
    "race_eccentricity": RaceEccentricityEffect(0.05, 0.3),
    "transverse_motion": TransverseMotionEffect(0.7, 0.1, 0.02),
    "transverse_motion, free spin": TransverseMotionEffect(0.7, 0.1, 0.02, free_spin=True),
    "gravity": GravityEffect(0.3),
    "grinding_contact": CONTACT,
    "grinding_contact, rigid": replace(CONTACT, contact="rigid", contact_stiffness=0.0),
    "grinding_contact, face": replace(CONTACT, contact="face", contact_stiffness=0.0),
    "lift_off": LiftOffEffect(1.2, 1.3, 0.05, 0.06),
    "ball_contact": BallContactEffect(0.1, 0.5),
    "dry_rolling_friction": DryRollingFrictionEffect(0.02, 0.1),
}
"""Numbers that fit `scene_on`, some effects in several ways."""

NOTHING: list[Effect] = [
    RaceEccentricityEffect(0.0, 0.3),
    GravityEffect(0.0),
    replace(CONTACT, press_force=0.0, contact_stiffness=1e-300),
    replace(CONTACT, press_force=0.0, contact="face", contact_stiffness=0.0),
    BallContactEffect(0.1, 0.5),
    DryRollingFrictionEffect(0.0, 0.1),
]
"""Effects without strength, or with nothing to act on, which need no states."""

WEIGHTLESS = [effect for effect in NOTHING if not (effect.balls_meet or getattr(effect, "contact_stiffness", 0.0))]
"""Those whose influence is estimated as none: balls of some size meet, and a soft contact has its own tests."""

STATES: dict[str, list[str]] = {
    "run_up": ["turn", "turn'"],
    "motor": ["turn", "turn'"],
    "transverse_motion": [f"across{k}" for k in range(1, 6)] + [f"across'{k}" for k in range(1, 6)],
    "transverse_motion, free spin": [f"{name}{k}" for name in ("across", "across'", "spin") for k in range(1, 6)],
}
"""States that effects add to a scene of five balls."""

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
    return replace(effect, angle=effect.angle + angle) if isinstance(effect, RaceEccentricityEffect) else effect


def mirrored_effect(effect: Effect, whole: float) -> Effect:
    """An angle becomes `whole` less the angle; that is 0 where up and down change places."""
    if isinstance(effect, RaceEccentricityEffect):
        return replace(effect, angle=whole - effect.angle)
    if isinstance(effect, GravityEffect) and whole == 0:
        return replace(effect, acceleration=-effect.acceleration)
    if isinstance(effect, LiftOffEffect):
        return replace(effect, touch_angle=-effect.touch_angle, depth=-effect.depth)
    if isinstance(effect, MotorEffect):
        return replace(effect, stall_torque=-effect.stall_torque, no_load_speed=-effect.no_load_speed)
    if isinstance(effect, GrindingContactEffect):
        # The direction of rotation is told by s: T drives or brakes as before.
        return replace(effect, rotation_sense=-effect.rotation_sense, runout_angle=whole - effect.runout_angle)
    return effect
