"""Labels of results by their paths, as the records of the results name them: tables show these instead of raw keys."""

from typing import Any

from abu_calc.features.design.study import SizeResult
from abu_calc.features.seats.study import CheckFitResult
from abu_calc.foundation.quantity import Record, hints, parts_of_type, quantities
from abu_calc.foundation.units import quantity_and_unit


def label_of(path: str, unit: str = "") -> str:
    """Label of a design's result: the parts that hold it, its own label, its unit; items of lists count from 1.

    >>> label_of("autobalancer.ball_diameter_mm", "mm")
    'autobalancer: ball diameter, mm'
    >>> label_of("frequency.natural_frequencies_hz.0", "Hz")
    'frequency: natural frequencies x, y 1, Hz'
    """
    names = path.split(".")
    record: type[Record] | None = SizeResult
    if names[0] == "fits" and len(names) > 1 and not names[1].isdigit():  # bearing seats alone
        record, names = CheckFitResult, names[1:]
    words = list[str]()
    for name in names:
        if name.isdigit():
            words[-1:] = [f"{' '.join(words[-1:])} {int(name) + 1}".strip()]
            continue
        known = None if record is None else quantities(record).get(name)
        words.append(_plain(name) if known is None else known.label)
        record = None if record is None else _record_in(hints(record).get(name))
    label = ", ".join(words[:-1]) + (": " if words[:-1] else "") + words[-1]
    return f"{label}, {unit}" if unit else label


def _plain(name: str) -> str:
    """Words of a key, without its unit."""
    words = quantity_and_unit(name)[0].replace("_", " ").replace("felt mass", "effective mass")
    return words.replace("accuracy budget", "residual-displacement budget")


def _record_in(hint: Any) -> type[Record] | None:
    """The record that a type holds, if any."""
    return next((part for part in parts_of_type(hint) if isinstance(part, type) and issubclass(part, Record)), None)
