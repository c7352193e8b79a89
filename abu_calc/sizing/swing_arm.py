"""Step 9: bounds for a machine on a swing arm, over all contact angles, and changes that meet them.

Changes come with their size: stiffness first, damping second. Source: Kovalenko 2010, corrected.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Final, Literal

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
from abu_calc.foundation.checks import CHECK_CODES, Check, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.foundation.validity import bounded
from abu_calc.inputs.machine import SwingArm
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
    arm, limit = bounds.arm, min(bounds.contact_stiffness_limit, bounds.contact_stiffness_limit_exact)
    stiff, stiffness, lifted = arm.contact_stiffness < limit, arm_stiffness(arm), _lifted(bounds.lifted_contact_angles)
    return (
        coded("ABU501", verdict(stiff), "The arm must be supercritical at the lowest speed and the worst contact "
              "angle (safer of two formulas). That is necessary, not sufficient",
              arm.contact_stiffness, limit, "N/m", None if stiff else CHECK_CODES["ABU501"].action),
        _damped(arm, bounds.damping_limit, bounds.damping_limit_bunched),
        coded("ABU504", verdict(stiffness > 0), f"Static stiffness with the contact. {lifted}",
              stiffness, 0.0, "N/m", None if stiffness > 0 else CHECK_CODES["ABU504"].action, "least"),
        _pressing(arm, bounds.pressed_angle),
    )  # fmt: skip


def _damped(arm: Arm, limit: float, bunched: float | None) -> Check:
    """Check of the damping against the imbalance.

    It warns if balls that are on the heavy side at a start need more.
    """
    damped = arm.joint_damping > limit
    safe = bunched is not None and arm.joint_damping > bunched
    message = "The damping overcomes parametric resonance at twice the natural frequency while the disk is pressed"
    if not damped:
        message = "Parametric resonance at twice the natural frequency overcomes the damping while the disk is pressed"
    elif not safe:
        message += ". While the balls are together on the heavy side, as in a start, it does not"
    more = None if bunched is None else f"A pivot damping above {bunched:.3g} N·s/m overcomes that, too (calculated)."
    return coded("ABU502", verdict(damped, safe), message, arm.joint_damping, limit, "N·s/m",
                 CHECK_CODES["ABU502"].action if not damped else None if safe else more, "least")  # fmt: skip


def _lifted(angles: tuple[float, float] | None) -> str:
    """Contact angles at which the arm would not stand, in words."""
    if angles is None:
        return "The arm stands at every contact angle"
    low, high = (from_si(angle, "deg") for angle in angles)
    return f"From {low:.3g}° to {high:.3g}° friction lifts the wheel by itself (static divergence)"


def _pressing(arm: Arm, angle: float | None) -> Check:
    """N = c_n·l·(φ − φ₀)·sin Z presses only when the arm stands and does not point along the normal."""
    touch = from_si(arm.touch_angle, "deg")
    if angle is None or math.sin(arm.contact_angle) < LEAST_SINE:
        return coded("ABU503", "not-done", "The arm does not stand, or points along the normal, so that no force "
                     "presses", None, touch, "°", "Turn the contact angle nearer to 90°.", "least")  # fmt: skip
    pressed = angle > arm.touch_angle
    return coded("ABU503", verdict(pressed), "The resting angle must be beyond the touching angle",
                 from_si(angle, "deg"), touch, "°", None if pressed else CHECK_CODES["ABU503"].action,
                 "least")  # fmt: skip


PRESSED: Final = 45.0
"""Force [N] to press with where nothing else says how much; the upper feed force of ISO 28927-4."""

OFF_THE_NORMAL: Final = math.radians(10)
"""Least angle to the normal that is proposed."""

DIGITS: Final = 3
ROUNDING: Final = 1e-9
WHOLE: Final = 2.0
"""A new value beyond this multiple of the old one is told as a multiple."""


@dataclass(frozen=True)
class ArmRepair:
    """A key of [swing_arm] with another value."""

    key: str
    old: float
    new: float

    @property
    def text(self) -> str:
        """Change in words, with the step from the old value.

        >>> ArmRepair("joint_damping_N_s_per_m", 2.0, 2.5).text, ArmRepair("joint_damping_N_s_per_m", 0.01, 0.35).text
        ('joint_damping_N_s_per_m = 2.5 (+25 %)', 'joint_damping_N_s_per_m = 0.35 (35 times)')
        """
        if self.key.endswith("_deg"):
            step = f"{self.new - self.old:+.3g}°"
        elif not self.old:
            step = "from 0"
        elif self.new >= WHOLE * self.old:
            times = self.new / self.old
            step = f"{times:.0f} times" if times >= 100 else f"{times:.3g} times"
        else:
            share = 100 * (self.new / self.old - 1)
            step = f"{share:+.0f} %" if share > -99 else f"{share:+.2f} %"
        return f"{self.key} = {bounded(self.new)} ({step})"

    @property
    def reach(self) -> float:
        """Distance from the old value: the logarithm of the ratio; 0 for an angle, which is at hand."""
        if self.key.endswith("_deg") or not self.old or not self.new:
            return 0.0
        return abs(math.log(self.new / self.old))


@dataclass(frozen=True)
class Way:
    """Choices in mending an arm; `margin` over each bound."""

    margin: float = 1.05
    softer_contact: bool = False
    joint: Literal["as it is", "stiffer", "softer"] = "as it is"
    """Stiff enough for every contact angle, or soft enough for the torque that presses."""
    inertia: float = 1.0
    """Least factor on the present inertia, whatever the bounds say."""
    damping: float = 1.0


def changes(
    arm: Arm, own_inertia: float, imbalance: float, lowest_speed: float, way: Way
) -> tuple[ArmRepair, ...] | None:
    """Least changes by `way`, in the units of [swing_arm], with which the bounds hold; None: there are none.

    At `lowest_speed` [rad/s]; `own_inertia`: without the autobalancer. They rest on each other: what is stiffer needs
    more inertia, and the damping is that which the arm changed so far needs.
    """
    best = _standing(_supercritical(_held(arm, way), own_inertia, lowest_speed, way), way)
    if best is None:
        return None
    limit = damping_limit(best, imbalance, resonance(best, _gain(best)))
    if best.joint_damping <= limit or way.damping > 1:
        best = replace(best, joint_damping=up(max(way.margin * limit, way.damping * arm.joint_damping)))
    angle = pressed_angle(best)
    if angle is None or angle <= best.touch_angle:
        best = replace(best, pressing_moment=up(way.margin * least_pressing_moment(best) or PRESSED * best.length))
    return tuple(ArmRepair(key, old, new) for key, old, new in _differences(arm, best, own_inertia))


def _gain(arm: Arm) -> float:
    """The larger of series and exact, the safer."""
    ratio = arm.disk_radius / arm.length
    exact = contact_gain(worst_contact_angle(arm.friction, ratio), arm.friction, ratio)
    return max(series_gain(arm.friction, ratio), exact)


def _held(arm: Arm, way: Way) -> Arm | None:
    """Arm with another pivot, if `way` asks for one; None if it cannot be softer."""
    if way.joint == "stiffer":
        return replace(arm, joint_stiffness=up(max(arm.joint_stiffness, way.margin * standing_stiffness(arm))))
    if way.joint == "softer":
        torque = arm.length**2 * arm.touch_angle
        softer = -up(-arm.pressing_moment / torque / way.margin) if torque > 0 else arm.joint_stiffness
        return replace(arm, joint_stiffness=softer) if softer < arm.joint_stiffness else None
    return arm


def _supercritical(arm: Arm | None, own: float, speed: float, way: Way) -> Arm | None:
    """More inertia or a softer contact, where the contact is too stiff."""
    if arm is None:
        return None
    limit, square = stiffness_limit(arm, speed, _gain(arm)), arm.length**2
    if arm.contact_stiffness < limit and way.inertia == 1:
        return arm
    if way.softer_contact:
        return replace(arm, contact_stiffness=-up(-limit / way.margin)) if limit > 0 else None
    needed = square * (way.margin * _gain(arm) * arm.contact_stiffness + arm.joint_stiffness) / speed**2
    added = arm.inertia - own
    return replace(arm, inertia=up(max(needed - added, way.inertia * own)) + added)


def _standing(arm: Arm | None, way: Way) -> Arm | None:
    """A contact angle at which it stands and presses."""
    if arm is None or (arm_stiffness(arm) > 0 and math.sin(arm.contact_angle) >= LEAST_SINE):
        return arm
    if arm.contact_angle > math.pi / 2:
        return replace(arm, contact_angle=math.pi - OFF_THE_NORMAL)
    edge = max(way.margin * (lifted_angles(arm) or (0.0, 0.0))[1], OFF_THE_NORMAL)
    whole = to_si(math.ceil(from_si(edge, "deg") - 1e-9), "deg")
    return replace(arm, contact_angle=min(whole, math.pi / 2))


def _differences(arm: Arm, best: Arm, own: float) -> list[tuple[str, float, float]]:
    """Keys of the table whose values differ, in its units."""
    pairs: Mapping[str, tuple[float, float]] = {
        "moment_of_inertia_kg_m2": (own, _plain(own + best.inertia - arm.inertia)),
        "contact_stiffness_N_per_m": (arm.contact_stiffness, best.contact_stiffness),
        "joint_stiffness_N_per_m": (arm.joint_stiffness, best.joint_stiffness),
        "contact_angle_deg": (_degrees(arm), _degrees(best)),
        "joint_damping_N_s_per_m": (arm.joint_damping, best.joint_damping),
        "pressing_moment_N_m": (arm.pressing_moment, best.pressing_moment),
    }
    return [(key, old, new) for key, (old, new) in pairs.items() if old != new]


def _degrees(arm: Arm) -> float:
    return _plain(from_si(arm.contact_angle, "deg"))


def _plain(value: float) -> float:
    """Value without the rounding of a conversion to SI and back."""
    return float(f"{value:.12g}")


def up(value: float) -> float:
    """The next number of few digits that is not below.

    >>> up(1.2341), up(0.5), up(2046.1), -up(-2046.1)
    (1.24, 0.5, 2050.0, 2040.0)
    """
    if not value:
        return value
    places = DIGITS - 1 - math.floor(math.log10(abs(value)))
    return round(math.ceil(value * 10.0**places - ROUNDING) / 10.0**places, places)
