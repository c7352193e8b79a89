"""Measurement with the autobalancer, beside the prediction for the same place."""

import math

from abu_calc.frozen import dataclass
from abu_calc.sizing.budget import accuracy_budget, displacement_level
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.imbalance import measured_velocity
from abu_calc.spec.measured import Shown
from abu_calc.units import level_from_velocity, velocity_from_level


@dataclass(frozen=True)
class Compared:
    """A measured and a predicted rms velocity of one axis [m/s] at a place; no `predicted` where balls cannot balance.

    `shown`: as the instrument showed it; `speed` [rad/s]: of the spindle, by which it is converted.
    """

    shown: Shown
    place: str
    speed: float
    measured: float
    predicted: float | None

    @property
    def difference(self) -> float | None:
        """measured − predicted [dB]."""
        if not self.predicted:
            return None
        return level_from_velocity(self.measured) - level_from_velocity(self.predicted)


def measured_place(case: Case, shown: Shown) -> tuple[str, float]:
    """Name and place [m] from the centre of mass of where it was measured."""
    named_handle = next((handle for handle in case.handles if handle.name == shown.at), None)
    return ("wheel plane", case.body.wheel) if named_handle is None else (named_handle.name, named_handle.place)


def compared(case: Case, level: float | None) -> Compared | None:
    """[measured_after] against a predicted level [dB] at its place; None without the table."""
    table = case.table.measured_after
    if table is None or table.shown is None:
        return None
    shown = table.shown
    measured = measured_velocity(shown, case.speed, "measured_after")
    predicted = None if level is None else velocity_from_level(level)
    return Compared(shown, measured_place(case, shown)[0], case.speed, measured, predicted)


def compared_design(design: Design) -> Compared | None:
    """Against what the accuracy budget leaves, idle at the rated speed, background included."""
    case, chosen, possible = design.case, design.autobalancer, design.frequency.balancing_possible
    table = case.table.measured_after
    if table is None or table.shown is None:
        return None
    budget = accuracy_budget(
        case, design.imbalance.value, chosen.requirement, chosen.balls, chosen.budget.resting_angles, case.speed
    )
    known = possible and math.isfinite(budget.residual)
    return compared(case, level_where_measured(design, budget.residual if known else None))


def level_where_measured(design: Design, moved: float | None) -> float | None:
    """Level [dB] at the place of [measured_after] of a displacement 0–peak [m] of the wheel; None without either."""
    case, table = design.case, design.case.table.measured_after
    if table is None or table.shown is None or not moved:
        return None
    there = moved * case.body.transmission(measured_place(case, table.shown)[1], design.autobalancer.mass)
    return displacement_level(there, case.speed, case.background_level) if there else None
