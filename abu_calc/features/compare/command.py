"""`abu compare MACHINE MACHINE …`, `abu compare MACHINE --variant "key=value,key=value" …`: what differs."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from abu_calc.cli.command import IN_SIMULATIONS, REQUIRED, SET, Answer, Command, Option
from abu_calc.cli.output import Delivery
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress
from abu_calc.registry import outcome_of

if TYPE_CHECKING:
    from abu_calc.features.compare.measured import MeasuredCompareResult
    from abu_calc.features.compare.study import CompareResult


def _compared(
    study: "Callable[..., CompareResult]",
    machines: Sequence[str],
    variants: Sequence[str] = (),
    measured: Sequence[str] = (),
    set_: Sequence[str] = (),
    *,
    how: Delivery,
    progress: Progress,
    **given: Any,
) -> Answer:
    from abu_calc.features.compare.view import compare_blocks
    from abu_calc.inputs.read_machine import read_machine, variant_of

    if variants and len(machines) > 1:
        raise InputError(
            "variants are of one machine", place=Place(key="--variant"), found=f"{len(machines)} machines",
            remedy="Name one machine, or write a file for each variant.",
        )  # fmt: skip
    if measured:
        return _measured(machines, set_, variants, measured, progress)
    read = [read_machine(machine, set_) for machine in machines]
    read += [variant_of(read[0], variant) for variant in variants]
    result = study(read, progress=progress, **given)
    return replace(outcome_of(result), view=lambda: compare_blocks(result, full=how.full))


def _measured(
    files: Sequence[str],
    overrides: Sequence[str],
    variants: Sequence[str],
    recordings: Sequence[str],
    progress: Progress,
) -> "MeasuredCompareResult":
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
    return compare_measured(read, recordings, progress=progress)


COMMAND = Command(
    "compare.study:compare",
    (
        Option(
            "machines",
            list[str],
            "MACHINE",
            "Machine files or names of presets. The first one is the reference.",
            default=REQUIRED,
        ),
        Option(
            "variants",
            list[str],
            "--variant KEY=VALUE,KEY=VALUE",
            "Add a variant of the machine with these entries replaced; repeatable.",
        ),
        Option("measured", list[str], "--measured FILE", "Set a recorded start beside predicted ones; repeatable."),
        *(SET, IN_SIMULATIONS),
    ),
    around=_compared,
    simulates=True,
)
