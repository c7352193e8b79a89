"""Circumstances of a scene: all of it but its effects, and what effects tell each other.

An effect may know this of a scene and no more. Axes x, y are inertial; angles (imbalance, balls) are measured in the
rotor from its zero mark, which lies on +x at t = 0, in the sense of rotation (from +x to +y).

Interface of a support, which carries a rotor.

The kinds are in `supports/`, one file each. No other code asks for the kind: whatever a kind needs is behind one of
these names.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Final, Self, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.rotor import (
    LARGEST,
    NON_NEGATIVE,
    Balls,
    Frame,
    Geometry,
    Race,
    Rotation,
    balls_of,
    finite,
    same_length,
)
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.reading.table import Table

if TYPE_CHECKING:
    from abu_calc.formulas.swing_arm import Arm


Complex = NDArray[np.complex128]
Array = NDArray[np.float64]

STILL: Final = 1e-6
"""Rates of motions, as a share of the fastest, that are none, or the same."""


@dataclass(frozen=True)
class Unbalance:
    """m₀e [kg m] at an angle [rad], and the couple χ(J_t − J_p) [kg m²] at another."""

    static: float
    angle: float
    couple: float
    couple_angle: float


@dataclass(frozen=True)
class SmallMotion:
    """M q'' + C q' + K q = Pᵀ F: motion of the N coordinates about rest, by forces F on the frame; what the speed adds
    stands in C. The frame moves by P q: x and y, or these and two tilts.
    """

    mass: Array
    damping: Array
    stiffness: Array
    frame: Array

    def carrying(self, balls: Balls) -> "SmallMotion":
        """The same with the balls' mass at the centres of their races."""
        P = self.frame
        return replace(self, mass=self.mass + P.T @ balls.mass(len(P)) @ P)

    def dynamic_stiffness(self, frequency: float) -> Complex:
        """D = K − ν²M + iνC, N × N: forces on the coordinates by a unit motion e^{iνt} of each; ν [rad/s]."""
        D = self.stiffness - frequency**2 * self.mass + 1j * frequency * self.damping
        return np.asarray(D, dtype=complex)

    def answer(self, frequency: float) -> tuple[Complex, Complex]:
        """D⁻¹ Pᵀ and its slope over ν: motion of the coordinates by unit forces on the frame [m/N, m s/N]."""
        D = self.dynamic_stiffness(frequency)
        right = np.linalg.solve(D, self.frame.T)
        slope = np.linalg.solve(D, (2 * frequency * self.mass - 1j * self.damping) @ right)
        return np.asarray(right, dtype=complex), np.asarray(slope, dtype=complex)

    def receptance(self, frequency: float) -> Complex:
        """h = P D⁻¹ Pᵀ [m/N]: motion of the frame by a unit force e^{iνt} on it; ν [rad/s].

        Raises InputError at a resonance that nothing damps.
        """
        try:
            moved = self.frame @ np.linalg.solve(self.dynamic_stiffness(frequency), self.frame.T)
        except np.linalg.LinAlgError:
            raise undamped_resonance(frequency) from None
        return np.asarray(moved, dtype=complex)

    def left_of_stiffness(self, frequency: float) -> float:
        """Least stiffness of any motion at this frequency, as a share of what springs and inertia have each."""
        size = np.sqrt(np.abs(np.diag(self.stiffness)) + frequency**2 * np.diag(self.mass))
        relative = self.dynamic_stiffness(frequency) / np.outer(size, size)
        return float(np.linalg.svd(relative, compute_uv=False).min())

    @property
    def motion(self) -> Array:
        """A of the free motion z' = A z, z = (q, q')."""
        size = len(self.mass)
        lower = -np.linalg.solve(self.mass, np.hstack([self.stiffness, self.damping]))
        return np.vstack([np.eye(size, 2 * size, size), lower])

    def swinging(self, force: Array, t: float) -> float:
        """The most the axis [m] swings at t about the place to which a force on the frame moves it from t = 0 on."""
        values, V = np.linalg.eig(self.motion)
        push = np.linalg.solve(self.mass, self.frame.T @ force)
        shares = np.linalg.solve(V, np.concatenate([0 * push, push]).astype(complex))
        limit = STILL * np.abs(values).max()
        moving = np.abs(values) > limit  # a coordinate that nothing holds goes away
        values, shares, places = values[moving], shares[moving], V[: len(push), moving]
        left = self.frame[:2] @ places * (shares / values * np.exp(values * t))
        # Motions of one rate count as one, however they are named.
        alike = np.abs(values[:, None] - values) < limit
        return float((np.abs(left @ alike) / alike.sum(axis=0)).sum())


def undamped_resonance(speed: float) -> InputError:
    """The error that says so."""
    return InputError(
        "the speed is a natural frequency of the support, which nothing damps: no steady amplitude to compare with",
        found=f"{speed:g} rad/s",
        remedy="give the support some damping, or another speed",
    )


