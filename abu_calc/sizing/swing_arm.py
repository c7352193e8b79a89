"""Step 9: bounds for a machine on a swing arm, over all contact angles (Kovalenko 2010, corrected)."""

import math
from dataclasses import replace

from abu_calc.check_codes import CHECK_CODES
from abu_calc.checks import Check, coded, verdict
from abu_calc.formulas.swing_arm import (
    MODULATION,
    Arm,
    arm_stiffness,
    contact_gain,
    damping_limit,
    growth_rate,
    least_pressing_moment,
    lifted_angles,
    parametric_angles,
    press_force,
    pressed_angle,
    resonance,
    series_gain,
    standing_stiffness,
    stiffness_limit,
    worst_contact_angle,
)
from abu_calc.frozen import dataclass
from abu_calc.sizing.case import Case
from abu_calc.spec.machine import SwingArm
from abu_calc.units import from_si, to_si

LEAST_SINE = 1e-6


@dataclass(frozen=True)
class SwingArmBounds:
    """Stiffness and damping that the arm must have [SI]; `arm`: the arm with the autobalancer on it.

    `bunched_limit`: damping needed while the balls are together on the heavy side; None beyond κ = 0.3.
    `lifted`: contact angles between which the arm does not stand.
    `standing_stiffness`: stiffness of the pivot with which the arm stands at every contact angle.
    `parametric_angles`: contact angles at which the rated speed is twice the natural frequency.
    `cutting_frequency`: at the contact angle given; None, like the resting angle, if the arm does not stand.
    """

    arm: Arm
    stiffness_limit: float
    stiffness_limit_exact: float
    worst_angle: float
    resonance: float
    damping_limit: float
    bunched_limit: float | None
    growth_rate: float
    idle_frequency: float
    cutting_frequency: float | None
    parametric_angles: tuple[float, ...]
    lifted: tuple[float, float] | None
    standing_stiffness: float
    least_moment: float
    pressed_angle: float | None
    press_force: float | None
    checks: tuple[Check, ...]


def swing_arm_bounds(
    case: Case, table: SwingArm, imbalance: float, added_mass: float, capacity: float = 0.0
) -> SwingArmBounds:
    """All bounds at the rated speed, stiffness ones at the lowest; the autobalancer adds its mass times l² to J_O.

    `capacity` of the balls [kg m]: it adds to the imbalance while they stand on the heavy side.
    """
    arm = read_arm(case, table, added_mass)
    ratio = arm.disk_radius / arm.length
    worst, series = worst_contact_angle(arm.friction, ratio), series_gain(arm.friction, ratio)
    natural = resonance(arm, series)
    lowest = case.speed_range[0]
    limits = [stiffness_limit(arm, lowest, gain) for gain in (series, contact_gain(worst, arm.friction, ratio))]
    damping, angle = damping_limit(arm, imbalance, natural), pressed_angle(arm)
    own = contact_gain(arm.contact_angle, arm.friction, ratio)
    heavy = imbalance + capacity
    known = arm.length * heavy / arm.inertia <= MODULATION.high
    bounds = SwingArmBounds(
        arm=arm,
        stiffness_limit=limits[0],
        stiffness_limit_exact=limits[1],
        worst_angle=worst,
        resonance=natural,
        damping_limit=damping,
        bunched_limit=damping_limit(arm, heavy, natural) if known else None,
        growth_rate=growth_rate(arm, imbalance, natural),
        idle_frequency=resonance(arm, 0.0),
        cutting_frequency=resonance(arm, own) if arm_stiffness(arm) > 0 else None,
        parametric_angles=parametric_angles(arm, case.speed),
        lifted=lifted_angles(arm),
        standing_stiffness=standing_stiffness(arm),
        least_moment=least_pressing_moment(arm),
        pressed_angle=angle,
        press_force=None if angle is None else press_force(arm, angle),
        checks=(),
    )
    return replace(bounds, checks=doubted(_checks(bounds), table.borrowed()))


def doubted(checks: tuple[Check, ...], borrowed: tuple[str, ...]) -> tuple[Check, ...]:
    """Checks with a warning in place of each pass that rests on another machine's data alone."""
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


def _checks(bounds: SwingArmBounds) -> tuple[Check, ...]:
    arm, limit = bounds.arm, min(bounds.stiffness_limit, bounds.stiffness_limit_exact)
    stiff, stiffness = arm.contact_stiffness < limit, arm_stiffness(arm)
    return (
        coded("ABU501", verdict(stiff), "supercritical at the lowest speed and the worst "
              "contact angle (the safer of series and exact), while the disk is pressed; necessary, not sufficient",
              arm.contact_stiffness, limit, "N/m", None if stiff else CHECK_CODES["ABU501"].remedy),
        _damped(arm, bounds.damping_limit, bounds.bunched_limit),
        coded("ABU504", verdict(stiffness > 0), f"static stiffness with the contact{_lifted(bounds.lifted)}",
              stiffness, 0.0, "N/m", None if stiffness > 0 else CHECK_CODES["ABU504"].remedy, "least"),
        _pressing(arm, bounds.pressed_angle),
    )  # fmt: skip


def _damped(arm: Arm, limit: float, bunched: float | None) -> Check:
    """Check of the damping against the imbalance.

    It warns if balls that are on the heavy side at a start need more.
    """
    damped = arm.joint_damping > limit
    safe = bunched is not None and arm.joint_damping > bunched
    message = "above what parametric resonance at twice the natural frequency can overcome while the disk is pressed"
    if damped and not safe:
        message += "; not while the balls stand on the heavy side, as in a start"
    more = None if bunched is None else f"Above {bunched:.3g} N·s/m it damps that, too."
    return coded("ABU502", verdict(damped, safe), message, arm.joint_damping, limit, "N·s/m",
                 CHECK_CODES["ABU502"].remedy if not damped else None if safe else more, "least")  # fmt: skip


def _lifted(angles: tuple[float, float] | None) -> str:
    """Contact angles at which the arm would not stand, in words."""
    if angles is None:
        return "; it stands at every contact angle"
    low, high = (from_si(angle, "deg") for angle in angles)
    return f"; from {low:.3g}° to {high:.3g}° friction lifts the wheel by itself (static divergence)"


def _pressing(arm: Arm, angle: float | None) -> Check:
    """N = c_n·l·(φ − φ₀)·sin Z presses only when the arm stands and does not point along the normal."""
    touch = from_si(arm.touch_angle, "deg")
    if angle is None or math.sin(arm.contact_angle) < LEAST_SINE:
        return coded("ABU503", "not-done", "the arm does not stand, or points along the normal, so that no force "
                     "presses", None, touch, "°", "Turn the contact angle nearer to 90°.", "least")  # fmt: skip
    pressed = angle > arm.touch_angle
    return coded("ABU503", verdict(pressed), "resting angle beyond the touching angle", from_si(angle, "deg"), touch,
                 "°", None if pressed else CHECK_CODES["ABU503"].remedy, "least")  # fmt: skip
