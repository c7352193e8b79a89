"""Largest distance from its place at which dry rolling friction can hold the axis."""

import math
from itertools import pairwise

from abu_calc.formula import formula


@formula(
    "Largest axis displacement at which dry rolling friction can hold every ball where it is",
    "(k_r·R_p/r)/cos(γ_g/2)",
    "m",
    shown="um",
    signs="w θ",
    where=(
        "|Im(w e^{−iθ})| ≤ k_r·R_p/r for every ball, so |w| is at most that; γ_g is taken modulo 180°. For two balls "
        "at ±θ this is (k_r·R_p/r)/min(|sin θ|, |cos θ|). Infinite when all balls are in one line."
    ),
    assumed="hard, clean race, k_r 0.5–5 µm; whatever the speed",
    source="derived; Kladiev 1996 has no such limit",
)
def friction_band(arm: float, pitch_radius: float, ball_radius: float, angles: tuple[float, ...]) -> float:
    """
    >>> round(1e6 * friction_band(2e-6, 23e-3, 8e-3, (-math.radians(60), math.radians(60))), 2)
    11.5
    """
    if arm == 0:
        return 0.0
    directions = sorted(angle % math.pi for angle in angles)
    gap = max(after - before for before, after in pairwise([*directions, directions[0] + math.pi]))
    in_line = math.pi - gap < 1e-9
    return math.inf if in_line else arm * pitch_radius / ball_radius / math.cos(gap / 2)
