"""Dry rolling friction of balls that gravity shakes once in a revolution, on a horizontal spindle."""

import math
from typing import Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import GRAVITY


@formula(
    "Friction over gravity of a ball in a race that turns about a horizontal axis",
    "k_r·R_p·Ω²/(r·g)",
    "",
    where="Below 1 gravity shakes friction out: no ball stays at rest beside its balanced place.",
    source="derived",
)
def friction_number(lever: float, pitch_radius: float, ball_radius: float, speed: float) -> float:
    """
    >>> round(friction_number(1.5e-6, 23e-3, 7.9375e-3, 607.37), 4)
    0.1635
    """
    return lever * pitch_radius * speed**2 / (ball_radius * GRAVITY)


COUNTED: Final = 0.5
"""Share of gravity that counts. Balls whose friction is near their weight creep so slowly that runs end before they do.

The half also stands for a spindle that is held askew by up to 60°.
"""


@formula(
    "Part of the friction band by which dry friction still holds balls that gravity shakes, on a horizontal spindle",
    "max(w_f − g/(2Ω²), 0)",
    "m",
    shown="um",
    where=(
        "A spindle displacement w pulls a ball along the race with Ω²·Im(w e^{−iθ}). Gravity adds a force of amplitude "
        "g at the rotor's speed. The ball stays at rest through the revolution only if both together never exceed the "
        "friction Ω²·w_f, so gravity takes g/Ω² from the band. Otherwise it slips a little in each revolution, always "
        "the way it is pulled. Near the end of that way balls creep: at constant κ_s the rest falls as "
        "2π·g·J/(4.5·κ_s·Ω·t). So only half of gravity counts here, which also allows for a spindle held askew. The "
        "worst friction case keeps at least the friction of evenly spread balls."
    ),
    assumed="spindle horizontal or up to 60° askew, constant speed",
    source="derived here; safe side chosen by simulations with other equations, friction 0.2 to 4 times gravity",
)
def remaining_band(band: float, speed: float) -> float:
    """`band`: w_f = k_r·R_p/r [m]; the same as w_f·max(1 − 1/(2Λ), 0), Λ the `friction_number`.

    >>> [round(1e6 * remaining_band(band, 607.37), 2) for band in (5.8e-6, 13.4e-6, 40e-6)]
    [0.0, 0.11, 26.71]
    """
    return max(band - COUNTED * GRAVITY / speed**2, 0.0)


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
