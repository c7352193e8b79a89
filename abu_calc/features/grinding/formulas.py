"""Formulas of balls under load: resting places as published, flutter, contacts they bear, friction shaken out.

Conventions of `formulas.tilting_contact`; angles in the rotor, from the imbalance in the sense of rotation.

Stability of balls of finite mass: growing roots of the characteristic equation are counted. The balls' slow motion is
no longer slow if a natural frequency of the machine on its contact is near the speed. The whirl then follows with its
own dynamics, G at Ω − is instead of Ω.

Shaking frees balls from dry rolling friction in a race if it moves them faster than they creep.
"""

import cmath
import math
from collections.abc import Callable, Sequence
from typing import Final

from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass


@formula(
    "Resultant of the balls under load, as published",
    "√{(Mε)²(ω_x²−Ω²)² + (m₀e)²Ω⁴ − 2 m₀e Mε Ω²(ω_x²−Ω²) cos φ_ε}/Ω², at the angle π + β_U",
    "kg m",
    signs="m R_p",
    where=(
        "β_U = arctan(Mε(ω_x²−Ω²) sin φ_ε/(Mε(ω_x²−Ω²) cos φ_ε − m₀eΩ²)). Two balls then rest on either side of that "
        "angle, by the arccos of half the resultant over m·R_p."
    ),
    assumed="rigid contact, no friction, undamped support",
    source="Kladiev 1996, (4)",
    published=(
        "for comparison only; the formula leaves friction out, and its arctan loses the quadrant if Mε(ω_x²−Ω²)cos "
        "φ_ε > m₀eΩ². The right formula is Ω²U = ε·(D_x − i·s·f·D_y)/(1 + i·s·f + q_n(D_x + D_y))"
    ),
)
def published_resultant(
    mass: float, imbalance: float, runout: complex, natural_frequency: float, speed: float
) -> complex:
    """
    >>> printed = published_resultant(5.6, 1e-4, cmath.rect(4e-5, 0.6), 80.0, 607.3746)
    >>> round(1e6 * abs(printed), 4), round(math.degrees(cmath.phase(printed)), 3)
    (307.8696, -156.191)
    """
    pushed = mass * (natural_frequency**2 - speed**2) / speed**2 * runout
    below = pushed.real - imbalance
    beta = math.atan(pushed.imag / below) if below else math.copysign(math.pi / 2, pushed.imag)
    return cmath.rect(abs(pushed - imbalance), math.pi + beta)


@formula(
    "Stiffness of the slow motion of balls under load: its two eigenvalues that are not neutral",
    "mΩ²/2·[−n Re G ± √(n²(Re G)² − |G|²(n² − |Σe^{2iθ}|²))]",
    "1/s²",
    signs="κ f",
    where=(
        "θ are the angles of the balls at rest. For two balls at a rigid contact the eigenvalues are κ·(1 ± √(cos² − "
        "f²·sin²)), sine and cosine of the angle between them. A complex pair lets the balls flutter."
    ),
    assumed="balls light compared with the machine, contact without separation",
    source="derived by averaging; Re > 0 without friction is Kladiev 1996, (7)",
    published="(7) is not sufficient with friction",
)
def loaded_stiffness(
    whirl: complex, ball_mass: float, speed: float, count: int, doubled: float
) -> tuple[complex, complex]:
    """`doubled`: |Σe^{2iΘ}|, 0 for balls in a cross, n for balls in one line."""
    root = cmath.sqrt((count * whirl.real) ** 2 - abs(whirl) ** 2 * (count**2 - doubled**2))
    unit = ball_mass * speed**2 / 2
    return unit * (-count * whirl.real + root), unit * (-count * whirl.real - root)


