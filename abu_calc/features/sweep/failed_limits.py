"""Values that decide whether a limit fails: sensitivity of the limit's margin, and where among a value failures lie.

The margin of the level is limit − level [dB], that of the quiet time ln(limit/time); samples that are never quiet take
twice the longest time. For balancing and stalling no margin is stored: there the answer itself, 1 or 0, counts. Where
failures lie is told by comparing failing with passing samples (Spear & Hornberger 1980, Water Res. 14(1), 43).
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.sweep.answers import parts_of
from abu_calc.features.sweep.columns import FLAGS, LEVEL, QUIET
from abu_calc.features.sweep.result import DecidingValue, FailedLimit, MeetsLimits
from abu_calc.features.sweep.sampling import BLOCK, Factor, Sample, block
from abu_calc.features.sweep.sensitivity import RegressionSums
from abu_calc.features.sweep.store import Store

Array = NDArray[np.float64]

LEAST: Final = 0.02
"""Least total index of a value that is named."""
NAMED: Final = 4
SHIFT: Final = 0.05
"""Least difference of the mean places of failing and passing samples in a distribution for a side to be named."""


def failed_limits(
    store: Store, sample: Sample, met: MeetsLimits, limits: Mapping[str, float]
) -> tuple[FailedLimit, ...]:
    """Each limit that a sample fails, the most frequent first, with the values that decide its margin."""
    failing = [name for name, share in met.each.items() if share.met < share.of]
    if not failing or sample.scheme == "saltelli":
        return ()
    places, columns = _samples(store, sample)
    found = [_failed(name, places, columns, sample, limits) for name in failing]
    return tuple(sorted(found, key=lambda each: -each.failed))


def _samples(store: Store, sample: Sample) -> tuple[Array, dict[str, Array]]:
    """Places of all samples in the distributions, and their numbers and flags; NaN where one is none."""
    names = [LEVEL.name, QUIET.name, *(column.name for column in FLAGS["build"])]
    numbers, places = list[Array](), list[Array]()
    for members, columns in parts_of(store, names):
        its = np.empty((len(members), len(sample.factors)))
        for first in np.unique(members // BLOCK).tolist():
            inside = members // BLOCK == first
            its[inside] = block(sample, first)[members[inside] - first * BLOCK]
        places.append(its)
        numbers.append(columns)
    whole = np.concatenate(numbers, axis=1)
    return np.concatenate(places), dict(zip(names, whole, strict=True))


def _failed(
    name: str, places: Array, columns: Mapping[str, Array], sample: Sample, limits: Mapping[str, float]
) -> FailedLimit:
    fails = columns[name] == 0
    margin = MARGINS.get(name, _answer)(columns, limits, name)
    fit = RegressionSums(sample.factors, len(margin))
    fit.add(fit.products(places), margin, np.arange(len(margin)))
    indices = fit.indices()
    rows = [] if indices is None else [
        DecidingValue(key=factor.key, total=index.total, fails_at=_side(factor, places[:, k], fails))
        for k, (factor, index) in enumerate(zip(sample.factors, indices.each, strict=True))
        if index.total >= LEAST
    ]  # fmt: skip
    rows.sort(key=lambda row: -row.total)
    return FailedLimit(limit=name, failed=int(fails.sum()), of=len(fails), decides=tuple(rows[:NAMED]))


def _level(columns: Mapping[str, Array], limits: Mapping[str, float], _: str) -> Array:
    return limits[LEVEL.name] - columns[LEVEL.name]


def _quiet(columns: Mapping[str, Array], limits: Mapping[str, float], _: str) -> Array:
    times, limit = columns[QUIET.name], limits[QUIET.name]
    longest = max(limit, float(np.nanmax(times)) if np.isfinite(times).any() else 0.0)
    times = np.clip(np.where(np.isfinite(times), times, 2 * longest), 1e-3 * limit, None)
    return np.asarray(math.log(limit) - np.log(times))


def _answer(columns: Mapping[str, Array], _: Mapping[str, float], name: str) -> Array:
    return columns[name]


Margin = Callable[[Mapping[str, Array], Mapping[str, float], str], Array]
MARGINS: Final[dict[str, Margin]] = {"meets_level": _level, "meets_settling": _quiet}


def _side(factor: Factor, places: Array, fails: NDArray[Any]) -> str:
    """Part of a distribution in which failing samples lie: high, low, a choice; empty if it cannot be told."""
    if not fails.any() or fails.all():
        return ""
    if values := factor.variation.values:
        index = np.minimum((places * len(values)).astype(int), len(values) - 1)
        shares = [float(fails[index == k].mean()) if (index == k).any() else 0.0 for k in range(len(values))]
        return str(values[int(np.argmax(shares))])
    shift = float(places[fails].mean() - places[~fails].mean())
    return "" if abs(shift) < SHIFT else "high values" if shift > 0 else "low values"


def flags_of(store: Store) -> Iterator[tuple[int, tuple[bool, ...]]]:
    """Number of each sample with its flags; one without numbers meets none."""
    names = ", ".join(column.name for column in FLAGS["build"])
    for member, *flags in store.ask(f"SELECT member, {names} FROM members WHERE member < ?", (store.drawn,)):
        yield member, tuple(map(bool, flags))
