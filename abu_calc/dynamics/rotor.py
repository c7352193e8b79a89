"""Ways in which a rotor turns: at constant speed, with a given acceleration, or by a torque.

Each way answers for itself.

Races and their balls.

Numbers of a scene in SI, combined once so that an evaluation of the equations needs few operations.
"""

import sys
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from typing import Any, ClassVar, Final, final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.motion import AnyArray, Levers, Motion
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range


class Rotation(ABC):
    """One way of turning. Turn and speed are counted from what carries the rotor, an arm for instance."""

    states: ClassVar[tuple[str, ...]] = ("turn", "turn'")
    """Names of the states that the rotor adds."""
    rows: ClassVar[int] = 0
    """Number of rows that the rotor adds to the frame.

    The rotor's own acceleration is one more unknown besides the support's, or none.
    """
    given: ClassVar[bool] = False
    """True if the acceleration of the rotor is given, and may be other than zero."""

    @abstractmethod
    def turning(self, t: Any, y: Any, speed: Any) -> tuple[Any, Any]:
        """Turn and speed [rad, rad/s] of a state y, or of many, in a scene of that speed."""

    def start(self, speed: float) -> tuple[float, ...]:
        """States of the rotor at t = 0."""
        return (0.0, speed)

    def rates(self, y: Any, acceleration: Any) -> list[AnyArray]:
        """Time derivatives of its states."""
        return [np.array((y[-1], acceleration))]

    def acceleration(self, m: Motion, A: AnyArray) -> Any:
        """Acceleration of the rotor [rad/s²], from that of the frame."""
        return m.acceleration

    def carry(self, m: Motion, levers: Levers, leaning: Any = None) -> Levers:
        """The levers with what a changing speed does to races; `leaning`: way along the spindle per turn of it [m]."""
        return levers

    @abstractmethod
    def unbalanced(
        self, m: Motion, force: AnyArray, weight: Any, coupling: Callable[[], Any], own: Callable[[], Any]
    ) -> tuple[AnyArray, Any]:
        """Force of an imbalance on the frame and what it weighs there, by those on the support at constant speed.

        `coupling` (d): its inertia between frame and turning; `own`: torque on the rotor at a constant speed [N m].
        """

    def on_frame(self, forces: Any, torque: Any) -> AnyArray:
        """Forces on the frame with a torque on the rotor."""
        return np.array(forces)


@final
class SteadyRotation(Rotation):
    """Rotation at constant speed: the turn is speed times time."""

    states = ()

    def turning(self, t: Any, y: Any, speed: Any) -> tuple[Any, Any]:
        """Ωt and Ω."""
        return speed * t, speed

    def start(self, speed: float) -> tuple[float, ...]:
        """There are none."""
        return ()

    def rates(self, y: Any, acceleration: Any) -> list[AnyArray]:
        """There are none."""
        return []

    def unbalanced(
        self, m: Motion, force: AnyArray, weight: Any, coupling: Callable[[], Any], own: Callable[[], Any]
    ) -> tuple[AnyArray, Any]:
        """Force and weight, unchanged."""
        return force, weight


@final
class Guided(Rotation):
    """Rotation with a given acceleration: turn and speed are states."""

    given = True

    def turning(self, t: Any, y: Any, speed: Any) -> tuple[Any, Any]:
        """The last two states."""
        return y[-2], y[-1]

    def carry(self, m: Motion, levers: Levers, leaning: Any = None) -> Levers:
        """The races are carried along."""
        if levers.axial is not None:
            levers.axial.carried = levers.axial.carried + leaning * m.acceleration
        levers.carry(m.radii * m.acceleration, 0.0 * m.radii)
        return levers

    def unbalanced(
        self, m: Motion, force: AnyArray, weight: Any, coupling: Callable[[], Any], own: Callable[[], Any]
    ) -> tuple[AnyArray, Any]:
        """Less what it takes to accelerate the imbalance."""
        return force - m.acceleration * coupling(), weight


