"""A machine on a swing arm: stiffness added by the contact, resonances, forced motion, decay, and instability.

Forced motion of an arm whose imbalance is not balanced:

    (1 + 2κ_a cos Ωt) φ_f'' + 2 φ_f' (h_a − κ_aΩ sin Ωt) + ω₀² φ_f = Ω²κ_a sin Ωt

φ_f is the arm's angle from rest [rad], κ_a = l·m₀e/J_O, h_a = h_sh·l²/(2J_O), ω₀ its natural frequency.

Source: Kovalenko 2010, (8) for this equation, corrected.
"""

import itertools
import math

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.roots import root
from abu_calc.foundation.validity import Range

FRICTION = Range("cutting coefficient f", 0.0, 0.8, key="swing_arm.cutting_coefficient")
RADIUS_RATIO = Range("disk radius over arm length R_w/l", 0.0, 1.0, key="swing_arm.arm_length_mm")
MODULATION = Range("κ_a = l·m₀e/J_O", 0.0, 0.3, key="swing_arm.moment_of_inertia_kg_m2")


@dataclass(frozen=True)
class Arm:
    """The arm with the machine on it [SI]; inertia about the arm's axis, with the autobalancer.

    Stiffness and damping of the joint are reduced to the length. Without a contact the arm idles.
    """

    length: float
    inertia: float
    joint_stiffness: float
    joint_damping: float
    contact_stiffness: float = 0.0
    friction: float = 0.0
    disk_radius: float = 0.0
    contact_angle: float = 0.0
    touch_angle: float = 0.0
    pressing_moment: float = 0.0


@formula(
    "Contact stiffness that acts on the arm, relative to c_n·l²",
    "k_Z(Z) = sin Z·(sin Z + f·(R_w/l − cos Z))",
    "1",
    where="f is that of a disk turning in the pressing sense.",
    source="Kovalenko 2010, (3)",
    published="the text measures Z to the tangent; sine and cosine would then change places",
)
def contact_gain(angle: float, friction: float, ratio: float) -> float:
    return math.sin(angle) * (math.sin(angle) + friction * (ratio - math.cos(angle)))


def _slope(angle: float, friction: float, ratio: float) -> float:
    """dk_Z/dZ, of the gain above."""
    return math.sin(2 * angle) + friction * ratio * math.cos(angle) - friction * math.cos(2 * angle)


@formula(
    "Contact angle Z* with the largest contact gain",
    "sin 2Z + f·(R_w/l)·cos Z − f·cos 2Z = 0",
    "rad",
    where="Z* as a series: π/2 + f/2 − (R_w/l)f²/4 + (3(R_w/l)² − 4)f³/24.",
    checked=(FRICTION, RADIUS_RATIO),
    source="Kovalenko 2010, (13); the exact root instead of the series",
)
def worst_contact_angle(friction: float, ratio: float) -> float:
    """
    >>> round(worst_contact_angle(0.4, 0.33), 5), round(worst_contact_angle(0.8, 0.33), 5)
    (1.75012, 1.87707)
    """
    f, r = FRICTION.check(friction), RADIUS_RATIO.check(ratio)
    return root(lambda angle: _slope(angle, f, r), math.pi / 2, 3 * math.pi / 4, xtol=1e-12)


@formula(
    "Contact angle with the smallest contact gain, at which friction lifts the wheel by itself",
    "sin 2Z + f·(R_w/l)·cos Z − f·cos 2Z = 0, Z < π/2",
    "rad",
    signs="k_Z",
    where="If f > 0 and R_w < l, k_Z is negative at this angle, and so is the stiffness of the contact.",
    checked=(FRICTION, RADIUS_RATIO),
    source="derived from Kovalenko 2010, (3)",
)
def lifting_angle(friction: float, ratio: float) -> float:
    """
    >>> round(lifting_angle(0.45, 0.33), 3), round(contact_gain(lifting_angle(0.45, 0.33), 0.45, 0.33), 4)
    (0.144, -0.022)
    """
    f, r = FRICTION.check(friction), RADIUS_RATIO.check(ratio)
    return root(lambda angle: _slope(angle, f, r), 0.0, math.pi / 2, xtol=1e-12)


@formula(
    "Pivot stiffness with which the arm stands at every contact angle",
    "c_sh > −c_n·min k_Z",
    "N/m",
    source="derived from Kovalenko 2010, (3)",
)
def standing_stiffness(arm: Arm) -> float:
    ratio = arm.disk_radius / arm.length
    return max(0.0, -arm.contact_stiffness * contact_gain(lifting_angle(arm.friction, ratio), arm.friction, ratio))


