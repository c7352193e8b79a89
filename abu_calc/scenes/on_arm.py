"""The swing arm of a design as the support of its scenes."""

import math

from abu_calc.dynamics.supports.swing_arm import SwingArm, cutting_arm, idle_arm
from abu_calc.errors import NotTrustworthyError
from abu_calc.formulas.slow_motion import ball_stiffness, decay_rate
from abu_calc.formulas.swing_arm import pressed_angle
from abu_calc.sizing.design import Design
from abu_calc.sizing.swing_arm import read_arm
from abu_calc.spec.machine import SwingArm as SwingArmTable


def arm_of_design(design: Design, table: SwingArmTable, *, cutting: bool) -> SwingArm:
    """The swing arm with the machine and the autobalancer, without balls."""
    case, autobalancer = design.case, design.autobalancer
    arm = read_arm(case, table, autobalancer.mass - autobalancer.ball_count * autobalancer.ball_mass)
    joint = arm.length, arm.inertia, arm.joint_stiffness, arm.joint_damping
    if not cutting:
        return idle_arm(*joint)
    angle = pressed_angle(arm)
    if angle is None or angle < arm.touch_angle:
        why = "does not stand" if angle is None else "does not reach the work"
        raise NotTrustworthyError(
            f"the swing arm {why} while cutting\n  turn the contact angle nearer to 90°, or press with a larger moment"
        )
    return cutting_arm(
        *joint, arm.contact_stiffness, arm.friction, arm.contact_angle, arm.touch_angle, arm.pressing_moment,
        arm.disk_radius,
    )  # fmt: skip


def ball_rate_on_arm(design: Design, arm: SwingArm, drag: float) -> float:
    """Slowest decay rate of the balls' slow motion [1/s] on an arm, at a viscous drag rate [1/s].

    There the rotor moves along one axis alone, so that half the stiffness of the slow motion is left.
    """
    case, candidate = design.case, design.autobalancer
    mass = arm.felt_mass + candidate.ball_count * candidate.ball_mass
    natural = math.sqrt(max(arm.stiffness, 0.0) / mass)
    kappa = ball_stiffness(candidate.ball_mass, mass, case.speed, (natural, natural)) / 2
    return decay_rate((kappa,) * candidate.ball_count, candidate.budget.resting_angles, drag, case.inertia_factor)
