"""What the simulation of an idle machine must show for its design to pass."""

from abu_calc.analysis.response import Response
from abu_calc.checks import Check, verdict
from abu_calc.units import from_si

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
