"""Step 9: bounds for a machine on a swing arm, over all contact angles, and changes that meet them.

Source: Kovalenko 2010, corrected.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Final

from abu_calc.formulas.swing_arm import (
    MODULATION,
    Arm,
    arm_stiffness,
    contact_gain,
    damping_limit,
    growth_rate,
    least_pressing_moment,
    lifted_angles,
    normal_force,
    parametric_angles,
    pressed_angle,
    resonance,
    series_gain,
    standing_stiffness,
    stiffness_limit,
    worst_contact_angle,
)
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import in_file, shown
from abu_calc.inputs.duty import SwingArm
from abu_calc.sizing.case import Case

LEAST_SINE = 1e-6


@dataclass(frozen=True)
class SwingArmBounds:
    """Stiffness and damping that the arm must have [SI]; `arm`: the arm with the autobalancer on it.

    `damping_limit_bunched`: damping needed while the balls are together on the heavy side; None beyond κ = 0.3.
    `lifted_contact_angles`: contact angles between which the arm does not stand.
    `joint_stiffness_standing`: stiffness of the pivot with which the arm stands at every contact angle.
    `parametric_contact_angles`: contact angles at which the rated speed is twice the natural frequency.
    `cutting_frequency`: at the contact angle given; None, like the resting angle, if the arm does not stand.
    """

    arm: Arm
    contact_stiffness_limit: float
    contact_stiffness_limit_exact: float
    worst_contact_angle: float
    resonance: float
    damping_limit: float
    damping_limit_bunched: float | None
    parametric_growth_rate: float
    idle_frequency: float
    cutting_frequency: float | None
    parametric_contact_angles: tuple[float, ...]
    lifted_contact_angles: tuple[float, float] | None
    joint_stiffness_standing: float
    least_pressing_moment: float
    pressed_angle: float | None
    press_force: float | None
    checks: tuple[Check, ...]


def swing_arm_bounds(
    case: Case, table: SwingArm, imbalance: float, added_mass: float, capacity: float = 0.0
) -> SwingArmBounds:
    """All bounds at the rated speed, stiffness ones at the lowest; the autobalancer adds its mass times l² to J_O.

    `capacity` of the balls [kg m]: it adds to the imbalance while they stand on the heavy side.
    """
    arm = table.arm(case.wheel_radius, added_mass)
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
        contact_stiffness_limit=limits[0],
        contact_stiffness_limit_exact=limits[1],
        worst_contact_angle=worst,
        resonance=natural,
        damping_limit=damping,
        damping_limit_bunched=damping_limit(arm, heavy, natural) if known else None,
        parametric_growth_rate=growth_rate(arm, imbalance, natural),
        idle_frequency=resonance(arm, 0.0),
        cutting_frequency=resonance(arm, own) if arm_stiffness(arm) > 0 else None,
        parametric_contact_angles=parametric_angles(arm, case.speed),
        lifted_contact_angles=lifted_angles(arm),
        joint_stiffness_standing=standing_stiffness(arm),
        least_pressing_moment=least_pressing_moment(arm),
        pressed_angle=angle,
        press_force=None if angle is None else normal_force(arm, angle),
        checks=(),
    )
    return replace(bounds, checks=doubted(_checks(bounds), table.borrowed()))


def doubted(checks: tuple[Check, ...], borrowed: tuple[str, ...]) -> tuple[Check, ...]:
    """Checks with a warning in place of each pass that rests on another machine's data alone."""
    if not borrowed:
        return checks
    reason, remedy = ". It rests on example data", "Specify your own numbers in [swing_arm], see the warning."
    return tuple(
        replace(check, status="warn", message=check.message + reason, remedy=remedy)
        if check.status == "pass"
        else check
        for check in checks
    )


def _checks(bounds: SwingArmBounds) -> tuple[Check, ...]:
    arm, limit = bounds.arm, min(bounds.contact_stiffness_limit, bounds.contact_stiffness_limit_exact)
    stiff, stiffness, lifted = arm.contact_stiffness < limit, arm_stiffness(arm), _lifted(bounds.lifted_contact_angles)
    return (
        coded("ABU501", verdict(stiff), "The arm must be supercritical at the lowest speed and the worst contact "
              "angle (safer of two formulas). That is necessary, not sufficient", arm.contact_stiffness, limit),
        _damping_check(arm, bounds.damping_limit, bounds.damping_limit_bunched),
        coded("ABU504", verdict(stiffness > 0), f"Static stiffness with the contact. {lifted}", stiffness, 0.0),
        _pressing(arm, bounds.pressed_angle),
    )  # fmt: skip


def _damping_check(arm: Arm, limit: float, bunched: float | None) -> Check:
    """Check of the damping against the imbalance.

    It warns if balls that are on the heavy side at a start need more.
    """
    enough = arm.joint_damping > limit
    safe = bunched is not None and arm.joint_damping > bunched
    message = "The damping overcomes parametric resonance at twice the natural frequency while the disk is pressed"
    if not enough:
        message = "Parametric resonance at twice the natural frequency overcomes the damping while the disk is pressed"
    elif not safe:
        message += ". While the balls are together on the heavy side, as in a start, it does not"
        message += "" if bunched is None else f". That needs {bunched:.3g} N·s/m"
    return coded("ABU502", verdict(enough, safe), message, arm.joint_damping, limit)


