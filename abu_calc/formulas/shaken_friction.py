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


TILT: Final = math.radians(30)
"""Angle to the horizontal up to which a hand-held spindle counts as horizontal [rad]."""


@formula(
    "Part of the friction band by which dry friction still holds balls that gravity shakes, on a horizontal spindle",
    "max(w_f − g·cos 30°/Ω², 0)",
    "m",
    shown="um",
    where=(
        "A spindle displacement w pulls a ball along the race with Ω²·Im(w e^{−iθ}). Gravity adds a force of amplitude "
        "g at the rotor's speed; 30° stand for a spindle that is held askew. The ball stays at rest through the "
        "revolution only if both together never exceed the friction Ω²·w_f. Otherwise it slips a little in each "
        "revolution, always the way it is pulled, until the pull is within this part. Close to it the balls creep: at "
        "constant κ_s the rest falls as 2π·g·J/(4.5·κ_s·Ω·t). So the worst friction case keeps at least the friction "
        "of evenly spread balls."
    ),
    assumed="spindle within 30° of horizontal, constant speed; balls that have had time to settle",
    source="derived here; compared with simulations by other equations, friction 0.2 to 4 times gravity",
)
def remaining_band(band: float, speed: float) -> float:
    """`band`: w_f = k_r·R_p/r [m]; the same as w_f·max(1 − cos 30°/Λ, 0), Λ the `friction_number`.

    >>> [round(1e6 * remaining_band(band, 607.37), 2) for band in (5.8e-6, 23.1e-6, 40e-6)]
    [0.0, 0.08, 16.98]
    """
    return max(band - GRAVITY * math.cos(TILT) / speed**2, 0.0)
