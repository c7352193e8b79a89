"""Workers of a sweep: this process, several, or another's executor; and their record in the store."""

import json
import os
import platform
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, suppress
from itertools import islice
from time import perf_counter
from typing import Final

from abu_calc.features.sweep.batches import BatchStudy as Computed
from abu_calc.features.sweep.batches import RenewableExecutor, Row, given, here, in_batches, processes
from abu_calc.features.sweep.cluster import (
    PLACE,
    client_of,
    differences_of_software,
    is_alive,
    is_ours_to_end,
    refuse_other_software,
    software,
    threads_of,
    versions,
    worker_name,
)
from abu_calc.features.sweep.columns import OUTSIDE
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.store import Store
from abu_calc.features.sweep.store_faults import fault
from abu_calc.foundation.errors import AbuError, InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress
from abu_calc.inputs.reading.document import FileReading

Take = Callable[[list[Row]], None]

SOON: Final = 6.0
"""Seconds of work that are left, below which starting processes is not worth the while."""
FIRST: Final = 4
"""Members that are computed here first: they make the compiled code for all, and tell how long one takes."""


@dataclass(frozen=True)
class Workers:
    """Number of processes that compute, or somebody's executor, with the longest wait for its workers [s]."""

    workers: int | None
    executor: Executor | None
    patience: float

    def refuse_other_software(self) -> None:
        """Raise InputError if workers of a cluster have other software than this process."""
        client = None if self.executor is None else client_of(self.executor)
        if client is not None:
            refuse_other_software(client)

    def executors(self) -> RenewableExecutor:
        """Source of their executors."""
        if self.executor is None:
            return here() if self.workers is None or self.workers < 2 else processes(self.workers)
        client = client_of(self.executor)
        count = getattr(self.executor, "_max_workers", None) or (threads_of(client) if client else os.cpu_count()) or 1
        alive = None if client is None else lambda: is_alive(client)
        ends = is_ours_to_end(self.executor)
        return given(self.executor, count, ends=ends, alive=alive, patience=self.patience)

    @property
    def described(self) -> str:
        """Description of the workers, for the store."""
        who = f"{self.workers or 1} of this machine" if self.executor is None else type(self.executor).__name__
        return f"{who}; Python {platform.python_version()}, {platform.system()} {platform.machine()}"

    @contextmanager
    def noted(self, store: Store, files: Sequence[FileReading], seed: int, command: str | None) -> Iterator[None]:
        """Note in the store who computes, from when until when."""
        store.begun({
            "file": ", ".join(each.file for each in files),
            "sha256": ", ".join(each.sha256 for each in files),
            "versions": json.dumps({**software(), **versions("distributed")}),
            "seed": seed,
            "command": command,
            "workers": self.described,
        })  # fmt: skip
        try:
            yield
        except BaseException:
            with suppress(AbuError):  # the first fault is the one to tell
                store.ended()
            raise
        store.ended()


def compute(study: SweepStudy, store: Store, hands: Workers, progress: Progress) -> None:
    """Put the missing members into the store as they come."""
    counted = _Counted(store.put, store.done, store.runs, progress, "sweep: {} of {} samples")
    _computed(study, store.missing(), counted, hands)
    if (there := store.ask("SELECT COUNT(*) FROM members")[0][0]) != store.runs:
        text = f"it has {there} samples and not {store.runs}: another program removed some"
        raise fault(store.path, text, "Go on with --resume.")


def once_more(
    study: Computed, numbers: Iterator[int], take: Take, count: int, hands: Workers, progress: Progress
) -> None:
    """Members beside those of the store."""

    def keep(rows: list[Row], *_: object) -> None:
        """Rows of a batch, whose further numbers nobody needs."""
        take(rows)

    counted = _Counted(keep, 0, count, progress, "sweep: trials of advice, {} of {}")
    _computed(study, numbers, counted, hands)


@dataclass(frozen=True)
class Attributed:
    """A study as workers get it: its rows come with who computed them. A worker with other software computes none."""

    study: Computed
    software: Mapping[str, str]

    def rows(self, members: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        """One entry: the worker, its software, the rows of the members."""
        if different := differences_of_software(self.software, software()):
            raise InputError(
                "a worker has other software than the process that asks it",
                place=PLACE,
                found=f"{worker_name()}: {different}",
                remedy=f"Install abu-calc {self.software['abu-calc']} with the same libraries there, and restart it.",
            )
        rows, seconds = self.study.rows(members, may_end_process)
        return [(worker_name(), {**software(), "python": platform.python_version()}, rows)], seconds

    def lost(self, member: int, reason: str) -> Row:
        """The entry of a member whose worker gave nothing: the next run tries it again."""
        return ("", None, [self.study.lost(member, OUTSIDE + reason)])


def _computed(study: Computed, missing: Iterator[int], counted: "_Counted", hands: Workers) -> None:
    workers, executor, study = hands.workers, hands.executor, Attributed(study, software())
    if executor is not None or workers is None or workers < 2:
        in_batches(study, missing, hands.executors(), counted)
        return
    begun = perf_counter()
    first = list(islice(missing, FIRST))
    for member in first:  # the last one shows what one takes when all is compiled
        begun = perf_counter()
        in_batches(study, iter([member]), here(), counted)
    left = (counted.of - counted.done) * (perf_counter() - begun)
    who = here() if left < SOON else processes(workers)
    try:
        in_batches(study, missing, who, counted)
    except BaseException:
        who.close(at_once=True)
        raise
    who.close()


class _Counted:
    """Takes rows: where they are kept, and says how far it is."""

    def __init__(self, take: Callable[..., None], done: int, of: int, progress: Progress, words: str) -> None:
        self.take, self.of, self.progress, self.words = take, of, progress, words
        self.before = self.done = done
        self.begun = perf_counter()

    def __call__(self, entries: list[Row]) -> None:
        for worker, its_software, rows in entries:
            self.take(rows, worker, its_software)
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
