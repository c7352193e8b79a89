"""Reading of the data files of standards: each once, when first asked for."""

import difflib
import tomllib
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from abu_calc.foundation.errors import InputError

_DATA = Path(__file__).parent / "data"


@cache
def toml_table(name: str) -> dict[str, Any]:
    """A data file `name.toml`; its `source` and `edition` say where the facts are from."""
    return tomllib.loads((_DATA / f"{name}.toml").read_text(encoding="utf-8"))


@cache
def csv_rows(name: str) -> tuple[tuple[str, ...], ...]:
    """The rows of a data file `name.csv` below its column names; source and edition stand in its comments."""
    lines = (_DATA / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    return tuple(tuple(line.split(",")) for line in lines if not line.startswith("#"))[1:]


def unknown(what: str, name: str, known: Iterable[str], remedy: str | None = None) -> InputError:
    """The refusal of a name that a table does not have, with the nearest that it has.

    >>> print(unknown("balance grade", "6,3", ["G16", "G6.3"]))
    unknown balance grade (found 6,3; allowed: G16, G6.3)
      The nearest known one is G6.3.
    """
    names = list(known)
    close = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    advice = f"The nearest known one is {close[0]}." if close else remedy
    allowed = ", ".join(names) if len(names) <= 50 else None
    return InputError(f"unknown {what}", found=name, allowed=allowed, remedy=advice)