@final
class Driven(Rotation):
    """Rotation by torques: turn and speed are states.

    The acceleration is one of the frame's, the last.
    """

    rows = 1

    def turning(self, t: Any, y: Any, speed: Any) -> tuple[Any, Any]:
        """The last two states."""
        return y[-2], y[-1]

    def acceleration(self, m: Motion, A: AnyArray) -> Any:
        """The frame's last."""
        return A[-1]

    def carry(self, m: Motion, levers: Levers, leaning: Any = None) -> Levers:
        """One row more."""
        if levers.axial is not None:
            levers.axial.lever = np.array([*levers.axial.lever, leaning])
        levers.along = np.vstack([levers.along, m.radii])
        levers.outward = np.vstack([levers.outward, 0.0 * m.radii])
        levers.mass = None
        return levers

    def unbalanced(
        self, m: Motion, force: AnyArray, weight: Any, coupling: Callable[[], Any], own: Callable[[], Any]
    ) -> tuple[AnyArray, Any]:
        """Force and weight with one more row."""
        beside = coupling()
        rows = np.zeros((len(force), len(force))) if weight is None else weight
        bordered = [[*row, more] for row, more in zip(rows, beside, strict=True)]
        return np.append(force, own()), np.array([*bordered, [*beside, 0.0]])

    def on_frame(self, forces: Any, torque: Any) -> AnyArray:
        """The torque turns the rotor."""
        return np.array([*forces, torque])


STEADY: Final[Rotation] = SteadyRotation()
GUIDED: Final[Rotation] = Guided()
DRIVEN: Final[Rotation] = Driven()


def most_demanding(rotors: Iterable[Rotation]) -> Rotation:
    """The way that asks for most: a torque before a given acceleration before none, which is there without any."""
    return max(rotors, key=lambda rotor: (rotor.rows, rotor.given), default=STEADY)


LARGEST: Final = sys.float_info.max
NON_NEGATIVE: Final = (0.0, LARGEST)


def finite(name: str, values: tuple[float, ...]) -> None:
    """Refuse infinities and NaN."""
    for value in values:
        Range(name, -LARGEST, LARGEST, remedy="give a finite number").check(value)


def same_length(name: str, values: tuple[float, ...], count: int, of: str) -> None:
    """Refuse values that are more or fewer than what they belong to."""
    if len(values) != count:
        raise InputError(f"{name}: one value for each {of}", found=str(len(values)), allowed=str(count))


@dataclass(frozen=True)
class Race:
    """A race and its balls.

    pitch_radius R_p [m] to the ball centres; ball_masses [kg], none or more; drag h0 [1/s], the torque on a ball being
    −m·R_p²·h0·(speed relative to the race); inertia_factor J = 1 (point), 7/5 (rolling ball), 3/2 (rolling roller);
    start_angles [rad] in the rotor; start_speeds [rad/s] relative to the race; plane_offset z [m] from the centre of
    mass; ball_radius r [m], 0 where it is not known. Raises RangeError, InputError.
    """

    pitch_radius: float
    ball_masses: tuple[float, ...]
    drag: float
    inertia_factor: float
    start_angles: tuple[float, ...]
    start_speeds: tuple[float, ...]
    plane_offset: float = 0.0
    ball_radius: float = 0.0

    def __post_init__(self) -> None:
        Range("pitch radius", 0, LARGEST, "m", open_low=True).check(self.pitch_radius)
        Range("rolling drag", *NON_NEGATIVE, "1/s").check(self.drag)
        # Below 1 a ball would have less than its own mass, above 2 more than a rolling thin ring.
        Range("inertia factor", 1, 2).check(self.inertia_factor)
        Range("ball radius", 0, self.pitch_radius, "m").check(self.ball_radius)
        finite("plane offset", (self.plane_offset,))
        for mass in self.ball_masses:
            Range("ball mass", 0, LARGEST, "kg", open_low=True).check(mass)
        for name, values in (("start angles", self.start_angles), ("start speeds", self.start_speeds)):
            same_length(name, values, len(self.ball_masses), "ball")
            finite(name, values)

    @property
    def static_moment(self) -> float:
        """Σ m·R_p [kg m]: the imbalance of all balls in one place."""
        return sum(self.ball_masses) * self.pitch_radius


Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Balls:
    """All balls of some races, race by race: arrays with one number each, and which race a ball is in.

    masses m [kg], radii R_p [m], drags h₀ [1/s], factors J, sizes r [m], places z of their races [m].
    """

    race: NDArray[np.intp]
    masses: Array
    radii: Array
    drags: Array
    factors: Array
    sizes: Array
    places: Array

    @property
    def static_moments(self) -> Array:
        """m R_p [kg m]."""
        return self.masses * self.radii

    def mass(self, rows: int) -> Array:
        """Σ m [[I, zI], [zI, z²I]], or its first rows: what they weigh at the centres of their races.

        In x and y of the centre of mass and the tilts toward these. That is all that balls which are free to roll weigh
        in the motion of the frame, when their angles are counted in space; see `Support.holding` for balls that stand.
        """
        m, places = self.masses, self.places
        sums = m.sum(), (m * places).sum(), (m * places**2).sum()
        planes = np.array([[sums[0], sums[1]], [sums[1], sums[2]]])
        return np.kron(planes, np.eye(2))[:rows, :rows]


