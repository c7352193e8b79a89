"""The client of a Dask cluster, as `abu sweep --cluster` makes it."""

import sys
import warnings
from types import SimpleNamespace
from typing import Any

import pytest

from abu_calc.features.sweep.execution import executor


class Client:
    """A client that warns of versions as soon as it connects."""

    def __init__(self, address: str, timeout: float) -> None:
        warnings.warn(f"Mismatched versions found at {address}", UserWarning, stacklevel=2)

    def wait_for_workers(self, count: int, timeout: float) -> None:
        """There are some."""

    def get_executor(self, pure: bool) -> str:
        """The executor, by a name."""
        return "executor"

    def close(self, timeout: float) -> None:
        """Leave the cluster."""


def test_a_table_of_versions_is_not_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    """The sweep itself names workers whose software matters."""
    distributed: Any = SimpleNamespace(Client=Client)
    monkeypatch.setitem(sys.modules, "distributed", distributed)
    with executor("tcp://a:1", 1.0) as chosen:  # a warning would be an error here
        assert str(chosen) == "executor"
