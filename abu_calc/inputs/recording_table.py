"""Table of numbers of a recording in text: names, rows with their line numbers, and what other lines tell.

Lines that are no data: `sep=;` for spreadsheets, comments that begin with #, lines above the names, trailers.
"""

import csv
import re
from collections.abc import Callable, Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.recording_columns import MOTION, TIME, column_of, is_unit, plain_unit

SEPARATOR: Final = re.compile(r'"?sep=(.)"?\s*', re.IGNORECASE)
NUMBER: Final = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?")
DAY: Final = r"(?:\d{4}[./-]\d\d?[./-]\d\d?|\d\d?[./-](?:\d\d?|[A-Za-z]{3})[./-]\d{2,4})"
WHEN: Final = re.compile(rf"{DAY}|\d\d?:\d|0x[0-9A-Fa-f]+$")
CLOCK: Final = re.compile(
    rf"{DAY}?[T ]?\s*"
    r"(?:(\d{1,2}):)?(\d{1,2}):(\d{1,2}(?:[.,:]\d+)?)\s*([AaPp][Mm])?(?:Z|\s?[-+]\d\d:?\d\d)?"
)
"""A time of day, with a date or without: hours, minutes, seconds."""
SPAN: Final = re.compile(r"([-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)\s*(s|sec|seconds|ms|us|µs)")
"""A time with its unit in the cell."""
DATE: Final = re.compile(r"\d+\.\d+\.\d+")
_NUMBER: Final = r"(\d{1,3}(?:,\d{3})+|\d+(?:\.\d+)?)"
RATE: Final = re.compile(
    r"(?:(?<!baud )(?<!bit )\brate|sampl\w*?[ _-]?(?:rate|freq\w*)|data_rate|\bfs\b|\bodr\b|abtast\w*|дискретизаци\w*|"
    rf"échantillonnage|采样\w*)(?:[\W_]*(?:k?hz|гц|кгц))?[\W_]*{_NUMBER}\s*(k?hz|гц|кгц)?",
    re.IGNORECASE,
)
INTERVAL: Final = re.compile(
    r"(?:sampl\w*[ _-]?(?:period|interval)|\bdt\b|delta_x)\W*(?:(s|ms|us|µs)\b\W*)?(\d+(?:\.\d+)?(?:e[-+]?\d+)?)\s*"
    r"(s|ms|us|µs)?\b",
    re.IGNORECASE,
)
BARE_RATE: Final = re.compile(rf"{_NUMBER}\s*(k?hz|k?sps|k?sa/s|гц|кгц)", re.IGNORECASE)
"""A rate that stands alone on its line, or behind the names of the columns."""
LOST: Final = re.compile(r"(?:overflows?|overruns?|drops|dropped|lost|missed)\W{0,3}(\d+)", re.IGNORECASE)
UNITS: Final = re.compile(r"(?:\bunits?|einheit\w*|единиц\w*|unités?)\b\W*(.+)", re.IGNORECASE)
COMMENT: Final = re.compile(r"#+|//+|%+|;(?=[^;]*$|\w)")
"""Signs with which lines begin that hold no data."""
TRAILING: Final = frozenset({"", "comment", "comments", "note", "notes", "remark", "remarks"})
"""Names of last columns that rows may leave out."""
MOST_BELOW: Final = 20
"""Lines below the numbers, at most."""


class Told(NamedTuple):
    """What lines beside the data tell: samples a second, and the line that says so."""

    rate: float
    line: int


@dataclass(frozen=True)
class Lines:
    """Rows of numbers with their line numbers, and the names above them.

    `named`: whether the file names its columns; `clocks`: columns that were times of day [s]; `empty`: columns that
    hold no numbers; `told`: rates that other lines tell; `unit`: the one of the motion that another line tells.
    """

    path: str
    names: tuple[str, ...]
    numbers: tuple[int, ...]
    values: NDArray[np.float64]
    head: int | None = None
    """Line of the names."""
    named: bool = True
    clocks: frozenset[int] = frozenset()
    empty: frozenset[int] = frozenset()
    told: tuple[Told, ...] = ()
    unit: str = ""


Row = tuple[int, str]
"""A line with its number."""


