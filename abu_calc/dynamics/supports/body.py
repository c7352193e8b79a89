"""A planar rotor with a further body on it, such as a casing or a handle that gives."""

import numpy as np

from abu_calc.dynamics.motion import Array
from abu_calc.dynamics.supports.linear import DAMPING, MASS, STIFFNESS, Pair, rows
from abu_calc.dynamics.supports.planar import PlanarSupport

ROTOR, BETWEEN = np.array(((1.0, 0.0), (0.0, 0.0))), np.array(((1.0, -1.0), (-1.0, 1.0)))
"""Matrices of an element's action on rotor and body.

The element acts from the rotor to the ground, or between the two.
"""


def with_body(
    mass: float, stiffness: Pair, damping: Pair, body_mass: float, body_stiffness: Pair, body_damping: Pair
) -> PlanarSupport:
    """M x'' + b x' + k x = F + R, m_b x_b'' = −R, R = k_b (x_b − x) + b_b (x_b' − x'); likewise y.

    A rotor on springs to the ground, the body on the rotor: masses [kg], stiffness [N/m] and damping [N·s/m] along x
    and y. Masses positive, the rest not negative; raises RangeError.
    Source: Den Hartog 1956, Mechanical Vibrations, 3.2.

    >>> with_body(1.0, (5.0, 6.0), (0.0, 0.0), 0.5, (2.0, 3.0), (0.0, 0.0)).stiffness[1]
    (0.0, 9.0, 0.0, -3.0)
    """
    own, hung = MASS.check(mass), MASS.check(body_mass)
    return PlanarSupport(
        mass=rows(np.diag((own, own, hung, hung))),
        damping=rows(_joined([DAMPING.check(b) for b in damping], [DAMPING.check(b) for b in body_damping])),
        stiffness=rows(_joined([STIFFNESS.check(k) for k in stiffness], [STIFFNESS.check(k) for k in body_stiffness])),
        race_map=rows(np.eye(2, 4)),
        names=("x", "y", "body_x", "body_y"),
    )


def _joined(ground: list[float], link: list[float]) -> Array:
    """Matrix that acts against the motion of rotor and body.

    Its order is x, y of the rotor, x, y of the body.
    """
    return np.kron(ROTOR, np.diag(ground)) + np.kron(BETWEEN, np.diag(link))