@formula(
    "Viscous drag rate below which balls flutter under load",
    "h₀ = |Im κ_s|·√(J/Re κ_s)",
    "1/s",
    signs="κ f",
    where=(
        "κ_s is that under load; the larger value of both counts. For two balls at a rigid contact it is √(Jκ(f²·sin² "
        "− cos²)), sine and cosine of the angle between them, or 0 if the root is not real. If Re κ_s < 0, it is "
        "infinite: no drag rate holds the balls."
    ),
    source="derived: J λ² + h₀ λ + κ_s = 0 has a root in the right half plane below this rate",
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
    "Contact stiffnesses between which balls increase the imbalance",
    "c₁ = MΩ² − c_y, c₂ = 2MΩ² − c_x − c_y",
    "N/m",
    where=(
        "Below c₁ balls balance, and wear centres the wheel. Between c₁ and c₂ balls increase the imbalance; without "
        "an autobalancer, wear drives the wheel off centre. Above c₂ balls balance, and wear increases the runout."
    ),
    assumed="no separation; little damping of the suspension",
    source="derived",
    published="Kladiev 1996 says that wear centres the wheel at a rigid contact; it drives the wheel off centre",
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
    "Change of the runout per mean depth of wear",
    "dε/ds_w = −Re(F_H e^{−iφ_ε})/N₀",
    "1",
    signs="ε s_w D_x D_y",
    where=(
        "F_H is D_y·ε + Ω²U at a rigid contact, and with free balls ε·(D_x + D_y)/(1 + i·s·f + q_n(D_x + D_y)). Wear "
        "on one side also changes the imbalance, by dε times the wheel's mass as a disc. With or without bouncing, "
        "the rate is between −2 and 2."
    ),
    assumed="wear proportional to force and sliding distance (Archard 1953)",
    source="derived",
    published=(
        "according to Kladiev 1996 wear centres the wheel at a rigid contact. By this law it drives the wheel off "
        "centre, twice as fast with an autobalancer. Kladiev 1996 also gives a longer life with an autobalancer (48 "
        "min against 32). By this law the mean wear does not depend on vibration"
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
    ("Spindle displacement without autobalancer at a rigid contact, well above the suspension's natural frequencies"),
    "|m₀e(1 + i·s·f)/M − i·s·f·ε·e^{iφ_ε}|",
    "m",
    shown="um",
    where=(
        "The amplitude along the workpiece, as a function of φ_ε, is largest at φ_ε = s(90° + arctan f). Its square "
        "is a limaçon of Pascal."
    ),
    assumed="Ω far above the natural frequencies, rigid contact",
    source="derived",
    published="Kladiev 1996 calls the curve a cardioid. Only its square is one, and only if m₀e/M·√(1+f²) = fε",
)
def hodograph_limit(displacement: float, runout: complex, friction: float) -> float:
    """`displacement` m₀e/M [m], `friction` sf.

    >>> round(1e6 * hodograph_limit(17.9e-6, 0j, 0.35), 2)
    18.96
    """
    return abs(displacement * (1 + 1j * friction) - 1j * friction * runout)


@formula(
    "Amplitude of shaking beyond which balls roll in spite of dry friction",
    "a_s > k_r·R_p/r",
    "m",
    shown="um",
    where=(
        "A face wheel shakes the balls across the race, since its axial runout moves the machine. Runout at work "
        "shakes them along the race, by the backward whirl |X − iY|/2. Both act against the friction force "
        "m(k_r/r)Ω²R_p."
    ),
    assumed=(
        "the groove may be shaken at any frequency; with 5(R−r) = 7(R_g−r), shaking at Ω across the race is at "
        "resonance"
    ),
    source="derived; compared with a simulation of every machine",
    published=(
        "according to Kladiev 1996 axial runout alone shakes friction out. The whirl by runout in the plane does so, "
        "too, but slowly"
    ),
)
def shaking_threshold(arm: float, pitch_radius: float, ball_radius: float) -> float:
    """
    >>> round(1e6 * shaking_threshold(2e-6, 24e-3, 8e-3), 3)
    6.0
    """
    return arm * pitch_radius / ball_radius


@formula(
    "Viscous drag rate equivalent to dry friction while a backward whirl shakes the balls along the race",
    "4J(k_r·R_p/r)Ω/(π·a_s)",
    "1/s",
    where="This is the mean of the friction over one swing at 2Ω.",
    assumed="a_s well above k_r·R_p/r",
    source="derived by averaging",
)
def shaken_drag(threshold: float, whirl: float, speed: float, inertia_factor: float) -> float:
    """
    >>> round(shaken_drag(5.81e-6, 20e-6, 607.37, 1.4))
    315
    """
    return 4 * inertia_factor * threshold * speed / (math.pi * whirl)


TURN: Final = 0.7
"""Largest step of the phase [rad] between neighbours on the imaginary axis."""
FAR: Final = 30.0
"""Bound in multiples of the speed, from which the equation is as good as its highest power."""
MOST: Final = 100_000
"""Points that are looked at."""


@dataclass(frozen=True)
class BallArrangement:
    """Equal balls of one race at rest in it."""

    count: int
    mass: float
    """Mass of a ball [kg]."""
    doubled: float
    """|Σe^{2iθ}| of their angles."""
    inertia_factor: float
    """J: a ball that rolls counts as J times its mass."""
    drag: float
    """Viscous drag rate h₀ [1/s]."""


@formula(
    "Characteristic equation of balls of finite mass under load",
    "Λ² + n(P_λ + P̄_λ)Λ + (n² − |Σe^{2iθ}|²)·P_λ·P̄_λ = 0, Λ = J λ² + h₀ λ",
    "",
    signs="m G Ω",
    where=(
        "P_λ = −(m/2)(Ω − iλ)²·G(Ω − iλ); P̄_λ is its conjugate at the conjugate λ. If a root has a positive real "
        "part, the balls leave their places. The cause is flutter by cutting friction, or a natural frequency on the "
        "contact too near the speed for the balls' mass."
    ),
    assumed="no separation; terms at 2Ω averaged out",
    source="derived; exact at idle on equal axes",
    published="Kladiev 1996, (7), requires only Ω > ω",
)
def characteristic(whirl: Callable[[complex], complex], balls: BallArrangement, speed: float, s: complex) -> complex:
    """`whirl`: G [m/(kg m)] by the complex speed; speed [rad/s], λ = s [1/s]. The value is in 1/s⁴."""

    def pull(root: complex) -> complex:
        """P_λ [1/s²]."""
        at = speed - 1j * root
        return -balls.mass / 2 * at**2 * whirl(at)

    p, q = pull(s), pull(s.conjugate()).conjugate()
    inertia = balls.inertia_factor * s**2 + balls.drag * s
    return inertia**2 + balls.count * (p + q) * inertia + (balls.count**2 - balls.doubled**2) * p * q


def growing_roots(value: Callable[[complex], complex], speed: float) -> int:
    """Number of roots of an equation that grow by more than a millionth of the speed.

    The equation is of fourth order, real for real s. The count follows the principle of the argument, on a grid
    of a two-hundredth of the speed up to four speeds. Two roots that turn the phase right round within one step
    of the grid may be missed. No term of the equation may be infinite there. Raises NotTrustworthyError if a
    root lies so near that edge that the roots cannot be counted.
    """
    far, small = FAR * speed, 1e-6 * speed
    grid = [0.0, *(small * (far / small) ** (k / 160) for k in range(161))]
    grid += [k / 200 * speed for k in range(1, 800)]
    edge = small
    points = [(w, value(edge + 1j * w)) for w in sorted(set(grid))]
    turned, looked = 0.0, 0
    stack = points[::-1]
    at, before = stack.pop()
    while stack:
        after, next_value = stack[-1]
        step = cmath.phase(next_value / before) if before else math.inf
        if abs(step) <= TURN:
            turned, (at, before) = turned + step, stack.pop()
            continue
        middle, looked = (at + after) / 2, looked + 1
        if looked > MOST or middle in (at, after):
            raise NotTrustworthyError("whether balls stand still under load is decided by less than rounding")
        stack.append((middle, value(edge + 1j * middle)))
    # From 0 to far the phase of a stable equation of fourth order turns by 2π; what lies beyond adds next to nothing.
    return round(2 - turned / math.pi)
