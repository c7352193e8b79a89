"""Averaged slow motion of the balls about the balanced state: stiffness, rates, settling, best drag, stalling.

Averaging the balls' equation over a revolution leaves J θ_k'' + h₀ θ_k' = (Ω²/R_p) Im(F e^{−iθ_k}), F the forward
circular part of the axis' motion. About F = 0 that is J δθ'' + h₀ δθ' + K δθ = 0 with K_kj = κ_j cos(θ_k − θ_j)
(Kladiev 1996, eq. (7), is the condition κ > 0). K has rank two: with more than two balls the rest are neutral.
Leading order in Σm/M: real rates differ by about (m/M)^{1/2}, and a lightly damped pair needs in addition
(Ω − ω)/Ω > (2m/(J M))^{1/3}.

Stalling: bounds on the viscous drag rate above which balls cannot lag behind the rotor in a state beside the balanced
one. Balls that lag and go round near a natural frequency drive the support as an imbalance of their own. The support's
dissipation brakes them, the drag of the race pulls them on (the Sommerfeld effect of the balls). Each bound suffices
and none is necessary: below them balls may stall or not, and the start decides.
"""

import cmath
import math
from collections.abc import Sequence
from typing import Any, TypeVar

from abu_calc.foundation.errors import InputError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import GRAVITY


@formula(
    "Stiffness of the slow motion of a ball about the balanced state",
    "κ = (m Ω⁴/2M) [1/(Ω² − ω₁²) + 1/(Ω² − ω₂²)]",
    "1/s²",
    where=(
        "κ is positive exactly if balls balance: above both natural frequencies, or between the smaller one and "
        "√((ω₁² + ω₂²)/2)."
    ),
    checked=("not at a resonance",),
    assumed="both axes free, balls light compared with the machine",
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
    "Slowest rate at which a disturbance of the balls dies out; at most 0 if one persists",
    "−Re λ of J λ² + h₀ λ + κ_s = 0",
    "1/s",
    signs="κ θ",
    where="κ_s are the eigenvalues ½(Σκ ∓ |Σ κ e^{2iθ}|). Neutral directions do not count.",
    assumed="real rates differ from this by a relative error of about (m/M)^(1/2)",
    source="derived by averaging",
)
def decay_rate(stiffnesses: Sequence[float], angles: Sequence[float], drag: float, inertia_factor: float) -> float:
    return min(-slow_rates(k, drag, inertia_factor)[0].real for k in slow_stiffness(stiffnesses, angles))


@formula(
    "Viscous drag rate that damps one slow mode critically",
    "h₀ = 2√(J κ_s)",
    "1/s",
    checked=("κ_s > 0",),
    source="derived by averaging",
    where="At a lower rate the mode swings, at a higher rate it creeps.",
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


Numbers = TypeVar("Numbers", float, Any)
"""One or an array of them."""


@formula(
    "Viscous drag rate that pulls stalled balls past a resonance of the support",
    "h₀ > n·m·χ²·Ω_b⁴·(−Im[H_xx(Ω_b) + H_yy(Ω_b)])/(2(Ω − Ω_b))",
    "1/s",
    signs="ζ M ω",
    where=(
        "χ is that of balls side by side (1 for balls without size). H_xx and H_yy include the balls' mass on the "
        "race. The largest value up to the highest natural frequency below Ω counts. On springs alike along x and y "
        "the bound is n·m·ω²/(2ζM(Ω − ω)), on springs along one axis half of that. The bound sufficed in all 64 "
        "isotropic and 32 anisotropic supports that were simulated (2–30 Hz, ζ 0.005–0.5, 2–8 balls, drag rates "
        "scanned)."
    ),
    assumed="Ω_b below Ω, linear support; sufficiency, as simulated",
    source="derived from the balance of drag and dissipation; the effect: Sperling et al. 2002, Wright & Peng 2019",
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
    (
        "Viscous drag rate above which balls do not stall at a speed above a heavily damped resonance (ζ of 0.3 and "
        "more)"
    ),
    "h₀ > 2ζω·√(n·m·J/(2M))",
    "1/s",
    where=(
        "2ζω is the damping of the support over all mass that moves with the balls. The bound sufficed in the same "
        "simulations as that of the resonance drag. The largest rate that was needed there was 0.73 of this bound."
    ),
    assumed="sufficiency, as simulated",
    source="found by simulation",
)
def damped_drag(damping_rate: float, mass_ratio: float, inertia_factor: float) -> float:
    """`mass_ratio`: n·m/M.

    >>> round(damped_drag(2 * 0.5 * 2 * math.pi * 2.5, 0.0055, 7 / 5), 2)
    0.97
    """
    return damping_rate * math.sqrt(mass_ratio * inertia_factor / 2)


@formula(
    "Viscous drag rate above which gravity does not hold the balls of a horizontal spindle",
    "h₀ > g/(R_p·Ω)",
    "1/s",
    source="derived: drag on a ball at rest, m·R_p·h₀·Ω, against its weight",
    where="Simulated balls stalled at 0.97 of this rate, and did not stall at 1.03 of it.",
)
def gravity_drag(pitch_radius: float, speed: float) -> float:
    """
    >>> round(gravity_drag(0.024, 600.0), 4)
    0.681
    """
    return GRAVITY / (pitch_radius * speed)


@formula(
    "Resultant of touching balls, relative to that of as many balls in one place",
    "χ = sin(nβ)/(n·sin β)",
    "1",
    where="For balls without size β is 0 and χ is 1.",
    source="geometry",
)
def side_by_side(count: int, beta: float) -> float:
    """
    >>> side_by_side(4, 0.0), round(side_by_side(2, math.pi / 3), 9)
    (1.0, 0.5)
    """
    return math.sin(count * beta) / (count * math.sin(beta)) if count and beta else 1.0
