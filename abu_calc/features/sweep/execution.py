"""Workers of a sweep: this process, several, or another's executor; and their record in the store.

A Dask cluster as an executor of concurrent.futures: its address, its workers, their software, and its health.

Samples depend on software: abu-calc with its source, the compiler of its kernels, numerical libraries. So all workers
need the same.
"""

import importlib
import json
import logging
import os
import platform
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, suppress
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from itertools import islice
from pathlib import Path
from time import perf_counter
from typing import Any, Final

from abu_calc.features.sweep.batches import OUTSIDE, RenewableExecutor, Row, given, here, in_batches, processes
from abu_calc.features.sweep.batches import BatchStudy as Computed
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.store import Store
from abu_calc.features.sweep.store_faults import fault
from abu_calc.foundation.errors import AbuError, InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress
from abu_calc.inputs.reading.document import FileReading
from abu_calc.version import __version__

LIBRARIES: Final = ("numpy", "scipy", "llvmlite")
SOURCES: Final = (".py", ".toml", ".csv")
"""Suffixes of the files that numbers come from."""


def versions(*names: str) -> dict[str, str]:
    """Versions of this program and of libraries; "none" if a library is not installed."""
    return {"abu-calc": __version__, **{name: _version(name) for name in names}}


@cache
def software() -> dict[str, str]:
    """Versions here, with a digest of abu-calc's source: two states of one version compute different members."""
    return {**versions(*LIBRARIES), "source": _source()}


def worker_name() -> str:
    """Name of this process, as stores and errors give it."""
    return f"{platform.node()}:{os.getpid()}"


def differences_of_software(here: Mapping[str, str], there: Mapping[str, str]) -> str:
    """Differences of software, in words; empty if there are none.

    >>> differences_of_software({"numpy": "2.3", "scipy": "1.16"}, {"numpy": "2.1", "scipy": "1.16"})
    'numpy 2.1, here 2.3'
    """
    names = [name for name in dict.fromkeys((*here, *there)) if here.get(name) != there.get(name)]
    return ", ".join(f"{name} {there.get(name, 'unknown')}, here {here.get(name, 'unknown')}" for name in names)


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "none"


