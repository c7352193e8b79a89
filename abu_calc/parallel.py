"""The same work on many things, side by side in threads; the outcome does not depend on how many there are.

Compiled code lets go of the interpreter, so its runs go side by side. Plain Python gains nothing by threads.
"""

import os
import time
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Any, TypeVar

T = TypeVar("T")

LONG = 0.05
"""Processor time [s] of a task that is worth threads: most of a shorter one holds the interpreter."""


def processors() -> int:
    """How many threads of compiled code run at once."""
    return os.cpu_count() or 1


def side_by_side(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: int, told: Callable[[int], None]
) -> Generator[T, None, None]:
    """What the work gives for each task, in their order, as it is asked for; `told` how many are done.

    By one worker one after the other. Who asks for no more ends what has not begun. Threads begin when the first task
    is done, so that what all need is made once, and when a task has taken `LONG`: short ones only wait for each other.
    """
    alone, long = 0, False
    while alone < len(tasks) and not (workers > 1 and long):
        begun = time.thread_time()
        outcome = work(*tasks[alone])
        long = time.thread_time() - begun >= LONG
        alone += 1
        told(alone)
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
                    told(len(tasks) - len(waiting))
                yield future.result()
        finally:
            for future in futures:
                future.cancel()
