"""Drag equivalent to rolling friction that gravity shakes on a horizontal spindle."""

import math

from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import GRAVITY


@formula(
    "Viscous drag rate equivalent to dry friction that gravity shakes, for slow balls on a horizontal spindle",
    "(2/π)·(k_r/r)·J·R_p·Ω³/g",
    "1/s",
    where="It adds to the drag of the oil while the balls are slow: the end of a decay shows the friction.",
    assumed="a friction number below 1, and balls slower than g/(J·R_p·Ω) in the rotor",
    source="derived by averaging; compared with simulations",
)
def equivalent_drag(
    lever: float, pitch_radius: float, ball_radius: float, speed: float, inertia_factor: float
) -> float:
    """
    >>> round(equivalent_drag(0.5e-6, 23e-3, 7.9375e-3, 607.37, 1.4), 1)
    29.5
    """
    return 2 / math.pi * lever / ball_radius * inertia_factor * pitch_radius * speed**3 / GRAVITY
