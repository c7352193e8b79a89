"""Values to tighten or to loosen, each with its effect on the level that 95 % of samples keep.

Values that decide nothing are each tried with twice their scatter: the same samples, computed once more.
"""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np

from abu_calc.features.sweep.answers import percentiles, there
from abu_calc.features.sweep.batches import DECIDING, IMPATIENT, MEETS, Row
from abu_calc.features.sweep.result import Price, Sensitivity
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.sensitivity import Sample
from abu_calc.features.sweep.store import Store, quoted
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.variation import Variation

LEAST: Final = 64
MOST: Final = 128
"""Members of a trial."""
PART: Final = 0.5
"""All trials together have no more members than this part of the sweep."""
KEPT: Final = 0.95

Numbers = tuple[float | None, ...]
Compute = Callable[["Trials", Iterator[int], Callable[[list[Row]], None]], None]


@dataclass(frozen=True)
class Trials:
    """A study of studies: number k is member `members[k % n]` of the trial k // n."""

    studies: tuple[SweepStudy, ...]
    members: tuple[int, ...]

    def rows(self, numbers: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        """Answers of the samples, the number of each in place of the member's, and how long all took [s]."""
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

    def _of(self, number: int) -> tuple[SweepStudy, int]:
        trial, member = divmod(number, len(self.members))
        return self.studies[trial], self.members[member]


def _loosened(study: SweepStudy, store: Store, keys: Sequence[str], compute: Compute) -> dict[str, dict[str, Any]]:
    """Fields of the price of each value with twice its scatter, as many as are cheap beside the sweep; of the others
    nothing. Nor of trials that patience left out.
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


def _compared(way: str, before: Sequence[Numbers], after: Sequence[Numbers]) -> dict[str, Any]:
    """Rise of the level that 95 % of these members keep [dB], and how many more of them miss a limit."""
    was, now = _kept([level for level, _ in before]), _kept([level for level, _ in after])
    fail = sum(bool(met) for _, met in before) - sum(bool(met) for _, met in after)
    rise = None if was is None or now is None else now - was
    return {"loosened_to": way, "loosened_db": rise, "loosened_fail": fail, "loosened_of": len(before)}


def _kept(levels: Sequence[float | None]) -> float | None:
    """The level that 95 % keep; none where a member without one is among those about it."""
    ordered = np.sort([math.inf if level is None else level for level in levels])
    with np.errstate(invalid="ignore"):
        quantile = float(np.quantile(ordered, KEPT))
    return quantile if math.isfinite(quantile) else None


def _doubled(sample: Sample, key: str) -> Sample:
    factors = (
        replace(item, variation=rescaled(item.variation, 2)) if item.key == key else item for item in sample.factors
    )
    return replace(sample, factors=tuple(factors))


def rescaled(way: Variation, factor: float, *, about_zero: bool = False) -> Variation:
    """The scatter times a factor about the same middle; what begins at zero, as eccentricities do, goes on from there.

    `about_zero`: the values themselves times the factor.

    >>> from abu_calc.foundation.errors import Place
    >>> from abu_calc.inputs.variation import variation
    >>> given = [variation(text, Place()) for text in ("uniform(4, 8)", "normal(5, 1)", "triangular(0, 1, 3)")]
    >>> [rescaled(way, 2).numbers for way in given], rescaled(given[2], 0.5).text
    ([(2.0, 10.0), (5.0, 2.0), (0.0, 2.0, 6.0)], 'triangular(0, 0.5, 1.5)')
    """
    first, *rest = way.numbers
    if way.kind in ("normal", "lognormal"):
        more = factor if about_zero else 1.0
        numbers = [more * first, (1.0 if about_zero and way.kind == "lognormal" else factor) * rest[0]]
    else:
        middle = 0.0 if first == 0 or about_zero else (first + rest[-1]) / 2 if way.kind == "uniform" else rest[0]
        numbers = [middle + factor * (number - middle) for number in way.numbers]
        if first > 0:  # nothing that is there becomes negative
            numbers[0] = max(numbers[0], 0.0)
    text = f"{way.kind}({', '.join(f'{value:.6g}' for value in numbers)})"
    return Variation(way.kind, tuple(map(float, numbers)), (), text)


FIRST: Final = 0.02
"""A value whose total index is below decides nothing."""
LEAST_PRICE: Final = 40
"""Members in each half for a price to be told."""
LITTLE: Final = 0.5
"""Largest rise of the level with which a value may still be loosened [dB]."""


def prices(study: SweepStudy, store: Store, ranked: Sequence[Sensitivity], compute: Compute) -> tuple[Price, ...]:
    """Price of each value of the file that is drawn as a number, with the advice that follows.

    Values that decide nothing as they scatter are worth a trial with twice the scatter; loosening is advised only after
    it.
    """
    (whole,) = percentiles(store, DECIDING[study.what], (KEPT,), there(store))
    if whole is None:
        return ()
    drawn = {factor.key for factor in study.sample.factors if factor.path and factor.variation.numbers}
    split = ((row, _halves(store, DECIDING[study.what], row.key, whole)) for row in ranked if row.key in drawn)
    priced = [(row, price) for row, price in split if price is not None]
    idle = [row.key for row, price in reversed(priced) if price.within_chance and row.total < FIRST]
    tried = _loosened(study, store, idle, compute)
    return tuple(_advised(replace(price, **tried.get(price.key, {}))) for _, price in priced)


def _advised(price: Price) -> Price:
    rise, fail = price.loosened_db, price.loosened_fail
    loosen = rise is not None and rise <= LITTLE and fail is not None and fail <= 0
    return replace(price, advice="may be loosened" if loosen else "" if price.within_chance else "tighten")


def _halves(store: Store, name: str, key: str, whole: float) -> Price | None:
    """Price of a value by the members in its better and its other half."""
    (middle,) = percentiles(store, key, (0.5,), there(store))
    if middle is None:
        return None
    sides = []
    for side, sign in (("lower", "<="), ("upper", ">")):
        where = f"{there(store)} AND {quoted(key)} {sign} {middle!r}"
        many = store.ask(f"SELECT COUNT(*) FROM members WHERE {where}")[0][0]
        # By the binomial law of how many of a half lie below its own 95 % level.
        off = 1.96 * math.sqrt(KEPT * (1 - KEPT) / max(many, 1))
        level, highest = percentiles(store, name, (KEPT, min(KEPT + off, 1.0)), where)
        if level is not None and many >= LEAST_PRICE:
            sides.append((level, side, highest))
    if not sides:
        return None
    (level, better, highest), worse = min(sides), max(sides)[0] if len(sides) > 1 else None
    return Price(
        key=key,
        better=better,
        median=middle,
        gain_db=whole - level,
        cost_db=None if worse is None else worse - whole,
        within_chance=highest is None or whole <= highest,
        advice="",
    )
