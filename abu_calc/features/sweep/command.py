"""`abu sweep MACHINE|SCENE`: many machines like this one: share that meets the limits, deciding values."""

import os
import shlex
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final, TypeVar

from abu_calc.cli.command import ACCURACY, FILE, SET, Answer, Command, Option, Study
from abu_calc.cli.output import Delivery
from abu_calc.foundation.call_files import enter
from abu_calc.foundation.errors import InputError, NotTrustworthyError, StoppedError
from abu_calc.foundation.parallel import EndedBySignal, status_of

Asked = TypeVar("Asked")

SAMPLING: Final = "Sampling"
COMPUTING: Final = "Computing"
"""Panels of the options about the samples, and about the processes that compute them."""

STORE: Final = Option("store", Path, "--store FILE.sqlite", "Store every sample when it is computed.", COMPUTING)
RESUME: Final = Option("resume", bool, "--resume", "Continue with the store.", COMPUTING)
WORKERS: Final = Option(
    "workers", int, "--workers N", "Number of processes; default one for each processor.", COMPUTING
)
CLUSTER: Final = Option(
    "cluster", str, "--cluster ADDRESS", "Compute on the Dask scheduler at this address.", COMPUTING
)
CLUSTER_WAIT: Final = Option(
    "cluster_wait_s", float, "--cluster-wait S", "Longest wait for the cluster.", COMPUTING, default=60.0
)
EACH_ACCURACY: Final = ACCURACY._replace(text="Relative error of each simulation.")


def computed(
    study: Callable[..., Asked],
    read: Callable[[], object],
    *,
    how: Delivery,
    store: Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    cluster: str | None = None,
    cluster_wait_s: float = 60.0,
    **given: Any,
) -> Asked:
    """Result of a study whose samples go to the store, and are computed by the processes, that the options name.

    `read` reads the files of machines: no file that the call writes may be one of them, so that the store comes first.
    """
    from abu_calc.features.sweep.store_faults import checked_path
    from abu_calc.features.sweep.study import WAIT

    WAIT.check(cluster_wait_s)
    if resume and store is None:
        raise InputError("--resume goes with --store", remedy="Add --store FILE.sqlite.")
    if store is not None:
        enter(checked_path(store), written=True)
    with _wording(store), _cluster_executor(cluster, cluster_wait_s) as executor:
        return study(
            read(), store=store, resume=resume, force=how.force, executor=executor,
            workers=None if executor else (workers or os.cpu_count() or 1), cluster_wait_s=cluster_wait_s,
            command=_command(), **given,
        )  # fmt: skip


def _command() -> str:
    """Command line as it was typed."""
    return shlex.join(["abu", *sys.argv[1:]])


@contextmanager
def _wording(store: Path | None) -> Iterator[None]:
    """Who interrupts, or meets an error, is told how to go on."""
    try:
        yield
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
def _cluster_executor(cluster: str | None, patience: float) -> Iterator[Executor | None]:
    """Executor of a Dask cluster, if one is requested."""
    if cluster is None:
        yield None
        return
    from abu_calc.features.sweep.execution import executor

    with executor(cluster, patience) as chosen:
        yield chosen


def _swept(study: Study, machine: str, set_: Sequence[str] = (), *, how: Delivery, **given: Any) -> Answer:
    from abu_calc.simulation.scene_file import read_any

    return computed(study, lambda: read_any(machine, set_), how=how, **given)


COMMAND = Command(
    "sweep.study:sweep",
    (
        FILE._replace(key="machine", reads=None),
        SET,
        Option(
            "vary",
            list[str],
            "--vary KEY=HOW",
            "LOW:HIGH:N, A,B,…, uniform(LOW,HIGH), normal(MEAN,SD), lognormal(MEDIAN,SIGMA), "
            "triangular(LOW,MODE,HIGH) or choice(A,B,…); repeatable. KEY is a key of the file, start.kind, "
            "start.angle_deg, start.eccentricity_deg or start.temperature_C.",
            SAMPLING,
        ),
        Option("runs", int, "--runs N", "Number of samples; default 100.", SAMPLING),
        Option(
            "what", str, "--what NAME", "build: size once, then build and start each sample; design: size each sample."
        ),
        Option(
            "tolerances", bool, "--tolerances", "Vary the drawing's tolerances and the usual scatter of use.", SAMPLING
        ),
        Option("grid", tuple[str, str], "--grid KEY KEY", "Chart two keys that have listed values.", SAMPLING),
        Option(
            "sensitivity", bool, "--sensitivity", "Use a Saltelli design of N × (varied values + 2) samples.", SAMPLING
        ),
        Option("sampling", str, "--sampling NAME", "latin-hypercube (default) or sobol.", SAMPLING),
        Option("seed", int, "--seed N", "Seed of the random numbers; default 0.", SAMPLING),
        EACH_ACCURACY,
        Option("time_limit_s", float, "--time-limit S", "Longest computing time of one sample; default 60.", COMPUTING),
        *(STORE, RESUME, WORKERS, CLUSTER, CLUSTER_WAIT),
    ),
    around=_swept,
    simulates=True,
)
