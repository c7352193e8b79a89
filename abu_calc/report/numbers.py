"""Numbers as text, the same wherever they are shown."""

from abu_calc.studies.quantity import Quantity, Record, quantities
from abu_calc.units import unit_of


def number(value: float, digits: int = 4) -> str:
    """A number with so many significant digits, never in exponents between 1e-4 and 1e7.

    >>> number(1135.91, 4), number(0.0412345, 3), number(2.0, 3), number(1957172.0, 5), number(3.2e-9, 2)
    ('1136', '0.0412', '2.00', '1957200', '3.2e-09')
    """
    if value == 0:
        return "0"
    if not 1e-4 <= abs(value) < 1e7:
        return f"{value:.{digits - 1}e}"
    rounded = float(f"{value:.{digits - 1}e}")
    whole = len(str(int(abs(rounded)))) if abs(rounded) >= 1 else 0
    if whole:
        return f"{rounded:.{max(0, digits - whole)}f}"
    return f"{rounded:#.{digits}g}"


def shown(kind: type[Record], name: str, value: object) -> str:
    """A value of a field of a record with its unit, as text."""
    return shown_as(quantities(kind)[name], unit_of(name), value)


def shown_as(quantity: Quantity, unit: str, value: object) -> str:
    """A value with its unit, to the digits of its quantity."""
    if value is None:
        return "not computed"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if quantity.percent and isinstance(value, float):
        return f"{number(100 * value, quantity.digits)} %"
    if isinstance(value, (list, tuple)):
        text = ", ".join(number(float(each), quantity.digits) for each in value)
    else:
        text = number(value, quantity.digits) if isinstance(value, float) else str(value)
    return f"{text} {unit}".rstrip()
