"""Samples computed in batches, by any executor of concurrent.futures: here, in processes, or on a cluster.

Batches take about a second, so that handing them out costs little; a few are in flight, so that memory does not grow
with their number. A sample whose worker dies is identified, recorded and passed over.

Columns of a sample of a sweep, with units, as store, answers and Python have them; oil drag by temperature.
"""

import dataclasses
import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import nullcontext
from dataclasses import field
from itertools import islice
from typing import Any, Final, Literal, Protocol

from abu_calc.foundation.errors import AbuError, NotTrustworthyError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import end_processes, interrupts_left_to_parent, process_pool
from abu_calc.foundation.units import unit_of
from abu_calc.foundation.validity import Range

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


@dataclasses.dataclass
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


MEANT: Final = 40.0
"""Temperature [°C] at which the drag of a file is meant, that of the viscosity grades of ISO 3448."""
VISCOSITY: Final = ((40.0, 46.0), (100.0, 6.8))
"""Temperature [°C] and kinematic viscosity [mm²/s] of an oil ISO VG 46 with a viscosity index near 100."""
TEMPERATURE: Final = Range("temperature of the oil", -20.0, 120.0, unit="°C", key="start.temperature_C")
ADDED: Final = 0.7
"""mm²/s, of the double logarithm."""


@formula(
    "Viscous drag rate in oil at a temperature, relative to that at 40 °C",
    "ν_o(T_o)/ν_o(40 °C), lg lg(ν_o + 0.7) = A_o − B_o·lg T_o",
    "1",
    where="The equation takes ν_o in mm²/s. A_o and B_o follow from 46 at 40 °C and 6.8 at 100 °C (VG 46).",
    checked=(TEMPERATURE,),
    assumed="a mineral oil of viscosity index 100; drag rate proportional to viscosity (Stokes)",
    source="ASTM D341 (Walther 1931); ISO 3448 for the grade",
)
def drag_ratio(temperature: float) -> float:
    """
    >>> round(drag_ratio(40.0), 12), round(drag_ratio(100.0), 4)
    (1.0, 0.1478)
    """
    return _viscosity(TEMPERATURE.check(temperature)) / _viscosity(MEANT)


def _viscosity(temperature: float) -> float:
    (t1, v1), (t2, v2) = ((math.log10(t + 273.15), math.log10(math.log10(v + ADDED))) for t, v in VISCOSITY)
    slope = (v2 - v1) / (t2 - t1)
    return float(10 ** (10 ** (v1 + slope * (math.log10(temperature + 273.15) - t1))) - ADDED)


What = Literal["build", "design", "scene"]


@dataclass(frozen=True)
class SampleColumn:
    """One number of each member: its name (which ends in the unit), what it means."""

    name: str
    meaning: str

    @property
    def unit(self) -> str:
        """Unit as shown."""
        return unit_of(self.name)


LEVEL: Final = SampleColumn("level_db", "velocity level, idle, at the loudest handle")
QUIET: Final = SampleColumn("quiet_time_s", "from full speed until the level stays low")
TIMES: Final = (
    QUIET,
    SampleColumn("rest_time_s", "from full speed until the balls keep their places"),
    SampleColumn("settling_time_s", "from full speed until what is left stays near its end"),
)
LEFT: Final = SampleColumn("residual_imbalance_g_mm", "what balls leave of the imbalance")
BALANCES: Final = SampleColumn("balances", "1: the balls rest in their race, and what they leave is allowed")
MEETS: Final = SampleColumn("meets_limits", "1: it meets all of the limits")
SEED: Final = SampleColumn("seed", "of what is particular to the member: how its balls differ within their lot")
REASON: Final = SampleColumn("reason", "why there are no numbers")
MEMBER: Final = SampleColumn("member", "number of the member, from 0")

OUTSIDE: Final = "not computed: "
"""Start of reasons that lie outside the machine, in the computer: such members are tried again by the next run."""
OVERTIME: Final = "not done within "
"""Start of the reason of a member that took too long; the limit in seconds follows. A longer one tries it again."""
IMPATIENT: Final = OUTSIDE + "the seconds of --patience were over"
"""Reason of a member that the patience of its run left out; the next run computes it."""

QUANTITIES: Final[dict[What, tuple[SampleColumn, ...]]] = {
    "build": (
        LEVEL,
        *TIMES,
        SampleColumn("residual_um", "amplitude of the axis that stays"),
        LEFT,
        SampleColumn("capacity_ratio", "capacity over need"),
    ),
    "design": (
        SampleColumn("level_after_db", "level with the autobalancer, as expected"),
        SampleColumn("worst_level_db", "of the loudest start"),
        *(SampleColumn(f"worst_{column.name}", "of the slowest start") for column in TIMES),
        SampleColumn("ball_count", "balls"),
        SampleColumn("ball_diameter_mm", "their diameter"),
        SampleColumn("race_radius_mm", "radius of the race"),
        SampleColumn("mass_g", "mass with balls"),
        SampleColumn("capacity_ratio", "capacity over need"),
    ),
    "scene": (
        LEVEL,
        *TIMES,
        SampleColumn("axis_amplitude_mm", "amplitude of the axis that stays"),
        LEFT,
    ),
}
"""Numbers that percentiles are told of."""

FLAGS: Final[dict[What, tuple[SampleColumn, ...]]] = {
    "build": (
        BALANCES,
        SampleColumn("none_hangs", "1: no ball goes round behind the rotor at the end"),
        SampleColumn("meets_level", "1: the level is within limits.vibration_level_db"),
        SampleColumn("meets_settling", "1: it is quiet in time, and at rest if that is limited"),
        MEETS,
    ),
    "design": (MEETS,),
    "scene": (BALANCES, MEETS),
}
"""Conditions that are met or not; the last of them is all together."""

DECIDING: Final[dict[What, str]] = {"build": "level_db", "design": "level_after_db", "scene": "level_db"}
"""The number whose sensitivities are told first."""
