"""Return value of a sweep: its answers, and its samples as arrays."""

import os
import shutil
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
from abu_calc.studies.sweeping.store import Store, connected
from abu_calc.studies.sweeping.store_faults import faults_of


@record
class Varied(Record):
    """One value that varied, and how."""

    key: Annotated[str, Quantity("value")]
    how: Annotated[str, Quantity("varies")]


class Members:
    """The members as arrays, read when asked for: `members["level_db"]`; `names` and `units` of all columns.

    A copy that is pickled carries them if their store is a temporary one; else it reads the store that was named.
    """

    def __init__(self, store: Path, columns: Sequence[Column], runs: int, kept: object = None) -> None:
        self.store, self.names, self._runs, self._kept = store, tuple(column.name for column in columns), runs, kept
        self.units = {column.name: column.unit for column in columns}
        self._carried: dict[str, NDArray[Any]] = {}

    def __getstate__(self) -> dict[str, Any]:
        carried = self._carried if self._kept is None else {name: self[name] for name in self.names}
        return {**vars(self), "store": self.store.absolute(), "_kept": None, "_carried": carried}

    def __len__(self) -> int:
        return self._runs

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.names:
            raise KeyError(f"{name} is no column; there are {', '.join(self.names)}")
        if name in self._carried:
            return self._carried[name].copy()
        with faults_of(self.store):
            store = Store(self.store, connected(self.store), self.names, self._runs)
            try:
                return store.column(name)
            finally:
                store.close()

    def __repr__(self) -> str:
        return f"Members({self._runs} of {', '.join(self.names)})"


class Kept:
    """A folder that is there as long as somebody in this process holds this; its forks leave it alone."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="abu-sweep-"))
        weakref.finalize(self, _remove, self.folder, os.getpid())


def _remove(folder: Path, owner: int) -> None:
    if os.getpid() == owner:
        shutil.rmtree(folder, ignore_errors=True)


@record
class SweepResult(Result):
    """Common answers of a sweep's samples."""

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
