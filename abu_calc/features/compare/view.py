"""The report of `abu compare`: the whole comparison as tables, and its figures.

A table has one column for each machine and one row for each entry. The figures show the main numbers of each machine as
bars.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, Final, NamedTuple

from abu_calc.features.compare.study import (
    ROUNDING,
    ComparedFile,
    CompareResult,
    Difference,
    Part,
    checks_named,
    main_blocks,
)
from abu_calc.features.design.study import SizeResult
from abu_calc.features.design.verdict import WORDS, in_capitals
from abu_calc.features.seats.study import CheckFitResult
from abu_calc.foundation.checks import RANK, Check, worst
from abu_calc.foundation.checks import WORDS as VERDICTS
from abu_calc.foundation.quantity import Record, hints, parts_of_type, quantities
from abu_calc.foundation.units import quantity_and_unit
from abu_calc.inputs.reading.text import is_number
from abu_calc.inputs.reading.text import shown as exact
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Extras, Figure
from abu_calc.reporting.parts import WORD, check_blocks, provenance_blocks, warning_blocks
from abu_calc.reporting.screen import many, verdict_line

SECTIONS: Final[dict[Part, str]] = {
    "check": "Checks: grade, value (limit)",
    "design": "Results of the designs",
    "file": "Entries of the files",
}
NOTHING: Final = "Nothing differs."
SIGN: Final = {"most": "≤", "least": "≥"}
"""Sign between a value and its limit."""
LONGEST_CELL: Final = 24
DIGITS: Final = 4
MOST_DIGITS: Final = 15


class ComparisonTable(NamedTuple):
    """A part of what is compared, and lines: what an entry is called, and the cell of each machine."""

    part: Part
    lines: tuple[tuple[str, ...], ...]

    @property
    def heading(self) -> Heading:
        """Heading of the table."""
        return Heading(SECTIONS[self.part])


def tables_of(result: CompareResult, rows: Sequence[Difference], *, marked: bool = False) -> list[ComparisonTable]:
    """Each part that has rows under its heading, the checks with value beside grade."""
    tables = []
    for part in SECTIONS:
        own = [row for row in rows if row.part == part]
        lines = _checks(result, own, marked) if part == "check" else [_cells(row, marked) for row in own]
        if lines:
            tables.append(ComparisonTable(part, tuple(lines)))
    return tables


def table_blocks(letters: Sequence[str], table: ComparisonTable, count: int | None = None) -> list[Block]:
    """Blocks of the first `count` lines of a table; None: all lines.

    Lines with long cells stand below the table, one machine after another.
    """
    lines = table.lines[:count]
    short = [line for line in lines if max(map(len, line[1:])) <= LONGEST_CELL]
    blocks: list[Block] = [table.heading, *_grid(letters, short)]
    for label, *cells in (line for line in lines if line not in short):
        blocks.append(Paragraph(label))
        blocks += [Paragraph(f"{k}  {cell}", indent=4, hang=3) for k, cell in zip(letters, cells, strict=True)]
    return blocks


def _grid(letters: Sequence[str], lines: Sequence[tuple[str, ...]]) -> list[Grid]:
    """A table; where the machines do not stand side by side each begins with the first of them."""
    return [Grid(("", *letters), tuple(lines), frozenset(range(1, len(letters) + 1)), kept=2)] if lines else []


def _mark(row_alike: bool, marked: bool) -> str:
    return "" if not marked else "  " if row_alike else "≠ "


def _cells(row: Difference, marked: bool) -> tuple[str, ...]:
    label = label_of(row.path, row.unit) if row.part == "design" else row.path
    return f"{_mark(row.alike, marked)}{label}", *written_alike(row.values)


def _checks(result: CompareResult, rows: Sequence[Difference], marked: bool) -> list[tuple[str, ...]]:
    """One line for each check of these rows, the worst first: grade, value and limit of each machine."""
    equal = {row.path for row in result.alike}
    lines = []
    for head in dict.fromkeys(row.path.rpartition(".")[0] for row in rows):
        name = head.removeprefix("checks.").strip('"')
        same = all(f"{head}.{key}" in equal for key in ("status", "value", "limit"))
        label, *cells = graded_line(result, name)
        ranks = [RANK.index(check.status) for check in checks_named(result, name) if check]
        lines.append((min(ranks, default=len(RANK)), (f"{_mark(same, marked)}{label}", *cells)))
    return [line for _, line in sorted(lines, key=lambda pair: pair[0])]


def graded_line(result: CompareResult, name: str, digits: int = DIGITS, *, limits: bool = True) -> tuple[str, ...]:
    """Code, name and unit of a check, then grade and value of each machine, and the limit if `limits`."""
    checks = checks_named(result, name)
    first = next(check for check in checks if check)
    label = f"{first.code} {first.name.rpartition(', ')[0]}"
    unit = next((check.unit for check in checks if check and check.unit), "")
    values = written_alike([check and check.value for check in checks], digits)
    cells = ("–" if check is None else f"{WORD[check.status]}{_value(value, check, digits, limits)}"
             for check, value in zip(checks, values, strict=True))  # fmt: skip
    return (f"{label}, {unit}" if unit else label), *cells


def _value(value: str, check: Check, least: int, limits: bool) -> str:
    """A value beside its limit, which has digits enough not to look like the value."""
    if check.value is None:
        return ""
    if check.limit is None or not limits:
        return f" {value}"
    texts = (_text(check.limit, digits) for digits in range(least, MOST_DIGITS + 1))
    limit = next((text for text in texts if text != value), value)
    return f" {value} ({SIGN[check.bound]} {limit})"


def written_alike(values: Sequence[Any], least: int = DIGITS) -> list[str]:
    """Values as text; numbers to as many digits as tell apart those that differ."""
    apart = len({value for value in values if is_number(value)})
    for digits in range(least, MOST_DIGITS + 1):
        texts = [_text(value, digits) for value in values]
        if len({text for text, value in zip(texts, values, strict=True) if is_number(value)}) >= apart:
            break
    return texts


def _text(value: Any, digits: int) -> str:
    if value is None:
        return "–"
    if isinstance(value, float):
        short = f"{value:g}"
        return (
            short if math.isclose(float(short), value, rel_tol=ROUNDING) and "e" not in short else number(value, digits)
        )
    return value if isinstance(value, str) else exact(value)


def compare_blocks(result: CompareResult, *, full: bool = True) -> tuple[Block, ...]:
    """The whole report: every entry, those marked ≠ that differ; not `full`: those alone that differ."""
    rows, letters = (*result.differences, *(result.alike if full else ())), [file.letter for file in result.files]
    tables = tables_of(result, rows, marked=full)
    less = [] if full else [Paragraph(left_out(result) if rows else NOTHING)]
    return (
        *about(result),
        *main_blocks(result),
        *less,
        *(block for table in tables for block in table_blocks(letters, table)),
        *check_blocks(result.checks),
        *warning_blocks(result.warnings),
        *provenance_blocks(result.provenance),
        *(Paragraph(f"{file.letter}: {file.file}, SHA-256 {file.sha256[:16]}…") for file in result.files),
    )


def left_out(result: CompareResult) -> str:
    """Numbers of the lines that are equal, by part, with the option that shows them."""
    equal = Counter(row.part for row in result.alike)
    checks = len({row.path.rpartition(".")[0] for row in result.alike if row.path.endswith(".status")}
                 - {row.path.rpartition(".")[0] for row in result.differences})  # fmt: skip
    counts = (
        (checks, "check", "checks"),
        (equal["design"], "result of the designs", "results of the designs"),
        (equal["file"], "entry of the files", "entries of the files"),
    )
    named = [many(count, name, plural) for count, name, plural in counts if count]
    return f"Left out because equal: {', '.join(named) or 'nothing'}. --full shows every line."


def about(result: CompareResult) -> list[Block]:
    """Title, verdict of all machines together, and the machine and verdict of each letter.

    Variants of one machine have its name once, above them.
    """
    first, *others = result.files
    of_one = all((file.title, file.file) == (first.title, first.file) for file in others)
    shared: list[Block] = [Paragraph(f"{first.title}, {first.file}")] if of_one else []
    words = next((row.values for row in (*result.differences, *result.alike) if row.path == "verdict.word"), ())
    own = [in_capitals(word or "") for word in words] or [""] * len(result.files)
    machines = (_machine(result, *each, named=not of_one) for each in zip(result.files, own, strict=True))
    whole = verdict_line(result)
    if all(own):  # the worst machine has the worst check
        word = in_capitals(WORDS[worst(result.checks)])
        whole = whole._replace(text=f"{word}{whole.text[whole.text.index(':') :]}")
    return [Heading(result.title, "title"), whole, *shared, *machines]


def _machine(result: CompareResult, file: ComparedFile, own: str, *, named: bool) -> Paragraph:
    """Letter, verdict and what differs of a machine; `own`: its verdict where it has more than seats."""
    replaced = ", ".join(f"{key} = {exact(value)}" for key, value in file.overrides.items())
    warned = any(check.status == "warn" and check.name.endswith(f", {file.letter}") for check in result.checks)
    warns = file.status == "pass" and warned
    word = own or ("PASS WITH WARNINGS" if warns else VERDICTS[file.status])
    text = f"{file.title}, {file.file}" + (f", with {replaced}" if replaced else "")
    return Paragraph(
        f"{file.letter}  {word}: {text if named else replaced or 'as the file stands'}",
        "warn" if warns else file.status, hang=3,
    )  # fmt: skip


SERIES: Final = {"without": 2, "slowest": 3, "measured": 3}


class _Compared(NamedTuple):
    """A figure: paths of designs with what they are called, and the key of a check whose limit is drawn."""

    name: str
    title: str
    axis: str
    paths: dict[str, str]
    caption: str
    key: str = ""


FIGURES: Final = (
    _Compared(
        "levels", "Levels of the machines", "velocity level, idle [dB]",
        {"vibration.level_before_db": "without", "vibration.level_after_db": "expected",
         "measured_after.measured_level_db": "measured"},
        "Idle velocity level without (square) and expected with (round) the autobalancer; lozenge: measured with it. "
        "0 dB = 5e-8 m/s rms.",
        "idle_level",
    ),
    _Compared(
        "residual", "Residuals of the machines", "residual, 0–peak [µm]", {"accuracy_budget.residual_um": ""},
        "Expected displacement at the wheel that remains when the balls have settled: shorter is better.",
    ),
    _Compared(
        "mass", "Masses of the autobalancers", "mass with balls [g]", {"autobalancer.mass_g": ""},
        "Mass of each autobalancer with its balls.",
    ),
    _Compared(
        "quiet", "Quiet times of the machines", "quiet time [s]",
        {"ensemble.quiet_time_s.typical": "median", "ensemble.quiet_time_s.worst": "slowest"},
        "Quiet time of the start cases: median and slowest, at any drag rate. A machine without a bar has a start case "
        "that is never quiet.",
        "quiet_time",
    ),
)  # fmt: skip


def compare_extras(result: CompareResult) -> Extras:
    """Figures of what more than one machine has."""
    rows = {row.path: row for row in (*result.differences, *result.alike) if row.part == "design"}
    return Extras(tuple(figure for quantity in FIGURES for figure in _figure(result, quantity, rows)))


def _figure(result: CompareResult, quantity: _Compared, rows: dict[str, Difference]) -> Iterator[Figure]:
    unit = quantity.axis.partition("[")[2].rstrip("]")
    words = list(quantity.paths.values())
    bars = [
        Bar(f"{file.letter}  {file.title}{f', {words[k]}' if words[k] else ''}", value, _told(value, unit),
            SERIES.get(words[k], 1))
        for index, file in enumerate(result.files)
        for k, path in enumerate(quantity.paths)
        if path in rows and is_number(value := rows[path].values[index])
    ]  # fmt: skip
    if len({bar.name[0] for bar in bars}) < 2:  # of one machine alone there is nothing to compare
        return
    limit = _limit(result, quantity.key, unit) if quantity.key else None
    values = [*(bar.value for bar in bars), *([limit[0]] if limit else [])]
    axis = Axis.around(quantity.axis, values) if unit == "dB" else Axis(quantity.axis, 0.0, max(values) or 1.0)
    text = "; ".join(f"{bar.name} {bar.text}" for bar in bars) + (f"; {limit[1]}" if limit else "")
    yield Figure(quantity.name, "title", Bars(quantity.title, text, axis, bars, limit), quantity.caption)


def _told(value: Any, unit: str) -> str:
    return f"{value:.1f} dB" if unit == "dB" else f"{number(value, 3)} {unit}"


def _limit(result: CompareResult, key: str, unit: str) -> tuple[float, str] | None:
    """Limit of a check with its text; None unless all machines have the same limit."""
    limits: Sequence[float | None] = list({check.limit for check in result.checks if check.key == key})
    if len(limits) != 1 or limits[0] is None:
        return None
    return limits[0], f"limit {number(limits[0])} {unit}"


def label_of(path: str, unit: str = "") -> str:
    """Label of a design's result: the parts that hold it, its own label, its unit; items of lists count from 1.

    >>> label_of("autobalancer.ball_diameter_mm", "mm")
    'autobalancer: ball diameter, mm'
    >>> label_of("frequency.natural_frequencies_hz.0", "Hz")
    'frequency: natural frequencies x, y 1, Hz'
    """
    names = path.split(".")
    record: type[Record] | None = SizeResult
    if names[0] == "fits" and len(names) > 1 and not names[1].isdigit():  # bearing seats alone
        record, names = CheckFitResult, names[1:]
    words = list[str]()
    for name in names:
        if name.isdigit():
            words[-1:] = [f"{' '.join(words[-1:])} {int(name) + 1}".strip()]
            continue
        known = None if record is None else quantities(record).get(name)
        words.append(_plain(name) if known is None else known.label)
        record = None if record is None else _record_in(hints(record).get(name))
    label = ", ".join(words[:-1]) + (": " if words[:-1] else "") + words[-1]
    return f"{label}, {unit}" if unit else label


def _plain(name: str) -> str:
    """Words of a key, without its unit."""
    words = quantity_and_unit(name)[0].replace("_", " ").replace("felt mass", "effective mass")
    return words.replace("accuracy budget", "residual-displacement budget")


def _record_in(hint: Any) -> type[Record] | None:
    """The record that a type holds, if any."""
    return next((part for part in parts_of_type(hint) if isinstance(part, type) and issubclass(part, Record)), None)
