"""Reading of the data files of standards: each once, when first asked for."""

import difflib
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from abu_calc.foundation.errors import InputError, RangeError
from abu_calc.foundation.units import from_si, to_si

Row = TypeVar("Row", bound=Sequence[float])
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


def millimetres(size: float) -> float:
    """A size [m] in the unit of the tables: 80 mm written in metres and back stays in the row "up to and including 80".

    >>> millimetres(0.08)
    80.0
    """
    return round(from_si(size, "mm"), 6)


def metres(figures: Iterable[str | float]) -> Iterator[float]:
    """Millimetres of a table [m]."""
    return (to_si(float(figure), "mm") for figure in figures)


def micrometres(figure: float) -> float:
    """Micrometres of a table [m], freed of the noise of binary fractions: −15 µm is the number nearest to −15e-6 m."""
    return round(to_si(figure, "um"), 12)


def row_of_size(rows: Iterable[Row], size: float) -> Row | None:
    """The row that holds a size [m]; rows begin with the ends of their range, over … up to and including [mm].

    >>> row_of_size([(0, 3, 6), (3, 6, 8)], 0.006)
    (3, 6, 8)
    """
    wanted = millimetres(size)
    return next((row for row in rows if row[0] < wanted <= row[1]), None)


def lengths_for_size(rows: Sequence[Sequence[float]], size: float, fault: str, remedy: str) -> tuple[float, float]:
    """Two lengths [m], micrometres in the row that holds a size [m]. Raises RangeError outside the rows."""
    row = row_of_size(rows, size)
    if row is None:
        raise RangeError(
            fault,
            found=f"{millimetres(size):g} mm",
            allowed=f"over {rows[0][0]:g} up to {rows[-1][1]:g} mm",
            remedy=remedy,
        )
    return micrometres(row[2]), micrometres(row[3])


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