def _lifted(angles: tuple[float, float] | None) -> str:
    """Contact angles at which the arm would not stand, in words."""
    if angles is None:
        return "The arm stands at every contact angle"
    low, high = (shown(angle, "deg") for angle in angles)
    return f"From {low} to {high} friction lifts the wheel by itself (static divergence)"


def _pressing(arm: Arm, angle: float | None) -> Check:
    """N = c_n·l·(φ − φ₀)·sin Z presses only when the arm stands and does not point along the normal."""
    if angle is None or math.sin(arm.contact_angle) < LEAST_SINE:
        return coded("ABU503", "not-done", "The arm does not stand, or points along the normal, so that no force "
            "presses", None, arm.touch_angle,
        )  # fmt: skip
    pressed = angle > arm.touch_angle
    return coded("ABU503", verdict(pressed), "The resting angle must be beyond the touching angle", angle,
        arm.touch_angle,
    )  # fmt: skip


MARGINS: Final = (1.05, 1.2, 1.5, 2.0, 3.0)
"""Factors over a bound that are proposed."""

PRESSED: Final = 45.0
"""Force [N] to press with if nothing else gives one; the upper feed force of ISO 28927-4."""

OFF_THE_NORMAL: Final = 10.0
"""Least angle to the normal that is proposed [°]."""

DIGITS: Final = 3
ROUNDING: Final = 1e-9

INERTIA, DAMPING, PRESSING = "moment_of_inertia_kg_m2", "joint_damping_N_s_per_m", "pressing_moment_N_m"
ANGLE, JOINT, CONTACT = "contact_angle_deg", "joint_stiffness_N_per_m", "contact_stiffness_N_per_m"
"""Keys of [swing_arm] that are changed."""


def changes(bounds: SwingArmBounds, case: Case, key: str) -> Iterator[dict[str, float]]:
    """Values by keys of [swing_arm] that meet the bound of a check, by its key, from near to far."""
    ways: Mapping[str, Callable[[SwingArmBounds], Iterator[dict[str, float]]]] = {
        "arm_stiffness": partial(_supercritical, case), "arm_damping": _damped, "arm_pressed": _pressed,
        "arm_stands": _standing,
    }  # fmt: skip
    yield from ways[key](bounds)


def _supercritical(case: Case, bounds: SwingArmBounds) -> Iterator[dict[str, float]]:
    """A softer contact or more inertia, by more and more above the bound at the lowest speed.

    The contact comes first: on a heavier arm the balls lower the level less.
    """
    limit = min(bounds.contact_stiffness_limit, bounds.contact_stiffness_limit_exact)
    table = case.table.swing_arm
    added = bounds.arm.inertia - (table.moment_of_inertia_kg_m2 if table else 0.0)
    for margin in MARGINS:
        if limit > 0:
            yield {CONTACT: -up(-limit / margin)}
        yield {INERTIA: up(margin * bounds.arm.inertia * (bounds.resonance / case.speed_range[0]) ** 2 - added)}


def _damped(bounds: SwingArmBounds) -> Iterator[dict[str, float]]:
    """Damping against parametric resonance, with the balls together on the heavy side or with the imbalance alone."""
    for limit in (bounds.damping_limit_bunched, bounds.damping_limit):
        if limit is not None:
            yield {DAMPING: up(MARGINS[0] * limit)}


def _standing(bounds: SwingArmBounds) -> Iterator[dict[str, float]]:
    """A contact angle or a pivot with which the arm stands and can press."""
    if bounds.arm.contact_angle > math.pi / 2:
        yield {ANGLE: 180.0 - OFF_THE_NORMAL}
    else:
        key, lifted = in_file(ANGLE, (bounds.lifted_contact_angles or (0.0, 0.0))[1])
        yield {key: min(float(math.ceil(max(MARGINS[0] * lifted, OFF_THE_NORMAL))), 90.0)}
    yield {JOINT: up(MARGINS[0] * bounds.joint_stiffness_standing)}


def _pressed(bounds: SwingArmBounds) -> Iterator[dict[str, float]]:
    """More pressing torque or a softer pivot; another contact angle if no force can press at this one."""
    arm, least = bounds.arm, bounds.least_pressing_moment
    if bounds.pressed_angle is None or math.sin(arm.contact_angle) < LEAST_SINE:
        yield next(_standing(bounds))
        return
    for moment in (MARGINS[0] * least, least + PRESSED * arm.length):
        if moment:
            yield {PRESSING: up(moment)}
    if least:
        yield {JOINT: -up(-arm.joint_stiffness * arm.pressing_moment / least / MARGINS[0])}


def up(value: float) -> float:
    """The next number of few digits that is not below.

    >>> up(1.2341), up(0.5), up(2046.1), -up(-2046.1)
    (1.24, 0.5, 2050.0, 2040.0)
    """
    if not value:
        return value
    places = DIGITS - 1 - math.floor(math.log10(abs(value)))
    return round(math.ceil(value * 10.0**places - ROUNDING) / 10.0**places, places)
