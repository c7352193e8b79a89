"""Strength of balls, race and rim under their forces at the highest speed."""

from abu_calc.frozen import dataclass
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import ALUMINIUM, STEEL, groove_radius
from abu_calc.sizing.stress import (
    hertz_ball_in_toroid,
    hertz_roller_in_cylinder,
    hoop_stress,
    permitted_pressure,
)
from abu_calc.standards.hardness import vickers
from abu_calc.units import to_si

HOOP_LIMIT = {STEEL: to_si(200, "MPa"), ALUMINIUM: to_si(80, "MPa")}
"""Assumed: a third of the yield strength of plain steel and of wrought aluminium."""


@dataclass(frozen=True)
class Strength:
    """Force of a ball [N], pressures and stresses [Pa] at the top of the speed range, with what is permitted."""

    ball_force: float
    contact_pressure: float
    permitted_pressure: float
    hoop_stress: float
    permitted_hoop: float

    @property
    def enough(self) -> bool:
        """True if both stresses are permitted."""
        return self.contact_pressure <= self.permitted_pressure and self.hoop_stress <= self.permitted_hoop


def strength(case: Case, ball_mass: float, diameter: float, race_radius: float, outer_diameter: float) -> Strength:
    """Force m·R_p·Ω² of one ball, its Hertz pressure in the groove, and the hoop stress of the rim."""
    abu, top, radius = case.autobalancer, case.speed_range[1], diameter / 2
    force = ball_mass * (race_radius - radius) * top**2
    if abu.corrector == "ball":
        pressure = hertz_ball_in_toroid(force, radius, race_radius, groove_radius(race_radius, radius))
    else:
        pressure = hertz_roller_in_cylinder(force, radius, race_radius, diameter)
    rim = ALUMINIUM if abu.design == "light" else STEEL
    return Strength(
        ball_force=force,
        contact_pressure=pressure,
        permitted_pressure=permitted_pressure(vickers(abu.race_hardness_HRC)),
        hoop_stress=hoop_stress(top, outer_diameter / 2, rim),
        permitted_hoop=HOOP_LIMIT[rim],
    )
