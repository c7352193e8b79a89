"""Columns of a sample of a sweep, with units, as store, answers and Python have them; oil drag by temperature."""

import math
from typing import Final, Literal

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import unit_of
from abu_calc.foundation.validity import Range

MEANT: Final = 40.0
"""Temperature [°C] at which the drag of a file is meant, that of the viscosity grades of ISO 3448."""
VISCOSITY: Final = ((40.0, 46.0), (100.0, 6.8))
"""Temperature [°C] and kinematic viscosity [mm²/s] of an oil ISO VG 46 with a viscosity index near 100."""
TEMPERATURE: Final = Range("temperature of the oil", -20.0, 120.0, unit="°C", key="start.temperature_C")
ADDED: Final = 0.7
"""mm²/s, of the double logarithm."""


@formula(
    "Viscous drag rate in oil at a temperature, relative to that at 40 °C",
    "ν_o(T_o)/ν_o(40 °C), lg lg(ν_o + 0.7) = A_o − B_o·lg T_o",
    "1",
    where="The equation takes ν_o in mm²/s. A_o and B_o follow from 46 at 40 °C and 6.8 at 100 °C (VG 46).",
    checked=(TEMPERATURE,),
    assumed="a mineral oil of viscosity index 100; drag rate proportional to viscosity (Stokes)",
    source="ASTM D341 (Walther 1931); ISO 3448 for the grade",
)
def drag_ratio(temperature: float) -> float:
    """
    >>> round(drag_ratio(40.0), 12), round(drag_ratio(100.0), 4)
    (1.0, 0.1478)
    """
    return _viscosity(TEMPERATURE.check(temperature)) / _viscosity(MEANT)


def _viscosity(temperature: float) -> float:
    (t1, v1), (t2, v2) = ((math.log10(t + 273.15), math.log10(math.log10(v + ADDED))) for t, v in VISCOSITY)
    slope = (v2 - v1) / (t2 - t1)
    return float(10 ** (10 ** (v1 + slope * (math.log10(temperature + 273.15) - t1))) - ADDED)


What = Literal["build", "design", "scene"]


@dataclass(frozen=True)
class SampleColumn:
    """One number of each member: its name (which ends in the unit), what it means."""

    name: str
    meaning: str

    @property
    def unit(self) -> str:
        """Unit as shown."""
        return unit_of(self.name)


LEVEL: Final = SampleColumn("level_db", "velocity level, idle, at the loudest handle")
QUIET: Final = SampleColumn("quiet_time_s", "from full speed until the level stays low")
TIMES: Final = (
    QUIET,
    SampleColumn("rest_time_s", "from full speed until the balls keep their places"),
    SampleColumn("settling_time_s", "from full speed until what is left stays near its end"),
)
LEFT: Final = SampleColumn("residual_imbalance_g_mm", "what balls leave of the imbalance")
BALANCES: Final = SampleColumn("balances", "1: the balls rest in their race, and what they leave is allowed")
MEETS: Final = SampleColumn("meets_limits", "1: it meets all of the limits")
SEED: Final = SampleColumn("seed", "of what is particular to the member: how its balls differ within their lot")
REASON: Final = SampleColumn("reason", "why there are no numbers")
MEMBER: Final = SampleColumn("member", "number of the member, from 0")

OUTSIDE: Final = "not computed: "
"""Start of reasons that lie outside the machine, in the computer: such members are tried again by the next run."""
OVERTIME: Final = "not done within "
"""Start of the reason of a member that took too long; the limit in seconds follows. A longer one tries it again."""
IMPATIENT: Final = OUTSIDE + "the seconds of --patience were over"
"""Reason of a member that the patience of its run left out; the next run computes it."""

QUANTITIES: Final[dict[What, tuple[SampleColumn, ...]]] = {
    "build": (
        LEVEL,
        *TIMES,
        SampleColumn("residual_um", "amplitude of the axis that stays"),
        LEFT,
        SampleColumn("capacity_ratio", "capacity over need"),
    ),
    "design": (
        SampleColumn("level_after_db", "level with the autobalancer, as expected"),
        SampleColumn("worst_level_db", "of the loudest start"),
        *(SampleColumn(f"worst_{column.name}", "of the slowest start") for column in TIMES),
        SampleColumn("ball_count", "balls"),
        SampleColumn("ball_diameter_mm", "their diameter"),
        SampleColumn("race_radius_mm", "radius of the race"),
        SampleColumn("mass_g", "mass with balls"),
        SampleColumn("capacity_ratio", "capacity over need"),
    ),
    "scene": (
        LEVEL,
        *TIMES,
        SampleColumn("axis_amplitude_mm", "amplitude of the axis that stays"),
        LEFT,
    ),
}
"""Numbers that percentiles are told of."""

FLAGS: Final[dict[What, tuple[SampleColumn, ...]]] = {
    "build": (
        BALANCES,
        SampleColumn("none_hangs", "1: no ball goes round behind the rotor at the end"),
        SampleColumn("meets_level", "1: the level is within limits.vibration_level_db"),
        SampleColumn("meets_settling", "1: it is quiet in time, and at rest if that is limited"),
        MEETS,
    ),
    "design": (MEETS,),
    "scene": (BALANCES, MEETS),
}
"""Conditions that are met or not; the last of them is all together."""

DECIDING: Final[dict[What, str]] = {"build": "level_db", "design": "level_after_db", "scene": "level_db"}
"""The number whose sensitivities are told first."""
