"""A change of a file in words: what changes, from what to what, without what stays."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

from abu_calc.foundation.units import SYMBOLS, quantity_and_unit
from abu_calc.inputs.oil import oil_name
from abu_calc.inputs.reading.overrides import parse_override, value_at
from abu_calc.sizing.actions import PINS, plain

PINNED: Final = tuple(f"autobalancer.{key}" for key in PINS)
"""Keys that pin the choice of balls and race."""
PLAIN: Final = ("autobalancer", "machine", "suspension", "swing_arm")
"""Tables whose keys say by themselves what they are of."""


def in_words(entries: Sequence[str], table: Any = None, made: Sequence[str] = ()) -> str:
    """Entries as a sentence lists them, with the values of a file's `table` that they replace.

    `made`: the entries that pin the present balls and race, which are not told if they stay.

    >>> in_words(("oil.grade=VG 100", "oil.viscosity_index=120", "oil.fill_ml=1", "autobalancer.ball_count=4"))
    'oil VG 100 (viscosity index 120, 1 ml)'
    >>> in_words(("autobalancer.0.max_width_mm=40", "autobalancer.1.max_width_mm=40"))
    'max width 40 mm in both races'
    """
    values, own = (dict(entry.split("=", 1) for entry in each) for each in (entries, made))
    file = {} if table is None else table.model_dump(mode="json")
    parts = [f"{_oil(values)}{_instead_of_oil(table)}"] if "oil.grade" in values else []
    parts += [_entry(entry, file) for entry in entries if not entry.startswith(("oil.", *PINNED))]
    balls = [_balls(each) for each in (values, own)]
    if balls[0] and (not parts or (made and balls[0] != balls[1])):
        parts.append(balls[0] if balls[1] in ("", balls[0]) else f"{balls[0]} instead of {balls[1]}")
    parts = parts or [_entry(entry, file) for entry in entries]
    texts = [f"{part}{' in both races' * (parts.count(part) > 1)}" for part in dict.fromkeys(parts)]
    *first, last = texts
    return f"{', '.join(first)} and {last}" if first else last


def _oil(values: Mapping[str, str]) -> str:
    """An oil by grade, viscosity index and fill."""
    given = {"viscosity index {}": "oil.viscosity_index", "{} ml": "oil.fill_ml"}
    more = ", ".join(text.format(values[key]) for text, key in given.items() if key in values)
    return f"oil {values['oil.grade']}" + (f" ({more})" if more else "")


def _instead_of_oil(table: Any) -> str:
    """Oil or drag rate of a file that another oil takes the place of."""
    if table is None:
        return ""
    if "rolling_drag_per_s" in table.autobalancer.model_fields_set:
        source = "a" if table.identified is None else "the measured"
        return f" instead of {source} drag rate of {table.autobalancer.rolling_drag_per_s:g} 1/s"
    old = table.oil
    return f" instead of {f'{oil_name(old)} (viscosity index {old.viscosity_index:g})' if old else 'the assumed one'}"


def _balls(values: Mapping[str, str]) -> str:
    """Balls and race that entries pin, in words; nothing if they pin less than all."""
    if not all(key in values for key in PINNED):
        return ""
    count, diameter, radius = (values[key] for key in PINNED)
    return f"{count} balls Ø{float(diameter):.5g} mm in a race R {float(radius):.4g} mm"


def _entry(entry: str, file: Mapping[str, object]) -> str:
    """One entry, and the value that it replaces."""
    *parents, key = path = parse_override(entry).path
    value, before = entry.split("=", 1)[1], value_at(file, path)
    name, unit = quantity_and_unit(str(key))
    of = [] if parents[0] in PLAIN else [f"{part + 1}" if isinstance(part, int) else part for part in parents]
    instead = "" if before is None or plain(before) == value else f" instead of {plain(before)}"
    words = f"{' '.join([*of, name])} {value}{instead} {SYMBOLS.get(unit, unit)}"
    words = words.replace("run_up", "run-up").replace("_", " ").replace(",", ", ").strip()
    return f"a harder, smoother race ({words}, to be measured)" if key == "rolling_friction_mm" else words
