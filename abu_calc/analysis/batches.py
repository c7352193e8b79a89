"""Many members in batches, by any executor of concurrent.futures: here, in processes, or on a cluster.

Batches take about a second, so that handing them out costs little; a few are in flight, so that memory does not grow
with their number. Who dies while computing is found, recorded and passed over.
"""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass, field
from itertools import islice
from multiprocessing import get_context, parent_process
from typing import Any, Final, Protocol

from abu_calc.errors import NotTrustworthyError

BATCH: Final = 1.0
MOST: Final = 512
"""Seconds that a batch should take, and the most members in one."""
RATE: Final = 32
"""Batches a second that one process hands out at ease, of some milliseconds each; for more workers they are longer."""
AHEAD: Final = 2
"""Batches in flight for each worker."""
ENDED: Final = "the process that computed it ended"
KILLED: Final = "KilledWorker"
"""What Dask raises once some of its workers ended on the same member."""

Row = tuple[Any, ...]


class Study(Protocol):
    """What is computed: sent to the workers with each batch."""

    def rows(self, members: tuple[int, ...], may_end_process: bool) -> tuple[list[Row], float]:
        """What each member came to, and the seconds that it took."""

    def lost(self, member: int, reason: str) -> Row:
        """The row of a member that gave nothing."""


class Here(Executor):
    """Computes in this process, at once."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Done when it returns."""
        done: Future[Any] = Future()
        done.set_result(fn(*args, **kwargs))
        return done


@dataclass
class RenewableExecutor:
    """Who computes: `make` an executor, and how many work at once; `own`: it is ours to close and to make anew.

    `ends`: whoever computes is a process that may be ended when it hangs, since another takes its place.
    """

    make: Callable[[], Executor]
    count: int = 1
    own: bool = True
    ends: bool = False
    _executor: Executor | None = field(default=None, init=False)

    @property
    def executor(self) -> Executor:
        """Made when it is first needed."""
        if self._executor is None:
            self._executor = self.make()
        return self._executor

    def renew(self) -> None:
        """After a process of ours ended, and the pool with it. Raises NotTrustworthyError where it is another's."""
        if not self.own:
            raise NotTrustworthyError("the executor is broken, so no more members can be computed")
        self.close()

    def close(self) -> None:
        """No more is wanted."""
        if self._executor is not None and self.own:
            self._executor.shutdown(wait=True, cancel_futures=True)
        self._executor = None


def here() -> RenewableExecutor:
    """This process alone."""
    return RenewableExecutor(Here)


def processes(count: int) -> RenewableExecutor:
    """So many processes, started afresh on every system."""

    def pool() -> Executor:
        return ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=_begin)

    return RenewableExecutor(pool, count, ends=True)


def given(executor: Executor, count: int, *, ends: bool = False) -> RenewableExecutor:
    """Somebody else's; `ends`: of processes that their owner starts anew when they end."""
    return RenewableExecutor(lambda: executor, count, own=False, ends=ends)


def _begin() -> None:
    """A worker leaves Ctrl-C to the one who started it, and ends when that one does, however."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)


def in_batches(
    study: Study, members: Iterator[int], workers: RenewableExecutor, take: Callable[[list[Row]], None], size: int = 1
) -> None:
    """Computes all members; `take` gets rows as they come, in any order. `size` of the first batch."""
    waiting: dict[Future[Any], tuple[int, ...]] = {}
    lasting = max(BATCH, workers.count / RATE)
    ahead = AHEAD * workers.count if not isinstance(workers.executor, Here) else 1
    try:
        while True:
            while len(waiting) < ahead and (batch := tuple(islice(members, size))):
                waiting[_submit(study, batch, workers)] = batch
            if not waiting:
                return
            suspects: list[tuple[int, ...]] = []
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                batch = waiting.pop(future)
                if future.cancelled() or future.exception() is not None:
                    suspects.append(batch)
                    continue
                rows, seconds = future.result()
                take(rows)
                size = max(1, min(2 * size, MOST, int(lasting * len(batch) / max(seconds, 1e-9))))
            if suspects:
                _one_by_one(study, [*suspects, *_stopped(waiting, workers)], workers, take)
    finally:
        for future in waiting:
            future.cancel()


def _submit(study: Study, batch: tuple[int, ...], workers: RenewableExecutor) -> Future[Any]:
    try:
        return workers.executor.submit(study.rows, batch, workers.ends)
    except BrokenExecutor as error:
        broken: Future[Any] = Future()
        broken.set_exception(error)
        return broken


def _stopped(waiting: dict[Future[Any], tuple[int, ...]], workers: RenewableExecutor) -> list[tuple[int, ...]]:
    """Batches that a pool of ours took with it when it broke, each of which may be the reason."""
    if not workers.own:
        return []
    wait(waiting)
    gone = [future for future in waiting if future.cancelled() or isinstance(future.exception(), BrokenExecutor)]
    return [waiting.pop(future) for future in gone]


def _one_by_one(
    study: Study, batches: list[tuple[int, ...]], workers: RenewableExecutor, take: Callable[[list[Row]], None]
) -> None:
    """Members one after the other, so that it is seen whom it ends; that one is recorded with the reason."""
    broken = workers.own
    for member in (one for batch in batches for one in batch):
        if broken:
            workers.renew()
        future = _submit(study, (member,), workers)
        error = future.exception()
        broken = isinstance(error, BrokenExecutor)
        if error is None:
            take(future.result()[0])
        else:
            ended = broken or type(error).__name__ == KILLED
            take([study.lost(member, ENDED if ended else f"{type(error).__name__}: {error}".splitlines()[0])])
    if broken:
        workers.renew()
