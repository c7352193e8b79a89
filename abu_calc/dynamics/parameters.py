"""Numbers of a scene in SI, combined once so that an evaluation of the equations needs few operations."""

from abc import ABC, abstractmethod
from typing import Any

from abu_calc.dynamics.motion import AnyArray, Levers, Motion
from abu_calc.dynamics.rotor import Rotation
from abu_calc.foundation.frozen import dataclass

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
