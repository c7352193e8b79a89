"""The one screen of `abu compare`: levels and settling first, then what differs, and counts of what is left out."""

from collections.abc import Iterable, Sequence
from typing import Final

from abu_calc.features.compare.study import CompareResult, checks_named, main_blocks
from abu_calc.features.compare.view import (
    NOTHING,
    ComparisonTable,
    about,
    graded_line,
    left_out,
    table_blocks,
    written_alike,
)
from abu_calc.foundation.checks import RANK
from abu_calc.foundation.units import quantity_and_unit, unit_of
from abu_calc.reporting.blocks import Block, Heading, Paragraph
from abu_calc.reporting.parts import told, unlike, warning_blocks, without_entries
from abu_calc.reporting.screen import BLANK, LINES, cut, fitted, height, many, taken_by

LABELS: Final = {
    "autobalancer.ball_count": "Number of balls",
    "autobalancer.ball_diameter_mm": "Ball diameter, mm",
    "autobalancer.race_radius_mm": "Race radius, mm",
    "autobalancer.groove_radius_mm": "Groove radius, mm",
    "autobalancer.outer_diameter_mm": "Outer diameter, mm",
    "autobalancer.width_mm": "Width, mm",
    "autobalancer.mass_g": "Mass with balls, g",
    "autobalancer.capacity_g_mm": "Capacity, g·mm",
    "required_capacity_g_mm": "Required capacity without margin, g·mm",
    "imbalance_g_mm": "Imbalance, g·mm",
    "accuracy_budget.residual_um": "Expected residual displacement, 0–peak, µm",
    "autobalancer.contact_pressure_MPa": "Hertz pressure, MPa",
    "frequency.region": "Region of the speed",
    "system_mass_kg": "Mass with wheel and autobalancer, kg",
    "swing_arm.contact_stiffness_limit_exact_N_per_m": "Arm stands: contact stiffness at most, N/m",
    "swing_arm.damping_limit_bunched_N_s_per_m": "Pivot damping at least, balls together, N·s/m",
}
"""Numbers of the designs on one screen, in this order, beside those of the first tables."""
OF_SEATS: Final = {
    "fit": "tolerance class",
    "interference_um.0": "least interference, µm",
    "interference_um.1": "largest interference, µm",
    "recommended_fit": "recommended tolerance class",
}
"""Numbers of a bearing seat."""
DIGITS: Final = 3
"""Significant digits of numbers on the screen; more where two that differ would look alike."""
WITH_LIMITS: Final = 3
"""Most machines whose limits stand beside their values."""
HEADINGS: Final = {
    "check": "Checks that differ: grade, value (limit)",
    "design": "Designs: what differs",
    "file": "Entries of the files that differ",
}


