"""Members are known from the seed and their number alone, and drawn as SciPy draws."""

from typing import Any

import numpy as np
import pytest
from scipy import stats
from scipy.stats import qmc

from abu_calc.features.sweep.sensitivity import BLOCK, Factor, Sample, Scheme, block, value_at
from abu_calc.foundation.errors import Place
from abu_calc.inputs.variation import variation


def factor(key: str, how: str) -> Factor:
    return Factor(key, (key,), variation(how, Place()))


def sample(runs: int, scheme: Scheme = "latin-hypercube", *hows: str, base: int = 0) -> Sample:
    factors = tuple(factor(f"k{k}", how) for k, how in enumerate(hows or ("uniform(0,1)",) * 3))
    return Sample(factors, runs, 7, scheme, base)


def test_each_block_is_a_latin_hypercube() -> None:
    drawn = sample(BLOCK + 100)
    for number, count in ((0, BLOCK), (1, 100)):
        strata = np.sort((block(drawn, number) * count).astype(int), axis=0)
        assert (strata == np.arange(count)[:, None]).all()


def test_a_member_does_not_hang_on_who_was_asked_before() -> None:
    drawn = sample(3000)
    late = drawn.values(2500)
    block.cache_clear()
    assert [drawn.values(member) for member in (0, 2500)][1] == late


def test_seeds_are_the_children_of_the_seed_sequence() -> None:
    drawn = sample(5)
    children = np.random.SeedSequence(7).spawn(2)[1].spawn(5)
    assert [drawn.member_seed(k) for k in range(5)] == [int(child.generate_state(1)[0]) for child in children]


def test_a_sobol_sequence_goes_on_over_blocks() -> None:
    drawn = sample(2 * BLOCK, "sobol")
    found = np.vstack([block(drawn, 0), block(drawn, 1)])
    first = np.random.SeedSequence(7, spawn_key=(0,))
    expected = qmc.Sobol(3, scramble=True, seed=np.random.default_rng(first)).random(2 * BLOCK)
    assert np.allclose(found, expected, rtol=0, atol=1e-11)
    assert qmc.discrepancy(found) < qmc.discrepancy(np.random.default_rng(1).random((2 * BLOCK, 3))) / 20


def test_saltellis_matrices_share_their_columns() -> None:
    base = 8
    drawn = sample(5 * base, "saltelli", base=base)
    rows = np.array([drawn.probabilities(member) for member in range(5 * base)]).reshape(5, base, 3)
    a, b = rows[0], rows[1]
    assert not np.isclose(a, b).any()
    for k in range(3):
        expected = a.copy()
        expected[:, k] = b[:, k]
        assert (rows[2 + k] == expected).all()
    assert drawn.member_seed(3) == drawn.member_seed(3 + 4 * base)


def test_listed_values_are_dealt_in_turn() -> None:
    drawn = sample(12, "latin-hypercube", "1:3:3", "uniform(0,1)", "a,b")
    pairs = [(drawn.values(k)[0], drawn.values(k)[2]) for k in range(12)]
    assert pairs[:6] == [(1, "a"), (1, "b"), (2, "a"), (2, "b"), (3, "a"), (3, "b")] and pairs[6:] == pairs[:6]
    assert drawn.points == 6


@pytest.mark.parametrize(
    ("how", "law"),
    [
        ("uniform(2,5)", stats.uniform(2, 3)),
        ("normal(265,40)", stats.norm(265, 40)),
        ("lognormal(2.5,0.3)", stats.lognorm(0.3, scale=2.5)),
        ("triangular(1,2,5)", stats.triang(0.25, 1, 4)),
        ("triangular(1,1,5)", stats.triang(0, 1, 4)),
    ],
)
def test_distributions_are_those_of_scipy(how: str, law: Any) -> None:
    way = variation(how, Place())
    for probability in (1e-9, 0.1, 0.25, 0.5, 0.9, 1 - 1e-9):
        assert value_at(way, probability) == pytest.approx(law.ppf(probability), rel=1e-9)
