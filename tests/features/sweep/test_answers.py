"""Answers from a store whose members are known: percentiles, shares, basins, charts."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import beta

from abu_calc.features.sweep.answers import basins, chart, distributions, failed, meets, percentiles, spread, there
from abu_calc.features.sweep.batches import FLAGS, MEMBER, QUANTITIES, REASON, SEED, SampleColumn
from abu_calc.features.sweep.sensitivity import Factor, Sample
from abu_calc.features.sweep.store import Store
from abu_calc.foundation.errors import Place
from abu_calc.inputs.variation import variation

KEYS = SampleColumn("start.kind", ""), SampleColumn("wheel.mass_kg", "")
COLUMNS = (MEMBER, SEED, *KEYS, *QUANTITIES["scene"], *FLAGS["scene"], REASON)
LEVELS = (90.0, 95.0, 100.0, 110.0, None, 92.0)
"""The fifth member has no level; the seventh gives no numbers."""
TIMES = (1.0, 2.0, 3.0)
"""Quiet, rest and settling time of each [s]."""


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    texts = frozenset({"start.kind", "reason"})
    made = Store.open(tmp_path / "members.sqlite", {"runs": 7}, COLUMNS, texts)
    made.begun({})
    rows: list[tuple[object, ...]] = [
        (k, k, "spread" if k % 2 else "bunched", 0.5 + 0.1 * (k % 2), level, *TIMES, 0.01, 5.0, k < 4, k < 3, None)
        for k, level in enumerate(LEVELS)
    ]
    made.put([*rows, (6, 6, "bunched", 0.5, *[None] * 8, "no number")])
    yield made
    made.close()


def test_percentiles_are_those_of_numpy_and_none_comes_last(store: Store) -> None:
    known = np.sort([level for level in LEVELS if level is not None])
    low, middle, high = percentiles(store, "level_db", (0.0, 0.5, 1.0), there(store))
    assert (low, high) == (90.0, None) and middle == np.quantile([*known, 1e9], 0.5)
    assert spread(store, "level_db").mean is None and [
        spread(store, f"{name}_time_s").mean for name in ("quiet", "rest", "settling")
    ] == list(TIMES)
    assert percentiles(store, "level_db", (0.5,), "member > 99") == (None,)


def test_only_what_differs_has_a_distribution(store: Store) -> None:
    (name,) = (curves := distributions(store, "scene", {"level_db": 109.0}))
    assert name == "level_db" and curves[name].limit == 109.0 and curves[name].percent[1] == 1.0


def test_a_member_without_numbers_misses_its_limits(store: Store) -> None:
    """3 of 7; the exact interval of Clopper and Pearson by quantiles of the beta distribution."""
    share = meets(store, "scene")
    assert (share.met, share.of, share.share) == (3, 7, pytest.approx(3 / 7))
    assert share.confidence_interval == pytest.approx((beta.ppf(0.025, 3, 5), beta.ppf(0.975, 4, 4)))
    assert (share.each["balances"].met, share.each["balances"].of) == (4, 7)
    reasons = failed(store)
    assert reasons.members == 1 and (reasons.reasons[0].reason, reasons.reasons[0].first) == ("no number", 6)
    assert {basin.start: (basin.met, basin.of) for basin in basins(store)} == {"bunched": (2, 4), "spread": (2, 3)}


def test_cells_of_a_chart_have_the_shares_of_their_members(store: Store) -> None:
    ways = {"wheel.mass_kg": "0.5, 0.6, 0.7", "start.kind": "bunched, spread"}
    factors = tuple(Factor(key, (), variation(how, Place())) for key, how in ways.items())
    drawn = chart(store, Sample(factors, 7, 0), "scene", ("wheel.mass_kg", "start.kind"))
    assert drawn.x == (0.5, 0.6, 0.7) and drawn.y == ("bunched", "spread") and drawn.meets is None
    assert drawn.shares[0] == (0.5, None, None) and drawn.shares[1] == (None, pytest.approx(2 / 3), None)
    assert drawn.levels_db is not None and drawn.levels_db[0][0] == pytest.approx((90 + 100) / 2)
