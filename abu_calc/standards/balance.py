"""Balance quality grades."""

from abu_calc.formula import formula
from abu_calc.standards.tables import toml_table, unknown
from abu_calc.validity import Range

_MASS = Range("rotor mass", 0.0, 1e6, "kg", open_low=True)
_SPEED = Range("rotor speed", 0.0, 1e5, "rad/s", open_low=True)


def balance_grades() -> dict[str, float]:
    """The grades by name, coarsest first, with e·Ω [m/s]. Source: ISO 21940-11:2016.

    >>> balance_grades()["G6.3"]
    0.0063
    """
    return {f"G{grade:g}": grade / 1000 for grade in toml_table("balance_grades")["grades"]}


@formula(
    "Permissible residual imbalance of a rotor",
    "U_per = G_e·m_R/Ω",
    "kg m",
    where="In user units U_per = 9549·G_e·m_R/Ω in g·mm, by the grade in mm/s, kg and rpm.",
    checked=(_MASS, _SPEED, "a grade of the list"),
    assumed="rotors in a constant (rigid) state",
    source="ISO 21940-11:2016",
)
def permissible_imbalance(grade: str, mass: float, speed: float) -> float:
    """
    >>> from abu_calc.units import to_si
    >>> round(1e6 * permissible_imbalance("G6.3", 2.0, to_si(10000, "rpm")), 2)
    12.03
    """
    grades = balance_grades()
    if grade not in grades:
        raise unknown("balance grade", grade, grades)
    return grades[grade] * _MASS.check(mass) / _SPEED.check(speed)
