"""Bounds of a share against SciPy's exact binomial test, and by simulation."""

import numpy as np
import pytest
from scipy.stats import binomtest

from abu_calc.foundation.shares import chance, compared, interval, lower, upper


@pytest.mark.parametrize(("met", "of"), [(0, 5), (5, 5), (3, 16), (97, 100), (1, 1000)])
def test_intervals_are_those_of_clopper_and_pearson(met: int, of: int) -> None:
    known = binomtest(met, of).proportion_ci(0.95, method="exact")
    assert interval(met, of) == pytest.approx((known.low, known.high), abs=1e-9)


@pytest.mark.parametrize(("wins", "losses"), [(0, 0), (0, 3), (5, 0), (7, 3), (2, 9)])
def test_the_sign_test_is_that_of_scipy(wins: int, losses: int) -> None:
    known = binomtest(wins, wins + losses, 0.5, alternative="greater").pvalue if wins + losses else 1.0
    assert chance(wins, losses) == pytest.approx(known, abs=1e-12)


def test_a_lower_bound_is_too_high_no_more_often_than_its_risk() -> None:
    draws = np.random.default_rng(1).binomial(200, 0.95, 20_000)
    wrong = np.mean([lower(int(met), 200, 0.02) > 0.95 for met in draws])
    assert wrong <= 0.02 + 3 * np.sqrt(0.02 / 20_000)
    assert np.mean([upper(int(met), 200, 0.02) < 0.95 for met in draws]) <= 0.02 + 3 * np.sqrt(0.02 / 20_000)


def test_comparison_counts_common_samples_only() -> None:
    first, second = np.array([1, 1, 0, 1, 1], dtype=bool), np.array([1, 0, 1], dtype=bool)
    assert compared(first, second) == (1, 1)
