"""Balls that hang: drags above which no state stands beside the balanced one in which balls lag behind the rotor.

Balls that lag and go round near a natural frequency drive the support as an imbalance of their own; what it dissipates
brakes them, the drag of the race pulls them on (the Sommerfeld effect of the balls). Each bound suffices and none is
necessary: below them balls may hang or not, and the start decides.
"""

import math
from typing import Any, TypeVar

from abu_calc.formula import formula
from abu_calc.units import GRAVITY

Numbers = TypeVar("Numbers", float, Any)
"""One or an array of them."""

_CHECKED = (
    "as found by 64 isotropic and 32 anisotropic sets, 2–30 Hz, ζ 0.005–0.5, 2–8 balls, drag scanned: no counterexample"
)


@formula(
    "Drag that balls going round below the speed need to be pulled on past a resonance",
    "h₀ > n·m·χ²·Ω_b⁴·(−Im[H_xx(Ω_b) + H_yy(Ω_b)])/(2(Ω − Ω_b))",
    "1/s",
    signs="ζ M ω",
    where=(
        "χ of balls side by side (1 without size), H_xx and H_yy with the balls' mass on the race. The largest up to "
        "the highest natural frequency below Ω counts. Of springs alike along x and y that is n·m·ω²/(2ζM(Ω − ω)), "
        "of one axis alone half of it."
    ),
    assumed=f"Ω_b below Ω, linear support; sufficient {_CHECKED}",
    source="derived by the balance of drag and dissipation; the effect: Sperling et al. 2002, Wright & Peng 2019",
)
def resonance_drag(lost: Numbers, frequency: Numbers, speed: float) -> Numbers:
    """`lost`: n·m·σ²·(−Im[h_xx + h_yy]) [kg m/N].

    >>> M, w, zeta = 2.0, 100.0, 0.1
    >>> lost = 0.02 * 2 / (2 * zeta * M * w**2)  # two axes alike, at their natural frequency
    >>> round(resonance_drag(lost, w, 300.0), 9), round(0.02 * w**2 / (2 * zeta * M * 200.0), 9)
    (2.5, 2.5)
    """
    return lost * frequency**4 / (2 * (speed - frequency))


@formula(
    "Drag above which balls do not run above a heavily damped resonance (ζ of 0.3 and more)",
    "h₀ > 2ζω·√(n·m·J/(2M))",
    "1/s",
    where="2ζω is the damping of the support over all mass that moves with the balls.",
    assumed=f"sufficient {_CHECKED}; the highest seen was 0.73 of it",
    source="found by integration",
)
def damped_drag(damping_rate: float, mass_ratio: float, inertia_factor: float) -> float:
    """`mass_ratio`: n·m/M.

    >>> round(damped_drag(2 * 0.5 * 2 * math.pi * 2.5, 0.0055, 7 / 5), 2)
    0.97
    """
    return damping_rate * math.sqrt(mass_ratio * inertia_factor / 2)


@formula(
    "Drag above which balls do not stand still under gravity, the spindle horizontal",
    "h₀ > g/(R_p·Ω)",
    "1/s",
    source="derived: the drag on a ball at rest, m·R_p·h₀·Ω, against its weight; hung at 0.97 of it, not at 1.03",
)
def gravity_drag(pitch_radius: float, speed: float) -> float:
    """
    >>> round(gravity_drag(0.024, 600.0), 4)
    0.681
    """
    return GRAVITY / (pitch_radius * speed)


@formula(
    "Resultant of touching balls over that of as many in one place",
    "χ = sin(nβ)/(n·sin β)",
    "1",
    where="β is 0 without size.",
    source="geometry",
)
def side_by_side(count: int, beta: float) -> float:
    """
    >>> side_by_side(4, 0.0), round(side_by_side(2, math.pi / 3), 9)
    (1.0, 0.5)
    """
    return math.sin(count * beta) / (count * math.sin(beta)) if count and beta else 1.0
