"""Text form of keys, values and units, the same in every message.

Number of the format of the files that people write.

A file may say `format = 1` above its tables. The number goes up when a key changes, and with nothing else. A file
without the number is read as one of the newest format; one of a newer format than this version knows is refused, for
its keys may mean something else.
"""

import datetime
import math
import re
from collections.abc import Iterable
from typing import Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import SI_PER_UNIT, SYMBOLS

Part = str | int
"""One step of a key path: a key, or the place in an array of tables."""

BARE_KEY: Final = re.compile(r"[A-Za-z0-9_-]+")
LONGEST_SHOWN: Final = 60
# Longest first, so that `joint_damping_N_s_per_m` ends in `N_s_per_m` and not in `m`.
UNITS: Final = tuple(sorted((*SI_PER_UNIT, "db", "HRC"), key=len, reverse=True))


def key_path(parts: Iterable[Part]) -> str:
    """A key path as TOML writes it; places in arrays count from 0.

    >>> key_path(("bearing", 0, "shaft_fit")), key_path(("expected", "autobalancer.ball_count"))
    ('bearing[0].shaft_fit', 'expected."autobalancer.ball_count"')
    """
    path = ""
    for part in parts:
        if isinstance(part, int):
            path += f"[{part}]"
        else:
            path += ("." if path else "") + (part if BARE_KEY.fullmatch(part) else quoted(part))
    return path


def quoted(text: str) -> str:
    """Text as a TOML basic string."""
    import json

    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def shown(value: object) -> str:
    """A value as TOML writes it, one line.

    >>> shown(True), shown((2.5, 2.5)), shown("5,6"), shown(float("nan"))
    ('true', '[2.5, 2.5]', '"5,6"', 'nan')
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(shown(item) for item in value)}]"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, (datetime.date, datetime.time)):
        return value.isoformat()
    # Python refuses to print integers of thousands of digits; no quantity has that many.
    return "a huge integer" if isinstance(value, int) and abs(value) > 10**300 else str(value)


def shown_short(value: object) -> str:
    """The same, cut for a message."""
    if isinstance(value, list) and any(isinstance(item, dict) for item in value):
        return "an array of tables"
    text = shown(value)
    return text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 1] + "…"


def unit_suffix(key: str) -> str | None:
    """The unit a key ends in, as its suffix.

    >>> unit_suffix("mass_kg"), unit_suffix("joint_damping_N_s_per_m"), unit_suffix("rotation_sense")
    ('kg', 'N_s_per_m', None)
    """
    return next((unit for unit in UNITS if key.endswith("_" + unit)), None)


def unit_symbol(key: str) -> str:
    """The unit of a key as printed after a number, with its space; empty where the key has none."""
    unit = unit_suffix(key)
    return f" {SYMBOLS.get(unit, unit)}" if unit else ""


def is_number(value: object) -> bool:
    """True if a value is a finite number (true and false are none)."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and -math.inf < value < math.inf


FORMAT: Final = 1
"""Newest format of files, that of this version."""
KEY: Final = "format"


def check_format(given: object, place: Place) -> None:
    """Refuse a newer format, and what is no number of a format."""
    if isinstance(given, bool) or not isinstance(given, int) or given < 1:
        raise InputError(
            "not the number of a format", place=place, found=shown_short(given), allowed=f"1 … {FORMAT}",
            remedy=f"write format = {FORMAT}, or leave the key out",
        )  # fmt: skip
    if given > FORMAT:
        raise InputError(
            "the file has a newer format than this version of abu-calc knows", place=place, found=str(given),
            allowed=f"1 … {FORMAT}", remedy="install a newer abu-calc: pip install --upgrade abu-calc",
        )  # fmt: skip
