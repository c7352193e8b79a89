"""Who computes a sweep: this process, several, or somebody else's executor; and what stands of it in the store."""

import os
import platform
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from importlib.metadata import PackageNotFoundError, version
from itertools import islice
from time import perf_counter
from typing import Any, Final

from abu_calc.analysis.batches import Row, given, here, in_batches, processes
from abu_calc.analysis.batches import Study as Computed
from abu_calc.progress import Progress
from abu_calc.studies.sweeping.members import Study
from abu_calc.studies.sweeping.store import Store
from abu_calc.version import __version__

Take = Callable[[list[Row]], None]

SOON: Final = 6.0
"""Seconds of work that are left, below which starting processes is not worth the while."""
FIRST: Final = 4
"""Members that are computed here first: they make the compiled code for all, and tell how long one takes."""


def versions(*names: str) -> dict[str, str]:
    """Of this program and of what its numbers hang on."""
    found = {"abu-calc": __version__}
    for name in ("numpy", "scipy", *names):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "none"
    return found


def described(workers: int | None, executor: Executor | None) -> str:
    """Who computes, for the store."""
    who = type(executor).__name__ if executor is not None else f"{workers or 1} of this machine"
    return f"{who}; Python {platform.python_version()}, {platform.system()} {platform.machine()}"


def compute(study: Study, store: Store, workers: int | None, executor: Executor | None, progress: Progress) -> None:
    """Puts the missing members into the store as they come."""
    told = _Told(store.put, store.done, store.runs, progress, "sweep: {} of {} members")
    _computed(study, store.missing(), told, workers, executor)


def once_more(
    study: Computed, numbers: Iterator[int], take: Take, count: int, workers: int | None, executor: Executor | None,
    progress: Progress,
) -> None:  # fmt: skip
    """Members beside those of the store."""
    told = _Told(take, 0, count, progress, "sweep: what may be loosened, {} of {}")
    _computed(study, numbers, told, workers, executor)


def _computed(
    study: Computed, missing: Iterator[int], told: "_Told", workers: int | None, executor: Executor | None
) -> None:
    if executor is not None:
        count = getattr(executor, "_max_workers", None) or _cluster_size(executor) or os.cpu_count() or 1
        in_batches(study, missing, given(executor, count, ends=is_ours_to_end(executor)), told)
        return
    if workers is None or workers < 2:
        in_batches(study, missing, here(), told)
        return
    begun = perf_counter()
    first = list(islice(missing, FIRST))
    for member in first:  # the last one shows what one takes when all is compiled
        begun = perf_counter()
        in_batches(study, iter([member]), here(), told)
    left = (told.of - told.done) * (perf_counter() - begun)
    who = here() if left < SOON else processes(workers)
    try:
        in_batches(study, missing, who, told)
    finally:
        who.close()


def _cluster_size(executor: Executor) -> int | None:
    """Threads of a Dask cluster behind its client's executor."""
    client: Any = getattr(executor, "_client", None)
    return sum(client.nthreads().values()) if client is not None else None


def is_ours_to_end(executor: Executor) -> bool:
    """Whether who computes is a process of a Dask cluster that is started anew when it ends."""
    client: Any = getattr(executor, "_client", None)
    if client is None:
        return False
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    return bool(workers) and all(one.get("nanny") for one in workers)


class _Told:
    """Takes rows: where they are kept, and says how far it is."""

    def __init__(self, take: Take, done: int, of: int, progress: Progress, words: str) -> None:
        self.take, self.of, self.progress, self.words = take, of, progress, words
        self.before = self.done = done
        self.begun = perf_counter()

    def __call__(self, rows: list[Row]) -> None:
        self.take(rows)
        self.done += len(rows)
        passed = perf_counter() - self.begun
        rate = (self.done - self.before) / max(passed, 1e-9)
        left = (self.of - self.done) / max(rate, 1e-9)
        self.progress(f"{self.words.format(self.done, self.of)}, {rate:.3g} a second, {duration(left)} left")


def duration(seconds: float) -> str:
    """Seconds as people say them.

    >>> duration(42), duration(200), duration(9000)
    ('42 s', '3.3 min', '2.5 h')
    """
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.1f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
