"""`abu explain [STEP|CODE]`: the formulas of a step, or what a check code means, without a machine."""

from typing import Annotated

import typer

from abu_calc.cli.command import add_command
from abu_calc.errors import InputError
from abu_calc.report.blocks import Grid, Heading, Paragraph
from abu_calc.report.outcome import Outcome

What = Annotated[str | None, typer.Argument(metavar="[STEP|CODE]", help="A step of sizing, or the code of a check.")]


def explain(step: What = None) -> Outcome:
    """Show equation, units, range and source of every formula of a step, or what a check asks; without one, list."""
    from abu_calc.check_codes import CHECK_CODES
    from abu_calc.report.steps import STEPS
    from abu_calc.spec.names import nearest

    if step is None:
        return _listed()
    if step in STEPS:
        return _step(step)
    if step.upper() in CHECK_CODES:
        return _code(step.upper())
    near = nearest(step, (*STEPS, *CHECK_CODES))
    allowed = ", ".join(STEPS) + ", or the code of a check, such as ABU201"
    raise InputError(
        "no such step or check", found=step, allowed=allowed, remedy=f'Did you mean "{near}"?' if near else None
    )


def _listed() -> Outcome:
    from abu_calc.check_codes import CHECK_CODES
    from abu_calc.report.steps import STEPS

    steps = tuple((name, each.title, ", ".join(one.name for one in each.formulas)) for name, each in STEPS.items())
    blocks = (
        Heading("Steps of `abu size`"),
        Grid(("step", "what", "formulas"), steps),
        Heading("Checks"),
        Grid(("code", "check", "step"), tuple((one.code, one.name, one.step) for one in CHECK_CODES.values())),
        Paragraph("abu explain STEP or CODE shows them; abu size MACHINE --explain puts the numbers in."),
    )
    result = {
        "steps": {name: each.title for name, each in STEPS.items()},
        "checks": {code: one.name for code, one in CHECK_CODES.items()},
    }
    return Outcome("explain", result, blocks)


def _step(name: str) -> Outcome:
    from abu_calc.report.explain import step_blocks
    from abu_calc.report.steps import STEPS

    step = STEPS[name]
    texts = {one.name: "\n".join(one.for_users) for one in step.formulas}
    return Outcome("explain", {"step": name, "formulas": texts}, tuple(step_blocks(step)))


def _code(code: str) -> Outcome:
    from abu_calc.check_codes import CHECK_CODES
    from abu_calc.formula import formula_of
    from abu_calc.report.explain import code_blocks

    one = CHECK_CODES[code]
    result = {
        "check": one.code,
        "name": one.name,
        "asks": one.asks,
        "fails": one.fails,
        "remedy": one.remedy,
        "step": one.step or None,
        "formulas": {each.name: "\n".join(each.for_users) for each in map(formula_of, one.formulas)},
    }
    return Outcome("explain", result, tuple(code_blocks(one)))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "explain", explain)
