"""`abu compare MACHINE MACHINE …`, `abu compare MACHINE --variant "key=value,key=value" …`: what differs."""

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from abu_calc.cli.command import Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.compare.measured import MeasuredCompareResult
    from abu_calc.features.compare.study import CompareResult


def compare(
    how: Delivery,
    machines: Annotated[
        list[str],
        typer.Argument(metavar="MACHINE", help="Machine files or names of presets. The first one is the reference."),
    ],
    variants: Annotated[
        list[str] | None,
        option(
            "--variant KEY=VALUE,KEY=VALUE", "Add a variant of the machine with these entries replaced; repeatable."
        ),
    ] = None,
    measured: Annotated[
        list[str] | None, option("--measured FILE", "Set a recorded start beside predicted ones; repeatable.")
    ] = None,
    set_: Overrides = None,
    accuracy: Annotated[float, option("--accuracy RATIO", "Relative error allowed in simulations.")] = 0.01,
) -> Outcome:
    """Compare machines or variants of one machine side by side."""
    from abu_calc.features.compare.study import compare as study
    from abu_calc.inputs.read_machine import read_machine, variant_of

    if variants and len(machines) > 1:
        raise InputError(
            "variants are of one machine", place=Place(key="--variant"), found=f"{len(machines)} machines",
            remedy="Name one machine, or write a file for each variant.",
        )  # fmt: skip
    if measured:
        return _measured(how, machines, set_ or (), variants or (), measured)
    read = [read_machine(machine, set_ or ()) for machine in machines]
    read += [variant_of(read[0], variant) for variant in variants or ()]
    with progress(how) as tell:
        result = study(read, accuracy, tell, os.cpu_count() or 1)
    return outcome_of(result, full=how.full)


def outcome_of(result: "CompareResult | MeasuredCompareResult", *, full: bool = True) -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.compare.measured import MeasuredCompareResult
    from abu_calc.features.compare.measured_view import measured_blocks

    if isinstance(result, MeasuredCompareResult):
        return Outcome.of(result, lambda: measured_blocks(result))
    from abu_calc.features.compare.screen import compare_screen
    from abu_calc.features.compare.view import compare_blocks

    return Outcome.of(result, lambda: compare_blocks(result, full=full), lambda: compare_screen(result))


def _measured(
    how: Delivery, files: Sequence[str], overrides: Sequence[str], variants: Sequence[str], recordings: list[str]
) -> Outcome:
    """Recorded starts beside the starts that files of machines or scenes predict."""
    from abu_calc.features.compare.measured import compare_measured
    from abu_calc.inputs.read_machine import Machine, variant_of
    from abu_calc.simulation.scene_file import read_any

    read = [read_any(file, overrides) for file in files]
    if variants and not isinstance(read[0], Machine):
        raise InputError(
            "variants are of a machine", place=Place(key="--variant"), found=files[0],
            remedy="Name a machine file, or write a scene file for each variant.",
        )  # fmt: skip
    read += [variant_of(read[0], variant) for variant in variants]  # type: ignore[arg-type]
    with progress(how) as tell:
        result = compare_measured(read, recordings, progress=tell)
    return outcome_of(result)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "compare", compare, simulates=True)
