"""A machine held in two hands, whose masses move on their own."""

import numpy as np

from abu_calc.dynamics.motion import Array
from abu_calc.dynamics.supports.linear import MASS, rows
from abu_calc.dynamics.supports.planar import PlanarSupport
from abu_calc.formulas.hands import hand_masses, joined
from abu_calc.standards.hands import Hand


def in_hands(mass: float, axes: tuple[Hand, Hand]) -> PlanarSupport:
    """A point mass [kg] in two hands that move alike, `axes` the hand along x and along y; see `formulas.hands`.

    Its receptance is 1/(`handle_reaction` − mΩ²). Mass positive; raises RangeError.

    >>> from abu_calc.standards.hands import hand
    >>> in_hands(5.0, (hand("x"), hand("z"))).names
    ('x', 'y', 'palm_x', 'palm_y', 'fingers_x', 'fingers_y')
    """
    own = np.array((MASS.check(mass), 0.0, 0.0))
    return PlanarSupport(
        mass=rows(_both([np.diag(own + hand_masses(hand)) for hand in axes])),
        damping=rows(_both([np.array(joined(hand.damping)) for hand in axes])),
        stiffness=rows(_both([np.array(joined(hand.stiffness)) for hand in axes])),
        race_map=rows(np.eye(2, 6)),
        names=("x", "y", "palm_x", "palm_y", "fingers_x", "fingers_y"),
    )


def _both(along: list[Array]) -> Array:
    """x and y side by side, coordinate by coordinate."""
    x, y = along
    return np.kron(x, np.diag((1.0, 0.0))) + np.kron(y, np.diag((0.0, 1.0)))
