"""A rotor at the end of a swing arm, of which small angles are not assumed."""

import math

import numpy as np

from abu_calc.dynamics.equations.parameters import Array, Parameters
from abu_calc.dynamics.motion import Levers, Motion
from abu_calc.dynamics.supports.kinds import LARGEST, SwingArm
from abu_calc.dynamics.supports.linear import turned
from abu_calc.errors import InputError
from abu_calc.formulas.swing_arm import contact_gain
from abu_calc.validity import Range

CONTACT_STIFFNESS = Range("contact stiffness", 0, LARGEST, "N/m")
FRICTION = Range("cutting coefficient", 0, 1.5)
CONTACT_ANGLE = Range("contact angle", 0, math.pi, "rad")
WHEEL_RADIUS = Range("wheel radius", 0, LARGEST, "m", open_low=True)
ARM_LENGTH = Range("arm length", 0, LARGEST, "m", open_low=True)


def idle_arm(length: float, inertia: float, joint_stiffness: float, joint_damping: float) -> SwingArm:
    """J_O φ'' + h_sh l² φ' + c_sh l² φ = what rotor and balls do; the arm rests at φ = 0.

    Length l [m], J_O [kg m²] without balls, stiffness [N/m] and damping [N·s/m] of the joint reduced to l. Source:
    Kovalenko 2010, (2). Raises RangeError.

    >>> idle_arm(0.35, 0.62, 2000.0, 40.0).moment
    0.0
    """
    return SwingArm(length, inertia, joint_stiffness, joint_damping)


def cutting_arm(
    length: float,
    inertia: float,
    joint_stiffness: float,
    joint_damping: float,
    contact_stiffness: float,
    cutting_coefficient: float,
    contact_angle: float,
    touch_angle: float,
    pressing_moment: float,
    wheel_radius: float,
) -> SwingArm:
    """The arm while the disk cuts, pressed to the work by N = c_n l (φ − φ₀) sin Z, dragged by T = f N.

        c^(p) = c_sh + c_n g(Z),    moment = M_p + c_n l² g(Z) φ₀,    g(Z) = sin Z (sin Z + f (R/l − cos Z))

    Contact stiffness c_n [N/m], cutting coefficient f of a disk that turns in the sense of +φ, the pressing one, Z
    [rad] between the arm and the contact radius, φ₀ [rad] where the disk touches, M_p [N m], wheel radius R [m]. One
    contact point that never parts. φ is the arm's own angle: it rests at `resting_angle`. Raises RangeError. Source:
    Kovalenko 2010, (3). Printed: the text measures Z to the tangent; (3) holds for the normal.

    >>> arm = cutting_arm(0.35, 0.62, 2000.0, 40.0, 1e6, 0.0, math.pi / 2, 0.02, 20.0, 0.115)
    >>> arm.stiffness, round(arm.moment, 9)
    (1002000.0, 2470.0)
    """
    CONTACT_STIFFNESS.check(contact_stiffness)
    ratio = WHEEL_RADIUS.check(wheel_radius) / ARM_LENGTH.check(length)
    gain = contact_gain(CONTACT_ANGLE.check(contact_angle), FRICTION.check(cutting_coefficient), ratio)
    felt = contact_stiffness * gain
    return SwingArm(
        length=length,
        inertia=inertia,
        stiffness=joint_stiffness + felt,
        damping=joint_damping,
        moment=pressing_moment + felt * length**2 * touch_angle,
    )


def resting_angle(arm: SwingArm) -> float:
    """φ [rad] at which the arm stands, moment/(c l²); Kovalenko 2010, (5').

    Raises InputError where it does not stand: friction at a small contact angle pushes the work's side away
    (static divergence), or nothing holds it.

    >>> resting_angle(SwingArm(2.0, 1.0, 5.0, 0.0, moment=4.0))
    0.2
    """
    if arm.stiffness > 0:
        return arm.moment / (arm.stiffness * arm.length**2)
    if arm.stiffness == 0 and arm.moment == 0:
        return 0.0
    raise InputError(
        "the arm does not stand: its stiffness with the contact is not positive",
        found=f"{arm.stiffness:g} N/m",
        allowed="above 0",
        remedy="turn the contact angle nearer to 90°, or a stiffer joint",
    )


def levers(m: Motion, p: Parameters) -> Levers:
    """A = φ'': T = l cos ψ + R_p, N = l sin ψ, ψ = γ − φ; the races are carried with φ'² l (sin ψ, −cos ψ).

    Source: Kovalenko 2010, (1) and (2), whose ball angle ψ is counted from the arm.
    """
    arm, rate = m.support[0], m.support[1]
    psi_cos, psi_sin = _about(m, m.cos, m.sin, m.xp.cos(arm), m.xp.sin(arm))
    l_cos, l_sin = p.arm_length * psi_cos, p.arm_length * psi_sin
    found = Levers((l_cos + m.radii)[None, :], l_sin[None, :], None)
    found.carry(rate * rate * l_sin, -(rate * rate) * l_cos)
    return turned(m, p, found)


def _about(m: Motion, cos: Array, sin: Array, arm_cos: Array, arm_sin: Array) -> tuple[Array, Array]:
    """cos and sin of an inertial angle less the arm's."""
    return cos * arm_cos + sin * arm_sin, sin * arm_cos - cos * arm_sin


def imbalance(m: Motion, p: Parameters) -> tuple[Array, Array | None]:
    """Moment about the arm's axis of an imbalance U at ψ₀: U l (speed² − φ'²) sin ψ₀, and its inertia 2 U l cos ψ₀.

    Source: Kovalenko 2010, (2), the term of index 0; its own inertia belongs to that of the arm.
    """
    arm, rate = m.support[0], m.support[1]
    psi = m.turn + p.imbalance_angle - arm
    along = p.imbalance * p.arm_length * m.xp.cos(psi)
    force = p.imbalance * p.arm_length * m.xp.sin(psi) * (m.speed * m.speed - rate * rate) - along * m.acceleration
    if p.rotor != "driven":
        return np.array([force]), np.array([[2 * along]])
    return np.array([force, -p.imbalance * p.arm_length * m.xp.sin(psi) * rate * rate]), np.array(
        [[2 * along, along], [along, 0.0]]
    )
