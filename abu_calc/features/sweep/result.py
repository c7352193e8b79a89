"""Result of a sweep: its answers, and its samples as arrays."""

import os
import shutil
import tempfile
import weakref
from collections.abc import Iterator, Sequence
from dataclasses import field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final

from numpy.typing import NDArray

from abu_calc.features.sweep.batches import MEMBER, SEED, SampleColumn
from abu_calc.features.sweep.store import Store, connected
from abu_calc.features.sweep.store_faults import faults_of
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.rows import Columns
from abu_calc.simulation.result import Result

if TYPE_CHECKING:
    from xarray import Dataset


@record
class Percentiles(Record):
    """Percentiles of one number over all members that gave one; null where it is later or more than any number."""

    p05: Annotated[float | None, Quantity("5 %")]
    p50: Annotated[float | None, Quantity("50 %")]
    p95: Annotated[float | None, Quantity("95 %")]
    mean: Annotated[float | None, Quantity("mean")]


@record
class Distribution(Record):
    """The value that a number keeps in so many of the members: its percentiles from the least to the greatest."""

    percent: Annotated[tuple[float, ...], Quantity("share of members", "", 4, "in hundredths, ascending")]
    values: Annotated[
        tuple[float | None, ...], Quantity("at most", "", 4, "in the unit of the number; null: later or more than any")
    ]
    limit: Annotated[float | None, Quantity("limit", "", 4, "of the file, which it must not exceed")]


@record
class Basin(Record):
    """Share of the start cases of one kind that balances."""

    start: Annotated[str, Quantity("start")]
    share: Annotated[float, Quantity("balances", "", 4, "", percent=True)]
    confidence_interval: Annotated[tuple[float, float], Quantity("95 % confidence", "", 4, "", percent=True)]
    met: Annotated[int, Quantity("that balance")]
    of: Annotated[int, Quantity("members")]


@record
class LimitShare(Record):
    """Share of all samples; one without an answer counts as not met."""

    schema_title: ClassVar[str] = "Share"

    share: Annotated[float, Quantity("share", "", 4, "", percent=True)]
    confidence_interval: Annotated[
        tuple[float, float], Quantity("95 % confidence", "", 4, "Clopper and Pearson 1934", percent=True)
    ]
    met: Annotated[int, Quantity("that meet it")]
    of: Annotated[int, Quantity("members")]


@record
class MeetsLimits(Record):
    """The share that meets all limits, and that of each."""

    share: Annotated[float, Quantity("meet the limits", "", 4, "", percent=True)]
    confidence_interval: Annotated[tuple[float, float], Quantity("95 % confidence", "", 4, "", percent=True)]
    met: Annotated[int, Quantity("that meet them")]
    of: Annotated[int, Quantity("members")]
    each: Annotated[dict[str, LimitShare], Quantity("each of them")]


@record
class Failure(Record):
    """Members without numbers, for one reason."""

    reason: Annotated[str, Quantity("reason")]
    members: Annotated[int, Quantity("members")]
    first: Annotated[int, Quantity("first of them")]


@record
class Failed(Record):
    """Members that gave no number to be trusted."""

    members: Annotated[int, Quantity("members without numbers")]
    reasons: tuple[Failure, ...]


@record
class Sensitivity(Record):
    """Shares of the variance of a number that one value decides, alone and with all others."""

    key: Annotated[str, Quantity("value")]
    first_order: Annotated[float, Quantity("alone", "S", 2)]
    total: Annotated[float, Quantity("in all", "S_T", 2)]


@record
class Price(Record):
    """Price of one value: the level that 95 % of samples keep if it stays in its better or worse half.

    The samples that lie there give it. `loosened_db`: rise of the level if the scatter is doubled, of samples
    that were computed once more for that; `loosened_fail`: how many more of them miss a limit than before.
    """

    key: Annotated[str, Quantity("value")]
    better: Annotated[str, Quantity("better half", "", 4, "lower or upper")]
    median: Annotated[float, Quantity("where the halves meet")]
    gain_db: Annotated[float, Quantity("the better half lowers it by", "", 2)]
    cost_db: Annotated[float | None, Quantity("the worse half raises it by", "", 2)]
    within_chance: Annotated[bool, Quantity("no more than chance may do")]
    loosened_to: Annotated[str | None, Quantity("tried with", "", 4, "twice the scatter")] = None
    loosened_db: Annotated[float | None, Quantity("twice the scatter raises it by", "", 2)] = None
    loosened_fail: Annotated[int | None, Quantity("more that miss a limit")] = None
    loosened_of: Annotated[int | None, Quantity("members computed once more")] = None
    advice: Annotated[str, Quantity("advice", "", 4, "tighten, may be loosened, or nothing")]