def compare_screen(result: CompareResult) -> tuple[Block, ...]:
    """Levels and settling, then checks, designs and entries that differ as far as there is room, then why.

    Every table counts the lines that it leaves out; the last lines count those that are equal.
    """
    first, verdict, *machines = about(result)
    main = main_blocks(result)
    top = [first, verdict, *cut(machines, LINES // 3), *(block for table in main for block in (BLANK, table))]
    last: list[Block] = [BLANK, Paragraph(f"{left_out(result)}{_why(result)}")]
    room = LINES - height([*top, *last])
    kept = 3 if unlike(result.checks) or result.warnings else 0
    tables: list[Block] = [BLANK, Paragraph(NOTHING)]
    if result.differences:
        tables = _shared_out(result, room - kept)
    below = room - height(tables) - 1
    rest = _reasons(result, below)
    over = height([*top, *tables, *rest, *last]) - LINES  # headings take more room below a table than alone
    if over > 0:
        rest = _reasons(result, below - over)
    return (*top, *tables, *rest, *last)


def _reasons(result: CompareResult, room: int) -> list[Block]:
    """Checks that did not simply pass, with their actions, and warnings, as far as there is room."""
    groups = unlike(result.checks)
    lines, notes = told(groups), warning_blocks(result.warnings)
    room_for_lines = room - 2 - (2 if notes else 0)
    if taken_by(lines) > room_for_lines:  # entries to paste are left to the whole report
        codes = [[check.code for check in alike] for alike in groups]
        lines = fitted(without_entries(groups), codes, room_for_lines)
    counts = list[str]()
    if lines and lines[0].mark is None:  # there is room for none
        named = ", ".join(dict.fromkeys(check.code for alike in groups for check in alike))
        counts, lines = [f"Actions ({named})"], []
    below: list[Block] = [Heading("Actions"), *lines] if lines else []
    if taken_by(notes) > room - height(below) - 2:
        counts.append(many(len(result.warnings), "note"))
        notes = []
    return [*below, *notes, *([BLANK, Paragraph(f"{' and '.join(counts)}: --full.")] if counts else [])]


def _why(result: CompareResult) -> str:
    code = next((check.code for check in result.checks if check.status != "pass"), None)
    return f" `abu explain {code}` explains that check." if code else ""


def _shared_out(result: CompareResult, room: int) -> list[Block]:
    """The tables of what differs; those that need less than their share of the lines leave it to the others."""
    tables = [table for table in (_checks(result), _designs(result), _entries(result)) if table[0].lines or table[1]]
    letters, cut_to = [file.letter for file in result.files], dict[int, list[Block]]()
    least = [height(_blocks(letters, table)) for table, _ in tables]
    for done, k in enumerate(sorted(range(len(tables)), key=least.__getitem__)):
        share = (room - sum(1 + height(blocks) for blocks in cut_to.values())) // (len(tables) - done)
        cut_to[k] = _rows_that_fit(letters, *tables[k], share - 1)
    return [block for k in range(len(tables)) for block in cut_to[k]]


def _checks(result: CompareResult) -> tuple[ComparisonTable, int]:
    """Checks whose grade differs, then those of another value, the worst first."""
    names = dict.fromkeys(row.path.rpartition(".")[0].removeprefix("checks.").strip('"')
                          for row in result.differences if row.part == "check")  # fmt: skip

    def rank(name: str) -> tuple[bool, int]:
        """Checks whose grades differ first, then the worst grade first."""
        grades = [check and check.status for check in checks_named(result, name)]
        return len(set(grades)) == 1, min((RANK.index(grade) for grade in grades if grade), default=len(RANK))

    limits = len(result.files) <= WITH_LIMITS
    lines = (graded_line(result, name, DIGITS, limits=limits) for name in sorted(names, key=rank))
    return ComparisonTable("check", tuple(lines)), 0


def _designs(result: CompareResult) -> tuple[ComparisonTable, int]:
    """The numbers of the designs that matter, and how many others differ."""
    rows = {row.path: row for row in result.differences if row.part == "design"}
    labels = {path: LABELS[path] for path in LABELS if path in rows}
    labels |= {path: label for path in rows if (label := _of_seat(result, path))}
    lines = tuple((label, *written_alike(rows[path].values, DIGITS)) for path, label in labels.items())
    return ComparisonTable("design", lines), len(rows) - len(lines)


def _of_seat(result: CompareResult, path: str) -> str:
    """Label of a number of a bearing seat; empty for any other."""
    part, _, rest = path.partition(".")
    index, _, key = rest.partition(".")
    if part == "fits" and index == "fits":  # of bearing seats alone
        index, _, key = key.partition(".")
    if part != "fits" or key not in OF_SEATS:
        return ""
    known = {row.path: row.values for row in (*result.differences, *result.alike) if row.part == "design"}
    stem = path.removesuffix(key)
    seat, name = (next((str(v) for v in known.get(f"{stem}{field}", ()) if v), "") for field in ("seat", "name"))
    place = {"shaft": "on the shaft", "housing": "in the housing"}.get(seat, seat)
    return f"Seat {place}, {name}: {OF_SEATS[key]}"


def _entries(result: CompareResult) -> tuple[ComparisonTable, int]:
    """Entries of the files that differ; the name stands above."""
    rows = [row for row in result.differences if row.part == "file" and row.path != "machine.name"]
    return ComparisonTable("file", tuple((words_of(row.path), *written_alike(row.values)) for row in rows)), 0


def words_of(path: str) -> str:
    """A key of a file as words, with its unit.

    >>> words_of("wheel.runout_mm"), words_of("bearing[0].shaft_fit")
    ('Wheel: runout, mm', 'Bearing 1: shaft fit')
    """
    table, _, key = path.rpartition(".")
    place = ", ".join(_numbered(part) for part in table.split(".")) if table else ""
    words, unit = quantity_and_unit(key)[0].replace("_", " "), unit_of(key)
    text = f"{place}: {words}" if place else words
    return (text[:1].upper() + text[1:]) + (f", {unit}" if unit else "")


def _numbered(part: str) -> str:
    """A table as words; of a list of tables the number, counted from one."""
    name, _, index = part.rstrip("]").partition("[")
    return name.replace("_", " ") + (f" {int(index) + 1}" if index.isdigit() else "")


def _blocks(letters: Sequence[str], table: ComparisonTable, count: int | None = None) -> list[Block]:
    """Blocks of a table below the heading of the screen."""
    return [Heading(HEADINGS[table.part]), *table_blocks(letters, table, count)[1:]]


def _rows_that_fit(letters: Sequence[str], table: ComparisonTable, further: int, room: int) -> list[Block]:
    """The first rows of a table, and how many there are beside them, `further` among them."""
    total = len(table.lines)
    for count in range(total, 0, -1):
        fitting = [*_blocks(letters, table, count), *_counted(further + total - count)]
        if height(fitting) <= room:
            return fitting
    return [Heading(HEADINGS[table.part]), *_counted(further + total, "")]


def _counted(further: int, more: str = " more that") -> Iterable[Block]:
    text = many(further, f"{more} differs".strip(), f"{more} differ".strip())
    return [Paragraph(f"{'And ' if more else ''}{text}: --full.")] if further else []
