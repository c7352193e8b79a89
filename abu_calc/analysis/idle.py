"""What the simulation of an idle machine must show for its design to pass, and what it leaves out."""

from dataclasses import dataclass

from abu_calc.analysis.response import Response
from abu_calc.checks import Check, verdict
from abu_calc.sizing.design import Design
from abu_calc.units import GRAVITY, from_si

BALANCED_SHARE = 0.1
LEAST_UM = 1.0


def idle_checks(response: Response, settling_limit: float) -> tuple[Check, ...]:
    """Balls that balance (axis amplitude under a tenth of that without them, or 1 µm), and soon enough."""
    amplitude, before = from_si(response.axis_amplitude, "um"), from_si(response.unbalanced_amplitude, "um")
    limit = max(BALANCED_SHARE * before, LEAST_UM)
    balanced = amplitude <= limit
    if balanced:
        message = "the balls end opposite the imbalance and still the axis"
    elif response.axis_amplitude > response.unbalanced_amplitude:
        message = "the balls make it worse: they do not go opposite the imbalance"
    else:
        message = "the balls help, but do not still the axis"
    settled = response.settling_time is not None and response.settling_time <= settling_limit
    start = "from the hard start, balls bunched on the heavy side"
    return (
        Check("ABU701", "simulated balancing", verdict(balanced), message, amplitude, limit, "µm",
              None if balanced else "Leave the speed's forbidden region, add capacity or drag, or simulate longer."),
        Check("ABU702", "settling time", verdict(settled and balanced),
              start if balanced else "settled in a place that does not balance", response.settling_time,
              settling_limit, "s", None if settled and balanced else "Drag nearer to the optimum, or more capacity."),
    )  # fmt: skip


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