@record
class DecidingValue(Record):
    """A value that decides the margin of a failed limit: its share of the margin's variance, with others."""

    key: Annotated[str, Quantity("value")]
    total: Annotated[float, Quantity("of the margin", "S_T", 2)]
    fails_at: Annotated[str, Quantity("fails at", "", 4, "high values, low values, or a choice")]


@record
class FailedLimit(Record):
    """A limit that samples fail, and the values that decide its margin."""

    limit: Annotated[str, Quantity("limit")]
    failed: Annotated[int, Quantity("samples that fail it")]
    of: Annotated[int, Quantity("samples")]
    decides: tuple[DecidingValue, ...]


@record
class LimitAdvice(Record):
    """A change that was tried on the same samples and raises the share that meets all limits.

    `set` goes to `--set`, `vary` to `--vary`; `next`: the command that repeats the sweep with them. `limits`: samples
    that fail each limit, before and after.
    """

    change: Annotated[str, Quantity("change")]
    set_: Annotated[dict[str, Any], Quantity("values to set")]
    vary: Annotated[dict[str, str], Quantity("distributions to set")]
    before: Annotated[float, Quantity("share before", "", 4, "", percent=True)]
    after: Annotated[float, Quantity("share after", "", 4, "", percent=True)]
    of: Annotated[int, Quantity("samples tried")]
    limits: Annotated[dict[str, tuple[int, int]], Quantity("samples that fail each limit")]
    next: Annotated[str, Quantity("next command")]


@record
class Chart(Record):
    """The share that balances (or of designs, that passes) and the mean level over two keys, `shares[y][x]`."""

    x_key: Annotated[str, Quantity("across")]
    y_key: Annotated[str, Quantity("upward")]
    x: Annotated[tuple[float | str, ...], Quantity("values across")]
    y: Annotated[tuple[float | str, ...], Quantity("values upward")]
    of: Annotated[str, Quantity("what is shared")]
    shares: Annotated[tuple[tuple[float | None, ...], ...], Quantity("shares", "", 3, "null: no member gave an answer")]
    meets: Annotated[
        tuple[tuple[float | None, ...], ...] | None, Quantity("shares that meet all limits", "", 3, "null: as `shares`")
    ]
    levels_db: Annotated[tuple[tuple[float | None, ...], ...] | None, Quantity("mean levels")]


@record
class Varied(Record):
    """One value that varied, and how."""

    key: Annotated[str, Quantity("value")]
    how: Annotated[str, Quantity("varies")]


WHOLE: Final = frozenset({MEMBER.name, SEED.name})
"""Columns of whole numbers."""


class Members(Columns):
    """The members as arrays, read when asked for: `members["level_db"]`; `names` and `units` of all columns.

    They are a table, too: `for member in members` gives dictionaries, `to_pandas()` and `polars.DataFrame(members)`
    all columns, `to_xarray()` a data set with units. Missing numbers are NaN.

    A copy that is pickled carries them if their store is a temporary one; else it reads the store that was named.
    """

    def __init__(self, store: Path, columns: Sequence[SampleColumn], runs: int, kept: object = None) -> None:
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

    @property
    def columns(self) -> dict[str, list[Any]]:
        """Values of each column by its name, as Python's own numbers and texts."""
        return {
            name: [int(value) for value in self[name]] if name in WHOLE else self[name].tolist() for name in self.names
        }

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def to_xarray(self) -> "Dataset":
        """An xarray.Dataset over the dimension `member`. Raises OutputError if xarray is not installed."""
        from abu_calc.foundation.arrays import dataset

        index, *others = self.names
        return dataset({index: self[index].astype(int)}, {name: ((index,), self[name]) for name in others}, self.units)

    def __repr__(self) -> str:
        return f"<Members {self._runs} × {', '.join(self.names)}>"


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
    failed_limits: tuple[FailedLimit, ...]
    advice: tuple[LimitAdvice, ...]
    tried: Annotated[int, Quantity("changes tried for failed limits")]
    chart: Chart | None
    store: Annotated[str | None, Quantity("store")]
    members: Members = field(compare=False)
