"""Suspension of the machine, seen from the wheel plane: two hands, or springs by natural frequencies."""

from typing import Protocol

from abu_calc.errors import InputError, Place
from abu_calc.formula import formula
from abu_calc.formulas.hands import handle_reaction
from abu_calc.frozen import dataclass
from abu_calc.roots import root
from abu_calc.standards.hands import Hand


class Suspension(Protocol):
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
        "Palm and arm m1 stand on the ground by element 1, the fingers m2 on m1 by 2; m1 and m2 reach the handle by 3 "
        "and 4; the skin masses m3, m4 move with the handle."
    ),
    assumed=(
        "how the elements connect; forearms push toward the work, so that the hands' z is the machine's y, and their x "
        "its x"
    ),
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


def dynamic_stiffness(suspension: Suspension, axis: int, speed: float, mass: float) -> complex:
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


def resonance_factor(suspension: Suspension, speed: float, mass: float) -> float:
    """Largest of the two axes of mΩ²/|D|: how much more the machine moves than a free mass would (1 far above)."""
    return max(mass * speed**2 / abs(dynamic_stiffness(suspension, axis, speed, mass)) for axis in (0, 1))


@formula(
    "Natural frequency of the mass on the suspension",
    "√(c/M)",
    "rad/s",
    shown="hz",
    signs="D_x",
    where=(
        "For springs. For hands the highest frequency at which Re D_x = 0 (bracketed from 1000 Hz down in steps of 1 "
        "%): the machine and the arms."
    ),
)
def natural_frequency(suspension: Suspension, axis: int, mass: float) -> float:
    if isinstance(suspension, Springs):
        return float((suspension.stiffness[axis] / mass) ** 0.5)

    def real(speed: float) -> float:
        return dynamic_stiffness(suspension, axis, speed, mass).real

    speed = FASTEST
    while real(speed) < 0:
        speed /= 1.01
    return root(real, speed, 1.01 * speed) if speed < FASTEST else speed
