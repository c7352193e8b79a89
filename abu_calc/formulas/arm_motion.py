"""An arm whose imbalance is not balanced: its forced motion, how fast it dies out, and where it grows.

(1 + 2κ cos ωt) z'' + 2 z' (h − κω sin ωt) + ω₀² z = ω²κ sin ωt, z the arm's angle from rest [rad], κ = l·ds/J_O,
h = h_sh·l²/(2J_O), ω₀ its natural frequency. Source: Kovalenko 2010, (8), corrected.
"""

import math

from abu_calc.formula import formula
from abu_calc.formulas.swing_arm import MODULATION

ORDERS = 3


@formula(
    "Forced motion of an arm with its imbalance, by perturbation",
    "z = κ(M₁ cos ωt + N₁ sin ωt) + κ²(M₂ cos 2ωt + N₂ sin 2ωt) + κ³(M₁₃ cos ωt + N₁₃ sin ωt + M₃ cos 3ωt + "
    "N₃ sin 3ωt)",
    "rad",
    where=(
        "    M₁ = −2hω³/D₁,  N₁ = ω²(ω₀² − ω²)/D₁,  D_i = (ω₀² − i²ω²)² + 4h²i²ω²\n"
        "    M₂ = 2ω²[(ω₀² − 4ω²)M₁ − 4hωN₁]/D₂,  N₂ = 2ω²[4hωM₁ + (ω₀² − 4ω²)N₁]/D₂\n"
        "    M₁₃ = 2ω²[(ω₀² − ω²)M₂ − 2hωN₂]/D₁,  N₁₃ = 2ω²[2hωM₂ + (ω₀² − ω²)N₂]/D₁\n"
        "    M₃ = 6ω²[(ω₀² − 9ω²)M₂ − 6hωN₂]/D₃,  N₃ = 6ω²[6hωM₂ + (ω₀² − 9ω²)N₂]/D₃\n"
        "Resonances at ω₀/i are forced ones: large motion, no growth."
    ),
    checked=(MODULATION,),
    source="Kovalenko 2010, (11)",
    printed="it calls the motion near ω₀/i unstable; there is no instability there",
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
    one = w**2 * complex(-2 * decay * w, first - w**2) / abs(roots[0]) ** 2
    two = 2 * w**2 * roots[1] * one / abs(roots[1]) ** 2
    again = 2 * w**2 * roots[0] * two / abs(roots[0]) ** 2
    three = 6 * w**2 * roots[2] * two / abs(roots[2]) ** 2
    return k * one + k**3 * again, k**2 * two, k**3 * three


@formula(
    "Rates at which the free motion of the arm dies out",
    "−h away from resonance; −(h ± κω₀/2) at ω = 2ω₀",
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
    "σ_c = ½·√{1 − 16·[(k − ½)/κ]²}, k = ω₀/ω, σ = h/(κω₀)",
    "1",
    where="Without damping the arm grows where |k − ½| < κ/4; above σ_c it does not grow at all.",
    assumed="small κ; the tongue at ω = 2ω₀, the only one that counts",
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
