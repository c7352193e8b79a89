"""What the simulation of an idle machine must show for its design to pass, and what it leaves out."""

from dataclasses import dataclass

from abu_calc.analysis.response import Response
from abu_calc.checks import Check, verdict
from abu_calc.sizing.design import Design
from abu_calc.units import GRAVITY, from_si

BALANCED_SHARE = 0.1
WORK = 250_000
"""Evaluations that a simulation within `abu size` may take, some seconds."""


def idle_checks(design: Design, response: Response) -> tuple[Check, ...]:
    """Balls that balance (a tenth of the imbalance is left, or of 1 % of all balls'), and soon enough.

    Not done where the balls, side by side, cannot carry the imbalance: simulated ones pass through each other.
    """
    one, limit = design.autobalancer, design.case.table.limits.settling_time_s
    moved = design.imbalance.value * abs(one.requirement.plane_ratio)
    names = ("ABU701", "simulated balancing"), ("ABU702", "settling time")
    if one.capacity < moved:
        reason = "the balls cannot carry the imbalance side by side; simulated ones pass through each other"
        return tuple(Check(*name, "not-done", reason, remedy="More or larger balls.") for name in names)
    left, allowed = response.residual_imbalance, BALANCED_SHARE * max(moved, 0.01 * one.static_moment)
    balanced, settled = left <= allowed, response.settling_time is not None and response.settling_time <= limit
    if balanced:
        message = "imbalance left: the balls end opposite the imbalance"
    elif left > moved:
        message = "imbalance left: the balls make it worse, they gather on the heavy side"
    else:
        message = "imbalance left: the balls help, but do not balance"
    start = "from the hard start, balls bunched on the heavy side"
    drag = design.track.optimum_drag
    sooner = "" if drag is None else f" {drag:.0f} 1/s"
    return (
        Check(*names[0], verdict(balanced), message, from_si(left, "g_mm"), from_si(allowed, "g_mm"), "g·mm",
              None if balanced else "Leave the forbidden speeds, or bring the drag nearer to the optimum."),
        Check(*names[1], verdict(settled and balanced), start if balanced else "settled where it does not balance",
              response.settling_time, limit, "s",
              None if settled and balanced else f"Drag nearer to the optimum{sooner}, or more capacity."),
    )  # fmt: skip


def not_simulated(reason: str) -> Check:
    """The check of a simulation that gave no number to be trusted."""
    return Check("ABU701", "simulated balancing", "not-done", f"no trustworthy simulation: {reason}",
                 remedy="A drag nearer to the optimum, or less accuracy (--accuracy).")  # fmt: skip


@dataclass(frozen=True)
class LeftOut:
    """An effect the simulation does not have; `weight`: what it would change, counted as `--accuracy` counts errors."""

    name: str
    weight: float | None
    why: str


def left_out(design: Design, response: Response) -> tuple[LeftOut, ...]:
    """Effects that are not simulated, each with an estimate of the error, as `--accuracy` counts it.

    Gravity swings the balls by g/(J·R_p·Ω²) [rad]; eccentricity and dry friction leave displacements that are counted
    relative to the axis amplitude or 1 % of that without balls.
    """
    case, one = design.case, design.autobalancer
    amplitude = max(response.axis_amplitude, 0.01 * response.unbalanced_amplitude)
    horizontal = case.table.machine.spindle_axis == "horizontal"
    swing = GRAVITY / (case.inertia_factor * one.pitch_radius * case.speed**2) if horizontal else 0.0
    budget = "stands in the accuracy budget instead; not simulated in this version"
    return (
        LeftOut("gravity", swing, "swings the balls a little once per turn" if horizontal else "vertical spindle"),
        LeftOut("race_eccentricity", _share(one.budget.race_eccentricity, amplitude), budget),
        LeftOut("dry_rolling_friction", _share(one.budget.rolling_friction, amplitude), budget),
        LeftOut("ball_contact", None, "balls pass through each other; not simulated in this version"),
    )


def _share(displacement: float, amplitude: float) -> float | None:
    return displacement / amplitude if amplitude > 0 else None
