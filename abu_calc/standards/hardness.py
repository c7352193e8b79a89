"""Hardness of steel: Rockwell C to Vickers."""

import tomllib
from bisect import bisect_left
from functools import lru_cache
from pathlib import Path

from abu_calc.validity import Range


@lru_cache(maxsize=1)
def _rows() -> tuple[tuple[float, float], ...]:
    data = tomllib.loads((Path(__file__).parent / "data" / "hardness.toml").read_text(encoding="utf-8"))
    return tuple((float(hrc), float(hv)) for hrc, hv in data["rows"])


def vickers(hrc: float) -> float:
    """Vickers hardness HV of a Rockwell C hardness, linear between the rows of the table (20 … 68 HRC).

    Source: ASTM E140-12b, table 1 (non-austenitic steels), as stated in the data file.

    >>> vickers(60)
    697.0
    """
    rows = _rows()
    Range("hardness", rows[0][0], rows[-1][0], "HRC", key="autobalancer.race_hardness_HRC").check(hrc)
    upper = max(1, bisect_left(rows, (hrc, 0.0)))
    (low, low_hv), (high, high_hv) = rows[upper - 1], rows[upper]
    return low_hv + (hrc - low) / (high - low) * (high_hv - low_hv)
