"""The same work on many things, side by side in threads; the outcome does not depend on how many there are.

Compiled code lets go of the interpreter, so its runs go side by side. Plain Python gains nothing by threads.
"""

import os
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import Any, TypeVar

T = TypeVar("T")

LEAST_TASKS = 3
"""So many tasks are worth the start of threads."""


def processors() -> int:
    """How many threads of compiled code run at once."""
    return os.cpu_count() or 1


def side_by_side(
    work: Callable[..., T], tasks: Sequence[tuple[Any, ...]], workers: int, told: Callable[[int], None]
) -> Generator[T, None, None]:
    """What the work gives for each task, in their order, as it is asked for; `told` how many are done.

    By one worker one after the other. Who asks for no more ends what has not begun. Threads begin when the first task
    is done, so that what all need is made once.
    """
    alone = len(tasks) if workers == 1 or len(tasks) < LEAST_TASKS else 1
    for done, task in enumerate(tasks[:alone], 1):
        outcome = work(*task)
        told(done)
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
