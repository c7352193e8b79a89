"""Table of numbers of a recording in text: names, rows with their line numbers, and equally spaced times."""

import re
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.recording_columns import RecordingColumn

EVEN: Final = 0.05
"""Share of a step by which times may stray from their grid: more is not the rounding of written times."""


@dataclass(frozen=True)
class Lines:
    """Rows of numbers with their line numbers, and the names above them."""

    path: str
    names: tuple[str, ...]
    numbers: tuple[int, ...]
    values: NDArray[np.float64]
    head: int | None = None
    """Line of the names."""


def decoded(path: str, content: bytes) -> str:
    """Text of a file in UTF-8, UTF-16 or a Windows code page. Raises InputError for what is no text."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    if b"\0" in content[:4096]:
        raise InputError("neither a table of text nor a WAV file", place=Place(path))
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Two letters of the upper half side by side are a Cyrillic word of Windows; alone they are µ or ².
        return content.decode("cp1251" if re.search(rb"[\xc0-\xff]{2}", content[:4096]) else "latin-1", "replace")


def table_of(path: str, text: str, remarks: list[str]) -> Lines:
    """Names and numbers; comments (#) and empty lines left out."""
    rows = [(k, line) for k, line in enumerate(text.splitlines(), 1) if line.strip() and not line.startswith("#")]
    first = next((k for k, (_, line) in enumerate(rows) if _numeric(line)), None)
    if first is None:
        raise InputError("no row of numbers", place=Place(path), remedy="Columns: time, and what moved.")
    if first > 2:
        raise InputError(
            "more lines above the numbers than names and units", place=Place(path, rows[0][0]),
            found=rows[0][1].strip()[:60], remedy="Keep one line of names, or begin the others with #.",
        )  # fmt: skip
    delimiter = _delimiter(rows[first][1])
    if delimiter and rows[first][1].rstrip().endswith(delimiter):  # every row ends so
        rows = [(number, line.rstrip().removesuffix(delimiter)) for number, line in rows]
    heads = [[cell.strip().strip('"') for cell in _cells(line, delimiter)] for _, line in rows[:first]]
    if delimiter != "," and any("," in line for _, line in rows[first:]):
        rows = [(number, _pointed(path, number, line) if k >= first else line) for k, (number, line) in enumerate(rows)]
        remarks.append("Commas are taken for decimal points.")
    width = len(_cells(rows[first][1], delimiter))
    for (number, _), head in zip(rows[:first], heads, strict=True):
        if len(head) != width:
            raise InputError(
                "another number of columns than the names above", place=Place(path, rows[first][0]),
                found=f"{width}, names on line {number}: {len(head)}",
                remedy="Are commas decimal points? Then put ; between the columns, or write points.",
            )  # fmt: skip
    names = [" ".join(parts) for parts in zip(*heads, strict=True)] if len(heads) == 1 else []
    if len(heads) == 2:
        names = [f"{name} [{unit.strip('[]()')}]" for name, unit in zip(*heads, strict=True)]
    names = names or ["t", *(f"column {k}" for k in range(2, width + 1))]
    numbers, lines = zip(*rows[first:], strict=True)
    above = rows[0][0] if first else None
    return Lines(path, tuple(names), numbers, _values(path, names, numbers, lines, delimiter), above)


def _numeric(line: str) -> bool:
    """True if the first cell of a line is a number.

    A comma before a digit may be a decimal point, or end the cell.
    """
    cell = re.split(r"[;\t]|,(?!\d)|\s", line.strip())[0].strip('"')
    return re.fullmatch(r"[-+]?(\d+([.,]\d*)*|[.,]\d+)([eE][-+]?\d+(,.*)?)?", cell) is not None


def _delimiter(line: str) -> str | None:
    """Delimiter of the cells in a row of numbers; None: blanks."""
    if not re.search(r"[;\t]", line) and re.search(r"\d,\d.*[^,\s]\s+[^,\s]", line.strip()):
        return None  # commas are decimal points between blanks
    return next((sign for sign in (";", "\t", ",") if sign in line), None)


def _cells(line: str, delimiter: str | None) -> list[str]:
    return line.strip().split(delimiter)


def _pointed(path: str, number: int, line: str) -> str:
    if "." in line:
        raise InputError("points and commas both stand for decimals", place=Place(path, number), found=line.strip())
    return line.replace(",", ".")


def _values(
    path: str, names: Sequence[str], numbers: Sequence[int], lines: Sequence[str], delimiter: str | None
) -> NDArray[np.float64]:
    """Numbers, row by row; the first cell that is none is told with its line and column."""
    plain = [line.strip().replace('"', "") for line in lines]
    try:
        array = np.loadtxt(plain, delimiter=delimiter, ndmin=2, comments=None)
        if np.isfinite(array).all() and array.shape[1] == len(names):
            return np.asarray(array, dtype=float)
    except ValueError:
        pass
    for number, line in zip(numbers, plain, strict=True):
        cells = line.split(delimiter)
        if len(cells) != len(names):
            raise InputError(
                "another number of columns than before", place=Place(path, number),
                found=f"{len(cells)}", allowed=f"{len(names)}",
                remedy="A row that was cut off, or commas as decimal points: put ; between the columns then.",
            )  # fmt: skip
        for name, cell in zip(names, cells, strict=True):
            _check_cell(Place(path, number, name), cell.strip())
    raise InputError("the numbers cannot be read", place=Place(path, numbers[0]))


def _check_cell(place: Place, cell: str) -> None:
    try:
        good = bool(np.isfinite(float(cell)))
    except ValueError:
        good = False
    if not good:
        raise InputError("not a number", place=place, found=cell or "nothing", remedy="Every row needs every number.")


def rate_of(table: Lines, time: int, column: RecordingColumn) -> float:
    """Samples a second of times that are equally spaced but for the rounding of their digits."""
    t, path, count = table.values[:, time], table.path, len(table.values)

    def place(row: int) -> Place:
        return Place(path, table.numbers[row], column.name)

    if count < 3:
        raise InputError("too few rows", place=Place(path), found=f"{count}")
    steps = np.diff(t)
    back = np.flatnonzero(steps <= 0)
    if len(back):
        k = int(back[0]) + 1
        raise InputError("the times do not ascend", place=place(k), found=f"{t[k]:.12g} after {t[k - 1]:.12g}")
    usual = float(t[-1] - t[0]) / (count - 1)
    stray = float(np.abs(t - np.linspace(t[0], t[-1], count)).max())
    rounded = stray <= 1.01 * _resolution(t) <= 1.01 * usual and not _gaps(steps)
    if stray > EVEN * usual and not rounded:
        raise _uneven(steps, place)
    return 1 / (usual * (column.unit or 1.0))


def _resolution(t: NDArray[np.float64]) -> float:
    """One unit of the last digit that the times are written with, decimals; 0 for more than nine."""
    for digits in range(10):
        scaled = t * 10.0**digits
        if float(np.abs(scaled - np.round(scaled)).max()) < 1e-6 * max(1.0, float(np.abs(scaled).max()) * 1e-6):
            return float(10.0**-digits)
    return 0.0


def _gaps(steps: NDArray[np.float64]) -> list[int]:
    """Steps of time that are twice as wide as others or wider, if they are few."""
    wide = np.flatnonzero(steps > 1.9 * float(np.median(steps)))
    return [int(k) for k in wide] if len(wide) <= max(3, len(steps) // 1000) else []


def _uneven(steps: NDArray[np.float64], place: Callable[[int], Place]) -> InputError:
    """Fault in the steps of time: a gap, if they are alike but for few, or no fixed rate."""
    usual, gaps = float(np.median(steps)), _gaps(steps)
    if gaps:
        k = gaps[0]
        return InputError(
            "a gap in the times", place=place(k + 1), found=f"{steps[k]:.6g} after steps of {usual:.6g}",
            remedy="Cut the file there, and take its longest part.",
        )  # fmt: skip
    k = int(np.argmax(np.abs(steps - usual)))
    return InputError(
        "the times are not equally spaced", place=place(k + 1),
        found=f"a step of {steps[k]:.6g} among steps of {usual:.6g}",
        remedy="Record at a fixed rate, or write the times with more digits.",
    )  # fmt: skip
