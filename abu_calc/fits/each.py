"""The bearings of a file judged one after another; what is refused of one names its table, and its key if known."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from abu_calc.errors import InputError, Place
from abu_calc.fits.seats import BearingSeats, seat_bearing
from abu_calc.units import SI_PER_UNIT

if TYPE_CHECKING:
    from abu_calc.spec.bearing import Bearing as BearingTable


def seat_bearings(tables: "Sequence[BearingTable]") -> tuple[BearingSeats, ...]:
    """Judge the seats of the tables `[[bearing]]`, in their order. Raises InputError, `bearing[0].shaft_fit`."""
    return tuple(_seated(index, table) for index, table in enumerate(tables))


def _seated(index: int, table: "BearingTable") -> BearingSeats:
    try:
        return seat_bearing(table)
    except InputError as error:
        key = error.place.key or _key_of(table, error.found or "")
        raise error.at(Place(key=f"bearing[{index}].{key}" if key else f"bearing[{index}]")) from None


def _key_of(table: "BearingTable", shown_value: str) -> str | None:
    """The key whose value a message shows, in the unit of the key or in SI: formulas know quantities, not keys."""
    fields = type(table).model_fields
    given = {key: getattr(table, key) for key in fields if key != "name"}
    shown = {key: _as_shown(key, value) for key, value in given.items() if value is not None}
    number = shown_value.split(" ")[0]
    return next((key for key, texts in shown.items() if shown_value in texts or number in texts), None)


def _as_shown(key: str, value: object) -> tuple[str, ...]:
    if not isinstance(value, (int, float)):
        return (str(value),)
    sizes = (SI_PER_UNIT[unit] for unit in SI_PER_UNIT if key.endswith(f"_{unit}"))
    return (f"{value:g}", *(f"{value * size:g}" for size in sizes))
