"""The same work on many things, side by side on all processors; the outcome does not depend on how many there are."""

import os
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Self, TypeVar

T = TypeVar("T")

LONG = 0.05
"""Processor time [s] of a task that is worth threads: most of a shorter one holds the interpreter."""


@dataclass(eq=False)
class Workers:
    """How many work side by side: threads, for work that lets go of the interpreter, or processes for any other.

    Within `with` they stay for all that they are given; else they are there for one round of work each.
    """

    count: int
    processes: bool = False
    begun: bool = field(default=False, init=False)
    """Whether they stay, and have worked: to begin takes processes half a second."""
    _kept: Executor | None = field(default=None, init=False, repr=False)

    def __enter__(self) -> Self:
        self._kept = self._executor()
        return self

    def __exit__(self, *_: object) -> None:
        if self._kept is not None:
            self._kept.shutdown(wait=True, cancel_futures=True)
        self._kept, self.begun = None, False

    def begin(self, module: str) -> None:
        """Processes start and import a module while this one does something else."""
        if self._kept is not None and self.processes:
            for _ in range(self.count):
                self._kept.submit(import_module, module)

    @contextmanager
    def running(self) -> Iterator[Executor]:
        """What runs them."""
        if self._kept is not None:
            self.begun = True
            yield self._kept
            return
        with self:
            assert self._kept is not None
            yield self._kept

    def _executor(self) -> Executor:
        if not self.processes:
            return ThreadPoolExecutor(self.count)
        from concurrent.futures import ProcessPoolExecutor  # here, since their imports take as long as some work
        from multiprocessing import get_context

        # Started afresh on every system: a copy of this process would have its locks, but not its threads.
        return ProcessPoolExecutor(self.count, mp_context=get_context("spawn"))


def threads() -> Workers:
    """One for each processor."""
    return Workers(os.cpu_count() or 1)


def several(workers: Workers | None, tasks: int) -> Workers | None:
    """The workers, where there are several, and so many tasks are worth their start or they have begun."""
    return workers if workers is not None and workers.count > 1 and (workers.begun or tasks > 2) else None


def side_by_side(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: Workers | None, told: Callable[[int], None]
) -> Generator[T, None, None]:
    """What the work gives for each task, in their order, as it is asked for; `told` how many are done.

    Without workers one after the other. Who asks for no more ends what has not begun. Threads begin when the first task
    is done, so that what all need is made once, and a task has taken `LONG`: short ones only wait for each other.
    """
    helpers, alone = several(workers, len(tasks)), 0
    while alone < len(tasks) and (helpers is None or not helpers.processes):
        begun = time.thread_time()
        found = work(*tasks[alone])
        long = time.thread_time() - begun >= LONG
        alone += 1
        told(alone)
        yield found
        if helpers is not None and long:
            break
    if helpers is None or alone == len(tasks):
        return
    with helpers.running() as executor:
        futures = [executor.submit(work, *task) for task in tasks[alone:]]
        waiting = set(futures)
        try:
            for one in futures:
                while one in waiting:
                    waiting = wait(waiting, return_when=FIRST_COMPLETED).not_done
                    told(len(tasks) - len(waiting))
                yield one.result()
        finally:
            for one in futures:
                one.cancel()
