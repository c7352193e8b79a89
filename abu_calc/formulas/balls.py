"""Balls side by side in a race: their half angle, mass and rolling inertia, and the imbalance they can hold."""

import math
from typing import Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.validity import Range

INERTIA_FACTORS: Final = {"ball": 7 / 5, "roller": 3 / 2}
"""J: rolling inertia of a solid ball or roller (translation 1 + rotation 2/5 or 1/2)."""

HALF_ANGLE_SINE = Range("ball radius over pitch radius", 0.0, 1.0, open_low=True)


@formula(
    "Half the angle between touching balls",
    "β = arcsin(r/(R−r))",
    "rad",
    checked=(HALF_ANGLE_SINE,),
    source="geometry",
)
def half_angle(ball_radius: float, pitch_radius: float) -> float:
    """
    >>> round(math.degrees(half_angle(8e-3, 24e-3)), 4)
    19.4712
    """
    return math.asin(HALF_ANGLE_SINE.check(ball_radius / pitch_radius))


def most_balls(beta: float) -> int:
    """Largest number of balls that fit round the race: ⌊π/β⌋."""
    return math.floor(math.pi / beta + 1e-12)


@formula(
    "Number of balls with the largest capacity",
    "n* = round(π/(2β))",
    "1",
    source="derived",
    where="One more ball reduces the capacity.",
)
def best_count(beta: float) -> int:
    return round(math.pi / (2 * beta))


@formula(
    "Largest imbalance that n balls side by side can balance",
    "m·R_p·sin(nβ)/sin β",
    "kg m",
    signs="R_p",
    where="The capacity grows up to n* = round(π/(2β)) balls.",
    checked=("1 ≤ n ≤ ⌊π/β⌋",),
    source="derived; an optimisation under the spacing constraint found the same maximum",
    published="Kladiev 1996, (6), takes 2·m·(R−r), as if balls had no size",
)
def capacity(count: int, ball_mass: float, pitch_radius: float, beta: float) -> float:
    """
    >>> beta = half_angle(8e-3, 22e-3)
    >>> [round(1e6 * capacity(n, 16.72835e-3, 22e-3, beta), 1) for n in (1, 2, 3, 4, 5)]
    [368.0, 685.7, 909.4, 1008.7, 969.8]
    """
    Range("number of balls side by side", 1, most_balls(beta)).check(count)
    return ball_mass * pitch_radius * math.sin(count * beta) / math.sin(beta)


def corrector_mass(corrector: str, diameter: float, density: float) -> float:
    """Mass of a ball, or of a roller as long as its diameter [kg].

    >>> round(1e3 * corrector_mass("ball", 16e-3, 7800), 3)
    16.728
    """
    cube = diameter**3 * math.pi
    return density * cube * (1 / 6 if corrector == "ball" else 1 / 4)