def balls_of(races: Sequence[Race]) -> Balls:
    """All balls of the races."""
    sizes = [len(race.ball_masses) for race in races]

    def each(name: str) -> Array:
        """A number of each race, repeated for its balls."""
        return np.repeat(np.array([getattr(race, name) for race in races], dtype=float), sizes)

    return Balls(
        race=np.repeat(np.arange(len(sizes)), sizes),
        masses=np.array([mass for race in races for mass in race.ball_masses], dtype=float),
        radii=each("pitch_radius"),
        drags=each("drag"),
        factors=each("inertia_factor"),
        sizes=each("ball_radius"),
        places=each("plane_offset"),
    )


Modes = tuple[Any, ...]
"""Present mode of each effect (sticking, touching …); None if it has only one way to act."""


@dataclass(frozen=True)
class Frame:
    """The frame: the d accelerations of a support that balls feel, and what force and mass stand behind them."""

    mass: AnyArray
    """d × d: what the frame weighs with the support behind it, (P M⁻¹ Pᵀ)⁻¹; with the row of a driven rotor."""
    held: AnyArray
    """d × 2N: the force of springs and dampers on the frame is `held @ (q, q')`."""
    turning: tuple[int, ...] = ()
    """Rows that turn the rotor and its races."""
    whole: AnyArray | None = None
    """`mass` with balls at rest in their races, where that is constant."""
    held_spinning: AnyArray | None = None
    """Likewise to `held` the gyroscopic force, per unit speed."""
    rest: AnyArray | None = None
    """N × 2N, with the next: q'' = rest @ (q, q') + carry @ frame accelerations; None where these are the same."""
    carry: AnyArray | None = None
    rest_spinning: AnyArray | None = None
    steady_force: AnyArray | None = None
    """d: constant forces on the frame."""


@dataclass(frozen=True)
class Geometry(ABC):
    """Geometry by which a support carries the races: its own numbers that the equations evaluate."""

    @abstractmethod
    def levers(self, m: Motion, p: "Parameters") -> Levers:
        """Levers of the frame, with the rows of the rotor."""

    @abstractmethod
    def imbalance(self, m: Motion, p: "Parameters") -> tuple[AnyArray, AnyArray | None]:
        """Force of the imbalance on the frame, and what it weighs there."""

    def turning(self, support: AnyArray) -> tuple[Any, Any] | None:
        """Turn and speed of the rotor's carrier by the support; None if the support does not turn it."""
        return None

    # Where work is pressed to a wheel: only of supports that answer by `Support.plane`.

    def plane(self, z: Any) -> AnyArray:
        """2 × N: x and y at a place z along the spindle per unit of each coordinate."""
        raise NotImplementedError

    def forces(self, x: Any, y: Any, z: Any) -> list[Any]:
        """Forces at such a place as the frame feels them."""
        raise NotImplementedError

    def rates(self, m: Motion, p: "Parameters") -> AnyArray:
        """Velocities of the frame."""
        raise NotImplementedError


@dataclass(frozen=True)
class Parameters:
    """Numbers that the equations read. Per ball n, race by race: arrays of that length."""

    size: int
    """N, the support's coordinates."""
    balls: int
    rotor: Rotation
    geometry: Geometry
    frame: Frame
    speed: Any
    masses: AnyArray
    radii: AnyArray
    """R_p of each ball."""
    static_moments: AnyArray
    """m R_p of each ball."""
    drags: AnyArray
    """R_p h₀ of each ball."""
    braking: AnyArray
    """−R_p h₀ of each ball."""
    inertia_factors: AnyArray
    mobilities: AnyArray
    """1/J of each ball."""
    reduced_masses: AnyArray
    """m/J of each ball."""
    spins: AnyArray
    """(J − 1) r of each ball: its own turning when the rotor's speed changes."""
    spin_inertia: AnyArray | None
    """d × d: Σ m (J − 1) r², what that weighs in the turning of rotor and arm."""
    places: AnyArray
    """z of each ball's race."""
    imbalance: Any
    imbalance_angle: Any
    effects: tuple[Any, ...]
    """Effects of the scene, whose own numbers are read too."""

    @property
    def traceable(self) -> bool:
        """True if the equations are plain arithmetic that also accepts other things than numbers."""
        return all(effect.traceable for effect in self.effects)


@dataclass(frozen=True)
class Acting:
    """The numbers of a scene while its effects act in some modes: what an evaluation of the equations gets.

    Modes change some thousand times in a run, the numbers never.
    """

    parameters: Parameters
    modes: Modes
