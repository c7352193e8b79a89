"""`abu explain [STEP]`: the formulas of a step, without a machine."""

from typing import Annotated

import typer

from abu_calc.cli.command import add_command
from abu_calc.errors import InputError
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.outcome import Outcome


def explain(step: Annotated[str | None, typer.Argument(metavar="[STEP]", help="A step of sizing.")] = None) -> Outcome:
    """Show equation, units, range and source of every formula of a step; without a step, list them."""
    from abu_calc.report.explain import STEPS, formula_text, spoken, step_blocks
    from abu_calc.spec.names import nearest

    if step is None:
        rows = tuple((name, each.title, ", ".join(map(spoken, each.formulas))) for name, each in STEPS.items())
        blocks: tuple[Block, ...] = (
            Heading("Steps of `abu size`"),
            Grid(("step", "what", "formulas"), rows),
            Paragraph("abu explain STEP shows them; abu size MACHINE --explain puts the numbers in."),
        )
        return Outcome("explain", {"steps": {name: each.title for name, each in STEPS.items()}}, blocks)
    if step not in STEPS:
        near = nearest(step, tuple(STEPS))
        remedy = f'Did you mean "{near}"?' if near else None
        raise InputError("no such step", found=step, allowed=", ".join(STEPS), remedy=remedy)
    texts = {spoken(formula): formula_text(formula) for formula in STEPS[step].formulas}
    return Outcome("explain", {"step": step, "formulas": texts}, tuple(step_blocks(STEPS[step])))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "explain", explain)
