"""The report of `abu verify`: each file in a line, what differs in a table."""

from typing import Any

from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.numbers import number
from abu_calc.report.parts import warning_blocks
from abu_calc.studies.expected import ComparedValue
from abu_calc.studies.verify import VerifyResult


def verify_blocks(result: VerifyResult) -> tuple[Block, ...]:
    """The whole report."""
    blocks: list[Block] = []
    for file, check in zip(result.files, result.checks, strict=True):
        blocks.append(Paragraph(f"{file.file}: {check.message}", check.status))
        if file.failed:
            rows = tuple(map(_row, file.failed))
            blocks += [Heading(file.file), Grid(("path", "expected", "found", "deviation", "allowed"), rows)]
    return (*blocks, *warning_blocks(result.warnings))


def _row(one: ComparedValue) -> tuple[str, ...]:
    deviation = "" if one.deviation is None else f"{one.deviation:.2e}"
    return one.path, _value(one.expected), _value(one.found), deviation, f"{one.tolerance:.0e}"


def _value(value: Any) -> str:
    if isinstance(value, float):
        return number(value, 6)
    return "nothing" if value is None else str(value)