def decoded(path: str, content: bytes) -> str:
    """Text of a file in UTF-8, UTF-16 or a Windows code page. Raises InputError for what is no text."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    if content[:2] == b"PK":
        raise InputError("a workbook or another packed file", place=Place(path), remedy="Save it as CSV.")
    if b"\0" in content[:4096]:
        line = content[: content.index(b"\0")].count(b"\n") + 1
        raise InputError("neither a table of text nor a WAV file", place=Place(path, line), found="a byte of zeros",
                         remedy="Export it as CSV.")  # fmt: skip
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Two letters of the upper half side by side are a Cyrillic word of Windows; alone they are µ or ².
        return content.decode("cp1251" if re.search(rb"[\xc0-\xff]{2}", content[:4096]) else "latin-1", "replace")


def table_of(path: str, text: str, remarks: list[str], skip: int = 0) -> Lines:
    """Names and numbers; `skip`: lines at the beginning that are left out. Remarks tell what is left out beside."""
    lines = list(_physical(text, skip))
    asked = SEPARATOR.fullmatch(lines[0][1].strip()) if lines else None
    sign, lines = (asked[1], lines[1:]) if asked else (None, lines)
    comments = [(k, COMMENT.sub("", line, count=1).strip()) for k, line in lines if COMMENT.match(line)]
    rows, below = _without_trailer([each for each in lines if not COMMENT.match(each[1])])
    first = next((k for k in range(len(rows)) if _begins(rows, k, sign)), None)
    if first is None:
        found = rows[0] if rows else (None, "")
        raise InputError(
            "no row of numbers", place=Place(path, found[0]), found=found[1].strip()[:60] or None,
            remedy="Columns of numbers are read: time, and what moved. Lines above them may be left out: --skip N.",
        )  # fmt: skip
    written = sign if sign and sign in rows[first][1] else _delimiter(rows[first][1])
    heads = rows[:first] or _commented(comments, rows[0], written)
    rows = rows[first:]
    if written and all(line.rstrip().endswith(written) for _, line in rows[:3]):
        rows = _without_last(rows, heads, written)
    body = _with_points(path, rows, written, remarks)
    delimiter = ";" if body is not rows and written == "," and ";" in body[0][1] else written
    width = len(_cells(body[0][1], delimiter))
    head, names, above = _names(path, heads, width, written, body[0], asked is not None)
    if above:
        which = f"Line {above[0][0]} stands" if len(above) == 1 else f"Lines {above[0][0]} to {above[-1][0]} stand"
        remarks.append(f"{which} above the names and {'is' if len(above) == 1 else 'are'} left out.")
    if len(body) > 1 and len(_cells(body[-1][1], delimiter)) < width:
        remarks.append(f"Line {body[-1][0]}, the last, is cut off and left out.")
        body = body[:-1]
    notes = [*comments, *above, *below]
    for number, line in notes:
        if lost := sum(int(count) for count in LOST.findall(line)):
            remarks.append(f"Line {number} tells of {lost} lost samples or overflows: levels may be wrong.")
    shown = names or [f"column {k}" for k in range(1, width + 1)]
    values, clocks, empty = _values(path, shown, body, delimiter)
    if empty:
        remarks.append(f"Without numbers, and left out: {', '.join(shown[k] for k in sorted(empty))}.")
    return Lines(
        path, tuple(shown), tuple(k for k, _ in body), values, head, names is not None, clocks, empty,
        tuple(_rates(notes, heads)), _unit_told(notes),
    )  # fmt: skip


MOST_JOINED: Final = 5


def _physical(text: str, skip: int) -> Iterator[Row]:
    """Lines that are not empty; one whose quotes are open goes on in the next, as spreadsheets write names."""
    joined, begun = "", 0
    for number, line in enumerate(text.splitlines(), 1):
        if number <= skip or not line.strip():
            continue
        if joined or (line.count('"') % 2 and number <= skip + MOST_JOINED):
            joined, begun = f"{joined} {line}" if joined else line, begun or number
            if joined.count('"') % 2 and number < begun + MOST_JOINED:
                continue
            yield begun, joined
            joined, begun = "", 0
        else:
            yield number, line


def _commented(comments: Sequence[Row], row: Row, delimiter: str | None) -> list[Row]:
    """Names, and maybe their units, that stand in the comments just above the numbers."""
    width, heads = len(_cells(row[1], delimiter)), list[Row]()
    for number, line in reversed(comments[-2:]):
        own = line.partition(";")[0] if delimiter == "," else line
        cells = _cells(own, delimiter)
        if len(cells) == width + 1 and cells[0].lower() in ("headers", "header", "columns", "columns:"):
            own = own.partition(delimiter or " ")[2]
        if number != row[0] - 1 - len(heads) or len(_cells(own, delimiter)) != width:
            break
        heads.insert(0, (number, own))
    return heads


def _without_last(rows: list[Row], heads: Sequence[Row], delimiter: str) -> list[Row]:
    """Rows without the sign at their end, unless names stand for the empty cell behind it."""
    width = len(_cells(rows[0][1].rstrip("\n"), delimiter))
    if any(len(_cells(line, delimiter)) == width and not line.rstrip().endswith(delimiter) for _, line in heads):
        return rows
    return [(number, line.rstrip().removesuffix(delimiter)) for number, line in rows]


def _without_trailer(rows: list[Row]) -> tuple[list[Row], list[Row]]:
    """Rows, and the lines below the last row of numbers, if they are few."""
    last = next((k for k in range(len(rows), max(len(rows) - MOST_BELOW, 1), -1) if _numeric(rows[k - 1][1])), 0)
    return (rows[:last], rows[last:]) if last and _numeric(rows[last - 2][1]) else (rows, [])


def _begins(rows: Sequence[Row], k: int, sign: str | None) -> bool:
    """True for a row of numbers with as many cells as most of the rows that follow."""
    if not _numeric(rows[k][1]):
        return False
    delimiter = sign or _delimiter(rows[k][1])
    counts = [len(_cells(line, delimiter)) for _, line in rows[k : k + 9]]
    return 2 * counts.count(counts[0]) > len(counts)


def _numeric(line: str) -> bool:
    """True if the first cell of a line that is not empty is a number, a date or a time of day."""
    first = re.split(r"[;\t,|]", line.strip().lstrip(";,\t|"))[0].strip().strip('"').strip()
    return NUMBER.fullmatch(first.split(" ")[0]) is not None or WHEN.match(first) is not None


def _delimiter(line: str) -> str | None:
    """Delimiter of the cells in a row of numbers; None: blanks."""
    bare = re.sub(r'"[^"]*"', '""', line)
    if not re.search(r"[;\t]", line) and re.search(r"\d,\d.*[^,\s]\s+[^,\s]", bare.strip()) and ":" not in line:
        return None  # commas are decimal points between blanks
    return next((sign for sign in (";", "\t", ",", "|") if sign in bare), None)


def _cells(line: str, delimiter: str | None) -> list[str]:
    """Cells of a line, quoted ones as RFC 4180 has them."""
    if delimiter is None:
        return line.split()
    cells = next(csv.reader([line.strip()], delimiter=delimiter)) if '"' in line else line.strip().split(delimiter)
    return [cell.strip() for cell in cells]


def _with_points(path: str, rows: list[Row], delimiter: str | None, remarks: list[str]) -> list[Row]:
    """Rows whose numbers have decimal points; quoted cells with decimal commas are parted by semicolons."""
    if delimiter == "," and any(re.search(r'"[^"]*\d,\d', line) for _, line in rows[:3]):
        rows, delimiter = [(number, ";".join(_cells(line, ","))) for number, line in rows], ";"
    if delimiter == "," or not any("," in line for _, line in rows):
        return rows
    remarks.append("Commas are taken for decimal points.")
    return [(number, _pointed(path, number, line)) for number, line in rows]


def _pointed(path: str, number: int, line: str) -> str:
    if "." in DATE.sub("", line):
        raise InputError(
            "points and commas both stand for decimals", place=Place(path, number), found=line.strip()[:60],
            remedy="Write decimals in one way, and no signs between thousands.",
        )  # fmt: skip
    return line.replace(",", ".")


def _names(
    path: str, heads: Sequence[Row], width: int, delimiter: str | None, row: Row, parted: bool
) -> tuple[int | None, list[str] | None, list[Row]]:
    """Line of the names, the names with their units (None: the file has none), and the lines above that are neither."""
    cells = [(head, _head_cells(head[1], width, delimiter)) for head in heads]
    full = [(head, each) for head, each in cells if len(each) == width]
    if not full:
        if heads:
            raise InputError(
                "another number of columns than the names above", place=Place(path, row[0]),
                found=f"{width}, names on line {heads[-1][0]}: {len(cells[-1][1])}",
                remedy="Correct the names, or leave out the lines above the numbers: --skip "
                f"{row[0] - 1} (Python: skip=)." if parted or delimiter != "," else "Are commas decimal points? Then "
                "put ; between the columns, or write points. Names of another number are left out by --skip "
                f"{row[0] - 1} (Python: skip=).",
            )  # fmt: skip
        return None, None, []
    alike = all(is_unit(each) for each in full[-1][1] if each)
    if alike and len(full) == 1:  # units and no names
        full.insert(0, (full[0][0], [f"column {k}" for k in range(1, width + 1)]))
    units = full[-1][1] if alike else None
    head, names = max(full[:-1] if units else full, key=lambda each: (_known(each[1]), each[0][0]))
    if units:
        bare = [re.sub(r"[\[\]()]", "", unit) for unit in units]
        names = [f"{name} [{unit}]" if unit else name for name, unit in zip(names, bare, strict=True)]
    return head[0], names, [each for each in heads if each[0] < head[0]]


def _head_cells(line: str, width: int, delimiter: str | None) -> list[str]:
    """Cells of a line above the numbers, parted by their sign or by another; names of cells that rows leave out go."""
    kept = [each for each in (delimiter, "\t", ";", ",") if each or delimiter is None]
    ways = [_cells(line, each) for each in kept]
    cells = next((way for way in ways if len(way) == width), ways[0])
    while len(cells) > width and cells[-1].lower() in TRAILING:
        cells = cells[:-1]
    return cells


def _known(names: Sequence[str]) -> int:
    """How many names tell time or motion, all times as one."""
    columns = [column_of(name) for name in names]
    motions = sum(column.quantity is not None or column.volts is not None or column.may_be_axis for column in columns)
    return motions + any(column.is_time or column.numbers_rows for column in columns)


def _rates(notes: Sequence[Row], heads: Sequence[Row]) -> Iterator[Told]:
    """Rates that lines tell in so many words, or that stand alone, or behind the names."""
    names = {number for number, _ in heads}
    for number, line in notes:
        behind = line.rpartition(";")[2].strip() if number in names else ""
        match = RATE.search(line) or BARE_RATE.fullmatch(line.strip()) or BARE_RATE.fullmatch(behind)
        if match and "decimat" not in line.lower():
            size = 1000 if (match[2] or "").lower()[:1] in ("k", "к") else 1
            yield Told(float(match[1].replace(",", "")) * size, number)
        elif step := INTERVAL.search(line):
            seconds = float(step[2]) * TIME[plain_unit(step[1] or step[3] or "s")]
            yield Told(round(1 / seconds, 6) if seconds else 0.0, number)


def _unit_told(notes: Sequence[Row]) -> str:
    """The unit of the motion that a line tells; empty if none does, or several do."""
    found = {
        part
        for _, line in notes if (match := UNITS.search(line))
        for part in re.split(r"[,;\t ]+", match[1]) if plain_unit(part) in MOTION
    }  # fmt: skip
    return found.pop() if len(found) == 1 else ""


def _values(
    path: str, names: Sequence[str], rows: Sequence[Row], delimiter: str | None
) -> tuple[NDArray[np.float64], frozenset[int], frozenset[int]]:
    """Numbers, row by row, columns of times of day [s], and columns without numbers (NaN)."""
    plain = [line.replace('"', "") for _, line in rows]
    try:
        array = np.loadtxt(plain, delimiter=delimiter, ndmin=2, comments=None)
        if np.isfinite(array).all() and array.shape[1] == len(names):
            return np.asarray(array, dtype=float), frozenset(), frozenset()
    except ValueError:
        pass
    cells = [_cells(line, delimiter) for _, line in rows]
    for (number, _), each in zip(rows, cells, strict=True):
        if len(each) != len(names):
            raise InputError(
                "another number of columns than before", place=Place(path, number),
                found=f"{len(each)}", allowed=f"{len(names)}",
                remedy="A row that was cut off, or commas as decimal points: put ; between the columns then.",
            )  # fmt: skip
    kinds = [[_kind(each[k]) for each in cells[:3]] for k in range(len(names))]
    clocks = frozenset(k for k, kind in enumerate(kinds) if set(kind) == {"clock"})
    empty = frozenset(k for k, kind in enumerate(kinds) if set(kind) <= {"word"})
    values = np.full((len(rows), len(names)), np.nan)
    for k, name in enumerate(names):
        if k in empty:
            continue
        read: Callable[[Place, str], float] = _clock if k in clocks else _number
        values[:, k] = [read(Place(path, rows[j][0], name), each[k]) for j, each in enumerate(cells)]
        if k in clocks:
            values[:, k] += 86400 * np.concatenate([[0], np.cumsum(np.diff(values[:, k]) < -43200)])
    return values, clocks, empty


def _kind(cell: str) -> str:
    return "number" if _is_number(cell) else "clock" if CLOCK.fullmatch(cell) or SPAN.fullmatch(cell) else "word"


def _is_number(cell: str) -> bool:
    try:
        return bool(np.isfinite(float(cell)))
    except ValueError:
        return cell.lower() in ("nan", "inf", "-inf")


def _number(place: Place, cell: str) -> float:
    try:
        number = float(cell)
    except ValueError:
        number = np.nan
    if not np.isfinite(number):
        raise InputError("not a number", place=place, found=cell or "nothing", remedy="Every row needs every number.")
    return number


def _clock(place: Place, cell: str) -> float:
    """Seconds of a time of day."""
    span = SPAN.fullmatch(cell)
    if span is not None:
        return float(span[1]) * TIME[plain_unit(span[2])]
    match = CLOCK.fullmatch(cell)
    if match is None:
        raise InputError("not a time of day", place=place, found=cell or "nothing", remedy="Every row needs its time.")
    whole, _, part = match[3].replace(",", ".").replace(":", ".").partition(".")
    hours = int(match[1] or 0) % (12 if match[4] else 24) + (12 if (match[4] or "").lower() == "pm" else 0)
    return 3600 * hours + 60 * int(match[2]) + float(f"{whole}.{part or 0}")
