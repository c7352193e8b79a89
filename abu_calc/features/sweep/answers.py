"""Answers of a sweep, common to all samples in a store: spreads, shares, sensitivities, charts.

They are read from the store in parts: memory does not grow with the number of samples.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

import numpy as np

from abu_calc.features.sweep.batches import BALANCES, DECIDING, FLAGS, IMPATIENT, MEETS, QUANTITIES, What
from abu_calc.features.sweep.result import (
    Basin,
    Chart,
    Distribution,
    Failed,
    Failure,
    LimitShare,
    MeetsLimits,
    Percentiles,
    Sensitivity,
)
from abu_calc.features.sweep.sensitivity import BLOCK, Indices, RegressionSums, Sample, block, saltelli
from abu_calc.features.sweep.store import Store, quoted
from abu_calc.foundation.shares import interval

REASONS: Final = 20
"""Most reasons that are listed."""
SHARES: Final = (0.0, 0.01, 0.02, *(k / 20 for k in range(1, 20)), 0.98, 0.99, 1.0)
"""Shares of samples for which a distribution is given."""
START: Final = "start.kind"
ANSWERED: Final = "reason IS NULL"
TRIED: Final = f"COALESCE(reason, '') <> '{IMPATIENT}'"
"""Members that patience left out count in no share: nobody knows what they meet."""


def there(store: Store) -> str:
    """Members with answers that were drawn each for itself."""
    return f"{ANSWERED} AND member < {store.drawn}"


def failed(store: Store) -> Failed:
    """Number of samples that gave no numbers, and the reasons."""
    query = "SELECT reason, COUNT(*), MIN(member) FROM members WHERE reason IS NOT NULL GROUP BY reason ORDER BY 2 DESC"
    rows = store.ask(f"{query}, 1 LIMIT {REASONS}")
    count = store.ask("SELECT COUNT(*) FROM members WHERE reason IS NOT NULL")[0][0]
    return Failed(members=count, reasons=tuple(Failure(reason=r, members=n, first=k) for r, n, k in rows))


def left_out(store: Store) -> int:
    """Number of samples that were not computed since the seconds of --patience were over."""
    return int(store.ask("SELECT COUNT(*) FROM members WHERE reason = ?", (IMPATIENT,))[0][0])


def spreads(store: Store, what: What) -> dict[str, Percentiles]:
    """Spread of each quantity."""
    return {column.name: spread(store, column.name) for column in QUANTITIES[what]}


def spread(store: Store, name: str) -> Percentiles:
    """Percentiles as NumPy has them; one that is null (never, or nothing) comes after all numbers."""
    column = quoted(name)
    query = f"SELECT COUNT(*), COUNT({column}), AVG({column}) FROM members WHERE {there(store)}"
    count, numbers, mean = store.ask(query)[0]
    p05, p50, p95 = percentiles(store, name, (0.05, 0.5, 0.95), there(store))
    return Percentiles(p05=p05, p50=p50, p95=p95, mean=mean if numbers == count and count else None)


def distributions(store: Store, what: What, limits: Mapping[str, float]) -> dict[str, Distribution]:
    """Distribution of each quantity that is not the same for all."""
    quantiles = {column.name: percentiles(store, column.name, SHARES, there(store)) for column in QUANTITIES[what]}
    percent = tuple(round(100 * share, 1) for share in SHARES)
    return {
        name: Distribution(percent=percent, values=values, limit=limits.get(name))
        for name, values in quantiles.items()
        if values[0] is not None and values[0] != values[-1]
    }


def percentiles(store: Store, name: str, shares: Sequence[float], where: str) -> tuple[float | None, ...]:
    """Each between the two members about it, None where one of them is none; the members are put in order once."""
    count = store.ask(f"SELECT COUNT(*) FROM members WHERE {where}")[0][0]
    if not count:
        return (None,) * len(shares)
    places = [share * (count - 1) for share in shares]
    wanted = sorted({k for place in places for k in (math.floor(place), math.ceil(place))})
    column = quoted(name)
    query = (
        f"SELECT k, v FROM (SELECT {column} AS v, ROW_NUMBER() OVER (ORDER BY {column} IS NULL, {column}) - 1 AS k "
        f"FROM members WHERE {where}) WHERE k IN ({', '.join(map(str, wanted))})"
    )
    values = dict(store.ask(query))
    return tuple(_between(values, place) for place in places)


def _between(values: Mapping[int, float | None], place: float) -> float | None:
    low, high = values[math.floor(place)], values[math.ceil(place)]
    if low is None or high is None:
        return None
    return float(low + (place - math.floor(place)) * (high - low))


def meets(store: Store, what: What) -> MeetsLimits:
    """Shares with their confidence; members without an answer count as not meeting."""
    each = {column.name: _share(store, column.name) for column in FLAGS[what]}
    whole = each.pop(MEETS.name)
    return MeetsLimits(**vars(whole), each=each)


def _share(store: Store, name: str) -> LimitShare:
    query = f"SELECT COALESCE(SUM({quoted(name)}), 0), COUNT(*) FROM members WHERE {TRIED} AND member < {store.drawn}"
    met, count = store.ask(query)[0]
    return LimitShare(share=met / count, confidence_interval=interval(met, count), met=int(met), of=int(count))


def basins(store: Store) -> tuple[Basin, ...]:
    """The share of starts that balance, of each kind of start; members without an answer count as not balancing."""
    if START not in store.names:
        return ()
    kind, flag = quoted(START), quoted(BALANCES.name)
    query = (
        f"SELECT {kind}, COALESCE(SUM({flag}), 0), COUNT(*) FROM members WHERE {TRIED} AND member < {store.drawn} "
        "GROUP BY 1"
    )
    return tuple(
        Basin(start=name, share=met / count, confidence_interval=interval(met, count), met=int(met), of=int(count))
        for name, met, count in store.ask(query)
    )


def sensitivities(
    store: Store, sample: Sample, what: What
) -> tuple[dict[str, tuple[Sensitivity, ...]], dict[str, float]]:
    """Sensitivities by number, the deciding one first; and the unexplained share of each.

    Sensitivities from too few samples are left out.
    """
    names = list(dict.fromkeys((DECIDING[what], *(column.name for column in QUANTITIES[what]), MEETS.name)))
    every = (_of_saltelli if sample.scheme == "saltelli" else _of_fits)(store, sample, names)
    by_name: dict[str, tuple[Sensitivity, ...]] = {}
    unexplained: dict[str, float] = {}
    for name, indices in every.items():
        if indices is not None:
            by_name[name] = tuple(sorted(indices.each, key=lambda row: -row.total))
            unexplained[name] = indices.unexplained
    return by_name, unexplained


def _of_fits(store: Store, sample: Sample, names: Sequence[str]) -> dict[str, Indices | None]:
    """All numbers in one pass, since their products are the same."""
    fits = {name: RegressionSums(sample.factors, sample.runs) for name in names}
    for members, columns in parts_of(store, names):
        places = np.empty((len(members), len(sample.factors)))
        for first in np.unique(members // BLOCK).tolist():
            here = members // BLOCK == first
            places[here] = block(sample, first)[members[here] - first * BLOCK]
        rows = fits[names[0]].products(places)
        for fit, values in zip(fits.values(), columns, strict=True):
            there = np.isfinite(values)
            fit.add(rows[there], values[there], members[there])
    return {name: fit.indices() for name, fit in fits.items()}


def _of_saltelli(store: Store, sample: Sample, names: Sequence[str]) -> dict[str, Indices | None]:
    """A row of the matrices in which a member gave no number is replaced by the next whole one."""
    values = np.full((len(names), sample.runs), np.nan)
    for members, columns in parts_of(store, names):
        values[:, members] = columns
    indices: dict[str, Indices | None] = {}
    for name, column in zip(names, values, strict=True):
        parts = column.reshape(len(sample.factors) + 2, -1)
        whole = np.flatnonzero(np.isfinite(parts).all(axis=0))
        rows = whole[np.searchsorted(whole, np.arange(parts.shape[1])) % len(whole)] if len(whole) else whole
        indices[name] = saltelli(parts[:, rows].ravel(), sample.factors) if len(whole) else None
    return indices


def parts_of(store: Store, names: Sequence[str]) -> Iterator[tuple[Any, Any]]:
    """Members with answers and their numbers (names × members), some thousand at a time; NaN where one is none."""
    query = f"SELECT member, {', '.join(map(quoted, names))} FROM members WHERE {ANSWERED}"
    size = 8 * BLOCK
    for first in range(0, store.runs, size):
        rows = store.ask(f"{query} AND member >= ? AND member < ? ORDER BY member", (first, first + size))
        if rows:
            table = np.array([[np.nan if value is None else value for value in row] for row in rows], dtype=float).T
            yield table[0].astype(np.int64), table[1:]


def chart(store: Store, sample: Sample, what: What, grid: tuple[str, str]) -> Chart:
    """Shares over two keys, the first across."""
    across, upward = (next(factor for factor in sample.factors if factor.key == key).variation.values for key in grid)
    flag = FLAGS[what][0].name
    # A member without an answer counts as not met; a cell without any has no share.
    met = (f"CASE WHEN COUNT({name}) THEN 1.0 * SUM({name}) / COUNT(*) END" for name in map(quoted, (flag, MEETS.name)))
    columns = f"{', '.join(map(quoted, grid))}, {', '.join(met)}, AVG({quoted(DECIDING[what])})"
    query = f"SELECT {columns} FROM members WHERE {TRIED} AND member < {store.drawn} GROUP BY 1, 2"
    cells: dict[tuple[object, object], tuple[float | None, ...]] = {
        (x, y): (*cell,) for x, y, *cell in store.ask(query)
    }

    def field(part: int) -> tuple[tuple[float | None, ...], ...]:
        """One quantity of all cells, a row for each value of the second key."""
        return tuple(tuple(cell(abscissa, other, part) for abscissa in x) for other in y)

    def cell(x: object, y: object, part: int) -> float | None:
        """One quantity of a cell; None where no sample gave one."""
        return cells.get((x, y), (None, None, None))[part]

    x, y = (tuple(_plain(value) for value in values) for values in (across, upward))
    return Chart(
        x_key=grid[0],
        y_key=grid[1],
        x=x,
        y=y,
        of=flag,
        shares=field(0),
        meets=field(1) if len(FLAGS[what]) > 2 else None,
        levels_db=field(2),
    )


def _plain(value: object) -> float | str:
    return value if isinstance(value, (int, float)) and not isinstance(value, bool) else str(value)
