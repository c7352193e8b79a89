"""Samples of a race: each is one machine of one variant, built and switched on once as a sample of `abu sweep` is.

Number k is sample k % MOST of variant k // MOST; numbers of fresh samples follow behind all others. The store is that
of sweeps; what is there is not computed again.
"""

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import field, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.sweep.batches import RenewableExecutor, Row, in_batches
from abu_calc.features.sweep.columns import (
    FLAGS,
    IMPATIENT,
    MEETS,
    MEMBER,
    OUTSIDE,
    QUANTITIES,
    REASON,
    SEED,
    SampleColumn,
)
from abu_calc.features.sweep.execution import Attributed, software
from abu_calc.features.sweep.plan import SweepRequest, planned
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.store import Store
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress
from abu_calc.inputs.read_machine import Machine

MOST: Final = 8192
"""Samples of one variant, in the race and fresh."""
COLUMNS: Final = (
    MEMBER, SEED, SampleColumn("variant", "number of the variant, from 0"), SampleColumn("sample", "its sample"),
    *QUANTITIES["build"], *FLAGS["build"], REASON,
)  # fmt: skip
NAMES: Final = tuple(column.name for column in COLUMNS)
KEPT: Final = len(QUANTITIES["build"]) + len(FLAGS["build"]) + 1
"""Last columns, which the rows of a sweep have alike."""
_STUDIES: Final[dict[tuple[str, int], SweepStudy]] = {}
MOST_STUDIES: Final = 4096

Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class VariantStudy:
    """All samples of all variants, sent to the workers; `key`: under which a process keeps what it has sized."""

    machines: tuple[Machine, ...]
    variants: tuple[tuple[int, tuple[tuple[str, Any], ...]], ...]
    """Machine of each variant, and its values."""
    requests: tuple[SweepRequest, ...]
    fresh: tuple[SweepRequest, ...]
    """Sampling of the race and of fresh samples, for each machine."""
    accuracy: float
    key: str
    until: float = field(default=math.inf, kw_only=True)

    def rows(self, numbers: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        """Rows of these samples, and the time for all [s]."""
        begun = time.perf_counter()
        rows = []
        for number in numbers:
            entry, sample = divmod(number, MOST)
            study = replace(self._study(entry), until=self.until)
            ((_, *row),), _ = study.rows((sample,), may_end_process)
            rows.append((number, row[0], entry % len(self.variants), sample, *row[-KEPT:]))
        return rows, time.perf_counter() - begun

    def lost(self, number: int, reason: str) -> Row:
        """The row of one that gave no numbers."""
        entry, sample = divmod(number, MOST)
        return (number, 0, entry % len(self.variants), sample, *(None,) * (KEPT - 1), reason)

    def _study(self, entry: int) -> SweepStudy:
        known = _STUDIES.get((self.key, entry))
        if known is None:
            if len(_STUDIES) >= MOST_STUDIES:
                _STUDIES.clear()
            machine, values = self.variants[entry % len(self.variants)]
            request = (self.fresh if entry >= len(self.variants) else self.requests)[machine]
            plan = planned(self.machines[machine].changed(dict(values)), request, self.accuracy)
            known = _STUDIES[self.key, entry] = plan.study
        return known


class SampleSource:
    """Answers which samples meet the limits, from the store or computed; all are kept in the store."""

    def __init__(self, study: VariantStudy, store: Store, workers: RenewableExecutor, progress: Progress) -> None:
        self.study, self.store, self.workers, self.progress = study, store, workers, progress
        self.computed = 0
        self.impatient = False
        self._meets = NAMES.index(MEETS.name)

    def __call__(self, orders: Sequence[tuple[int, int, int]]) -> list[Flags]:
        """The flags of samples first … last of variants."""
        return self._flags([(arm * MOST + first, arm * MOST + last) for arm, first, last in orders])

    def fresh(self, arm: int, count: int) -> Flags:
        """The flags of fresh samples of a variant."""
        first = (len(self.study.variants) + arm) * MOST
        return self._flags([(first, first + count)])[0]

    def _flags(self, ranges: Sequence[tuple[int, int]]) -> list[Flags]:
        missing = [number for first, last in ranges for number in self._missing(first, last)]
        if missing and not self.impatient:
            self._compute(missing)
        return [self._there(first, last) for first, last in ranges]

    def _missing(self, first: int, last: int) -> Iterator[int]:
        query = "SELECT member FROM members WHERE member >= ? AND member < ? AND COALESCE(reason, '') NOT LIKE ?"
        there = {row[0] for row in self.store.ask(query, (first, last, f"{OUTSIDE}%"))}
        return (number for number in range(first, last) if number not in there)

    def _there(self, first: int, last: int) -> Flags:
        query = "SELECT member, meets_limits, reason FROM members WHERE member >= ? AND member < ?"
        flags = np.zeros(last - first, dtype=np.bool_)
        for number, met, reason in self.store.ask(query, (first, last)):
            flags[number - first] = bool(met)
            self.impatient |= reason == IMPATIENT
        return flags

    def _compute(self, numbers: list[int]) -> None:
        before, total = self.computed, len(numbers)

        def take(entries: list[Row]) -> None:
            """Keep the rows of a batch, with who computed them."""
            for worker, its_software, rows in entries:
                self.store.put(rows, worker, its_software)
                self.computed += len(rows)
            done = self.computed - before
            self.progress(f"optimise: {done} of {total} samples of this round, {self.computed} in all")

        in_batches(Attributed(self.study, software()), iter(numbers), self.workers, take, size=4)
        if self.store.ask("SELECT COUNT(*) FROM members")[0][0] < total:
            raise NotTrustworthyError(f"{self.store.path}: another program removed samples")
