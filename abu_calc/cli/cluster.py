"""A Dask cluster by the address of its scheduler, as an executor of concurrent.futures."""

import importlib
import logging
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Any, Final

from abu_calc.errors import InputError, Place

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
