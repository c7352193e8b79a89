"""Steps, formulas and checks explained, and with a result the numbers put in.

What a formula says of itself (equation, units, range, source, where the print differs) is registered where it stands.
"""

from typing import TYPE_CHECKING

from abu_calc.check_codes import CheckCode
from abu_calc.formula import Formula, formula_of
from abu_calc.report.blocks import Block, Heading, Paragraph
from abu_calc.report.steps import STEPS, Step

if TYPE_CHECKING:
    from abu_calc.studies.size import SizeResult


def explanation_blocks(result: "SizeResult") -> tuple[Block, ...]:
    """Every step that the result has, formulas and numbers."""
    blocks: list[Block] = [Heading("FORMULAS, WITH THE NUMBERS OF THIS MACHINE")]
    for step in STEPS.values():
        numbers = step.numbers(result)
        if numbers is not None:
            blocks += step_blocks(step, numbers)
    return tuple(blocks)


def step_blocks(step: Step, numbers: tuple[str, ...] = ()) -> list[Block]:
    """One step: numbers first, then each formula as it speaks of itself."""
    return [Heading(step.title), *(Paragraph(f"→ {line}") for line in numbers), *formula_blocks(step.formulas)]


def formula_blocks(formulas: tuple[Formula, ...]) -> list[Block]:
    """Each formula under its name."""
    blocks: list[Block] = []
    for formula in formulas:
        blocks += [Heading(f"  {formula.name}"), *(Paragraph(part, indent=4) for part in formula.for_users)]
    return blocks


def code_blocks(code: CheckCode) -> list[Block]:
    """One check code: what is asked, what fails it, what to do, and the formulas that decide it."""
    see = [Paragraph(f"Step: abu explain {code.step}")] if code.step else []
    return [
        Heading(f"{code.code} {code.name}"),
        Paragraph(f"Asks: {code.asks}"),
        Paragraph(f"Fails: {code.fails}"),
        Paragraph(f"To do: {code.remedy}"),
        *see,
        *formula_blocks(tuple(map(formula_of, code.formulas))),
    ]
