"""The handbooks' load intensity of a seat, and the field they allow at it: advice beside the makers'."""

from typing import Final

from abu_calc.fits.ranges import SEAT_LENGTH
from abu_calc.formula import formula
from abu_calc.standards.limits import Seat
from abu_calc.standards.tables import toml_table
from abu_calc.units import from_si

SHOCK_FACTOR: Final = 1.8
"""k₁ of the load intensity: strong shocks, overload to 300 %, taken always as the safe side (moderate ones: 1.0)."""


@formula(
    "Load intensity of a seat",
    "P_R = k₁·k₂·k₃·F_r/b_s",
    "N/m",
    shown="kN_per_m",
    where=("Unverified advice."),
    checked=(SEAT_LENGTH,),
    source="handbooks as quoted by Afanasiev 2015",
)
def load_intensity(load: float, seat_length: float) -> float:
    """
    >>> round(1e-3 * load_intensity(3000.0, 29e-3), 1)
    186.2
    """
    return SHOCK_FACTOR * load / SEAT_LENGTH.check(seat_length)


def advised_class(seat: Seat, diameter: float, intensity: float) -> str | None:
    """The loosest class that handbook tables allow at a load intensity [N/m]; None outside the tables.

    Range: shafts over 18 up to 630 mm, housings over 50 up to 1600 mm; unverified advice, never the only criterion.
    Source: handbooks as quoted by Afanasiev 2015.

    >>> advised_class("shaft", 0.080, 186.2e3), advised_class("housing", 0.140, 186.2e3)
    ('js6', 'K7')
    """
    table = toml_table("load_intensity")[seat]
    size = round(from_si(diameter, "mm"), 6)
    for over, to, *limits in table["rows"]:
        if over < size <= to:
            pairs = zip(table["fields"], limits, strict=True)
            return next((field for field, limit in pairs if from_si(intensity, "kN_per_m") <= limit), None)
    return None
