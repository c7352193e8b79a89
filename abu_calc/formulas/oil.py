"""Change of the oil's viscous drag rate with its temperature."""

import math
from typing import Final

from abu_calc.formula import formula
from abu_calc.validity import Range

MEANT: Final = 40.0
"""Temperature [°C] at which the drag of a file is meant, that of the viscosity grades of ISO 3448."""
VISCOSITY: Final = ((40.0, 46.0), (100.0, 6.8))
"""Temperature [°C] and kinematic viscosity [mm²/s] of an oil ISO VG 46 with a viscosity index near 100."""
TEMPERATURE: Final = Range("temperature of the oil", -20.0, 120.0, unit="°C", key="start.temperature_C")
ADDED: Final = 0.7
"""mm²/s, of the double logarithm."""


@formula(
    "Drag of oil at a temperature over that at 40 °C",
    "ν_o(T_o)/ν_o(40 °C), lg lg(ν_o + 0.7) = A_o − B_o·lg T_o",
    "1",
    where="ν_o in mm²/s; A_o and B_o from 46 at 40 °C and 6.8 at 100 °C (VG 46).",
    checked=(TEMPERATURE,),
    assumed="a mineral oil of viscosity index 100; drag proportional to viscosity (Stokes)",
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