@formula(
    "Contact angles between which the arm does not stand",
    "c_sh + c_n·k_Z(Z) = 0",
    "rad",
    where="If c_sh > −c_n·min k_Z, the pivot is stiff enough for every angle, and there are none.",
    source="derived from Kovalenko 2010, (3)",
)
def lifted_angles(arm: Arm) -> tuple[float, float] | None:
    ratio = arm.disk_radius / arm.length
    lowest = lifting_angle(arm.friction, ratio)

    def stiffness(angle: float) -> float:
        """Stiffness of the arm [N/m] at a contact angle [rad]."""
        return arm.joint_stiffness + arm.contact_stiffness * contact_gain(angle, arm.friction, ratio)

    if stiffness(lowest) > 0:
        return None

    first = root(stiffness, 0.0, lowest) if stiffness(0.0) > 0 else 0.0
    return first, root(stiffness, lowest, math.pi / 2) if stiffness(math.pi / 2) > 0 else math.pi / 2


@formula(
    "Contact angles at which the speed causes parametric resonance",
    "c_sh + c_n·k_Z(Z) = J_O·Ω²/(4l²)",
    "rad",
    where="There are none, one or two: below and above the angle with the largest k_Z.",
    source="Kovalenko 2010, (3) and (22)",
)
def parametric_angles(arm: Arm, speed: float) -> tuple[float, ...]:
    ratio = arm.disk_radius / arm.length
    places = lifting_angle(arm.friction, ratio), worst_contact_angle(arm.friction, ratio), math.pi
    wanted = arm.inertia * speed**2 / (4 * arm.length**2)

    def excess(angle: float) -> float:
        """Stiffness of the arm above the resonant one [N/m] at a contact angle [rad]."""
        return arm.joint_stiffness + arm.contact_stiffness * contact_gain(angle, arm.friction, ratio) - wanted

    crossed = (pair for pair in itertools.pairwise(places) if excess(pair[0]) * excess(pair[1]) < 0)
    return tuple(root(excess, *pair, xtol=1e-12) for pair in crossed)


@formula(
    "Largest contact gain by its series",
    "k_Z* = 1 + (R_w/l)f + f²/4 − (R_w/l)f³/8",
    "1",
    checked=(FRICTION, RADIUS_RATIO),
    assumed="R_w/l 0.2 … 0.5",
    source="Kovalenko 2010, (14)",
    where="The series is never below the exact gain: it is on the safe side, by at most 1.2 %.",
)
def series_gain(friction: float, ratio: float) -> float:
    """
    >>> round(series_gain(0.4, 0.33), 6)
    1.16936
    """
    f, r = FRICTION.check(friction), RADIUS_RATIO.check(ratio)
    return 1 + r * f + f**2 / 4 - r * f**3 / 8


@formula(
    "Largest contact stiffness that keeps the arm supercritical",
    "(J_O·Ω² − c_sh·l²)/(k_Z·l²)",
    "N/m",
    where="k_Z is the exact contact gain or that of the series.",
    assumed="necessary, not sufficient, because the balls have mass",
    source="Kovalenko 2010, (13) and (14)",
)
def stiffness_limit(arm: Arm, speed: float, gain: float) -> float:
    return (arm.inertia * speed**2 - arm.joint_stiffness * arm.length**2) / (gain * arm.length**2)


@formula(
    "Natural frequency of the arm in contact",
    "ω₀* = √{(c_sh·l² + c_n·l²·k_Z*)/J_O}",
    "rad/s",
    source="Kovalenko 2010, (15)",
    where="Parametric resonance occurs at twice this frequency.",
)
def resonance(arm: Arm, gain: float) -> float:
    return arm.length * math.sqrt((arm.joint_stiffness + arm.contact_stiffness * gain) / arm.inertia)


@formula(
    "Pivot damping that parametric resonance cannot overcome",
    "(m₀e/l)·ω₀*·(1 + 17κ_a²/64 + 827κ_a⁴/4096), κ_a = l·m₀e/J_O",
    "N·s/m",
    checked=(MODULATION,),
    assumed="the least favourable speed near Ω = 2ω₀",
    source="Kovalenko 2010, (23) and (24); the factor is derived here (continued fraction of the modes)",
    published="without that factor the bound is unsafe by 0.27 % at κ_a = 0.1, and by 2.5 % at 0.3",
)
def damping_limit(arm: Arm, imbalance: float, natural: float) -> float:
    kappa = MODULATION.check(arm.length * imbalance / arm.inertia)
    return imbalance / arm.length * natural * (1 + 17 * kappa**2 / 64 + 827 * kappa**4 / 4096)


