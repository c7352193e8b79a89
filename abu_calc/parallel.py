"""The same work on many things, side by side on all processors; the outcome does not depend on how many there are."""

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import get_context
from typing import Any, Self, TypeVar

T = TypeVar("T")


@dataclass(eq=False)
class Workers:
    """How many work side by side: threads, for work that lets go of the interpreter, or processes for any other.

    Within `with` they stay for all that they are given; else they are there for one round of work each.
    """

    count: int
    processes: bool = False
    _kept: Executor | None = field(default=None, init=False, repr=False)

    def __enter__(self) -> Self:
        self._kept = self._executor()
        return self

    def __exit__(self, *_: object) -> None:
        if self._kept is not None:
            self._kept.shutdown(wait=True, cancel_futures=True)
        self._kept = None

    @contextmanager
    def running(self) -> Iterator[Executor]:
        """What runs them."""
        if self._kept is not None:
            yield self._kept
            return
        with self:
            assert self._kept is not None
            yield self._kept

    def _executor(self) -> Executor:
        if not self.processes:
            return ThreadPoolExecutor(self.count)
        # Started afresh on every system: a copy of this process would have its locks, but not its threads.
        return ProcessPoolExecutor(self.count, mp_context=get_context("spawn"))


def threads() -> Workers:
    """One for each processor."""
    return Workers(os.cpu_count() or 1)


def several(workers: Workers | None, tasks: int) -> Workers | None:
    """The workers, where there are several and so many tasks are worth their start."""
    return workers if workers is not None and workers.count > 1 and tasks > 2 else None


def side_by_side(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: Workers | None, told: Callable[[int], None]
) -> list[T]:
    """What the work gives for each task, in their order; `told` how many are done. None: one after the other.

    Threads begin when the first task is done, so that what all need is made once.
    """
    found: list[T] = []
    helpers = several(workers, len(tasks))
    alone = len(tasks) if helpers is None else 0 if helpers.processes else 1
    for task in tasks[:alone]:
        found.append(work(*task))
        told(len(found))
    if helpers is None:
        return found
    with helpers.running() as executor:
        waiting = [executor.submit(work, *task) for task in tasks[alone:]]
        try:
            for done, _ in enumerate(as_completed(waiting), alone + 1):
                told(done)
            return [*found, *(one.result() for one in waiting)]
        finally:
            for one in waiting:
                one.cancel()
