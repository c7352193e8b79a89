"""Bounds of a share from samples, and the comparison of two candidates on the same samples."""

from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

CONFIDENCE: Final = 0.95


@lru_cache(maxsize=65536)
def lower(met: int, of: int, risk: float) -> float:
    """Lower bound of a share, too high with at most this risk (Clopper & Pearson 1934, Biometrika 26, 404).

    >>> round(lower(299, 299, 0.05), 4)
    0.99
    """
    from scipy.special import betaincinv

    return 0.0 if met == 0 else float(betaincinv(met, of - met + 1, risk))


@lru_cache(maxsize=65536)
def upper(met: int, of: int, risk: float) -> float:
    """Upper bound of a share, too low with at most this risk.

    >>> round(upper(0, 299, 0.05), 4)
    0.01
    """
    from scipy.special import betaincinv

    return 1.0 if met == of else float(betaincinv(met + 1, of - met, 1 - risk))


def interval(met: int, of: int) -> tuple[float, float]:
    """Interval that holds the share with 95 % confidence at least.

    >>> tuple(round(bound, 4) for bound in interval(0, 10))
    (0.0, 0.3085)
    """
    risk = (1 - CONFIDENCE) / 2
    return lower(met, of, risk), upper(met, of, risk)


def middle(met: int, of: int) -> float:
    """Mean of the share after these samples if every share was equally likely before (Laplace).

    >>> middle(9, 9) < middle(99, 99)
    True
    """
    return (met + 1) / (of + 2)


def chance(wins: int, losses: int) -> float:
    """Probability of at least so many wins among the samples that tell two equal candidates apart: exact sign test.

    >>> chance(10, 0) == 0.5 ** 10
    True
    """
    from scipy.special import betainc

    return float(betainc(wins, losses + 1, 0.5)) if wins else 1.0


def compared(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> tuple[int, int]:
    """Samples that only the first one meets, and that only the second one does, of those that both have."""
    count = min(len(first), len(second))
    one, other = first[:count], second[:count]
    return int((one & ~other).sum()), int((other & ~one).sum())
