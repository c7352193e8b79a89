"""What the simulation of an idle machine must show for its design to pass, in `abu size`."""

from typing import Final

from abu_calc.analysis.response import Response
from abu_calc.checks import Check, verdict
from abu_calc.formulas.motion import SETTLED
from abu_calc.sizing.design import Design
from abu_calc.units import from_si

WORK = 300_000
"""Evaluations that the simulation of one scene within `abu size` may take, some seconds. A wheel that bounces before it
stays on the work took SciPy 200 000, events counted in, until two runs agreed; other machines take a tenth of that."""


HARD: Final = "from the hard start, balls bunched on the heavy side"


def idle_checks(design: Design, response: Response, start: str = HARD) -> tuple[Check, ...]:
    """Balls that balance (a tenth of the imbalance is left, beside what the budget grants), and soon enough.

    `start`: in words, how they began. Not done where the balls, side by side, cannot carry the imbalance.
    """
    one, limit = design.autobalancer, design.case.table.limits.settling_time_s
    moved = design.imbalance.value * abs(one.requirement.plane_ratio)
    names = ("ABU701", "simulated balancing"), ("ABU702", "settling time")
    if one.capacity < moved:
        reason = "the balls cannot carry the imbalance side by side"
        return tuple(Check(*name, "not-done", reason, remedy="More or larger balls.") for name in names)
    left, allowed = response.residual_imbalance, _allowed(design, moved)
    balanced, settled = left <= allowed, response.settling_time is not None and response.settling_time <= limit
    if balanced:
        message = "imbalance left: the balls end opposite the imbalance"
    elif left > moved:
        message = "imbalance left: the balls make it worse, they gather on the heavy side"
    else:
        message = "imbalance left: the balls help, but do not balance"
    drag = design.track.optimum_drag
    sooner = "" if drag is None else f" {drag:.0f} 1/s"
    return (
        Check(*names[0], verdict(balanced), message, from_si(left, "g_mm"), from_si(allowed, "g_mm"), "g·mm",
              None if balanced else "Leave the forbidden speeds, or bring the drag nearer to the optimum."),
        Check(*names[1], verdict(settled and balanced), start if balanced else "settled where it does not balance",
              response.settling_time, limit, "s",
              None if settled and balanced else f"Drag nearer to the optimum{sooner}, or more capacity."),
    )  # fmt: skip


def _allowed(design: Design, moved: float) -> float:
    """What may be left: a tenth of the imbalance, and what race eccentricity and dry friction leave in any case."""
    one = design.autobalancer
    remaining = one.requirement.effective_mass * (one.budget.race_eccentricity + one.budget.rolling_friction)
    return SETTLED * max(moved, 0.01 * one.static_moment) + remaining


def not_simulated(scene: str, reason: str) -> Check:
    """The check of a simulation that gave no number to be trusted."""
    name = "simulated balancing" if scene == "idle" else f"simulated scene {scene}"
    return Check("ABU701" if scene == "idle" else "ABU703", name, "not-done", f"no trustworthy simulation: {reason}",
                 remedy="A drag nearer to the optimum, or less accuracy (--accuracy, Python: accuracy=).")  # fmt: skip