def _source() -> str:
    """Digest of the package's files, whatever a system ends their lines with; presets are input."""
    package, digest = Path(__file__).parents[2], sha256()
    for path in sorted(each for each in package.rglob("*") if each.suffix in SOURCES):
        parts = path.relative_to(package).parts
        if parts[0] != "presets":
            digest.update("/".join(parts).encode() + b"\0" + path.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return digest.hexdigest()[:12]


ANSWER_S: Final = 5.0
"""Seconds in which a scheduler that is alive answers."""
SHOWN: Final = 3
"""Workers that an error names."""
PLACE: Final = Place(key="cluster")


def client_of(executor: Executor) -> Any | None:
    """The client of a Dask cluster whose executor this is; None for any other executor."""
    return getattr(executor, "_client", None)


def threads_of(client: Any) -> int:
    """Number of samples that the cluster's workers compute side by side."""
    return int(sum(client.nthreads().values()))


def is_ours_to_end(executor: Executor) -> bool:
    """Tell whether processes of a Dask cluster compute the members, and are started anew when they end."""
    client = client_of(executor)
    if client is None:
        return False
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    return bool(workers) and all(worker.get("nanny") for worker in workers)


def is_alive(client: Any) -> bool:
    """Tell whether the scheduler answers and has workers."""
    if client.status != "running":
        return False
    try:
        return bool(client.sync(client.scheduler.ncores, callback_timeout=ANSWER_S))
    except Exception:  # of the connection, whichever its protocol raises
        return False


def refuse_other_software(client: Any) -> None:
    """Raise InputError that names the workers whose members would differ from those computed here."""
    refused = list(_refused(client.run(software, on_error="return")))
    if refused:
        more = f"; and {len(refused) - SHOWN} more" if len(refused) > SHOWN else ""
        raise InputError(
            "workers have other software than this process",
            place=PLACE,
            found="; ".join(refused[:SHOWN]) + more,
            remedy=f"Install abu-calc {software()['abu-calc']} with the same libraries on them, and restart them.",
        )


def _refused(answers: Mapping[str, Any]) -> Iterator[str]:
    for address, answer in answers.items():
        if not isinstance(answer, Mapping):
            yield f"{address}: {type(answer).__name__}: {answer}"
        elif different := differences_of_software(software(), answer):
            yield f"{address}: {different}"


CONNECT_S: Final = 10.0
"""Seconds to wait for a scheduler that has never answered: most often the address is wrong."""


@contextmanager
def executor(address: str, patience: float) -> Iterator[Executor]:
    """Compute on the workers of that scheduler, which need the same software; wait so long [s] for the first.

    Raises InputError.
    """
    try:
        distributed = importlib.import_module("distributed")
    except ImportError:
        raise InputError(
            "dask.distributed is not installed",
            place=Place(key="--cluster"),
            remedy='pip install "abu-calc[cluster]", here and on the workers.',
        ) from None
    # Dask reports each lost connection with a traceback; the command ends with a line of its own.
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with _connected(distributed, address, patience) as client:
            yield client.get_executor(pure=False)
    finally:
        logging.disable(before)


@contextmanager
def _connected(distributed: Any, address: str, patience: float) -> Iterator[Any]:
    """A client of the cluster, once it has a worker."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a table of versions, of which the sweep refuses those that matter
            client = distributed.Client(address, timeout=min(CONNECT_S, patience))
    except (OSError, TimeoutError, ValueError) as error:
        raise InputError(
            "no Dask scheduler answers there",
            place=Place(key="--cluster"),
            found=f"{address}: {str(error).splitlines()[0] if str(error) else type(error).__name__}",
            allowed="tcp://HOST:8786, as `dask scheduler` prints it",
        ) from None
    try:
        client._timeout = patience  # for which it looks for a scheduler that is gone
        try:
            client.wait_for_workers(1, timeout=patience)
        except TimeoutError:
            raise InputError(
                f"the cluster has had no workers for {patience:g} s",
                place=Place(key="--cluster"),
                found=address,
                remedy="Start some: dask worker ADDRESS. Or wait longer: --cluster-wait S.",
            ) from None
        yield client
    finally:
        client.close(timeout=CONNECT_S)


Take = Callable[[list[Row]], None]

SOON: Final = 6.0
"""Seconds of work that are left, below which starting processes is not worth the while."""
FIRST: Final = 4
"""Members that are computed here first: they make the compiled code for all, and tell how long one takes."""


@dataclass(frozen=True)
class Workers:
    """Number of processes that compute, or somebody's executor, with the longest wait for its workers [s]."""

    workers: int | None
    executor: Executor | None
    patience: float

    def refuse_other_software(self) -> None:
        """Raise InputError if workers of a cluster have other software than this process."""
        client = None if self.executor is None else client_of(self.executor)
        if client is not None:
            refuse_other_software(client)

    def executors(self) -> RenewableExecutor:
        """Source of their executors."""
        if self.executor is None:
            return here() if self.workers is None or self.workers < 2 else processes(self.workers)
        client = client_of(self.executor)
        count = getattr(self.executor, "_max_workers", None) or (threads_of(client) if client else os.cpu_count()) or 1
        alive = None if client is None else lambda: is_alive(client)
        ends = is_ours_to_end(self.executor)
        return given(self.executor, count, ends=ends, alive=alive, patience=self.patience)

    @property
    def described(self) -> str:
        """Description of the workers, for the store."""
        who = f"{self.workers or 1} of this machine" if self.executor is None else type(self.executor).__name__
        return f"{who}; Python {platform.python_version()}, {platform.system()} {platform.machine()}"

    @contextmanager
    def noted(self, store: Store, files: Sequence[FileReading], seed: int, command: str | None) -> Iterator[None]:
        """Note in the store who computes, from when until when."""
        store.begun({
            "file": ", ".join(each.file for each in files),
            "sha256": ", ".join(each.sha256 for each in files),
            "versions": json.dumps({**software(), **versions("distributed")}),
            "seed": seed,
            "command": command,
            "workers": self.described,
        })  # fmt: skip
        try:
            yield
        except BaseException:
            with suppress(AbuError):  # the first fault is the one to tell
                store.ended()
            raise
        store.ended()


def compute(study: SweepStudy, store: Store, hands: Workers, progress: Progress) -> None:
    """Put the missing members into the store as they come."""
    counted = _Counted(store.put, store.done, store.runs, progress, "sweep: {} of {} samples")
    _computed(study, store.missing(), counted, hands)
    if (there := store.ask("SELECT COUNT(*) FROM members")[0][0]) != store.runs:
        text = f"it has {there} samples and not {store.runs}: another program removed some"
        raise fault(store.path, text, "Go on with --resume.")


def once_more(
    study: Computed, numbers: Iterator[int], take: Take, count: int, hands: Workers, progress: Progress
) -> None:
    """Members beside those of the store."""

    def keep(rows: list[Row], *_: object) -> None:
        """Rows of a batch, whose further numbers nobody needs."""
        take(rows)

    counted = _Counted(keep, 0, count, progress, "sweep: trials of advice, {} of {}")
    _computed(study, numbers, counted, hands)


@dataclass(frozen=True)
class Attributed:
    """A study as workers get it: its rows come with who computed them. A worker with other software computes none."""

    study: Computed
    software: Mapping[str, str]

    def rows(self, members: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        """One entry: the worker, its software, the rows of the members."""
        if different := differences_of_software(self.software, software()):
            raise InputError(
                "a worker has other software than the process that asks it",
                place=PLACE,
                found=f"{worker_name()}: {different}",
                remedy=f"Install abu-calc {self.software['abu-calc']} with the same libraries there, and restart it.",
            )
        rows, seconds = self.study.rows(members, may_end_process)
        return [(worker_name(), {**software(), "python": platform.python_version()}, rows)], seconds

    def lost(self, member: int, reason: str) -> Row:
        """The entry of a member whose worker gave nothing: the next run tries it again."""
        return ("", None, [self.study.lost(member, OUTSIDE + reason)])


def _computed(study: Computed, missing: Iterator[int], counted: "_Counted", hands: Workers) -> None:
    workers, executor, study = hands.workers, hands.executor, Attributed(study, software())
    if executor is not None or workers is None or workers < 2:
        in_batches(study, missing, hands.executors(), counted)
        return
    begun = perf_counter()
    first = list(islice(missing, FIRST))
    for member in first:  # the last one shows what one takes when all is compiled
        begun = perf_counter()
        in_batches(study, iter([member]), here(), counted)
    left = (counted.of - counted.done) * (perf_counter() - begun)
    who = here() if left < SOON else processes(workers)
    try:
        in_batches(study, missing, who, counted)
    except BaseException:
        who.close(at_once=True)
        raise
    who.close()


class _Counted:
    """Takes rows: where they are kept, and says how far it is."""

    def __init__(self, take: Callable[..., None], done: int, of: int, progress: Progress, words: str) -> None:
        self.take, self.of, self.progress, self.words = take, of, progress, words
        self.before = self.done = done
        self.begun = perf_counter()

    def __call__(self, entries: list[Row]) -> None:
        for worker, its_software, rows in entries:
            self.take(rows, worker, its_software)
            self.done += len(rows)
        passed = perf_counter() - self.begun
        rate = (self.done - self.before) / max(passed, 1e-9)
        left = (self.of - self.done) / max(rate, 1e-9)
        self.progress(f"{self.words.format(self.done, self.of)}, {rate:.3g} a second, {duration(left)} left")


def duration(seconds: float) -> str:
    """Seconds as people say them.

    >>> duration(42), duration(200), duration(9000)
    ('42 s', '3.3 min', '2.5 h')
    """
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.1f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
