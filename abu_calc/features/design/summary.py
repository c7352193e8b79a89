"""Summary of a sized machine for the first two sheets of its page: the numbers of the first screen, actions, notes."""

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import Final, NamedTuple

from abu_calc.features.design.screen import verdict_paragraph
from abu_calc.features.design.study import SizeResult
from abu_calc.features.design.tables import (
    action_groups,
    arm_change,
    gap_table,
    make,
    marked,
    numbers_that_matter,
    other_notes,
    point_mass,
    starts_and_defaults,
    title_with_speed,
    unusual_values,
)
from abu_calc.features.swing_arm.view import arm_bounds
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph
from abu_calc.reporting.parts import unlike
from abu_calc.reporting.screen import many

ENTRIES: Final = Paragraph(
    "The lines below an action are entries of the machine file, each behind the table in which it stands."
)


SHEETS_MM: Final = 2 * 269.0
"""Height of two A4 sheets between their margins."""
SPARE_MM: Final = 60.0
"""Height that may stay empty above a table that begins on the second sheet."""
TITLE_MM: Final = 25.0
HEADING_MM: Final = 12.0
ROW_MM: Final = 6.3
LINE_MM: Final = 4.9
"""Heights of the title with the verdict, of a heading, of a row of a table and of a line of text."""
LETTERS: Final = 92
"""Letters of a line of text."""


class Summary(NamedTuple):
    """Blocks of the summary, and whether they hold every note."""

    blocks: tuple[Block, ...]
    whole: bool


def size_summary(result: SizeResult, drawing_mm: float) -> Summary:
    """Title, verdict, what to make, levels and settling times with limits, actions, notes.

    `drawing_mm`: height of the section drawing. What has no room on two sheets is named and stands in the details.
    """
    tables = numbers_that_matter(result)
    changed = any(check.overrides for check in result.checks if check.status != "pass")
    body: list[Block] = [
        *unusual_values(result, most=None),
        *arm_change(result),
        *make(result),
        *tables,
        *([arm_bounds(result.swing_arm)] if result.swing_arm else []),
        Paragraph(starts_and_defaults(result)),
    ]
    notes = [*point_mass(result), *other_notes(result)]
    room = SHEETS_MM - SPARE_MM - TITLE_MM - drawing_mm - sum(map(height_mm, body))
    codes = [alike[0].code for alike in unlike(result.checks)]
    shown = first_that_fit(action_groups(result.checks, marked(tables)), room - HEADING_MM - 2 * LINE_MM)
    more = [Paragraph(f"More actions, see Checks: {', '.join(codes[len(shown) :])}.")] if codes[len(shown) :] else []
    actions = [*([ENTRIES] if changed else []), *(line for group in shown for line in group), *more]
    if codes:
        body += [Heading("Actions"), *actions]
    room -= HEADING_MM + sum(map(height_mm, actions)) if codes else 0.0
    gaps = gap_table(result.data_gaps)
    body += gaps
    room -= sum(map(height_mm, gaps))
    fitting = first_that_fit([[note] for note in notes], room - HEADING_MM - LINE_MM)
    left = len(notes) - len(fitting)
    further = [Paragraph(f"See Warnings for {many(left, 'more note')}.")] if left else []
    if notes:
        body += [Heading("Notes"), *(note for group in fitting for note in group), *further]
    return Summary(
        (Heading(title_with_speed(result)), verdict_paragraph(result.verdict, result.checks), *body), not left
    )


def first_that_fit(groups: Sequence[Sequence[Paragraph]], room_mm: float) -> list[Sequence[Paragraph]]:
    """The first groups of lines that fit into a height."""
    heights = accumulate(sum(map(height_mm, group)) for group in groups)
    return [group for group, height in zip(groups, heights, strict=True) if height <= room_mm]


def height_mm(block: Block) -> float:
    """Approximate height of a block on paper."""
    match block:
        case Paragraph(text) if text:
            entries = text.count("--set ")
            return LINE_MM * (entries or math.ceil(len(text) / LETTERS)) + (0.0 if entries else 1.0)
        case Grid(_, rows):
            return ROW_MM * (1 + len(rows)) + 2.0
        case Heading():
            return HEADING_MM
    return 0.0
