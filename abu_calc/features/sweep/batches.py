"""Samples computed in batches, by any executor of concurrent.futures: here, in processes, or on a cluster.

Batches take about a second, so that handing them out costs little; a few are in flight, so that memory does not grow
with their number. A sample whose worker dies is identified, recorded and passed over.
"""

import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import nullcontext
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, Final, Protocol

from abu_calc.foundation.errors import AbuError, NotTrustworthyError
from abu_calc.foundation.parallel import end_processes, interrupts_left_to_parent, process_pool

BATCH: Final = 1.0
MOST: Final = 512
"""Seconds that a batch should take, and the most members in one."""
RATE: Final = 32
"""Batches a second that one process hands out at ease, of some milliseconds each; for more workers they are longer."""
AHEAD: Final = 2
"""Batches in flight for each worker."""
LOOK_S: Final = 2.0
"""Seconds without a result after which it is looked whether anybody computes."""
TRIES: Final = 3
"""Most attempts to hand out a batch that an executor returns uncomputed."""
ENDED: Final = "the process that computed it ended"
KILLED: Final = "KilledWorker"
"""Name of the Dask exception that is raised once several of its workers ended on the same sample."""

Row = tuple[Any, ...]


class BatchStudy(Protocol):
    """Computation of a sweep, sent to the workers with each batch."""

    def rows(self, members: tuple[int, ...], may_end_process: bool) -> tuple[list[Row], float]:
        """Results of each sample, and the seconds that they took."""

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
    """Source of executors: `make` creates one, `count` workers run at once.

    `own`: this program may close the executor and make a new one. `ends`: its workers are processes that
    may be ended if they hang, since others take their place. `alive`: asks whether any worker is there;
    without one for `patience` seconds, waiting ends.
    """

    make: Callable[[], Executor]
    count: int = 1
    own: bool = True
    ends: bool = False
    alive: Callable[[], bool] | None = None
    patience: float = math.inf
    _executor: Executor | None = field(default=None, init=False)
    _seen: float = field(default=-math.inf, init=False)

    @property
    def executor(self) -> Executor:
        """Made when it is first needed."""
        if self._executor is None:
            self._executor = self.make()
        return self._executor

    def renew(self) -> None:
        """Discard the executor after one of its processes ended, so that a new one is made.

        Raises NotTrustworthyError if the executor belongs to the caller.
        """
        if not self.own:
            raise NotTrustworthyError("the executor is broken, so no more samples can be computed")
        self.close()

    def look(self) -> bool:
        """Tell whether anybody computes. Raises NotTrustworthyError if nobody has for too long."""
        if self.alive is None or self.alive():
            self._seen = math.inf
            return True
        now = time.monotonic()
        self._seen = now if math.isinf(self._seen) else self._seen
        if now - self._seen >= self.patience:
            gone = f"the cluster has had no scheduler or no worker for {self.patience:g} s"
            raise NotTrustworthyError(f"{gone}; no more samples are computed")
        return False

    def close(self, *, at_once: bool = False) -> None:
        """No more is wanted; `at_once`: nor is what is under way."""
        if self._executor is not None and self.own:
            if at_once:
                end_processes(self._executor)
            self._executor.shutdown(wait=True, cancel_futures=True)
        self._executor = None


def here() -> RenewableExecutor:
    """Return an executor that uses this process alone."""
    return RenewableExecutor(Here)


def processes(count: int) -> RenewableExecutor:
    """Return an executor of `count` processes, started afresh on every system."""
    return RenewableExecutor(lambda: process_pool(count), count, ends=True)


def given(
    executor: Executor, count: int, *, ends: bool = False, alive: Callable[[], bool] | None = None,
    patience: float = math.inf,
) -> RenewableExecutor:  # fmt: skip
    """Somebody else's; `ends`: of processes that their owner starts anew when they end."""
    return RenewableExecutor(lambda: executor, count, own=False, ends=ends, alive=alive, patience=patience)


