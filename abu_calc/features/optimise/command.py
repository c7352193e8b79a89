"""`abu optimise MACHINE [MACHINE …]`: the cheapest design of which a wanted share meets the limits."""

import os
import shlex
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.cli.command import Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.features.sweep.command import Cluster, ClusterWait, Resume, StoreFile, Workers, cluster_executor, wording
from abu_calc.foundation.call_files import enter
from abu_calc.foundation.errors import InputError, Place
from abu_calc.reporting.outcome import Outcome
from abu_calc.reporting.write import Target, check_target

if TYPE_CHECKING:
    from abu_calc.features.optimise.result import OptimiseResult
    from abu_calc.inputs.read_machine import Machine

RACE: Final = "Samples"
"""Panel of the options about samples."""


SELDOM: Final = ("--accuracy", "--seed", "--runs", "--cluster", "--cluster-wait", "--force", "--quiet", "--no-color")
"""Options that `--help` lists by name alone."""


def optimise(
    how: Delivery,
    machines: Annotated[
        list[str], typer.Argument(metavar="MACHINE", help="Machine files or names of presets: a series, or a family.")
    ],
    set_: Overrides = None,
    choose: Annotated[
        list[str] | None,
        option(
            "--choose KEY=choice(A,B,…)",
            "Values of one key to choose from; repeatable. Without it: balls, eccentricity, friction, drag rate.",
        ),
    ] = None,
    share: Annotated[
        float | None, option("--share SHARE", "Share of machines built that must meet the limits; 0.95.")
    ] = None,
    share_parts: Annotated[
        str | None,
        option(
            "--share-parts PART,…", "Parts that several machines share: balls, race, housing, oil; default balls,race."
        ),
    ] = None,
    tolerances: Annotated[
        bool | None,
        option(
            "--tolerances/--no-tolerances",
            "Vary the drawing's tolerances and the usual scatter of use; default: as [sweep] says, else yes.",
            RACE,
        ),
    ] = None,
    seed: Annotated[int | None, option("--seed N", "Seed of the random numbers; default 0.", RACE)] = None,
    runs: Annotated[int, option("--runs N", "Fresh samples of the recommended design.", RACE)] = 1000,
    samples: Annotated[
        int | None, option("--samples N", "Most samples of the race; default: by the choices.", RACE)
    ] = None,
    accuracy: Annotated[float, option("--accuracy RATIO", "Relative error of each simulation.")] = 0.01,
    store: StoreFile = None,
    resume: Resume = False,
    workers: Workers = None,
    cluster: Cluster = None,
    cluster_wait_s: ClusterWait = 60.0,
    write: Annotated[
        Path | None, option("--write FILE", "Write the recommended design as a machine file; of several, one for each.")
    ] = None,
) -> Outcome:
    """Find the cheapest design of which a wanted share meets the limits.

    Candidates race on common samples. Fresh samples give the share of the recommended design.
    """
    from abu_calc.features.optimise.study import optimise as study
    from abu_calc.features.optimise.view import optimise_blocks, optimise_screen
    from abu_calc.features.sweep.store_faults import checked_path
    from abu_calc.inputs.read_machine import read_machine

    if resume and store is None:
        raise InputError("--resume goes with --store", remedy="Add --store FILE.sqlite.")
    files = [] if write is None else _targets(write, len(machines))
    for file in files:
        check_target(file, force=how.force, suffixes=(".toml",), option="--write")
    if store is not None:
        enter(checked_path(store), written=True)
    read = [read_machine(machine, set_ or ()) for machine in machines]
    with _naming(), wording(store), cluster_executor(cluster, cluster_wait_s) as executor, progress(how) as tell:
        result = study(
            read, choose or None, share=share, share_parts=share_parts, tolerances=tolerances, seed=seed, runs=runs,
            samples=samples, accuracy=accuracy, store=store, resume=resume, force=how.force, executor=executor,
            workers=None if executor else (workers or os.cpu_count() or 1), cluster_wait_s=cluster_wait_s,
            command=shlex.join(["abu", *sys.argv[1:]]), progress=tell,
        )  # fmt: skip
    outcome = Outcome.of(result, lambda: optimise_blocks(result), lambda: optimise_screen(result))
    return replace(outcome, further=tuple(_written(files, read, result))) if files else outcome


def _targets(write: Path, machines: int) -> list[Path]:
    """The file of each machine: FILE.toml, or FILE-1.toml, FILE-2.toml of several."""
    if machines == 1:
        return [write]
    return [write.with_name(f"{write.stem}-{k + 1}{write.suffix}") for k in range(machines)]


def _written(files: Sequence[Path], machines: "Sequence[Machine]", result: "OptimiseResult") -> Iterator[Target]:
    from abu_calc.features.optimise.written import written_text

    values = result.recommended.set_
    each = [values] if len(files) == 1 else list(values.values())
    for file, machine, its in zip(files, machines, each, strict=True):
        yield Target(file, written_text(machine, its, result))


@contextmanager
def _naming() -> Iterator[None]:
    """Errors about a choice name the option."""
    try:
        yield
    except InputError as error:
        key = error.place.key or ""
        if error.place.file is not None or not key.startswith("choose"):
            raise
        raise error.at(Place(key=f"--{key}")) from None


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "optimise", optimise, simulates=True, seldom=SELDOM)
