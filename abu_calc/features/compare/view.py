"""The report of `abu compare`: differences on one screen, the whole comparison as tables, and its figures.

A table has one column for each machine and one row for each entry. The figures show the main numbers of each machine as
bars.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Final, NamedTuple

from abu_calc.features.compare.study import ROUNDING, ComparedFile, CompareResult, Difference, Part
from abu_calc.foundation.checks import Grade
from abu_calc.inputs.reading.text import is_number
from abu_calc.inputs.reading.text import shown as exact
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars
from abu_calc.reporting.charts.figure import Extras, Figure
from abu_calc.reporting.parts import RANK, WORD, check_blocks, provenance_blocks, reasons, warning_blocks
from abu_calc.reporting.screen import BLANK, LINES, cut, many, verdict_line
from abu_calc.reporting.text import height

SECTIONS: Final[dict[Part, str]] = {
    "file": "Files",
    "check": "Checks: grade, value (limit where it differs)",
    "design": "Designs",
}
LONGEST_CELL: Final = 20
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
    return f"{_mark(row.alike, marked)}{row.path}", *_written(row.values)


def _checks(result: CompareResult, rows: Sequence[Difference], marked: bool) -> list[tuple[str, ...]]:
    """One line for each check of these rows, the worst first: grade and value of each machine."""
    known = {row.path: row for row in (*result.differences, *result.alike) if row.part == "check"}
    names = {check.code: check.name for check in reversed(result.checks)}
    lines = []
    for head in dict.fromkeys(row.path.rpartition(".")[0] for row in rows):
        status, value, limit = (known[f"{head}.{key}"] for key in ("status", "value", "limit"))
        name = head.removeprefix("checks.").strip('"')
        label = name if " " in name else f"{name} {names[name].rpartition(', ')[0]}"
        limits = [""] * len(limit.values) if limit.alike else [f" ({text})" for text in _written(limit.values)]
        cells = (
            "–" if grade is None else f"{WORD[grade]} {value_text}{bound}".replace(" –", "").rstrip()
            for grade, value_text, bound in zip(status.values, _written(value.values), limits, strict=True)
        )  # fmt: skip
        same = status.alike and value.alike and limit.alike
        line = f"{_mark(same, marked)}{label}{f', {value.unit}' if value.unit else ''}", *cells
        lines.append((min(map(_rank, status.values)), line))
    return [line for _, line in sorted(lines, key=lambda pair: pair[0])]


def _rank(grade: Grade | None) -> int:
    return RANK.index(grade) if grade in RANK else len(RANK)


def _written(values: Sequence[Any]) -> list[str]:
    """Values as text; numbers to as many digits as tell apart those that differ."""
    apart = len({value for value in values if is_number(value)})
    for digits in range(DIGITS, MOST_DIGITS + 1):
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


FIRST: Final = (
    "system_mass_kg", "frequency.region", "imbalance_g_mm", "required_capacity_g_mm",
    *(f"autobalancer.{key}" for key in (
        "ball_count", "ball_diameter_mm", "race_radius_mm", "groove_radius_mm", "capacity_g_mm", "outer_diameter_mm",
        "width_mm", "mass_g", "contact_pressure_MPa",
    )),
    "accuracy_budget.residual_um", "vibration.level_before_db", "vibration.level_after_db",
    "vibration_loaded.level_after_db", "ensemble.level_db.worst", "ensemble.settling_time_s.typical",
    "ensemble.settling_time_s.worst", "swing_arm.contact_stiffness_limit_exact_N_per_m",
    "swing_arm.damping_limit_bunched_N_s_per_m",
)  # fmt: skip
"""Numbers of the designs on one screen, in this order; seats show their fits."""
OF_SEATS: Final = ("fit", "interference_um", "recommended_fit")
NOTHING: Final = "Nothing differs."


def compare_screen(result: CompareResult) -> tuple[Block, ...]:
    """The one screen: what differs in files, checks and designs, each as far as there is room, then why, and warnings.

    Of the designs it has the numbers that matter.
    """
    title, verdict, *machines = _about(result)
    about = [title, verdict, *cut(machines, LINES // 2)]
    last: list[Block] = [BLANK, Paragraph(f"More: --full, every entry, alike ones too.{_why(result)}")]
    room = LINES - height([*about, *last])
    others = height([BLANK]) + 2 if _unsettled(result) or result.warnings else 0
    tables: list[Block] = [BLANK, Paragraph(NOTHING)]
    if result.differences:
        tables = _shared_out(result, room - others)
    below: list[Block] = [Heading("What did not pass"), *reasons(result.checks)] if _unsettled(result) else []
    rest = cut([*below, *warning_blocks(result.warnings)], room - height([*tables, BLANK]) - 1)
    return (*about, *tables, *rest, *last)


def _unsettled(result: CompareResult) -> list[str]:
    return [check.code for check in result.checks if check.status != "pass"]


def _why(result: CompareResult) -> str:
    codes = _unsettled(result)
    return f" `abu explain {codes[0]}`, what a check asks." if codes else ""


def _shared_out(result: CompareResult, room: int) -> list[Block]:
    """The tables of what differs; those that need less than their share of the lines leave it to the others."""
    rows = [row for row in result.differences if row.path != "machine.name"]  # it stands above
    designs = [row for row in rows if row.part == "design"]
    first = _first(designs)
    tables = tables_of(result, [*(row for row in rows if row.part != "design"), *first])
    if designs and not first:
        tables.append(ComparisonTable("design", ()))
    letters, cut_to = [file.letter for file in result.files], dict[int, list[Block]]()
    further = [len(designs) - len(first) if table.part == "design" else 0 for table in tables]
    least = [height(table_blocks(letters, table)) for table in tables]
    for done, k in enumerate(sorted(range(len(tables)), key=least.__getitem__)):
        share = (room - sum(1 + height(blocks) for blocks in cut_to.values())) // (len(tables) - done)
        cut_to[k] = _rows_that_fit(letters, tables[k], share - 1, further[k])
    return [block for k in range(len(tables)) for block in cut_to[k]]


def _rows_that_fit(letters: Sequence[str], table: ComparisonTable, room: int, further: int) -> list[Block]:
    """The first rows of a table, and how many there are beside them, `further` among them."""
    total = len(table.lines)
    for count in range(total, 0, -1):
        fitting = [*table_blocks(letters, table, count), *_counted(further + total - count)]
        if height(fitting) <= room:
            return fitting
    return [table.heading, *_counted(further + total)]


def _counted(further: int) -> list[Block]:
    return [Paragraph(f"And {many(further, 'more that differs', 'more that differ')}: --full.")] if further else []


def compare_blocks(result: CompareResult, *, full: bool = True) -> tuple[Block, ...]:
    """The whole report: every entry, those marked ≠ that differ; not `full`: those alone that differ."""
    rows, letters = (*result.differences, *(result.alike if full else ())), [file.letter for file in result.files]
    tables = tables_of(result, rows, marked=full)
    less = [] if full else [Paragraph("Differences only; with --full every entry stands here." if rows else NOTHING)]
    return (
        *_about(result),
        *less,
        *(block for table in tables for block in table_blocks(letters, table)),
        *check_blocks(result.checks),
        *warning_blocks(result.warnings),
        *provenance_blocks(result.provenance),
        *(Paragraph(f"{file.letter}: {file.file}, SHA-256 {file.sha256[:16]}…") for file in result.files),
    )


def _about(result: CompareResult) -> list[Block]:
    """Title, verdict, and which machine each letter is."""
    return [Heading(result.title, "title"), verdict_line(result), *(_machine(file) for file in result.files)]


def _machine(file: ComparedFile) -> Paragraph:
    replaced = [f"{key} = {exact(value)}" for key, value in file.overrides.items()]
    text = f"{file.letter}  {WORD[file.status]}  {file.title}, {file.file}"
    return Paragraph(f"{text}, with {', '.join(replaced)}" if replaced else text, file.status, hang=3)


def _first(rows: Iterable[Difference]) -> list[Difference]:
    """The rows of designs that matter most, in the order of FIRST, then those of seats."""
    designs = {row.path: row for row in rows if row.part == "design"}
    seats = [row for path, row in designs.items() if path.startswith("fits.") and path.split(".")[2] in OF_SEATS]
    return [designs[path] for path in FIRST if path in designs] + seats


SERIES: Final = {"before": 2, "worst": 3, "measured": 3}


class _Compared(NamedTuple):
    """A figure: paths of designs with what they are called, and a check whose limit is drawn."""

    name: str
    title: str
    axis: str
    paths: dict[str, str]
    caption: str
    code: str = ""


FIGURES: Final = (
    _Compared(
        "levels", "Levels of the machines", "velocity level, idle [dB]",
        {"vibration.level_before_db": "before", "vibration.level_after_db": "after",
         "measured_after.measured_level_db": "measured"},
        "Velocity level without (square) and with (round) the autobalancer, lozenge: measured; 0 dB = 5e-8 m/s rms.",
        "ABU401",
    ),
    _Compared(
        "residual", "Residuals of the machines", "residual, 0–peak [µm]", {"accuracy_budget.residual_um": ""},
        "What the balls leave at the wheel, expected: shorter is better.",
    ),
    _Compared(
        "mass", "Masses of the autobalancers", "mass with balls [g]", {"autobalancer.mass_g": ""},
        "What each autobalancer adds to its machine.",
    ),
    _Compared(
        "settling", "Settling times of the machines", "settling time [s]",
        {"ensemble.settling_time_s.typical": "median", "ensemble.settling_time_s.worst": "worst"},
        "How long the balls take over many starts, median and worst; a machine without a bar does not always settle.",
        "ABU702",
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
    limit = _limit(result, quantity.code, unit)
    values = [*(bar.value for bar in bars), *([limit[0]] if limit else [])]
    axis = Axis.around(quantity.axis, values) if unit == "dB" else Axis(quantity.axis, 0.0, max(values) or 1.0)
    text = "; ".join(f"{bar.name} {bar.told}" for bar in bars) + (f"; {limit[1]}" if limit else "")
    yield Figure(quantity.name, "title", Bars(quantity.title, text, axis, bars, limit), quantity.caption)


def _told(value: Any, unit: str) -> str:
    return f"{value:.1f} dB" if unit == "dB" else f"{number(value, 3)} {unit}"


def _limit(result: CompareResult, code: str, unit: str) -> tuple[float, str] | None:
    """Limit of a check with its text; None unless all machines have the same limit."""
    limits: Sequence[float | None] = list({check.limit for check in result.checks if check.code == code})
    if len(limits) != 1 or limits[0] is None:
        return None
    return limits[0], f"limit {number(limits[0])} {unit}"
