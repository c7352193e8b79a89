"""What a sweep returns: its answers, and its members as arrays."""

import shutil
import sqlite3
import tempfile
import weakref
from collections.abc import Sequence
from dataclasses import field
from pathlib import Path
from typing import Annotated, Any, ClassVar

from numpy.typing import NDArray

from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.studies.result import Result
from abu_calc.studies.sweeping.columns import Column
from abu_calc.studies.sweeping.records import (
    Basin,
    Chart,
    Distribution,
    Failed,
    MeetsLimits,
    Percentiles,
    Price,
    Sensitivity,
)
from abu_calc.studies.sweeping.store import Store


@record
class Varied(Record):
    """One value that varied, and how."""

    key: Annotated[str, Quantity("value")]
    how: Annotated[str, Quantity("varies")]


class Members:
    """The members as arrays, read when asked for: `members["level_db"]`; `names` and `units` of all columns."""

    def __init__(self, store: Path, columns: Sequence[Column], runs: int, kept: object = None) -> None:
        self.store, self.names, self._runs, self._kept = store, tuple(one.name for one in columns), runs, kept
        self.units = {one.name: one.unit for one in columns}

    def __len__(self) -> int:
        return self._runs

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.names:
            raise KeyError(f"{name} is no column; there are {', '.join(self.names)}")
        store = Store(self.store, connection(self.store), self.names, self._runs)
        try:
            return store.column(name)
        finally:
            store.close()

    def __repr__(self) -> str:
        return f"Members({self._runs} of {', '.join(self.names)})"


class Kept:
    """A folder that is there as long as somebody holds this."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="abu-sweep-"))
        weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)


def connection(path: Path) -> sqlite3.Connection:
    """To a store that is there."""
    return sqlite3.connect(path, timeout=30)


@record
class SweepResult(Result):
    """What the members of a sweep say together."""

    command: ClassVar[str] = "sweep"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"members"}

    what: Annotated[str, Quantity("what each member is", "", 4, "build, design or scene")]
    runs: Annotated[int, Quantity("members")]
    seed: Annotated[int, Quantity("seed")]
    sampling: Annotated[str, Quantity("drawn by")]
    varied: tuple[Varied, ...]
    failed: Failed
    quantities: Annotated[dict[str, Percentiles], Quantity("percentiles")]
    distributions: Annotated[dict[str, Distribution], Quantity("distributions")]
    meets_limits: MeetsLimits
    basins: tuple[Basin, ...]
    sensitivity_of: Annotated[str | None, Quantity("number whose sensitivity stands first")]
    sensitivity: tuple[Sensitivity, ...]
    sensitivity_by_quantity: Annotated[dict[str, tuple[Sensitivity, ...]], Quantity("sensitivities by number")]
    unexplained: Annotated[
        dict[str, float], Quantity("unexplained", "", 3, "share of the variance that single values and pairs leave")
    ]
    prices: tuple[Price, ...]
    chart: Chart | None
    store: Annotated[str | None, Quantity("store")]
    members: Members = field(compare=False)
