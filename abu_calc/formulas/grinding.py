"""Balls of a machine at work: where the source puts them, what lets them flutter, which contacts they bear.

Conventions of `formulas.contact`; angles in the rotor, from the imbalance in the sense of rotation.
"""

import cmath
import math
from collections.abc import Sequence

from abu_calc.formula import formula


@formula(
    "What the balls add up to under load, as printed",
    "√{(Mε)²(ω_x²−Ω²)² + (m₀e)²Ω⁴ − 2 m₀e Mε Ω²(ω_x²−Ω²) cos φ_ε}/Ω², at the angle π + β_U",
    "kg m",
    signs="m R_p",
    where=(
        "β_U = arctan(Mε(ω_x²−Ω²) sin φ_ε/(Mε(ω_x²−Ω²) cos φ_ε − m₀eΩ²)). Two balls then rest to either side of that "
        "angle, by the arccos of the half of it over m·R_p."
    ),
    assumed="rigid contact, no friction, undamped support",
    source="Kladiev 1996, (4)",
    printed=(
        "Kept as printed, to be compared: it leaves the friction out, and arctan loses the quadrant when "
        "Mε(ω_x²−Ω²)cos φ_ε > m₀eΩ². Right is Ω²U = ε·(D_x − i·s·f·D_y)/(1 + i·s·f + q_n(D_x + D_y))"
    ),
)
def printed_resultant(
    mass: float, imbalance: float, runout: complex, natural_frequency: float, speed: float
) -> complex:
    """
    >>> printed = printed_resultant(5.6, 1e-4, cmath.rect(4e-5, 0.6), 80.0, 607.3746)
    >>> round(1e6 * abs(printed), 4), round(math.degrees(cmath.phase(printed)), 3)
    (307.8696, -156.191)
    """
    pushed = mass * (natural_frequency**2 - speed**2) / speed**2 * runout
    below = pushed.real - imbalance
    beta = math.atan(pushed.imag / below) if below else math.copysign(math.pi / 2, pushed.imag)
    return cmath.rect(abs(pushed - imbalance), math.pi + beta)


@formula(
    "Stiffness of the slow motion of balls under load, its two eigenvalues that are not neutral",
    "mΩ²/2·[−n Re G ± √(n²(Re G)² − |G|²(n² − |Σe^{2iθ}|²))]",
    "1/s²",
    signs="κ f",
    where=(
        "θ as the balls stand. Two balls at a rigid contact: κ times 1 ± √(cos² − f²·sin²) of the angle between "
        "them. A pair of complex ones lets the balls flutter."
    ),
    assumed="balls light beside the machine, no separation",
    source="derived by averaging; Kladiev 1996, (7), is Re > 0 without friction",
    printed="(7) is not sufficient with friction",
)
def loaded_stiffness(
    whirl: complex, ball_mass: float, speed: float, count: int, doubled: float
) -> tuple[complex, complex]:
    """`doubled`: |Σe^{2iΘ}|, 0 for balls in a cross, n for balls in one line."""
    root = cmath.sqrt((count * whirl.real) ** 2 - abs(whirl) ** 2 * (count**2 - doubled**2))
    unit = ball_mass * speed**2 / 2
    return unit * (-count * whirl.real + root), unit * (-count * whirl.real - root)


@formula(
    "Drag below which balls flutter under load",
    "h₀ = |Im κ_s|·√(J/Re κ_s)",
    "1/s",
    signs="κ f",
    where=(
        "κ_s under load; the larger of both. Two balls at a rigid contact: √(Jκ(f²·sin² − cos²)) of the angle "
        "between them where that is real, else 0. Infinite where Re κ_s < 0: no drag holds them."
    ),
    source="derived: J λ² + h₀ λ + κ_s = 0 has a root in the right half plane below it",
)
def flutter_drag(stiffnesses: Sequence[complex], inertia_factor: float) -> float:
    """
    >>> round(flutter_drag((560.7237 * (1 + 0.35j), 560.7237 * (1 - 0.35j)), 1.0), 3)
    8.288
    """
    if any(each.real < 0 for each in stiffnesses):
        return math.inf
    return max(abs(each.imag) * math.sqrt(inertia_factor / each.real) if each.imag else 0.0 for each in stiffnesses)


