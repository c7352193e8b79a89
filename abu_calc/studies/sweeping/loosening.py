"""Values that decide nothing, each tried with twice its scatter: the same members, computed once more."""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from abu_calc.analysis.batches import Row
from abu_calc.analysis.sampling import Sample
from abu_calc.frozen import dataclass
from abu_calc.spec.variation import Variation
from abu_calc.studies.sweeping.columns import DECIDING, IMPATIENT, MEETS
from abu_calc.studies.sweeping.members import Study
from abu_calc.studies.sweeping.store import Store, quoted

LEAST: Final = 64
MOST: Final = 128
"""Members of a trial."""
PART: Final = 0.5
"""All trials together have no more members than this part of the sweep."""
KEPT: Final = 0.95

Numbers = tuple[float | None, ...]
Compute = Callable[["Trials", Iterator[int], Callable[[list[Row]], None]], None]


class Loosened(NamedTuple):
    """By how much the level rises that 95 % of these members keep [dB], and how many more of them miss a limit."""

    way: str
    rise: float | None
    fail: int
    members: int


@dataclass(frozen=True)
class Trials:
    """A study of studies: number k is member `members[k % n]` of the trial k // n."""

    studies: tuple[Study, ...]
    members: tuple[int, ...]

    def rows(self, numbers: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        """What each came to, its number in place of the member's, and how long all took [s]."""
        begun, rows = time.perf_counter(), []
        for number in numbers:
            study, member = self._of(number)
            ((_, *row),), _ = study.rows((member,), may_end_process)
            rows.append((number, *row))
        return rows, time.perf_counter() - begun

    def lost(self, number: int, reason: str) -> Row:
        """The row of one that gave no numbers."""
        study, member = self._of(number)
        return (number, *study.lost(member, reason)[1:])

    def _of(self, number: int) -> tuple[Study, int]:
        trial, member = divmod(number, len(self.members))
        return self.studies[trial], self.members[member]


def loosened(study: Study, store: Store, keys: Sequence[str], compute: Compute) -> dict[str, Loosened]:
    """Each of these values with twice its scatter, as many as are cheap beside the sweep; of the others nothing.

    Nor of trials that patience left out.
    """
    many = int(min(MOST, max(LEAST, PART * store.drawn // max(len(keys), 1))))
    keys = keys[: int(PART * store.drawn) // many]
    if not keys:
        return {}
    # At random: listed values come round and round.
    drawn = np.random.default_rng(study.sample.seed).choice(store.drawn, many, replace=False)
    members = tuple(sorted(drawn.tolist()))
    trials = Trials(tuple(replace(study, sample=_doubled(study.sample, key)) for key in keys), members)
    computed: dict[int, Row] = {}
    compute(trials, iter(range(len(keys) * many)), lambda rows: computed.update({row[0]: row for row in rows}))
    names = [DECIDING[study.what], MEETS.name]
    places = [store.names.index(name) for name in names]
    before = _before(store, names, members)
    kept = [key for k, key in enumerate(keys) if all(computed[k * many + j][-1] != IMPATIENT for j in range(many))]
    after = {k: tuple(row[place] for place in places) for k, row in computed.items()}
    return {
        key: _compared(_way(trials.studies[k].sample, key).text, before, [after[k * many + j] for j in range(many)])
        for k, key in enumerate(keys)
        if key in kept
    }


def _way(sample: Sample, key: str) -> Variation:
    return next(factor.variation for factor in sample.factors if factor.key == key)


def _before(store: Store, names: Sequence[str], members: Sequence[int]) -> list[Numbers]:
    columns = ", ".join(map(quoted, names))
    query = f"SELECT {columns} FROM members WHERE member IN ({', '.join(map(str, members))}) ORDER BY member"
    return store.ask(query)


def _compared(way: str, before: Sequence[Numbers], after: Sequence[Numbers]) -> Loosened:
    was, now = _kept([level for level, _ in before]), _kept([level for level, _ in after])
    fail = sum(bool(met) for _, met in before) - sum(bool(met) for _, met in after)
    return Loosened(way, None if was is None or now is None else now - was, fail, len(before))


def _kept(levels: Sequence[float | None]) -> float | None:
    """The level that 95 % keep; none where a member without one is among those about it."""
    ordered = np.sort([math.inf if level is None else level for level in levels])
    with np.errstate(invalid="ignore"):
        quantile = float(np.quantile(ordered, KEPT))
    return quantile if math.isfinite(quantile) else None


def _doubled(sample: Sample, key: str) -> Sample:
    factors = (replace(item, variation=doubled(item.variation)) if item.key == key else item for item in sample.factors)
    return replace(sample, factors=tuple(factors))


def doubled(way: Variation) -> Variation:
    """Twice the scatter about the same middle; what begins at zero, as eccentricities do, goes twice as far.

    >>> from abu_calc.errors import Place
    >>> from abu_calc.spec.variation import variation
    >>> [doubled(variation(text, Place())).numbers for text in ("uniform(4, 8)", "normal(5, 1)", "triangular(0, 1, 3)")]
    [(2.0, 10.0), (5.0, 2.0), (0.0, 2.0, 6.0)]
    """
    first, *rest = way.numbers
    if way.kind in ("normal", "lognormal"):
        return _written(way.kind, (first, 2 * rest[0]))
    middle = 0.0 if first == 0 else (first + rest[-1]) / 2 if way.kind == "uniform" else rest[0]
    numbers = [middle + 2 * (number - middle) for number in way.numbers]
    if first > 0:  # nothing that is there becomes negative
        numbers[0] = max(numbers[0], 0.0)
    return _written(way.kind, numbers)


def _written(kind: str, numbers: Sequence[float]) -> Variation:
    return Variation(kind, tuple(map(float, numbers)), (), f"{kind}({', '.join(f'{value:.6g}' for value in numbers)})")
