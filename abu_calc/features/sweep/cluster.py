"""A Dask cluster as an executor of concurrent.futures: its address, its workers, their software, and its health.

Samples depend on software: abu-calc with its source, the compiler of its kernels, numerical libraries. So all workers
need the same.
"""

import importlib
import logging
import os
import platform
import warnings
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from contextlib import contextmanager
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Final

from abu_calc.foundation.errors import InputError, Place
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
