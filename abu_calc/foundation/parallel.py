"""The same work on many things: side by side in threads for compiled code, and pools of processes for any other.

Compiled code lets go of the interpreter, so its runs go side by side in threads. Plain Python gains nothing by them.
The outcome does not depend on the number of threads.
"""

import os
import signal
import threading
import time
import warnings
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from functools import cache, partial
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor

T = TypeVar("T")

LONG = 0.01
"""Processor time [s] of a task that is worth threads: most of a shorter one holds the interpreter."""


def processors() -> int:
    """Number of threads of compiled code that run at once."""
    return os.cpu_count() or 1


def side_by_side(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: int, report: Callable[[int], None]
) -> Generator[T, None, None]:
    """Yield the result of the work for each task, in the order of the tasks, as it is asked for.

    `told` is called with the number of tasks done. One worker does the tasks one after the other. A caller that
    asks for no more ends the tasks that have not begun. Threads begin after the first task, so that the data
    all tasks need is made once. They also wait until a task has taken `LONG`: short tasks only wait for each
    other.
    """
    alone, long = 0, False
    while alone < len(tasks) and not (workers > 1 and long):
        begun = time.thread_time()
        outcome = work(*tasks[alone])
        long = time.thread_time() - begun >= LONG
        alone += 1
        report(alone)
        yield outcome
    if alone == len(tasks):
        return
    with ThreadPoolExecutor(workers) as executor:
        futures = [executor.submit(work, *task) for task in tasks[alone:]]
        waiting = set(futures)
        try:
            for future in futures:
                while future in waiting:
                    waiting = wait(waiting, return_when=FIRST_COMPLETED).not_done
                    report(len(tasks) - len(waiting))
                yield future.result()
        finally:
            for future in futures:
                future.cancel()


def meanwhile(work: Callable[..., T], *given: Any, workers: int) -> Callable[[], T]:
    """Begin a task in a thread of its own, and return the function that waits for its outcome, or raises its error.

    One worker: the task is done when its outcome is asked for. An interrupted program does not wait for the thread.
    """
    if workers == 1:
        return cache(partial(work, *given))
    future = Future[T]()

    def run() -> None:
        """Keep the outcome, or the error, for the thread that asks for it."""
        try:
            future.set_result(work(*given))
        except BaseException as error:
            future.set_exception(error)

    threading.Thread(target=run, daemon=True).start()
    return future.result


def process_pool(count: int) -> "ProcessPoolExecutor":
    """Processes started afresh on every system: a copy of this one would have its locks, but not its threads."""
    from concurrent.futures import ProcessPoolExecutor  # here, since their imports take as long as some work
    from multiprocessing import get_context

    return ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=begin_worker)


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


def begin_worker() -> None:
    """A worker leaves Ctrl-C to the one who started it, and ends when that one does, however."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # The process that began them says once what there is to say of compiled code.
    warnings.filterwarnings("ignore", message="compiled code")
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    from multiprocessing import parent_process

    parent = parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)
