"""`abu optimise MACHINE [MACHINE …]`: the cheapest design of which a wanted share meets the limits."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from abu_calc.cli.command import REQUIRED, SET, Answer, Command, Option
from abu_calc.cli.output import Delivery
from abu_calc.features.sweep.command import CLUSTER, CLUSTER_WAIT, EACH_ACCURACY, RESUME, STORE, WORKERS, computed
from abu_calc.registry import outcome_of
from abu_calc.reporting.outcome import Target, check_target

if TYPE_CHECKING:
    from abu_calc.features.optimise.result import OptimiseResult
    from abu_calc.inputs.read_machine import Machine

RACE: Final = "Samples"
"""Panel of the options about samples."""


def _optimised(
    study: "Callable[..., OptimiseResult]",
    machines: Sequence[str],
    set_: Sequence[str] = (),
    write: Path | None = None,
    *,
    how: Delivery,
    **given: Any,
) -> Answer:
    from abu_calc.inputs.read_machine import read_machine

    files = [] if write is None else _targets(write, len(machines))
    for file in files:
        check_target(file, force=how.force, suffixes=(".toml",), option="--write")
    read = cache(lambda: [read_machine(machine, set_) for machine in machines])
    result = computed(study, read, how=how, **given)
    return replace(outcome_of(result), further=tuple(_written(files, read(), result)) if files else ())


def _targets(write: Path, machines: int) -> list[Path]:
    """The file of each machine: FILE.toml, or FILE-1.toml, FILE-2.toml of several."""
    if machines == 1:
        return [write]
    return [write.with_name(f"{write.stem}-{k + 1}{write.suffix}") for k in range(machines)]


def _written(files: Sequence[Path], machines: "Sequence[Machine]", result: "OptimiseResult") -> Iterator[Target]:
    from abu_calc.features.optimise.result import written_text

    values = result.recommended.set_
    each = [values] if len(files) == 1 else list(values.values())
    for file, machine, its in zip(files, machines, each, strict=True):
        yield Target(file, written_text(machine, its, result))


COMMAND = Command(
    "optimise.study:optimise",
    (
        Option(
            "machines",
            list[str],
            "MACHINE",
            "Machine files or names of presets: a series, or a family.",
            default=REQUIRED,
        ),
        SET,
        Option(
            "choose",
            list[str],
            "--choose KEY=choice(A,B,…)",
            "Values of one key to choose from; repeatable. Without it: balls, eccentricity, friction, drag rate.",
        ),
        Option("share", float, "--share SHARE", "Share of machines built that must meet the limits; 0.95."),
        Option(
            "share_parts",
            str,
            "--share-parts PART,…",
            "Parts that several machines share: balls, race, housing, oil; default balls,race.",
        ),
        Option(
            "tolerances",
            bool | None,
            "--tolerances/--no-tolerances",
            "Vary the drawing's tolerances and the usual scatter of use; default: as [sweep] says, else yes.",
            RACE,
        ),
        Option("seed", int, "--seed N", "Seed of the random numbers; default 0.", RACE),
        Option("runs", int, "--runs N", "Fresh samples of the recommended design.", RACE, default=1000),
        Option("samples", int, "--samples N", "Most samples of the race; default: by the choices.", RACE),
        *(EACH_ACCURACY, STORE, RESUME, WORKERS, CLUSTER, CLUSTER_WAIT),
        Option(
            "write", Path, "--write FILE", "Write the recommended design as a machine file; of several, one for each."
        ),
    ),
    "Candidates race on common samples. Fresh samples give the share of the recommended design.",
    around=_optimised,
    simulates=True,
    seldom=("--accuracy", "--seed", "--runs", "--cluster", "--cluster-wait", "--force", "--quiet", "--no-color"),
)