@formula(
    "Rate at which the arm's oscillation grows at Ω = 2ω₀, negative if it decays",
    "κ_a·ω₀/2 − h_a, h_a = h_sh·l²/(2J_O)",
    "1/s",
    checked=(MODULATION,),
    source="Kovalenko 2010, (22), as a rate in time",
)
def growth_rate(arm: Arm, imbalance: float, natural: float) -> float:
    kappa = MODULATION.check(arm.length * imbalance / arm.inertia)
    return kappa * natural / 2 - arm.joint_damping * arm.length**2 / (2 * arm.inertia)


@formula(
    "Static stiffness while cutting, reduced to the arm's length",
    "c_p = c_sh + c_n·k_Z(Z)",
    "N/m",
    where=(
        "At small contact angles the stiffness is negative, because friction lifts the wheel by itself. The arm then "
        "does not stand (static divergence)."
    ),
    assumed="one contact point",
    source="Kovalenko 2010, (3); the divergence is derived here",
)
def arm_stiffness(arm: Arm) -> float:
    return arm.joint_stiffness + arm.contact_stiffness * contact_gain(
        arm.contact_angle, arm.friction, arm.disk_radius / arm.length
    )


@formula(
    "Resting angle of the arm while cutting; none if the arm does not stand",
    "(T_a/l² + c_n·k_Z·φ₀)/c_p",
    "rad",
    source="Kovalenko 2010, (5')",
)
def pressed_angle(arm: Arm) -> float | None:
    stiffness = arm_stiffness(arm)
    if stiffness <= 0:
        return None
    contact = stiffness - arm.joint_stiffness
    return (arm.pressing_moment / arm.length**2 + contact * arm.touch_angle) / stiffness


@formula(
    "Pressing torque above which the wheel presses",
    "T_a > c_sh·l²·φ₀",
    "N·m",
    where=(
        "This holds if the arm stands. If the wheel touches the workpiece at rest or before, φ₀ ≤ 0, no torque is "
        "needed."
    ),
    source="Kovalenko 2010, below (5')",
)
def least_pressing_moment(arm: Arm) -> float:
    return max(0.0, arm.joint_stiffness * arm.length**2 * arm.touch_angle)


@formula(
    "Static normal force between wheel and workpiece",
    "N = c_n·l·(φ − φ₀)·sin Z",
    "N",
    source="Kovalenko 2010, (3)",
)
def normal_force(arm: Arm, angle: float) -> float:
    return arm.contact_stiffness * arm.length * (angle - arm.touch_angle) * math.sin(arm.contact_angle)


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
        "Resonances at ω₀ divided by a whole number are forced: the motion is large, but does not grow."
    ),
    checked=(MODULATION,),
    source="Kovalenko 2010, (11)",
    published="the source calls the motion near these resonances unstable; it is stable there",
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
    "Growth rates of the free motion of the arm",
    "−h_a away from resonance; −(h_a ± κ_a·ω₀/2) at Ω = 2ω₀",
    "1/s",
    where="A negative rate decays, a positive rate grows.",
    checked=(MODULATION,),
    source="Kovalenko 2010, (22), as rates in time",
)
def free_rates(kappa: float, natural: float, decay: float) -> tuple[float, float]:
    """The two at ω = 2ω₀, the larger first."""
    half = MODULATION.check(kappa) * natural / 2
    return half - decay, -half - decay


@formula(
    "Damping at the edge of the instability region, averaged",
    "h_a/(κ_a·ω₀) = ½·√{1 − 16·[(ω₀/Ω − ½)/κ_a]²}",
    "1",
    where=(
        "Without damping the arm's motion grows if |ω₀/Ω − ½| < κ_a/4. Outside this range it does not grow at any "
        "damping."
    ),
    assumed="small κ_a; the instability region at Ω = 2ω₀, the only one of practical size",
    source="Kovalenko 2010, (20) to (23)",
    published='the matrix "E = (0 0; 0 1)" is a misprint of the unit matrix',
)
def averaged_edge(kappa: float, ratio: float) -> float:
    """
    >>> averaged_edge(0.1, 0.5), averaged_edge(0.1, 0.525)
    (0.5, 0.0)
    """
    inside = 1 - 16 * ((ratio - 0.5) / kappa) ** 2
    return 0.5 * math.sqrt(inside) if inside > 0 else 0.0
