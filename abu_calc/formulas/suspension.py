"""Suspension of the machine, seen from the wheel plane: two hands, or springs by natural frequencies.

Two hands on a machine's handles are masses and elements: sizing and the equations of motion both start from them.
Source: ISO 10068:2012, Annex C, model 2; how its elements connect is assumed.
"""

from typing import Final, Protocol

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.roots import root
from abu_calc.standards.vibration import Hand

ELEMENTS: Final = ((0.0, 1.0, 0.0), (0.0, -1.0, 1.0), (1.0, -1.0, 0.0), (1.0, 0.0, -1.0))
"""Stretch of each element per displacement of the nodes.

The elements are: 1 palm to ground, 2 palm to fingers, 3 and 4 these to the handle.
"""

Matrix = tuple[tuple[float, float, float], ...]


def hand_masses(hand: Hand) -> tuple[float, float, float]:
    """Masses of both hands at the nodes, the machine's own left out [kg]."""
    palm, fingers, *skin = hand.masses
    return 2 * sum(skin), 2 * palm, 2 * fingers


def joined(values: tuple[float, float, float, float]) -> Matrix:
    """The symmetric matrix, nodes by nodes, of the elements of both hands: stiffness [N/m] or damping [N·s/m].

    >>> joined((5.0, 3.0, 2.0, 1.0))
    ((6.0, -4.0, -2.0), (-4.0, 20.0, -6.0), (-2.0, -6.0, 8.0))
    """
    pairs = list(zip(values, ELEMENTS, strict=True))
    return tuple(_row([2 * sum(value * way[i] * way[j] for value, way in pairs) for j in range(3)]) for i in range(3))


def _row(values: list[float]) -> tuple[float, float, float]:
    x, y, z = values
    return x, y, z


def handle_reaction(hand: Hand, speed: complex) -> complex:
    """Force of both hands per displacement of the handle [N/m] at Ω [rad/s]: palm and fingers eliminated.

    D₀₀ − D₀ᵢ (Dᵢⱼ)⁻¹ Dⱼ₀ of D = K + iΩC − Ω²M, the machine's own mass left out.
    """
    K, C, M = joined(hand.stiffness), joined(hand.damping), hand_masses(hand)
    D = [[K[i][j] + 1j * speed * C[i][j] - (M[i] * speed**2 if i == j else 0.0) for j in range(3)] for i in range(3)]
    determinant = D[1][1] * D[2][2] - D[1][2] * D[2][1]
    palm_moves = -(D[1][0] * D[2][2] - D[1][2] * D[2][0]) / determinant
    fingers_move = -(D[1][1] * D[2][0] - D[1][0] * D[2][1]) / determinant
    return D[0][0] + D[0][1] * palm_moves + D[0][2] * fingers_move


class SuspensionReaction(Protocol):
    """The reaction of the suspension to a harmonic motion, per axis (0: x, 1: y)."""

    def reaction(self, axis: int, speed: complex) -> complex:
        """Force per displacement [N/m] at the angular frequency `speed` [rad/s], the machine's own mass left out.

        A complex one, Ω − is, is that of a motion that grows meanwhile with e^{st}.
        """
        ...


@dataclass(frozen=True)
class Springs:
    """Springs and dampers in x and y, the same when the mass of the autobalancer is added."""

    stiffness: tuple[float, float]
    damping: tuple[float, float]

    def reaction(self, axis: int, speed: complex) -> complex:
        """c + iΩb [N/m]."""
        return self.stiffness[axis] + 1j * speed * self.damping[axis]


@formula(
    "Two hands on the handles, ISO 10068:2012 Annex C, model 2",
    where=(
        "Palm and arm (m1) are connected to the ground by element 1, the fingers (m2) to m1 by element 2. Elements 3 "
        "and 4 connect m1 and m2 to the handle. The skin masses m3 and m4 move with the handle. The forearms push "
        "toward the workpiece: the z-axis of the hands is the machine's y-axis, their x-axis the machine's x-axis. "
        "For a body in space whose wheel works with its face, the z-axis of the hands is the spindle's axis."
    ),
    assumed="how the elements connect; direction of the forearms",
    source="ISO 10068:2012",
)
@dataclass(frozen=True)
class Hands:
    axes: tuple[Hand, Hand]

    def reaction(self, axis: int, speed: complex) -> complex:
        """Force of both hands per displacement of the handle [N/m]: palm and fingers eliminated."""
        return handle_reaction(self.axes[axis], speed)


FASTEST = 6283.0
"""Speed at which the search for the natural frequency on hands begins [rad/s]."""


def dynamic_stiffness(suspension: SuspensionReaction, axis: int, speed: float, mass: float) -> complex:
    """D = reaction − mΩ² [N/m], the machine's mass m [kg] at the wheel included.

    Raises InputError at a resonance that nothing damps: there is no steady motion.
    """
    stiffness = suspension.reaction(axis, speed) - mass * speed**2
    if stiffness == 0:
        raise InputError(
            "the speed is a natural frequency, which nothing damps: vibration grows without bound",
            place=Place(key="suspension.damping_ratios"),
            found=f"{speed:g} rad/s",
            remedy="give the suspension some damping, or hold the machine more softly",
        )
    return stiffness


def resonance_factor(suspension: SuspensionReaction, speed: float, mass: float) -> float:
    """Largest of the two axes of mΩ²/|D|: how much more the machine moves than a free mass would (1 far above)."""
    return max(mass * speed**2 / abs(dynamic_stiffness(suspension, axis, speed, mass)) for axis in (0, 1))


@formula(
    "Natural frequency of the mass on the suspension",
    "√(c/M)",
    "rad/s",
    shown="hz",
    signs="D_x",
    where=(
        "√(c/M) holds for springs. For hands it is the highest frequency at which Re D_x = 0, that of machine and "
        "arms together. The search goes down from 1000 Hz in steps of 1 %."
    ),
)
def natural_frequency(suspension: SuspensionReaction, axis: int, mass: float) -> float:
    if isinstance(suspension, Springs):
        return float((suspension.stiffness[axis] / mass) ** 0.5)

    def real(speed: float) -> float:
        """Real part of the dynamic stiffness [N/m] at a speed [rad/s]; zero at a resonance."""
        return dynamic_stiffness(suspension, axis, speed, mass).real

    speed = FASTEST
    while real(speed) < 0:
        speed /= 1.01
    return root(real, speed, 1.01 * speed) if speed < FASTEST else speed
