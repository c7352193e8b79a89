"""A recorded run: a CSV file with the columns time, left, right, mark."""

import io
import re
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.errors import InputError, Place
from abu_calc.frozen import dataclass
from abu_calc.spec.source import regular_file

LARGEST: Final = 300_000_000
"""Bytes of the largest record that is read."""
COLUMNS: Final = ("time", "left", "right", "mark")
TIME: Final = re.compile(r"(time|t)\b|(time|t)[_ (\[]")
REMEDY: Final = "a header time,left,right,mark; then a row for each sample, time in seconds"
Array = NDArray[np.float64]


@dataclass(frozen=True)
class RigRecord:
    """Samples of a run: time [s], both sensors in the unit of the run's quantity, the mark in any unit."""

    time: Array
    left: Array
    right: Array
    mark: Array


def read_rig_record(path: Path) -> RigRecord:
    """Reads a record; columns go by their names, or without a header in the order of COLUMNS.

    Points or, between semicolons, commas as decimal signs. Raises InputError with file, line and remedy.
    """
    rows = [
        (line, row) for line, row in enumerate(_text(path).splitlines(), 1) if row.strip() and row.strip()[0] != "#"
    ]
    if not rows:
        raise InputError("the record is empty", place=Place(str(path)), allowed=REMEDY)
    separator = next((sign for sign in ";\t," if sign in rows[0][1]), None)
    if separator == ";":
        rows = [(line, row.replace(",", ".")) for line, row in rows]
    first = _split(rows[0][1], separator)
    columns, scale, skip = _columns(first, path, rows[0][0])
    table = _table(rows[skip:], separator, columns, path)
    _check(table, rows[skip:], path)
    return RigRecord(table[:, 0] * scale, table[:, 1], table[:, 2], table[:, 3])


def _text(path: Path) -> str:
    place = Place(str(path))
    try:
        raw = regular_file(path, LARGEST)
        if len(raw) > LARGEST:
            raise InputError("the record is too large", place=place, allowed=f"at most {LARGEST} bytes")
        return raw.decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"the record cannot be read: {error.strerror or error}", place=place) from None
    except UnicodeDecodeError:
        raise InputError("the record is not UTF-8 text", place=place, remedy="export it as CSV") from None


def _split(row: str, separator: str | None) -> list[str]:
    return [cell.strip().strip('"') for cell in row.split(separator)]


def _columns(first: list[str], path: Path, line: int) -> tuple[tuple[int, ...], float, int]:
    """The places of the four columns, seconds per unit of time, and how many rows the header takes."""
    place = Place(str(path), line)
    if len(first) < len(COLUMNS):
        raise InputError("too few columns", place=place, found=str(len(first)), allowed=REMEDY)
    if _is_number(first[0]):
        return tuple(range(len(COLUMNS))), 1.0, 0
    names = [name.lower() for name in first]
    matches = [[k for k, name in enumerate(names) if _is(name, column)] for column in COLUMNS]
    if len(names) == len(COLUMNS) and not any(matches[1:]):
        matches = [[k] for k in range(len(COLUMNS))]  # names of another language: in the order asked for
    if any(len(each) != 1 for each in matches):
        raise InputError(
            "columns are not told apart by their names", place=place, found=", ".join(first), allowed=REMEDY
        )
    time = names[matches[0][0]]
    return tuple(each[0] for each in matches), 1e-3 if re.search(r"[_ (\[]ms\b", time) else 1.0, 1


def _is(name: str, column: str) -> bool:
    return bool(TIME.match(name)) if column == "time" else name.startswith(column)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _table(rows: list[tuple[int, str]], separator: str | None, columns: tuple[int, ...], path: Path) -> Array:
    if not rows:
        raise InputError("the record has no samples", place=Place(str(path)), allowed=REMEDY)
    text = io.StringIO("\n".join(row for _, row in rows))
    try:
        return np.loadtxt(text, delimiter=separator, usecols=columns, ndmin=2, dtype=np.float64)
    except ValueError:
        for line, row in rows:
            cells = _split(row, separator)
            wrong = next((k for k in columns if k >= len(cells) or not _is_number(cells[k])), None)
            if wrong is not None:
                entry = cells[wrong] if wrong < len(cells) else f"{len(cells)} columns"
                raise InputError(
                    "not a number", place=Place(str(path), line), found=entry or "nothing", allowed=REMEDY
                ) from None
        raise


def _check(table: Array, rows: list[tuple[int, str]], path: Path) -> None:
    """Every number finite, time ascending."""
    wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if wrong.size:
        line, row = rows[int(wrong[0])]
        raise InputError("a finite number is expected", place=Place(str(path), line), found=row.strip()[:60])
    back = np.flatnonzero(np.diff(table[:, 0]) <= 0)
    if back.size:
        line, _ = rows[int(back[0]) + 1]
        times = " after ".join(f"{value:.9g}" for value in table[[back[0] + 1, back[0]], 0])
        remedy = "write time with more digits, if it stands still"
        raise InputError("time does not go on", place=Place(str(path), line), found=times, remedy=remedy)
