"""The averaged, slow motion of balls about the balanced state: stiffness, rates, settling, best drag.

Averaging the balls' equation over a revolution leaves J θ_k'' + h₀ θ_k' = (Ω²/R_p) Im(F e^{−iθ_k}), F the forward
circular part of the axis' motion. About F = 0 that is J δθ'' + h₀ δθ' + K δθ = 0 with K_kj = κ_j cos(θ_k − θ_j)
(Kladiev 1996, eq. (7), is the condition κ > 0). K has rank two: with more than two balls the rest are neutral.
Leading order in Σm/M: real rates differ by about (m/M)^{1/2}, and a lightly damped pair needs in addition
(Ω − ω)/Ω > (2m/(J M))^{1/3}.
"""

import cmath
import math
from collections.abc import Sequence

from abu_calc.errors import InputError
from abu_calc.formula import formula
from abu_calc.units import GRAVITY


@formula(
    "Stiffness of the slow motion of a ball about the balanced state",
    "κ = (m Ω⁴/2M) [1/(Ω² − ω₁²) + 1/(Ω² − ω₂²)]",
    "1/s²",
    where=(
        "Positive exactly where balls balance: above both frequencies, or between the smaller and √((ω₁² + ω₂²)/2)."
    ),
    checked=("not at a resonance",),
    assumed="both axes free, balls light beside the machine",
    source="derived by averaging; Kladiev 1996, (7), is κ > 0",
)
def ball_stiffness(
    ball_mass: float, total_mass: float, speed: float, natural_frequencies: tuple[float, float]
) -> float:
    """
    >>> round(ball_stiffness(0.05, 1.1, 2.0, (1.1**-0.5, 1.1**-0.5)), 6)
    0.235294
    """
    if speed in natural_frequencies:
        raise InputError("the averaged motion does not exist at a natural frequency", found=f"{speed:g} rad/s")
    share = sum(1 / (speed**2 - frequency**2) for frequency in natural_frequencies) / 2
    return ball_mass * speed**4 / total_mass * share


def slow_stiffness(stiffnesses: Sequence[float], angles: Sequence[float]) -> tuple[float, float]:
    """The two eigenvalues of K that are not neutral, ½(Σκ ∓ |Σ κ e^{2iθ}|) [1/s²]; κ of each ball, θ [rad].

    The smaller comes first. Two equal balls: κ(1 ∓ |cos(θ₂ − θ₁)|). It is zero where all balls lie on one diameter.

    >>> [round(k, 9) for k in slow_stiffness((2.0, 2.0, 2.0), (0.0, 2 * math.pi / 3, 4 * math.pi / 3))]
    [3.0, 3.0]
    """
    total = sum(stiffnesses)
    tilt = abs(sum(k * cmath.exp(2j * angle) for k, angle in zip(stiffnesses, angles, strict=True)))
    low, high = sorted(((total - tilt) / 2, (total + tilt) / 2))
    return low, high


def slow_rates(stiffness: float, drag: float, inertia_factor: float) -> tuple[complex, complex]:
    """The roots s [1/s] of J s² + h₀ s + k = 0, slower first; k [1/s²] an eigenvalue of K, h₀ [1/s].

    >>> slow_rates(2.0, 3.0, 1.0)
    ((-1+0j), (-2+0j))
    """
    root = cmath.sqrt(drag**2 - 4 * inertia_factor * stiffness)
    return (-drag + root) / (2 * inertia_factor), (-drag - root) / (2 * inertia_factor)


@formula(
    "Slowest rate at which a disturbance of the balls dies out, neutral directions apart; ≤ 0 where one does not",
    "−Re λ of J λ² + h₀ λ + κ_s = 0",
    "1/s",
    signs="κ θ",
    where=("κ_s the eigenvalues ½(Σκ ∓ |Σ κ e^{2iθ}|)."),
    assumed="real rates within about (m/M)^(1/2)",
    source="derived by averaging",
)
def decay_rate(stiffnesses: Sequence[float], angles: Sequence[float], drag: float, inertia_factor: float) -> float:
    return min(-slow_rates(k, drag, inertia_factor)[0].real for k in slow_stiffness(stiffnesses, angles))


@formula(
    "Drag that damps one slow mode critically: less lets it swing, more lets it creep",
    "h₀ = 2√(J κ_s)",
    "1/s",
    checked=("κ_s > 0",),
    source="derived by averaging",
)
def optimum_drag(stiffness: float, inertia_factor: float) -> float:
    """
    >>> optimum_drag(4.0, 1.0)
    4.0
    """
    if not stiffness > 0:
        raise InputError("no drag lets the balls settle", found=f"stiffness {stiffness:g} 1/s²", allowed="above 0")
    return 2 * math.sqrt(inertia_factor * stiffness)


def shaken_drag(
    friction_arm: float, ball_radius: float, pitch_radius: float, speed: float, inertia_factor: float
) -> float:
    """Drag rate [1/s] by which dry friction brakes the slow motion of balls that gravity shakes once a revolution.

        h_eq = (2/π) (k_r/r) J R_p Ω³/g    for Λ = k_r R_p Ω²/(r g) < 1, else 0

    Lever arm k_r, radii r and R_p [m], speed Ω [rad/s]. On a horizontal spindle gravity swings a ball with
    θ' = g/(J R_p Ω). Friction follows the sign of that swing, and so takes from a slower motion in proportion to it.
    It adds to h₀. From Λ = 1 on friction holds the balls. Source: derived by averaging the sign of the speed;
    simulated tails of 14.3–25.2 1/s against 15.9–26.4 1/s.

    >>> round(shaken_drag(0.5e-6, 8e-3, 23e-3, 600.0, 1.4), 2)
    28.22
    """
    if friction_arm * pitch_radius * speed**2 >= ball_radius * GRAVITY:
        return 0.0
    return 2 / math.pi * friction_arm / ball_radius * inertia_factor * pitch_radius * speed**3 / GRAVITY
