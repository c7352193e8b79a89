"""The report of `abu compare`: one screen of what differs, and the whole of what is compared."""

from collections.abc import Iterable, Sequence
from typing import Final

from abu_calc.report.blocks import Block, Heading, Paragraph
from abu_calc.report.compare_tables import SECTIONS, Table, table_blocks, tables_of
from abu_calc.report.parts import WORD, check_blocks, provenance_blocks, reasons, warning_blocks
from abu_calc.report.screen import BLANK, LINES, cut, many, verdict_line
from abu_calc.report.text import height
from abu_calc.spec.text import shown as exact
from abu_calc.studies.compare import ComparedFile, CompareResult
from abu_calc.studies.side_by_side import Difference

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
        tables.append(Table(SECTIONS["design"], ()))
    letters, cut_to = [file.letter for file in result.files], dict[int, list[Block]]()
    further = [len(designs) - len(first) if table.heading == SECTIONS["design"] else 0 for table in tables]
    least = [height(table_blocks(letters, table)) for table in tables]
    for done, k in enumerate(sorted(range(len(tables)), key=least.__getitem__)):
        share = (room - sum(1 + height(blocks) for blocks in cut_to.values())) // (len(tables) - done)
        cut_to[k] = _rows_that_fit(letters, tables[k], share - 1, further[k])
    return [block for k in range(len(tables)) for block in cut_to[k]]


def _rows_that_fit(letters: Sequence[str], table: Table, room: int, further: int) -> list[Block]:
    """The first rows of a table, and how many there are beside them, `further` among them."""
    total = len(table.lines)
    for count in range(total, 0, -1):
        fitting = [*table_blocks(letters, table, count), *_counted(further + total - count)]
        if height(fitting) <= room:
            return fitting
    return [Heading(table.heading), *_counted(further + total)]


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
    return [Heading(result.title), verdict_line(result), *(_machine(file) for file in result.files)]


def _machine(file: ComparedFile) -> Paragraph:
    replaced = [f"{key} = {exact(value)}" for key, value in file.overrides.items()]
    text = f"{file.letter}  {WORD[file.status]}  {file.title}, {file.file}"
    return Paragraph(f"{text}, with {', '.join(replaced)}" if replaced else text, file.status, hang=3)


def _first(rows: Iterable[Difference]) -> list[Difference]:
    """The rows of designs that matter most, in the order of FIRST, then those of seats."""
    designs = {row.path: row for row in rows if row.part == "design"}
    seats = [row for path, row in designs.items() if path.startswith("fits.") and path.split(".")[2] in OF_SEATS]
    return [designs[path] for path in FIRST if path in designs] + seats
