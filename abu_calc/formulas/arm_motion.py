"""An arm whose imbalance is not balanced: its forced motion, how fast it dies out, and where it grows.

(1 + 2κ_a cos Ωt) φ_f'' + 2 φ_f' (h_a − κ_aΩ sin Ωt) + ω₀² φ_f = Ω²κ_a sin Ωt, φ_f the arm's angle from rest [rad],
κ_a = l·m₀e/J_O, h_a = h_sh·l²/(2J_O), ω₀ its natural frequency. Source: Kovalenko 2010, (8), corrected.
"""

import math

from abu_calc.formula import formula
from abu_calc.formulas.swing_arm import MODULATION

ORDERS = 3


@formula(
    "Forced motion of an arm with its imbalance, by perturbation",
    (
        "φ_f = κ_a(M₁ cos Ωt + N₁ sin Ωt) + κ_a²(M₂ cos 2Ωt + N₂ sin 2Ωt) + κ_a³(M₁₃ cos Ωt + N₁₃ sin Ωt + M₃ cos "
        "3Ωt + N₃ sin 3Ωt)"
    ),
    "rad",
    signs="ω₀ h_a K_j",
    where=(
        "    M₁ = −2h_aΩ³/K₁,  N₁ = Ω²(ω₀² − Ω²)/K₁,  K_j = (ω₀² − j²Ω²)² + 4h_a²j²Ω²\n"
        "    M₂ = 2Ω²[(ω₀² − 4Ω²)M₁ − 4h_aΩN₁]/K₂,  N₂ = 2Ω²[4h_aΩM₁ + (ω₀² − 4Ω²)N₁]/K₂\n"
        "    M₁₃ = 2Ω²[(ω₀² − Ω²)M₂ − 2h_aΩN₂]/K₁,  N₁₃ = 2Ω²[2h_aΩM₂ + (ω₀² − Ω²)N₂]/K₁\n"
        "    M₃ = 6Ω²[(ω₀² − 9Ω²)M₂ − 6h_aΩN₂]/K₃,  N₃ = 6Ω²[6h_aΩM₂ + (ω₀² − 9Ω²)N₂]/K₃\n"
        "Resonances at ω₀ over a whole number are forced ones: large motion, no growth."
    ),
    checked=(MODULATION,),
    source="Kovalenko 2010, (11)",
    printed="it calls the motion near them unstable; there is no instability there",
)
def forced_harmonics(kappa: float, speed: float, natural: float, decay: float) -> tuple[complex, complex, complex]:
    """Amplitudes M + iN [rad] of ω, 2ω, 3ω; infinite at a resonance that nothing damps.

    >>> [complex(round(z.real, 4), round(z.imag, 4)) for z in forced_harmonics(0.001, 1.0, 0.62, 0.04)][0]
    (-0.0002-0.0016j)
    """
    k, w, first = MODULATION.check(kappa), speed, natural**2
    # M + iN of one order from that below: multiplication by (ω₀² − i²ω²) + 2ihω·i, over D_i.
    roots = [complex(first - (i * w) ** 2, 2 * decay * i * w) for i in (1, 2, 3)]
    if not all(roots):
        return (complex(math.inf),) * 3
    fundamental = w**2 * complex(-2 * decay * w, first - w**2) / abs(roots[0]) ** 2
    two = 2 * w**2 * roots[1] * fundamental / abs(roots[1]) ** 2
    again = 2 * w**2 * roots[0] * two / abs(roots[0]) ** 2
    three = 6 * w**2 * roots[2] * two / abs(roots[2]) ** 2
    return k * fundamental + k**3 * again, k**2 * two, k**3 * three


@formula(
    "Rates at which the free motion of the arm dies out",
    "−h_a away from resonance; −(h_a ± κ_a·ω₀/2) at Ω = 2ω₀",
    "1/s",
    where="A positive rate grows.",
    checked=(MODULATION,),
    source="Kovalenko 2010, (22), as rates in time",
)
def free_rates(kappa: float, natural: float, decay: float) -> tuple[float, float]:
    """The two at ω = 2ω₀, the larger first."""
    half = MODULATION.check(kappa) * natural / 2
    return half - decay, -half - decay


@formula(
    "Damping on the edge of the tongue, averaged",
    "h_a/(κ_a·ω₀) = ½·√{1 − 16·[(ω₀/Ω − ½)/κ_a]²}",
    "1",
    where="Without damping the arm grows where |ω₀/Ω − ½| < κ_a/4; above that it does not grow at all.",
    assumed="small κ_a; the tongue at Ω = 2ω₀, the only one that counts",
    source="Kovalenko 2010, (20) to (23)",
    printed='the matrix "E = (0 0; 0 1)" is the unit matrix',
)
def averaged_edge(kappa: float, ratio: float) -> float:
    """
    >>> averaged_edge(0.1, 0.5), averaged_edge(0.1, 0.525)
    (0.5, 0.0)
    """
    inside = 1 - 16 * ((ratio - 0.5) / kappa) ** 2
    return 0.5 * math.sqrt(inside) if inside > 0 else 0.0
