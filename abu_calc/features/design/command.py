"""`abu size MACHINE`: from one file about a machine to a sized and simulated design."""

import os
from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Machine, Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.registry import imported
from abu_calc.reporting.blocks import Block
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult
    from abu_calc.reporting.drawings.shapes import Drawing
    from abu_calc.reporting.solids.assembly import SolidAssembly


def size(
    how: Delivery,
    machine: Machine,
    set_: Overrides = None,
    explain: Annotated[bool, option("--explain", "Print the whole report and every formula with its numbers.")] = False,
    accuracy: Annotated[float, option("--accuracy RATIO", "Relative error allowed in simulations.")] = 0.01,
) -> Outcome:
    """Size the autobalancer of a machine and simulate it."""
    from abu_calc.features.design.study import size as study
    from abu_calc.inputs.read_machine import read_machine

    source = read_machine(machine, set_ or ())
    with progress(how) as tell:
        result = study(source, accuracy, tell, os.cpu_count() or 1)
    return outcome_of(result, explain=explain)


def outcome_of(result: "SizeResult", *, explain: bool = False) -> Outcome:
    """Outcome of a result: how it is shown and written; `explain`: with every formula."""
    if len(result.autobalancers) > 1:
        outcome: Outcome = imported("spindle.view:spindle_outcome")(result)
        return outcome
    short = None if explain else lambda: _screen(result)
    return Outcome.of(
        result, lambda: _blocks(result, explain), short, lambda: _drawings(result), lambda: _solids(result)
    )


def _screen(result: "SizeResult") -> tuple[Block, ...]:
    from abu_calc.features.design.screen import size_screen

    return size_screen(result)


def _blocks(result: "SizeResult", explain: bool) -> tuple[Block, ...]:
    from abu_calc.features.design.view import size_blocks

    if not explain:
        return size_blocks(result)
    from abu_calc.features.design.step_numbers import explanation_blocks

    return size_blocks(result) + explanation_blocks(result)


def _drawings(result: "SizeResult") -> "tuple[Drawing, ...]":
    from abu_calc.features.design.sheet import size_sheets

    return size_sheets(result)


def _solids(result: "SizeResult") -> "SolidAssembly":
    from abu_calc.features.design.solids import size_solids

    return size_solids(result)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "size", size, drawn=(".dxf", ".svg", ".pdf", ".step", ".stp"), simulates=True)
