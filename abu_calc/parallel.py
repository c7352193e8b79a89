"""The same work on many things, side by side on all processors; the outcome does not depend on how many there are."""

import os
import signal
import threading
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, ProcessPoolExecutor, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from multiprocessing import get_context, parent_process
from typing import Any, Self, TypeVar

T = TypeVar("T")


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

    def __exit__(self, kind: type[BaseException] | None = None, *_: object) -> None:
        if self._kept is not None:
            if kind is not None:
                end_processes(self._kept)
            self._kept.shutdown(wait=True, cancel_futures=True)
        self._kept, self.begun = None, False

    def begin(self, module: str) -> None:
        """Processes start and import a module while this one does something else."""
        if self._kept is not None and self.processes:
            with interrupts_left_to_parent():
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
        return process_pool(self.count)


def process_pool(count: int) -> ProcessPoolExecutor:
    """Processes started afresh on every system: a copy of this one would have its locks, but not its threads."""
    return ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=_begin)


@contextmanager
def interrupts_left_to_parent() -> Iterator[None]:
    """Processes started within never see Ctrl-C, not even while they start; this one sees it afterwards."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows, where they ignore it once they have started
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def end_processes(executor: Executor) -> None:
    """End the processes of a pool at once: nobody wants what they compute."""
    for process in list((getattr(executor, "_processes", None) or {}).values()):
        process.terminate()


def _begin() -> None:
    """A worker leaves Ctrl-C to the one who started it, and ends when that one does, however."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)


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
    is done, so that what all need is made once.
    """
    helpers = several(workers, len(tasks))
    alone = len(tasks) if helpers is None else 0 if helpers.processes else 1
    for done, task in enumerate(tasks[:alone], 1):
        found = work(*task)
        told(done)
        yield found
    if helpers is None:
        return
    with helpers.running() as executor:
        with interrupts_left_to_parent():
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
