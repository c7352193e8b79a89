"""A machine held in two hands, whose masses move on their own."""

import numpy as np

from abu_calc.dynamics.motion import Array
from abu_calc.dynamics.supports.linear import MASS, rows
from abu_calc.dynamics.supports.planar import PlanarSupport
from abu_calc.standards.hands import Hand

MACHINE, PALM, FINGERS = np.eye(3)


def in_hands(mass: float, axes: tuple[Hand, Hand]) -> PlanarSupport:
    """A point mass [kg] in two hands that move alike, `axes` the hand along x and along y.

    Element 1 stands between ground and palm (mass m₁), 2 between palm and fingers (m₂), 3 between palm and handle, 4
    between fingers and handle; the skin masses m₃, m₄ move with the handle. Its receptance is 1/(reaction − mΩ²) of
    `formulas.suspension.Hands`. Mass positive; raises RangeError. Source: ISO 10068:2012, Annex C, model 2; how its
    elements connect is assumed.

    >>> from abu_calc.standards.hands import hand
    >>> in_hands(5.0, (hand("x"), hand("z"))).names
    ('x', 'y', 'palm_x', 'palm_y', 'fingers_x', 'fingers_y')
    """
    own = MASS.check(mass)
    return PlanarSupport(
        mass=rows(_both([_masses(own, hand) for hand in axes])),
        damping=rows(_both([_elements(hand.damping) for hand in axes])),
        stiffness=rows(_both([_elements(hand.stiffness) for hand in axes])),
        race_map=rows(np.eye(2, 6)),
        names=("x", "y", "palm_x", "palm_y", "fingers_x", "fingers_y"),
    )


def _masses(own: float, hand: Hand) -> Array:
    """Machine with the skin on its handles, palms, fingers; of two hands."""
    palm, fingers, *skin = hand.masses
    return np.diag((own + 2 * sum(skin), 2 * palm, 2 * fingers))


def _elements(values: tuple[float, float, float, float]) -> Array:
    """Springs or dampers of two hands, each between two of machine, palm and fingers."""
    ways = (PALM, FINGERS - PALM, MACHINE - PALM, MACHINE - FINGERS)
    total: Array = 2 * sum(
        (value * np.outer(way, way) for value, way in zip(values, ways, strict=True)), np.zeros((3, 3))
    )
    return total


def _both(along: list[Array]) -> Array:
    """x and y side by side, coordinate by coordinate."""
    x, y = along
    return np.kron(x, np.diag((1.0, 0.0))) + np.kron(y, np.diag((0.0, 1.0)))
