"""A change of a file in words: what changes, from what to what, without what stays."""

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

from abu_calc.foundation.units import SYMBOLS, quantity_and_unit
from abu_calc.inputs.oil import oil_name
from abu_calc.sizing.actions import PINS

PINNED: Final = frozenset(f"autobalancer.{key}" for key in PINS)
"""Keys that pin the choice of balls and race."""
PLAIN: Final = ("autobalancer", "machine", "suspension", "swing_arm")
"""Tables whose keys say by themselves what they are of."""


def in_words(entries: Sequence[str], table: Any = None, made: Sequence[str] = ()) -> str:
    """Entries as a sentence lists them, with the values of a file's `table` that they replace.

    `made`: the entries that pin the present balls and race; what pins these alone is not told.

    >>> in_words(("oil.grade=VG 100", "oil.viscosity_index=120", "oil.fill_ml=1", "autobalancer.ball_count=4"))
    'oil VG 100 (viscosity index 120, 1 ml)'
    >>> in_words(("autobalancer.0.max_width_mm=40", "autobalancer.1.max_width_mm=40"))
    'max width 40 mm in both races'
    """
    values = dict(entry.split("=", 1) for entry in entries)
    oil = {key: values.pop(key) for key in list(values) if key.startswith("oil.")}
    balls = {key: values.pop(key) for key in list(values) if key in PINNED}
    parts = [*_of_oil(oil, table), *(_entry(key, value, table) for key, value in values.items())]
    if not parts or (made and not {*made} >= {f"{key}={value}" for key, value in balls.items()}):
        parts += _of_balls(balls, dict(entry.split("=", 1) for entry in made))
    both = [part for part in parts if parts.count(part) > 1]
    texts = [f"{part} in both races" if part in both else part for part in dict.fromkeys(parts)]
    *first, last = texts or [""]
    return f"{', '.join(first)} and {last}" if first else last


def _of_oil(entries: Mapping[str, str], table: Any) -> Iterator[str]:
    """An oil, and what it takes the place of."""
    if not entries:
        return
    values = {key.removeprefix("oil."): value for key, value in entries.items()}
    more = [f"viscosity index {values['viscosity_index']}"] if "viscosity_index" in values else []
    more += [f"{values['fill_ml']} ml"] if "fill_ml" in values else []
    name = values.get("grade", getattr(getattr(table, "oil", None), "grade", None) or "")
    yield f"oil {name}".strip() + (f" ({', '.join(more)})" if more else "") + _instead_of_oil(table)


def _instead_of_oil(table: Any) -> str:
    if table is None:
        return ""
    abu, oil = table.autobalancer, table.oil
    if "rolling_drag_per_s" in abu.model_fields_set:
        source = "the measured" if table.identified is not None else "a"
        return f" instead of {source} drag rate of {abu.rolling_drag_per_s:g} 1/s"
    if oil is None:
        return " instead of the assumed one"
    return f" instead of {oil_name(oil)} (viscosity index {oil.viscosity_index:g})"


def _of_balls(entries: Mapping[str, str], made: Mapping[str, str]) -> Iterator[str]:
    """Balls and race, where a change pins others."""
    texts = [_balls({key.rpartition(".")[2]: value for key, value in each.items()}) for each in (entries, made)]
    if texts[0]:
        yield texts[0] + (f" instead of {texts[1]}" if texts[1] and texts[0] != texts[1] else "")


def _balls(values: Mapping[str, str]) -> str:
    count, diameter, radius = (values.get(key, "") for key in PINS)
    balls = f"{count or ''} balls Ø{float(diameter):.5g} mm" if diameter else f"{count} balls" if count else ""
    race = f"race R {float(radius):.4g} mm" if radius else ""
    return " in a ".join(filter(None, (balls.strip(), race)))


def _entry(path: str, value: str, table: Any) -> str:
    """One entry, and the value that it replaces."""
    *parents, key = path.split(".")
    label, unit = quantity_and_unit(key)
    before = _before(path, table)
    table_words = [part for part in parents if part not in PLAIN and not (part.isdigit() and parents[0] in PLAIN)]
    words = [*(f"{int(part) + 1}" if part.isdigit() else part.replace("run_up", "run-up") for part in table_words)]
    text = " ".join([*words, label.replace("_", " "), value.replace(",", ", ")])
    instead = "" if before in (None, value) else f" instead of {before}".replace(",", ", ")
    return f"{text}{instead} {SYMBOLS.get(unit, unit)}".rstrip()


def _before(path: str, table: Any) -> str | None:
    """The value at a path of the file's tables, its default included; None: there is none."""
    held = table
    for part in path.split("."):
        try:
            held = held[int(part)] if part.isdigit() else getattr(held, part)
        except (AttributeError, IndexError, TypeError):
            return None
    if held is None:
        return None
    return f"{held:.10g}" if isinstance(held, float) else json.dumps(held).strip('"').replace(" ", "")