def in_batches(
    study: BatchStudy,
    members: Iterator[int],
    workers: RenewableExecutor,
    take: Callable[[list[Row]], None],
    size: int = 1,
) -> None:
    """Computes all members; `take` gets rows as they come, in any order. `size` of the first batch."""
    waiting: dict[Future[Any], tuple[int, ...]] = {}
    back: list[tuple[int, ...]] = []
    tries = Counter[int]()
    lasting = max(BATCH, workers.count / RATE)
    ahead = AHEAD * workers.count if not isinstance(workers.executor, Here) else 1
    try:
        while True:
            while len(waiting) < ahead and (batch := back.pop() if back else tuple(islice(members, size))):
                waiting[_submit(study, batch, workers)] = batch
            if not waiting:
                return
            suspects: list[tuple[int, ...]] = []
            done = wait(waiting, timeout=LOOK_S, return_when=FIRST_COMPLETED).done
            if not done:
                workers.look()
            for future in done:
                batch = waiting.pop(future)
                if not workers.own and future.cancelled():
                    _await(workers, batch[0], tries)
                    back.append(batch)
                    continue
                if future.cancelled() or _error(future) is not None:
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


def _submit(study: BatchStudy, batch: tuple[int, ...], workers: RenewableExecutor) -> Future[Any]:
    try:
        with interrupts_left_to_parent() if workers.own and workers.ends else nullcontext():
            return workers.executor.submit(study.rows, batch, workers.ends)
    except ImportError as error:
        raise _unloadable(error) from error
    except BrokenExecutor as error:
        broken: Future[Any] = Future()
        broken.set_exception(error)
        return broken
    except RuntimeError:  # closed, or without a connection
        if workers.own:
            raise
        returned: Future[Any] = Future()
        returned.cancel()
        returned.set_running_or_notify_cancel()
        return returned


def _error(future: Future[Any]) -> BaseException | None:
    """The error of a batch. Raises an error that has no member as its reason: whoever computes cannot compute any."""
    error = future.exception()
    if isinstance(error, AbuError):
        raise error
    if isinstance(error, ImportError):
        raise _unloadable(error)
    return error


def _unloadable(error: ImportError) -> NotTrustworthyError:
    return NotTrustworthyError(
        f"a library cannot be loaded where samples are computed: {error}\n"
        "  Install abu-calc of this version there, and resume. The samples under way are not recorded."
    )


def _await(workers: RenewableExecutor, member: int, tries: Counter[int]) -> None:
    """Wait until any worker is there, before a batch that came back uncomputed is handed out again."""
    tries[member] += 1
    if tries[member] > TRIES:
        raise NotTrustworthyError("the executor cancels what it is given, so no more samples are computed")
    while not workers.look():
        time.sleep(LOOK_S / 4)


def _stopped(waiting: dict[Future[Any], tuple[int, ...]], workers: RenewableExecutor) -> list[tuple[int, ...]]:
    """Batches that a pool of ours took with it when it broke, each of which may be the reason."""
    if not workers.own:
        return []
    wait(waiting)
    gone = [future for future in waiting if future.cancelled() or isinstance(future.exception(), BrokenExecutor)]
    return [waiting.pop(future) for future in gone]


def _alone(study: BatchStudy, member: int, workers: RenewableExecutor) -> Future[Any]:
    """A batch of one member, done."""
    tries = Counter[int]()
    while True:
        future = _submit(study, (member,), workers)
        while not wait([future], timeout=LOOK_S).done:
            workers.look()
        if workers.own or not future.cancelled():
            return future
        _await(workers, member, tries)


def _one_by_one(
    study: BatchStudy, batches: list[tuple[int, ...]], workers: RenewableExecutor, take: Callable[[list[Row]], None]
) -> None:
    """Members one after the other, so that it is seen whom it ends; that one is recorded with the reason."""
    broken = workers.own
    for member in (number for batch in batches for number in batch):
        if broken:
            workers.renew()
        future = _alone(study, member, workers)
        error = _error(future)
        broken = isinstance(error, BrokenExecutor)
        if error is None:
            take(future.result()[0])
        else:
            ended = broken or type(error).__name__ == KILLED
            take([study.lost(member, ENDED if ended else f"{type(error).__name__}: {error}".splitlines()[0])])
    if broken:
        workers.renew()
