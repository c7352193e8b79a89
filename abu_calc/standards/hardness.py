"""Hardness of steel: Rockwell C to Vickers."""

from bisect import bisect_left

from abu_calc.standards.tables import toml_table
from abu_calc.validity import Range


def vickers(hrc: float) -> float:
    """Vickers hardness HV of a Rockwell C hardness, linear between the rows of the table (20 … 68 HRC).

    Source: ASTM E140-12b, table 1 (non-austenitic steels), as stated in the data file.

    >>> vickers(60)
    697.0
    """
    rows: list[tuple[float, float]] = toml_table("hardness")["rows"]
    Range("hardness", rows[0][0], rows[-1][0], "HRC", key="autobalancer.race_hardness_HRC").check(hrc)
    upper = max(1, bisect_left(rows, hrc, key=lambda row: row[0]))
    (low, low_hv), (high, high_hv) = rows[upper - 1], rows[upper]
    return float(low_hv + (hrc - low) / (high - low) * (high_hv - low_hv))