@formula(
    "Contact stiffnesses at which the loaded machine changes its ways",
    "c₁ = MΩ² − c_y, c₂ = 2MΩ² − c_x − c_y",
    "N/m",
    where=(
        "Below c₁ balls balance and wear centres the wheel; between them balls increase the imbalance, and without "
        "an autobalancer wear drives the wheel off; above c₂ balls balance, and wear increases the runout."
    ),
    assumed="no separation; suspension hardly damped",
    source="derived",
    printed="Kladiev 1996 has wear centre the wheel at a rigid contact, where it drives it off",
)
def stiffness_regions(dynamic_stiffness: tuple[complex, complex]) -> tuple[float, float]:
    """
    >>> W2 = 607.3746**2
    >>> [round(c / 1e6, 3) for c in stiffness_regions((5.6 * (6400 - W2) + 0j, 5.6 * (14400 - W2) + 0j))]
    [1.985, 4.015]
    """
    dx, dy = (each.real for each in dynamic_stiffness)
    return -dy, -dx - dy


@formula(
    "Change of the runout per depth that is worn off on average",
    "dε/ds_w = −Re(F_H e^{−iφ_ε})/N₀",
    "1",
    signs="ε s_w D_x D_y",
    where=(
        "F_H is D_y·ε + Ω²U at a rigid contact, with free balls ε·(D_x + D_y)/(1 + i·s·f + q_n(D_x + D_y)). What is "
        "worn off one side is missing there: it changes the imbalance by dε times the wheel's mass as a disc. "
        "Bouncing or not, the rate is between −2 and 2."
    ),
    assumed="wear in proportion to force and way (Archard 1953)",
    source="derived",
    printed=(
        "Kladiev 1996 has wear centre the wheel at a rigid contact, and live longer with an autobalancer (48 min "
        "against 32); by this law it is driven off, twice as fast with one, and the mean wear does not depend on "
        "vibration"
    ),
)
def runout_rate(pressure: complex, runout: complex, press: float) -> float:
    """
    >>> runout_rate(-50 + 0j, 4e-5 + 0j, 100.0)
    0.5
    """
    if not runout:
        return abs(pressure) / press
    return -(pressure * runout.conjugate()).real / (abs(runout) * press)


def largest_factor(slope: complex, offset: complex, limit: float) -> float | None:
    """The largest t ≥ 0 with |slope·t + offset| ≤ limit; None where there is none, or no end.

    >>> largest_factor(3 + 0j, 0j, 6.0)
    2.0
    """
    if slope == 0 or abs(offset) > limit:
        return None
    along = (slope.conjugate() / abs(slope) * offset).real
    factor = (math.sqrt(along**2 + max(limit**2 - abs(offset) ** 2, 0.0)) - along) / abs(slope)
    return factor if math.isfinite(factor) else None


@formula(
    "Axis without autobalancer at a rigid contact, well above the suspension",
    "|m₀e(1 + i·s·f)/M − i·s·f·ε·e^{iφ_ε}|",
    "m",
    shown="um",
    where=(
        "Amplitude along the work against φ_ε; largest at φ_ε = s(90° + arctan f). Its square is a limaçon of Pascal."
    ),
    assumed="Ω far above the natural frequencies, rigid contact",
    source="derived",
    printed="Kladiev 1996 calls the figure a cardioid; it is none unless m₀e/M·√(1+f²) = fε, and then its square is",
)
def hodograph_limit(displacement: float, runout: complex, friction: float) -> float:
    """`displacement` m₀e/M [m], `friction` sf.

    >>> round(1e6 * hodograph_limit(17.9e-6, 0j, 0.35), 2)
    18.96
    """
    return abs(displacement * (1 + 1j * friction) - 1j * friction * runout)
