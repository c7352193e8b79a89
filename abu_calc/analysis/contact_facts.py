"""Curves and bounds of a machine at its work by steady contact: hodograph, speeds, separation, friction shaken out."""

import cmath
import math

from abu_calc.analysis.grinding import Work
from abu_calc.analysis.under_load import Steady, bare, contact_of, fitted, runout_of
from abu_calc.errors import InputError
from abu_calc.formulas.grinding import largest_factor
from abu_calc.formulas.shaking import shaken_drag, shaking_threshold
from abu_calc.frozen import dataclass
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.units import to_si

CURVE = 8
"""Steps of the curve over speeds."""
AROUND = 0.7, 1.1
"""Speed range as shares of the rated speed, for a file that gives no range."""


@dataclass(frozen=True)
class AtAngle:
    """Phasors X, Y [m] without and with the autobalancer, the runout at an angle [rad] from the imbalance."""

    angle: float
    without: tuple[complex, complex]
    fitted: tuple[complex, complex] | None


@dataclass(frozen=True)
class AtSpeed:
    """Amplitude [m] and variable force [N] without and with the autobalancer at a speed [rad/s], by steady contact.

    None where balls come to no rest, or at a resonance that nothing damps.
    """

    speed: float
    without: Steady | None
    fitted: Steady | None


@dataclass(frozen=True)
class Friction:
    """Dry friction of the balls: typical and worst displacement that it holds at idle, and what shakes it out [m].

    `axial`, `whirl`: amplitudes that shake across and along the race; `creep`: time constant [s] of balls that the
    whirl shakes, None where it does not.
    """

    typical: float
    worst: float
    threshold: float
    axial: float
    whirl: float | None
    creep: float | None


def hodograph(design: Design, count: int = 24) -> tuple[AtAngle, ...]:
    """Steady contact at `count` angles of the runout round a full turn."""
    return tuple(_at_angle(design, cmath.rect(design.case.runout, angle), angle)
                 for angle in (2 * math.pi * step / count for step in range(count)))  # fmt: skip


def _at_angle(design: Design, runout: complex, angle: float) -> AtAngle:
    without = bare(design, runout).axis
    return AtAngle(angle, without or (0j, 0j), fitted(design, runout, judged=False).axis)


def response(design: Design) -> tuple[AtSpeed, ...]:
    """Steady contact over the speed range, or about the rated speed if the file gives no range."""
    case, runout = design.case, runout_of(design.case)
    low, high = case.speed_range
    if low == high:
        low, high = (share * case.speed for share in AROUND)
    steps = [low + (high - low) * step / CURVE for step in range(CURVE + 1)]
    others = [speed for speed in steps if not math.isclose(speed, case.speed)]
    return tuple(_at_speed(design, runout, speed) for speed in sorted([*others, case.speed]))


def _at_speed(design: Design, runout: complex, speed: float) -> AtSpeed:
    try:
        return AtSpeed(speed, bare(design, runout, speed=speed), fitted(design, runout, speed=speed))
    except (InputError, ZeroDivisionError):
        return AtSpeed(speed, None, None)


def loaded_resonance(design: Design) -> float | None:
    """Natural frequency [rad/s] of the machine without autobalancer on its contact, normal to the work.

    None where the contact is rigid or that of a face. Of springs exactly, of hands by their stiffness at the rated
    speed.
    """
    contact = design.case.contact
    if contact is None or contact.kind != "compliant":
        return None
    mass = design.case.body.effective_mass()
    held = contact_of(design.case, 0.0).dynamic_stiffness[1].real + mass * design.case.speed**2
    return math.sqrt(max(held + contact.stiffness, 0.0) / mass)


def largest_runout(case: Case, steady: Steady) -> float | None:
    """The largest runout [m] at the file's angle at which wheel and work stay together; None where any or none does."""
    contact, direction = steady.contact, cmath.rect(1.0, to_si(case.table.wheel.runout_angle_deg, "deg"))
    if steady.imbalance is None or case.contact is None or contact.pressing == 0:
        return None
    press = case.contact.press_force
    if steady.balls is not None:
        if steady.balls.places != "balanced":
            return None
        slope = contact.normal_force(contact.balancing_imbalance(direction), direction)
        return largest_factor(slope, 0j, press)
    return largest_factor(contact.normal_force(0j, direction), contact.normal_force(steady.imbalance, 0j), press)


def friction(work: Work) -> Friction:
    """Imbalance that dry friction holds, and the motions that release it on the workpiece."""
    design = work.design
    case, autobalancer, steady = design.case, design.autobalancer, work.fitted.steady
    threshold = shaking_threshold(case.friction_arm, autobalancer.pitch_radius, autobalancer.ball_diameter / 2)
    face = case.contact is not None and case.contact.kind == "face"
    axial = to_si(case.table.wheel.axial_runout_mm, "mm") if face and design.track.groove_radius else 0.0
    axis = steady.axis
    whirl = None if axis is None else abs(axis[0] - 1j * axis[1]) / 2
    creep = None
    if whirl and whirl > threshold > 0 and steady.balls is not None and steady.balls.places == "balanced":
        drag = case.drag + shaken_drag(threshold, whirl, case.speed, case.inertia_factor)
        stiffness = [k.real for k in steady.balls.stiffness if k.real > 0]
        creep = drag / min(stiffness) if stiffness else None
    worst = max((budget.rolling_friction for budget in design.worst if budget.speed == case.speed), default=math.nan)
    return Friction(autobalancer.budget.rolling_friction, worst, threshold, axial, whirl, creep)
