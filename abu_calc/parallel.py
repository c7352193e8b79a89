"""The same work on many things, side by side on all processors; the outcome does not depend on how many there are."""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any, TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Workers:
    """How many work side by side: threads, for work that lets go of the interpreter, or processes for any other."""

    count: int
    processes: bool = False

    def executor(self) -> Executor:
        """That runs them."""
        if not self.processes:
            return ThreadPoolExecutor(self.count)
        # Started afresh on every system: a copy of this process would have its locks, but not its threads.
        return ProcessPoolExecutor(self.count, mp_context=get_context("spawn"))


def threads() -> Workers:
    """One for each processor."""
    return Workers(os.cpu_count() or 1)


def side_by_side(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: Workers | None, told: Callable[[int], None]
) -> list[T]:
    """What the work gives for each task, in their order; `told` how many are done. None: one after the other.

    The first task is done alone, so that what all need is made once.
    """
    found = [work(*task) for task in tasks[:1]]
    told(len(found))
    if workers is None or workers.count < 2 or len(tasks) < 3:
        for task in tasks[1:]:
            found.append(work(*task))
            told(len(found))
        return found
    executor = workers.executor()
    try:
        waiting = [executor.submit(work, *task) for task in tasks[1:]]
        for done, _ in enumerate(as_completed(waiting), 2):
            told(done)
        return [*found, *(one.result() for one in waiting)]
    finally:
        executor.shutdown(wait=True, cancel_futures=True)
