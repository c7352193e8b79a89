"""A Dask cluster by the address of its scheduler, as an executor of concurrent.futures."""

import importlib
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Final

from abu_calc.errors import InputError, Place

PATIENCE: Final = 10
"""Seconds to wait for the scheduler."""


@contextmanager
def executor(address: str) -> Iterator[Executor]:
    """Computes on the workers of that scheduler, which need abu-calc of the same version. Raises InputError."""
    try:
        distributed = importlib.import_module("distributed")
    except ImportError:
        raise InputError(
            "dask.distributed is not installed",
            place=Place(key="--cluster"),
            remedy='pip install "abu-calc[cluster]", here and on the workers.',
        ) from None
    try:
        client = distributed.Client(address, timeout=PATIENCE)
    except (OSError, TimeoutError, ValueError) as error:
        raise InputError(
            "no Dask scheduler answers there",
            place=Place(key="--cluster"),
            found=f"{address}: {str(error).splitlines()[0] if str(error) else type(error).__name__}",
            allowed="tcp://HOST:8786, as `dask scheduler` prints it",
        ) from None
    try:
        if not client.nthreads():
            raise InputError("the cluster has no workers", place=Place(key="--cluster"), found=address,
                             remedy="Start some: dask worker ADDRESS.")  # fmt: skip
        yield client.get_executor(pure=False)
    finally:
        client.close()
