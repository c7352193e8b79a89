"""Meaning of each check code: its question, its criterion, its action; `abu explain ABU203` shows it.

The texts are in check_data/, one file for each hundred, read when one of its codes is first requested.
"""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Final

from abu_calc.frozen import dataclass

_DATA: Final = Path(__file__).parent / "check_data"

HUNDREDS: Final = {
    "ABU1": "speeds",
    "ABU2": "autobalancer",
    "ABU3": "strength",
    "ABU4": "vibration",
    "ABU5": "swing_arm",
    "ABU6": "seats",
    "ABU7": "simulation",
    "ABU8": "trust",
    "ABU9": "files",
    "ABU10": "balancing",
}
"""The file of each hundred, by what stands before the last two digits of its codes."""


@dataclass(frozen=True)
class CheckCode:
    """One kind of check: its code, its name, and what a reader of a report wants to know of it."""

    code: str
    name: str
    asks: str
    fails: str
    remedy: str
    step: str = ""
    """The step of `abu explain` that it belongs to, if any."""
    formulas: tuple[str, ...] = ()
    """Keys of the formulas that decide it."""


@cache
def _hundred(file: str) -> dict[str, CheckCode]:
    """The codes of one file; one that is asked `as` another has all but its name from that."""
    codes: dict[str, CheckCode] = {}
    for code, table in tomllib.loads((_DATA / f"{file}.toml").read_text(encoding="utf-8")).items():
        if "as" in table:
            codes[code] = replace(codes[table["as"]], code=code, name=table["name"])
        else:
            codes[code] = CheckCode(code, **table | {"formulas": tuple(table.get("formulas", ()))})
    return codes


class _Codes(Mapping[str, CheckCode]):
    """All codes; looking one up reads the file of its hundred alone."""

    def __getitem__(self, code: str) -> CheckCode:
        return _hundred(HUNDREDS[code[:-2]])[code]

    def __iter__(self) -> Iterator[str]:
        return (code for file in HUNDREDS.values() for code in _hundred(file))

    def __len__(self) -> int:
        return sum(1 for _ in self)


CHECK_CODES: Final[Mapping[str, CheckCode]] = _Codes()
"""Check codes by their names."""
