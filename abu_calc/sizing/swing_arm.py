"""Step 9: bounds for a machine on a swing arm (Kovalenko 2010, corrected)."""

import math
from dataclasses import dataclass, replace

from abu_calc.checks import Check, coded, verdict
from abu_calc.formulas.swing_arm import (
    Arm,
    arm_stiffness,
    contact_gain,
    damping_limit,
    growth_rate,
    pressed_angle,
    resonance,
    series_gain,
    stiffness_limit,
    worst_contact_angle,
)
from abu_calc.sizing.case import Case
from abu_calc.spec.machine import SwingArm
from abu_calc.units import from_si, to_si

LEAST_SINE = 1e-6


@dataclass(frozen=True)
class SwingArmBounds:
    """What stiffness and damping the arm must have [SI]."""

    arm: Arm
    stiffness_limit: float
    stiffness_limit_exact: float
    worst_angle: float
    resonance: float
    damping_limit: float
    growth_rate: float
    pressed_angle: float | None
    checks: tuple[Check, ...]


def swing_arm_bounds(case: Case, table: SwingArm, imbalance: float, added_mass: float) -> SwingArmBounds:
    """All bounds at the rated speed, stiffness ones at the lowest; the autobalancer adds its mass times l² to J_O."""
    arm = read_arm(case, table, added_mass)
    ratio = arm.disk_radius / arm.length
    worst, series = worst_contact_angle(arm.friction, ratio), series_gain(arm.friction, ratio)
    exact = contact_gain(worst, arm.friction, ratio)
    natural = resonance(arm, series)
    lowest = case.speed_range[0]
    limit = stiffness_limit(arm, lowest, series)
    damping = damping_limit(arm, imbalance, natural)
    angle = pressed_angle(arm)
    return SwingArmBounds(
        arm, limit, stiffness_limit(arm, lowest, exact), worst, natural, damping,
        growth_rate(arm, imbalance, natural), angle,
        _doubted(_checks(arm, min(limit, stiffness_limit(arm, lowest, exact)), damping, angle), table.borrowed()),
    )  # fmt: skip


def _doubted(checks: tuple[Check, ...], borrowed: tuple[str, ...]) -> tuple[Check, ...]:
    """What passes by another machine's data alone warns."""
    if not borrowed:
        return checks
    reason, remedy = "; rests on example data", "Give [swing_arm] its own numbers, see the warning."
    return tuple(
        replace(check, status="warn", message=check.message + reason, remedy=remedy)
        if check.status == "pass"
        else check
        for check in checks
    )


def read_arm(case: Case, table: SwingArm, added_mass: float) -> Arm:
    """The table [swing_arm] in SI."""
    length = to_si(table.arm_length_mm, "mm")
    return Arm(
        length=length,
        inertia=table.moment_of_inertia_kg_m2 + added_mass * length**2,
        joint_stiffness=table.joint_stiffness_N_per_m,
        joint_damping=table.joint_damping_N_s_per_m,
        contact_stiffness=table.contact_stiffness_N_per_m,
        friction=table.cutting_coefficient,
        disk_radius=case.wheel_radius,
        contact_angle=to_si(table.contact_angle_deg, "deg"),
        touch_angle=to_si(table.touch_angle_deg, "deg"),
        pressing_moment=table.pressing_moment_N_m,
    )


def _checks(arm: Arm, limit: float, damping: float, angle: float | None) -> tuple[Check, ...]:
    stiff, damped, stiffness = arm.contact_stiffness < limit, arm.joint_damping > damping, arm_stiffness(arm)
    return (
        coded("ABU501", verdict(stiff), "supercritical at the lowest speed and the worst "
              "contact angle (the safer of series and exact); necessary, not sufficient", arm.contact_stiffness, limit,
              "N/m", None if stiff else "A longer arm, more inertia, a higher speed, or a softer wheel."),
        coded("ABU502", verdict(damped), "above what parametric resonance at twice the natural "
              "frequency can overcome", arm.joint_damping, damping, "N·s/m",
              None if damped else "More damping in the joint, or less imbalance.", "least"),
        coded("ABU504", verdict(stiffness > 0), "static stiffness with the contact,"
              " negative where friction lifts the wheel by itself (static divergence)", stiffness, 0.0, "N/m",
              None if stiffness > 0 else "Turn the contact angle nearer to 90°, or a much stiffer joint.", "least"),
        _pressing(arm, angle),
    )  # fmt: skip


def _pressing(arm: Arm, angle: float | None) -> Check:
    """N = c_n·l·(φ − φ₀)·sin Z presses only when the arm stands and does not point along the normal."""
    touch = from_si(arm.touch_angle, "deg")
    if angle is None or math.sin(arm.contact_angle) < LEAST_SINE:
        return coded("ABU503", "not-done", "the arm does not stand, or points along the normal, so that no force "
                     "presses", None, touch, "°", "Turn the contact angle nearer to 90°.", "least")  # fmt: skip
    pressed = angle > arm.touch_angle
    return coded("ABU503", verdict(pressed), "resting angle beyond the touching angle", from_si(angle, "deg"), touch,
                 "°", None if pressed else "A larger pressing torque or a softer joint.", "least")  # fmt: skip
