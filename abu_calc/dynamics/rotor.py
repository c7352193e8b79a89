"""Ways in which a rotor turns: at constant speed, with a given acceleration, or by a torque.

Each way answers for itself.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from typing import Any, ClassVar, Final, final

import numpy as np

from abu_calc.dynamics.motion import AnyArray, Levers, Motion


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
