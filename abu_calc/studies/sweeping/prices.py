"""Values to tighten or to loosen, each with its effect on the level that 95 % of samples keep."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

from abu_calc.analysis.sampling import Sample
from abu_calc.studies.sweeping.answers import percentiles, there
from abu_calc.studies.sweeping.columns import DECIDING, What
from abu_calc.studies.sweeping.loosening import Loosened
from abu_calc.studies.sweeping.records import Price, Sensitivity
from abu_calc.studies.sweeping.store import Store, quoted

FIRST: Final = 0.02
"""A value whose total index is below decides nothing."""
LEAST: Final = 40
"""Members in each half for a price to be told."""
KEPT: Final = 0.95
"""Share of members whose level is told."""
LITTLE: Final = 0.5
"""Largest rise of the level with which a value may still be loosened [dB]."""


class Halves(NamedTuple):
    """The members by one value: what the level is in its better and its other half."""

    row: Sensitivity
    better: str
    median: float
    gain: float
    cost: float | None
    within_chance: bool

    @property
    def idle(self) -> bool:
        """True if the value decides nothing as it is, so that more scatter is worth a trial."""
        return self.within_chance and self.row.total < FIRST


def halves(store: Store, sample: Sample, what: What, ranked: Sequence[Sensitivity]) -> tuple[Halves, ...]:
    """Halves for each value of the file that is drawn as a number."""
    (whole,) = percentiles(store, DECIDING[what], (KEPT,), there(store))
    if whole is None:
        return ()
    drawn = {factor.key for factor in sample.factors if factor.path and factor.variation.numbers}
    splits = (_halves(store, DECIDING[what], row, whole) for row in ranked if row.key in drawn)
    return tuple(split for split in splits if split is not None)


def _halves(store: Store, name: str, row: Sensitivity, whole: float) -> Halves | None:
    key = quoted(row.key)
    (middle,) = percentiles(store, row.key, (0.5,), there(store))
    if middle is None:
        return None
    sides = []
    for side, sign in (("lower", "<="), ("upper", ">")):
        where = f"{there(store)} AND {key} {sign} {middle!r}"
        many = store.ask(f"SELECT COUNT(*) FROM members WHERE {where}")[0][0]
        # By the binomial law of how many of a half lie below its own 95 % level.
        off = 1.96 * math.sqrt(KEPT * (1 - KEPT) / max(many, 1))
        level, highest = percentiles(store, name, (KEPT, min(KEPT + off, 1.0)), where)
        if level is not None and many >= LEAST:
            sides.append((level, side, highest))
    if not sides:
        return None
    (level, better, highest), worse = min(sides), max(sides)[0] if len(sides) > 1 else None
    cost = None if worse is None else worse - whole
    return Halves(row, better, middle, whole - level, cost, highest is None or whole <= highest)


def prices(splits: Sequence[Halves], tried: Mapping[str, Loosened]) -> tuple[Price, ...]:
    """Prices with the advice that follows; loosening is advised only after it was tried."""
    return tuple(_price(split, tried.get(split.row.key)) for split in splits)


def _price(split: Halves, tried: Loosened | None) -> Price:
    loosen = tried is not None and tried.rise is not None and tried.rise <= LITTLE and tried.fail <= 0
    loosened: dict[str, Any] = {} if tried is None else {
        "loosened_to": tried.way, "loosened_db": tried.rise, "loosened_fail": tried.fail, "loosened_of": tried.members,
    }  # fmt: skip
    return Price(
        key=split.row.key, better=split.better, median=split.median, gain_db=split.gain, cost_db=split.cost,
        within_chance=split.within_chance, **loosened,
        advice="may be loosened" if loosen else "" if split.within_chance else "tighten",
    )  # fmt: skip
