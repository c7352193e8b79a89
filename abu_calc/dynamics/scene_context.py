"""Circumstances of a scene: all of it but its effects, and what effects tell each other.

An effect may know this of a scene and no more. Axes x, y are inertial; angles (imbalance, balls) are measured in the
rotor from its zero mark, which lies on +x at t = 0, in the sense of rotation (from +x to +y).
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from functools import cached_property
from typing import Any, TypeVar, cast

from abu_calc.dynamics.race import LARGEST, NON_NEGATIVE, Balls, Race, balls_of, finite, same_length
from abu_calc.dynamics.rotor import Rotation
from abu_calc.dynamics.support import SmallMotion, Support, Unbalance
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range

Values = TypeVar("Values")


@dataclass(frozen=True)
class Holding:
    """Dry friction that can hold balls in their places: by how much of their normal force, and what it all weighs."""

    friction: float
    weight: float | None


@dataclass(frozen=True)
class Circumstances(ABC):
    """Speed Ω [rad/s], imbalance m₀e [kg m], its angle [rad], duration [s], start of the support.

    `largest_imbalance` [kg m]: of the machine, where this run has less; what is left is small against it.
    `couple`: χ(J_t − J_p) [kg m²] of a polar axis that leans by χ toward `couple_angle` [rad], on supports that tilt.
    Raises RangeError, InputError.
    """

    name: str
    support: Support
    speed: float
    imbalance: float
    imbalance_angle: float
    races: tuple[Race, ...]
    duration: float
    start_position: tuple[float, ...]
    start_velocity: tuple[float, ...]
    couple: float = 0.0
    couple_angle: float = 0.0
    largest_imbalance: float = 0.0

    def __post_init__(self) -> None:
        Range("speed", 0, LARGEST, "rad/s", open_low=True).check(self.speed)
        Range("imbalance", *NON_NEGATIVE, "kg m").check(self.imbalance)
        Range("duration", self.revolution, LARGEST, "s", remedy="results are means over at least one revolution").check(
            self.duration
        )
        finite("imbalance angle", (self.imbalance_angle,))
        finite("couple imbalance", (self.couple, self.couple_angle))
        self.support.refuse_couples(self.couple, [race.plane_offset for race in self.races])
        for name, values in (("start position", self.start_position), ("start velocity", self.start_velocity)):
            same_length(name, values, len(self.support.names), "support coordinate")
            finite(name, values)

    def by_race(self, values: Values) -> Iterator[tuple[Race, Values]]:
        """Each race with its own of values that all balls have."""
        every, first = cast("Any", values), 0
        for race in self.races:
            yield race, every[first : first + len(race.ball_masses)]
            first += len(race.ball_masses)

    @property
    def revolution(self) -> float:
        """Time of one revolution, 2π/Ω [s]."""
        return 2 * math.pi / self.speed

    @property
    def unbalance(self) -> Unbalance:
        """Imbalance and couple."""
        return Unbalance(self.imbalance, self.imbalance_angle, self.couple, self.couple_angle)

    @property
    def ball_masses(self) -> tuple[float, ...]:
        """Masses of all balls [kg], race by race."""
        return tuple(mass for race in self.races for mass in race.ball_masses)

    @property
    def static_moments(self) -> tuple[float, ...]:
        """m R_p of all balls [kg m], race by race."""
        return tuple(mass * race.pitch_radius for race in self.races for mass in race.ball_masses)

    @property
    def static_moment(self) -> float:
        """Σ m R_p [kg m] of all balls."""
        return sum(self.static_moments)

    @property
    def start_angles(self) -> tuple[float, ...]:
        """Start angles of all balls [rad], race by race."""
        return tuple(angle for race in self.races for angle in race.start_angles)

    @cached_property
    def balls(self) -> Balls:
        """All balls as arrays."""
        return balls_of(self.races)

    @cached_property
    def small_motion(self) -> SmallMotion:
        """Small motion of the support at the scene's speed.

        The balls' mass is at the centres of their races.
        """
        return self.support.small_motion(self.speed).carrying(self.balls)

    # What the effects say of themselves, all together.

    @property
    @abstractmethod
    def rotor(self) -> Rotation:
        """Way in which the rotor turns."""

    @property
    @abstractmethod
    def start_speed(self) -> float:
        """Speed of the rotor at t = 0 [rad/s]."""

    @property
    @abstractmethod
    def run_down(self) -> float:
        """Time [s] at the end in which nothing drives the rotor any more."""

    @property
    @abstractmethod
    def ball_states(self) -> tuple[str, ...]:
        """Names of the states that effects add for each ball, in the order of the state."""

    @property
    @abstractmethod
    def balls_meet(self) -> bool:
        """True if balls have a size and cannot pass each other."""

    @property
    @abstractmethod
    def holding(self) -> Holding | None:
        """Dry friction that can hold balls, if there is any."""
