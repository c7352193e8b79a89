"""Scenes at random, over all supports and effects: what a user may ask for, and much that no one should.

Masses 10 g … 10 t, speeds 1 … 300 000 rpm below, at and above resonance, none or much damping, drag 0 … 1e5 1/s,
2 … 20 balls, unequal, heavy, too few for the imbalance, packed so that they hardly move, started bunched, spread, at
random, or standing still in space.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.scene import Race, Scene, placed
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.planar import LinearSupport, PlanarSupport, planar
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.foundation.units import GRAVITY

RPM = math.pi / 30
MOST_RADIANS = 1500.0
"""Of the fastest motion of a scene: what a run lasts, so that five hundred of them end on the same day."""

SUPPORTS = ("planar", "hand", "tilting", "swing arm")


@dataclass(frozen=True)
class Dice:
    """Draws of one scene."""

    rng: np.random.Generator

    def log(self, low: float, high: float) -> float:
        """A number whose logarithm is even."""
        return float(np.exp(self.rng.uniform(math.log(low), math.log(high))))

    def even(self, low: float, high: float) -> float:
        """A number between two."""
        return float(self.rng.uniform(low, high))

    def often(self, share: float) -> bool:
        """True in this share of draws."""
        return bool(self.rng.random() < share)


@dataclass(frozen=True)
class Rotor:
    """What the parts of a scene share: speed [rad/s], natural frequency of the support, mass and size of the rotor."""

    speed: float
    frequency: float
    mass: float
    radius: float


def random_scene(seed: int) -> Scene:
    """Always the same scene for a seed."""
    dice = Dice(np.random.default_rng(seed))
    kind = SUPPORTS[int(dice.rng.integers(len(SUPPORTS)))]
    mass, speed = dice.log(0.01, 1e4), dice.log(1, 3e5) * RPM
    # From a shaft of a drill of 10 g to a drum: a tenth of a metre for 5 kg, more or less.
    radius = 0.1 * (mass / 5) ** (1 / 3) * dice.log(0.3, 3)
    ratio = dice.log(0.02, 0.8) if dice.often(0.8) else dice.log(0.8, 3)
    rotor = Rotor(speed, ratio * speed, mass, radius)
    support = _support(kind, rotor, dice)
    first = _race(rotor, 10 if kind == "tilting" else 20, dice)
    races = [first]
    if kind == "tilting":
        places = dice.even(0.1, 0.8) * radius, -dice.even(0.1, 0.8) * radius
        races = [replace(first, plane_offset=z) for z in places]
    moment = sum(race.static_moment for race in races)
    rest = (0.0,) * len(support.names)
    scene = Scene(
        name=f"{kind} {seed}",
        support=support,
        speed=speed,
        # Now and then more than the balls can carry, or next to nothing.
        imbalance=moment * (dice.even(0.05, 0.9) if dice.often(0.8) else dice.log(1e-4, 2)),
        imbalance_angle=dice.even(-math.pi, math.pi),
        races=tuple(races),
        duration=2 * math.pi / speed,
        start_position=rest,
        start_velocity=rest,
        couple=moment * radius * dice.even(0, 0.2) if kind == "tilting" and dice.often(0.5) else 0.0,
    )
    scene = replace(scene, duration=_duration(scene, rotor, dice))
    scene = replace(scene, effects=_effects(scene, rotor, dice))
    return placed(scene)


def _support(kind: str, rotor: Rotor, dice: Dice) -> Support:
    mass, w = rotor.mass, rotor.frequency
    zeta = 0.0 if dice.often(0.15) else dice.log(1e-3, 1)
    k, b = mass * w**2, 2 * zeta * mass * w
    ky = k * (1.0 if dice.often(0.5) else dice.log(0.3, 3))
    if kind == "swing arm":
        length = rotor.radius * dice.even(2, 6)
        return SwingArmSupport(length, mass * length**2 * dice.even(1.1, 2), k, b)
    if kind == "tilting":
        inertia = mass * rotor.radius**2 * dice.even(0.3, 1.5)
        place = rotor.radius * dice.even(0.4, 1.5)
        polar = inertia * dice.even(0.1, 1.8)
        return tilting(
            mass, inertia, polar, (place, -place), [(k / 2, ky / 2)] * 2, [(b / 2, b / 2)] * 2, dice.often(0.5)
        )
    own = planar(mass, (k, ky), (b, b))
    return own if kind == "planar" else _with_hand(own, dice)


def _with_hand(own: LinearSupport, dice: Dice) -> LinearSupport:
    """A further mass on spring and damper."""
    share = dice.even(0.05, 0.5)
    M, C, K = (np.array(matrix) for matrix in (own.mass, own.damping, own.stiffness))
    link = np.array(((1.0, -1.0), (-1.0, 1.0)))
    ground = np.diag((1.0, 0.0))
    return PlanarSupport(
        mass=_rows(np.kron(np.diag((1.0, share)), M)),
        damping=_rows(np.kron(ground, C) + share * np.kron(link, C)),
        stiffness=_rows(np.kron(ground, K) + share * np.kron(link, K)),
        race_map=_rows(np.eye(2, 4)),
        names=("x", "y", "hand_x", "hand_y"),
    )


def _rows(matrix: np.ndarray) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row) for row in matrix.tolist())


def _race(rotor: Rotor, most: int, dice: Dice) -> Race:
    count = int(dice.rng.integers(2, most + 1)) if dice.often(0.3) else int(dice.rng.integers(2, 7))
    share = dice.log(1e-4, 0.03) if dice.often(0.9) else dice.even(0.03, 0.3)
    pitch = rotor.radius * dice.even(0.3, 1)
    # Sizes from beads to balls that fill nine tenths of the race.
    radius = pitch * math.sin(math.pi / count * dice.even(0.1, 0.9))
    radius = min(radius, 0.45 * pitch)
    spread = dice.even(0, 0.3) if dice.often(0.2) else 0.0
    masses = rotor.mass * share / count * (1 + spread * dice.rng.uniform(-1, 1, count))
    drag = 0.0 if dice.often(0.07) else dice.log(1e-3, 0.3) * rotor.speed if dice.often(0.9) else dice.log(1, 1e5)
    speeds = (-rotor.speed if dice.often(0.15) else 0.0,) * count
    angles = _angles(count, 2 * math.asin(radius / pitch), dice)
    factor = float(dice.rng.choice((1.0, 1.4, 1.5)))
    return Race(pitch, tuple(masses.tolist()), drag, factor, angles, speeds, 0.0, radius)


def _angles(count: int, least: float, dice: Dice) -> tuple[float, ...]:
    """Bunched, spread, or at random, no two balls in one place."""
    first, kind = dice.even(-math.pi, math.pi), dice.rng.random()
    room = 2 * math.pi - count * least
    shares = np.zeros(count) if kind < 0.3 else np.ones(count) if kind < 0.5 else dice.rng.exponential(1, count)
    slack = room * shares / max(shares.sum(), 1.0) if kind < 0.3 else room * shares / shares.sum()
    # Bunched balls touch but for a millionth.
    steps = least * (1 + 1e-6) + slack if kind < 0.3 else least + slack
    return tuple((first + np.concatenate([[0.0], np.cumsum(steps)[:-1]])).tolist())


def _duration(scene: Scene, rotor: Rotor, dice: Dice) -> float:
    """Some tens of revolutions, fewer where something else is much faster than the rotor."""
    radius = scene.races[0].pitch_radius
    swing = math.sqrt(GRAVITY / radius)
    # Balls that gravity keeps tumbling soon forget where they came from.
    tumbling = 10 if radius * scene.speed**2 < GRAVITY else 1
    fastest = max(scene.speed, 2 * rotor.frequency, tumbling * swing)
    wanted = dice.log(8, 80) * scene.revolution
    return max(min(wanted, MOST_RADIANS / fastest), scene.revolution)


def _effects(scene: Scene, rotor: Rotor, dice: Dice) -> tuple[Effect, ...]:
    """Each now and then, in the order of the registry."""
    race, found = scene.races[0], []
    radius = race.ball_radius
    if dice.often(0.12):
        parts = dice.even(0.2, 0.6) * scene.duration, (dice.even(0.1, 0.3) * scene.duration if dice.often(0.3) else 0.0)
        found.append(RunUpEffect(*parts))
    if dice.often(0.12):
        inertia = rotor.mass * rotor.radius**2 * dice.even(0.2, 0.5)
        torque = inertia * rotor.speed / scene.duration * dice.log(0.3, 10)
        found.append(MotorEffect(torque, rotor.speed * dice.even(1.0, 1.2), inertia))
    whirl = scene.static_moment / rotor.mass
    if dice.often(0.3):
        found.append(RaceEccentricityEffect(whirl * dice.log(1e-3, 1), dice.even(-3, 3)))
    if dice.often(0.1) and not isinstance(scene.support, SwingArmSupport):
        found.append(
            TransverseMotionEffect(
                race.pitch_radius * dice.even(0.6, 1), radius, whirl * dice.log(1e-3, 0.3), dice.often(0.3)
            )
        )
    if dice.often(0.3):
        found.append(GravityEffect())
    if dice.often(0.15) and not isinstance(scene.support, SwingArmSupport):
        found.append(_contact(scene, rotor, whirl, dice))
    if dice.often(0.3):
        found.append(BallContactEffect(radius, dice.even(0, 1)))
    if dice.often(0.3):
        found.append(DryRollingFrictionEffect(radius * dice.log(1e-6, 1e-2), radius))
    return tuple(found)


def _contact(scene: Scene, rotor: Rotor, whirl: float, dice: Dice) -> Effect:
    """Work pressed against the wheel about as hard as an imbalance pulls; stiff, soft or rigid."""
    rigid = dice.often(0.3)
    force = rotor.mass * whirl * rotor.speed**2 * dice.log(0.03, 3)
    return GrindingContactEffect(
        press_force=force,
        cutting_coefficient=dice.even(0, 0.5),
        contact="rigid" if rigid else "compliant",
        contact_stiffness=0.0 if rigid else rotor.mass * rotor.speed**2 * dice.log(0.01, 3),
        rotation_sense=-1 if dice.often(0.7) else 1,
        runout=whirl * dice.log(1e-3, 1) if dice.often(0.7) else 0.0,
        runout_angle=dice.even(-3, 3),
        wheel_radius=rotor.radius * 1.2,
        plane_offset=0.0,
    )