class Support(ABC):
    """Support of a rotor.

    Kinds are frozen dataclasses; their fields are their numbers in SI, without balls.
    """

    names: tuple[str, ...]
    """Names of the coordinates q."""
    couples: ClassVar[bool] = False
    """True if the support tilts: it then takes couples and places along the spindle into account."""
    turns: ClassVar[bool] = False
    """True if the support's motion turns the rotor and the races too.

    The inertia of the imbalance in it then varies, and the state half a turn of the rotor later is not the
    same upside down.
    """

    @property
    def straight(self) -> bool:
        """True if the support neither tilts nor turns what it holds."""
        return not (self.couples or self.turns)

    bearings: tuple[float, ...] = ()
    """Places along the spindle [m] where motion is reported beside that of the axis."""

    # What a scene file says of it.

    kind: ClassVar[str]
    """Value of the key `support`."""
    about: ClassVar[str]
    """Meaning of that value in a few words."""
    needs: ClassVar[tuple[str, ...]]
    """Keys of the scene that it needs."""
    keys: ClassVar[Mapping[str, type[Table]]]
    """Tables of the scene that only it takes."""

    @classmethod
    def of(cls, scene: Any) -> Self:
        """The support of the tables of a scene file. Raises InputError."""
        raise NotImplementedError

    def started(self, scene: Any) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Places and velocities at the start: the axis, the first two, as the file says, all else at rest."""
        start, rest = scene.initial, (0.0,) * (len(self.names) - 2)
        return (start.x, start.y, *rest), (start.vx, start.vy, *rest)

    # What the equations need.

    @abstractmethod
    def frame(self, balls: Balls) -> Frame:
        """The frame, without the row of a driven rotor. Raises InputError for a mass that is none."""

    @abstractmethod
    def geometry(self, unbalance: Unbalance) -> Geometry:
        """Geometry by which the support carries the races, and the action of an imbalance on it."""

    @property
    @abstractmethod
    def felt_mass(self) -> float:
        """Mass [kg] that a force in the race plane meets."""

    @abstractmethod
    def shares(self, races: Sequence[Race]) -> list[float]:
        """Displacement of the races by a unit of each coordinate [m]."""

    # How it moves about rest.

    @abstractmethod
    def small_motion(self, speed: float) -> SmallMotion:
        """Small motion about rest while the rotor turns at a speed [rad/s], without balls."""

    @abstractmethod
    def holding(self, balls: Balls) -> Self:
        """The support with balls that stand still in their races, and move as these do."""

    @abstractmethod
    def resonances(self, balls: Balls) -> list[float]:
        """Speeds [rad/s] of resonance, forced or parametric, with the balls held."""

    @abstractmethod
    def resting_position(self, force: tuple[float, float] = (0.0, 0.0)) -> tuple[float, ...]:
        """q where it stands under a constant force [N] on the axis. Raises InputError where it does not stand."""

    def without_steady_force(self) -> Self:
        """The same without a constant force of its own, which only moves the place where it stands."""
        return self

    def standing_arm(self, balls: Balls) -> "Arm | None":
        """A swing arm with balls that stand in the race, no contact of its own told apart; None: it is none."""
        return None

    def critical_damping(self, imbalance: float, balls: Balls) -> float | None:
        """Damping [N·s/m] that parametric resonance by an imbalance [kg m] cannot overcome, if there is any."""
        return None

    def not_averaged(self, position: Sequence[float], velocity: Sequence[float]) -> str | None:
        """Why its motion from such a start cannot be averaged over turns; None where it can."""
        return None

    # Where things are.

    @abstractmethod
    def axis(self, q: Array, plane: float = 0.0) -> Array:
        """x, y of the axis [m] at a plane z [m] from the centre of mass, for places q [coordinate, time]."""

    @abstractmethod
    def axis_velocity(self, q: Array, rates: Array) -> Array:
        """Velocity of the axis [m/s], likewise."""

    def plane(self, z: float) -> Array:
        """2 × N: x and y of the axis at z [m] per unit of each coordinate, where work is pressed to a wheel there.

        Raises InputError where there is no such place.
        """
        raise InputError("no work can be pressed to a wheel on this support")

    def tilt(self, q: Array) -> tuple[float, float] | None:
        """Lean of the spindle toward x and y [rad]; None if it cannot lean."""
        return None

    def turned(self, q: Array) -> Any:
        """Angle by which the support turns the rotor and the races [rad]; None if it does not."""
        return None

    def lost(self, t: Array, q: Array) -> NotTrustworthyError | None:
        """Error to raise for a motion that left the range of the support; None if it did not."""
        return None

    def refuse_couples(self, couple: float, places: Sequence[float]) -> None:
        """Raises InputError for a couple or places along the spindle that it does not know."""
        if not self.couples and (couple or any(places)):
            raise InputError("only a support that tilts knows a couple and places along the spindle")

    # What is reported of it.

    @property
    @abstractmethod
    def description(self) -> str:
        """Description of the support in a few words, the first of them with a capital letter."""

    @abstractmethod
    def model(self) -> dict[str, Any]:
        """Numbers of the support in SI, by their names with units."""


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
