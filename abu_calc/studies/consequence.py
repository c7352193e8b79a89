"""Outcome of balls in a growing arrangement, as results hold it."""

from typing import Annotated, Final, Self

from abu_calc.analysis.disturbed import DISTURBANCE, Consequence
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.units import wrapped_deg

RUN: Final = f"Simulated without friction from the worst arrangement, disturbed by {DISTURBANCE:g} rad at most"
ENDS: Final = {
    "drift": "the balls drift to a stable arrangement nearby and balance there",
    "growth": "the balls leave the balanced state",
    "undecided": "the run does not decide whether the balls drift to a stable arrangement or leave the balanced state",
}


@record
class ArrangementEnd(Record):
    """The end of a run that starts in the worst arrangement, a little disturbed."""

    kind: Annotated[str, Quantity("what the balls do", "", 4, "drift, growth or undecided")]
    simulated_time_s: Annotated[float, Quantity("simulated time")]
    residual_ratio: Annotated[float | None, Quantity("residual imbalance at the end over that at the start")]
    resting_angles_deg: Annotated[tuple[float, ...] | None, Quantity("balls rest at", "θ", 5)]
    growth_rate_per_s: Annotated[float | None, Quantity("growth rate there", "max Re λ")]
    text: Annotated[str, Quantity("in words")]

    @classmethod
    def of(cls, end: Consequence) -> Self:
        """Record of the simulated outcome."""
        text = f"{RUN}, for {end.duration:.3g} s: {ENDS[end.kind]}"
        if end.growth_rate is not None:
            text += f" (growth rate {end.growth_rate:.3g} 1/s)"
        if end.duration == 0:
            text = "No simulation tells what becomes of the balls in the worst arrangement: the work allowed did not do"
        return cls(
            kind=end.kind,
            simulated_time_s=end.duration,
            residual_ratio=end.residual,
            resting_angles_deg=None if end.angles is None else tuple(map(wrapped_deg, end.angles)),
            growth_rate_per_s=end.growth_rate,
            text=f"{text}.",
        )
