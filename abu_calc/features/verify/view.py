"""The report of `abu verify`: a line for each file, and a table of differences."""

from typing import Any, Final

from abu_calc.features.verify.study import ComparedValue, VerifyResult
from abu_calc.reporting.blocks import Block, Grid, Paragraph, number
from abu_calc.reporting.parts import WORD, warning_blocks
from abu_calc.reporting.screen import LINES, cut, many
from abu_calc.reporting.text import height

MOST_NAMES: Final = 30
"""Files as expected that a screen names."""
LEAST: Final = 1e-6
"""Least relative deviation that is shown with digits."""


def verify_blocks(result: VerifyResult) -> tuple[Block, ...]:
    """The whole report."""
    return (*_blocks(result, {file.file for file in result.files}), *warning_blocks(result.warnings))


def verify_screen(result: VerifyResult) -> tuple[Block, ...]:
    """One screen: differences as far as there is room; files that are as expected take one line."""
    differ = [file.file for file in result.files if file.failed]
    same = [file.file for file in result.files if not file.failed]
    title = f"{len(same)} of {many(len(result.files), 'file')} as expected"
    verdict = Paragraph(f"{'FAIL' if differ else 'PASS'}: {title}", result.status)
    names = [Paragraph(f"As expected: {', '.join(same[:MOST_NAMES])}{', …' if len(same) > MOST_NAMES else ''}.")]
    last: list[Block] = (
        [Paragraph("More: --full, every file. --update writes the computed values into [expected].")] if differ else []
    )
    head: list[Block] = [verdict, *(names if same else [])]
    last = [*warning_blocks(result.warnings), *last]
    return (*head, *cut(_blocks(result, set(differ)), LINES - height([*head, *last])), *last)


def _blocks(result: VerifyResult, shown: set[str]) -> list[Block]:
    """A line and a table a file."""
    blocks: list[Block] = []
    for file, check in zip(result.files, result.checks, strict=True):
        if file.file in shown:
            blocks.append(Paragraph(f"{WORD[check.status]} {file.file}: {check.message}", check.status))
        if file.failed:
            rows = tuple(map(_row, file.failed))
            blocks.append(Grid(("path", "expected", "computed", "deviation", "allowed"), rows))
    return blocks


def _row(entry: ComparedValue) -> tuple[str, ...]:
    deviation = "" if entry.deviation is None else _percent(entry.deviation)
    return entry.path, _value(entry.expected), _value(entry.found), deviation, _percent(entry.tolerance)


def _percent(ratio: float) -> str:
    """A relative deviation; one that shows only rounding has the bound alone."""
    return f"{number(100 * ratio, 3)} %" if ratio == 0 or ratio >= LEAST else f"< {100 * LEAST:g} %"


def _value(value: Any) -> str:
    if isinstance(value, float):
        return number(value, 6)
    return "none" if value is None else str(value)
