"""`abu sweep MACHINE|SCENE`: many machines like this one: share that meets the limits, deciding values."""

import os
import shlex
import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from abu_calc.cli.command import File, Overrides, add_command, option
from abu_calc.cli.output import Delivery
from abu_calc.cli.progress import progress
from abu_calc.foundation.call_files import enter
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place, StoppedError
from abu_calc.foundation.interruption import EndedBySignal, status_of
from abu_calc.reporting.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.features.sweep.result import SweepResult

SAMPLING: Final = "Sampling"
COMPUTING: Final = "Computing"
"""Panels of the options about the samples, and about the processes that compute them."""

Vary = Annotated[
    list[str] | None,
    option(
        "--vary KEY=HOW",
        "LOW:HIGH:N, A,B,…, uniform(LOW,HIGH), normal(MEAN,SD), lognormal(MEDIAN,SIGMA), "
        "triangular(LOW,MODE,HIGH) or choice(A,B,…); repeatable. KEY is a key of the file, start.kind, "
        "start.angle_deg, start.eccentricity_deg or start.temperature_C.",
        SAMPLING,
    ),
]


Runs = Annotated[int | None, option("--runs N", "Number of samples; default 100.", SAMPLING)]
What = Annotated[
    str | None, option("--what NAME", "build: size once, then build and start each sample; design: size each sample.")
]
Tolerances = Annotated[
    bool, option("--tolerances", "Vary the drawing's tolerances and the usual scatter of use.", SAMPLING)
]
Grid = Annotated[tuple[str, str] | None, option("--grid KEY KEY", "Chart two keys that have listed values.", SAMPLING)]
Sensitivity = Annotated[
    bool, option("--sensitivity", "Use a Saltelli design of N × (varied values + 2) samples.", SAMPLING)
]
Sampling = Annotated[str | None, option("--sampling NAME", "latin-hypercube (default) or sobol.", SAMPLING)]
Seed = Annotated[int | None, option("--seed N", "Seed of the random numbers; default 0.", SAMPLING)]
SampleAccuracy = Annotated[float, option("--accuracy RATIO", "Relative error of each simulation.")]
TimeLimit = Annotated[
    float | None, option("--time-limit S", "Longest computing time of one sample; default 60.", COMPUTING)
]
StoreFile = Annotated[Path | None, option("--store FILE.sqlite", "Store every sample when it is computed.", COMPUTING)]
Resume = Annotated[bool, option("--resume", "Continue with the store.", COMPUTING)]
Workers = Annotated[
    int | None, option("--workers N", "Number of processes; default one for each processor.", COMPUTING)
]
Cluster = Annotated[
    str | None, option("--cluster ADDRESS", "Compute on the Dask scheduler at this address.", COMPUTING)
]
ClusterWait = Annotated[float, option("--cluster-wait S", "Longest wait for the cluster.", COMPUTING)]


def sweep(
    how: Delivery,
    machine: File,
    set_: Overrides = None,
    vary: Vary = None,
    runs: Runs = None,
    what: What = None,
    tolerances: Tolerances = False,
    grid: Grid = None,
    sensitivity: Sensitivity = False,
    sampling: Sampling = None,
    seed: Seed = None,
    accuracy: SampleAccuracy = 0.01,
    time_limit_s: TimeLimit = None,
    store: StoreFile = None,
    resume: Resume = False,
    workers: Workers = None,
    cluster: Cluster = None,
    cluster_wait_s: ClusterWait = 60.0,
) -> Outcome:
    """Vary values over many samples: share that passes, deciding values."""
    from abu_calc.features.sweep.store_faults import checked_path
    from abu_calc.features.sweep.study import WAIT
    from abu_calc.features.sweep.study import sweep as study
    from abu_calc.simulation.scene_file import read_any

    WAIT.check(cluster_wait_s)
    if resume and store is None:
        raise InputError("--resume goes with --store", remedy="Add --store FILE.sqlite.")
    if store is not None:
        enter(checked_path(store), written=True)
    with wording(store), cluster_executor(cluster, cluster_wait_s) as executor, progress(how) as tell:
        result = study(
            read_any(machine, set_ or ()),
            vary,
            runs,
            what=what,
            tolerances=tolerances or None,
            grid=grid,
            sensitivity=sensitivity or None,
            sampling=sampling,
            seed=seed,
            accuracy=accuracy,
            time_limit_s=time_limit_s,
            store=store,
            resume=resume,
            force=how.force,
            executor=executor,
            workers=None if executor else (workers or os.cpu_count() or 1),
            cluster_wait_s=cluster_wait_s,
            command=_command(),
            progress=tell,
        )
    return outcome_of(result)


def _command() -> str:
    """Command line as it was typed."""
    return shlex.join(["abu", *sys.argv[1:]])


@contextmanager
def wording(store: Path | None) -> Iterator[None]:
    """Errors name the option; who interrupts is told how to go on."""
    try:
        yield
    except InputError as error:
        key = error.place.key or ""
        if error.place.file is not None or not key.startswith("vary "):
            raise
        raise error.at(Place(key=f"--{key}")) from None
    except NotTrustworthyError as error:
        kept = getattr(error, "__notes__", ())
        if store is None or not kept:
            raise
        raise NotTrustworthyError(f"{error}\n{_going_on(store, kept[0])}") from None
    except (KeyboardInterrupt, EndedBySignal) as stopped:
        kept = getattr(stopped, "__notes__", ())
        if store is None or not kept:
            text = "interrupted; no member is kept. A sweep with --store FILE.sqlite can be gone on with."
        else:
            text = f"interrupted; {_going_on(store, kept[0])}"
        raise StoppedError(text, status_of(stopped)) from None


def _going_on(store: Path, kept: str) -> str:
    """Text that names the place of the members, and the command that computes the others."""
    resume = "" if "--resume" in sys.argv else " --resume"
    return f"{kept} are in {store}. Go on with:\n  {_command()}{resume}"


@contextmanager
def cluster_executor(cluster: str | None, patience: float) -> Iterator[Executor | None]:
    """Executor of a Dask cluster, if one is requested."""
    if cluster is None:
        yield None
        return
    from abu_calc.features.sweep.cluster import executor

    with executor(cluster, patience) as chosen:
        yield chosen


def outcome_of(result: "SweepResult") -> Outcome:
    """Outcome of a result: how it is shown and written."""
    from abu_calc.features.sweep.view import sweep_blocks, sweep_screen

    return Outcome.of(result, lambda: sweep_blocks(result), lambda: sweep_screen(result))


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "sweep", sweep, simulates=True)
