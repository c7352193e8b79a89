"""Intended meaning of an unknown key."""

import difflib
from collections.abc import Iterable
from functools import cache
from typing import Final

from abu_calc.spec.table import Table, all_tables, is_array, subtable
from abu_calc.spec.text import UNITS, Part, key_path, unit_suffix

_OTHER_UNITS: Final = frozenset(
    {*UNITS, "t", "lb", "lbs", "oz", "gram", "grams", "cm", "in", "inch", "hp", "ms", "min"}
)


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word nearest to one, whatever its case.

    >>> nearest("Mass-KG", ["mass_kg", "name"])
    'mass_kg'
    """
    folded = {name.lower(): name for name in known}
    close = difflib.get_close_matches(word.lower(), folded, n=1)
    return folded[close[0]] if close else None


def other_unit(key: str, known: Iterable[str]) -> str | None:
    """The known key that says the same in another unit, or with none written.

    >>> other_unit("mass_g", ["mass_kg"]), other_unit("mass", ["mass_kg"]), other_unit("name", ["mass_kg"])
    ('mass_kg', 'mass_kg', None)
    """
    for name in known:
        unit = unit_suffix(name)
        stem = name.removesuffix(f"_{unit}") if unit else None
        if stem and (key == stem or (key.startswith(f"{stem}_") and key.removeprefix(f"{stem}_") in _OTHER_UNITS)):
            return name
    return None


def header(root: type[Table], path: tuple[Part, ...]) -> str:
    """The header of a table, as the file writes it."""
    names = tuple(part for part in path if isinstance(part, str))
    model, array = root, False
    for name in names:
        array = is_array(model, name)
        model = subtable(model, name) or model
    return f"[[{key_path(names)}]]" if array else f"[{key_path(names)}]"


def meant_table(root: type[Table], name: str, value: object) -> tuple[str | None, str | None]:
    """The table an unknown name at the top of a file stands for, if any, and the remedy."""
    if not isinstance(value, (dict, list)) and (homes := _homes(root, name)):
        return None, f"{name} belongs in {homes}"
    tables = [key for key in root.model_fields if subtable(root, key) or key == "expected"]
    if (meant := nearest(name, tables)) and isinstance(value, (dict, list)):
        return meant, f"the nearest known table is {header(root, (meant,))}"
    if not isinstance(value, (dict, list)):
        return None, "every key belongs in a table: write its [table] above it"
    return None, "known tables: " + ", ".join(tables)


def meant_key(root: type[Table], path: tuple[Part, ...], table: type[Table], key: str) -> tuple[str | None, str]:
    """The key of a table that an unknown one stands for, if any, and the remedy."""
    known = list(table.model_fields)
    if homes := _homes(root, key):
        return None, f"{key} belongs in {homes}"
    if meant := other_unit(key, known):
        unit = key.removeprefix(meant.removesuffix(f"_{unit_suffix(meant)}")).strip("_")
        unit_note = f"in {unit_suffix(meant)} instead of {unit}" if unit else "the unit stands in the key"
        return meant, f"write {meant}, {unit_note}"
    if meant := nearest(key, known):
        return meant, f"the nearest known key is {meant}"
    elsewhere = _all_homes(root)
    if far := other_unit(key, elsewhere) or nearest(key, elsewhere):
        return None, f"the nearest known key is {far} of {elsewhere[far]}"
    return None, f"known keys of {header(root, path)}: {', '.join(known)}"


@cache
def _all_homes(root: type[Table]) -> dict[str, str]:
    """Every key, and the tables that know it."""
    return {
        name: homes for _, other in all_tables(root) for name in other.model_fields if (homes := _homes(root, name))
    }


def _homes(root: type[Table], key: str) -> str:
    """The headers of the tables that know a key, "[machine] or [wheel]"; empty for none."""
    return " or ".join(
        header(root, path)
        for path, table in all_tables(root)
        if key in table.model_fields and key not in ("name", "handle")
    )
