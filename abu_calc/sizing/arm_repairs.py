"""Changes of a swing arm, with their size, that meet its bounds: stiffness first, damping second."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Final, Literal

from abu_calc.formulas.swing_arm import (
    Arm,
    arm_stiffness,
    contact_gain,
    damping_limit,
    least_pressing_moment,
    lifted_angles,
    pressed_angle,
    resonance,
    series_gain,
    standing_stiffness,
    stiffness_limit,
    worst_contact_angle,
)
from abu_calc.frozen import dataclass
from abu_calc.sizing.swing_arm import LEAST_SINE
from abu_calc.units import from_si, to_si
from abu_calc.validity import bounded

PRESSED: Final = 45.0
"""Force [N] to press with where nothing else says how much; the upper feed force of ISO 28927-4."""

OFF_THE_NORMAL: Final = math.radians(10)
"""Least angle to the normal that is proposed."""

DIGITS: Final = 3
ROUNDING: Final = 1e-9
WHOLE: Final = 2.0
"""A new value beyond this multiple of the old one is told as a multiple."""


@dataclass(frozen=True)
class Change:
    """A key of [swing_arm] with another value."""

    key: str
    old: float
    new: float

    @property
    def text(self) -> str:
        """Change in words, with the step from the old value.

        >>> Change("joint_damping_N_s_per_m", 2.0, 2.5).text, Change("joint_damping_N_s_per_m", 0.01, 0.35).text
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


def changes(arm: Arm, own_inertia: float, imbalance: float, lowest_speed: float, way: Way) -> tuple[Change, ...] | None:
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
    return tuple(Change(key, old, new) for key, old, new in _differences(arm, best, own_inertia))


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
