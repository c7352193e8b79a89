"""Sensitivities of functions whose indices are known in closed form.

Members are known from the seed and their number alone, and drawn as SciPy draws.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from scipy import stats
from scipy.stats import qmc

from abu_calc.features.sweep.sensitivity import (
    BLOCK,
    Factor,
    Indices,
    RegressionSums,
    Sample,
    Scheme,
    block,
    saltelli,
    value_at,
)
from abu_calc.foundation.errors import Place
from abu_calc.inputs.variation import variation

ISHIGAMI = ((0.3139, 0.5576), (0.4424, 0.4424), (0.0, 0.2437))
"""Of sin x + 7 sin² y + 0.1 z⁴ sin x over (−π, π)³ (Ishigami & Homma 1990)."""


def ishigami(x: Sequence[float]) -> float:
    return math.sin(x[0]) + 7 * math.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * math.sin(x[0])


def drawn(runs: int, hows: Sequence[str], scheme: Scheme = "latin-hypercube", base: int = 0) -> Sample:
    factors = tuple(Factor(f"k{k}", (f"k{k}",), variation(how, Place())) for k, how in enumerate(hows))
    return Sample(factors, runs, 3, scheme, base)


def values(
    sample: Sample, function: Callable[[Sequence[float]], float]
) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.array([function(sample.values(member)) for member in range(sample.runs)])  # type: ignore[arg-type]


def fitted(sample: Sample, found: np.ndarray[tuple[int], np.dtype[np.float64]], parts: int = 1) -> Indices | None:
    fit = RegressionSums(sample.factors, sample.runs)
    places = np.vstack([block(sample, number) for number in range(-(-sample.runs // BLOCK))])
    for members in np.array_split(np.arange(sample.runs), parts):
        fit.add(fit.products(places[members]), found[members], members)
    return fit.indices()


CIRCLE = ["uniform(-3.141592653589793, 3.141592653589793)"] * 3


def test_indices_of_ishigami_from_the_members_there_are() -> None:
    """A fit of finite degree to 600 members; its error is some hundredths."""
    sample = drawn(600, CIRCLE)
    found = fitted(sample, values(sample, ishigami))
    assert found is not None
    for index, (first, total) in zip(found.each, ISHIGAMI, strict=True):
        assert index.first_order == pytest.approx(first, abs=0.02)
        assert index.total == pytest.approx(total, abs=0.02)
    assert found.unexplained < 0.02


def test_indices_of_ishigami_by_saltellis_design() -> None:
    """1024 rows; the error of estimates of this design is some hundredths (Saltelli et al. 2010, figure 1)."""
    sample = drawn(5 * 1024, CIRCLE, "saltelli", 1024)
    found = saltelli(values(sample, ishigami), sample.factors)
    for index, (first, total) in zip(found.each, ISHIGAMI, strict=True):
        assert index.first_order == pytest.approx(first, abs=0.05)
        assert index.total == pytest.approx(total, abs=0.05)


def test_a_sum_of_unequal_laws() -> None:
    """Var of a uniform (b−a)²/12, of a normal σ², of two equally likely values (d/2)²."""
    sample = drawn(400, ["uniform(0,6)", "normal(0,2)", "choice(-1,1)", "uniform(0,1)"])
    found = fitted(sample, values(sample, lambda x: x[0] + x[1] + x[2]))
    assert found is not None
    parts = np.array([3.0, 4.0, 1.0, 0.0])
    for index, share in zip(found.each, parts / parts.sum(), strict=True):
        assert index.first_order == pytest.approx(share, abs=0.02)
        assert index.total == pytest.approx(share, abs=0.02)


def test_a_product_acts_only_together() -> None:
    sample = drawn(400, ["uniform(-1,1)", "choice(-1,1)", "uniform(-1,1)"])
    found = fitted(sample, values(sample, lambda x: x[0] * x[1]))
    assert found is not None
    assert [round(index.first_order, 2) for index in found.each] == [0, 0, 0]
    assert [round(index.total, 2) for index in found.each] == [1, 1, 0]


def test_chance_alone_is_explained_by_nothing() -> None:
    sample = drawn(500, ["uniform(-1,1)"] * 5)
    found = fitted(sample, np.random.default_rng(2).normal(size=500))
    assert found is not None
    assert max(index.total for index in found.each) < 0.05 and found.unexplained > 0.9


def test_parts_do_not_matter() -> None:
    sample = drawn(300, CIRCLE)
    y = values(sample, ishigami)
    one, many = fitted(sample, y), fitted(sample, y, parts=7)
    assert one is not None and many is not None
    for a, b in zip(one.each, many.each, strict=True):
        assert (a.first_order, a.total) == pytest.approx((b.first_order, b.total), abs=1e-8)


def test_too_few_members_say_nothing_and_constants_are_decided_by_nothing() -> None:
    few, constant = drawn(10, CIRCLE), drawn(100, CIRCLE)
    assert fitted(few, values(few, ishigami)) is None
    found = fitted(constant, np.full(100, 3.0))
    assert found is not None and {index.total for index in found.each} == {0.0}
    assert {index.total for index in saltelli(np.full(40, 3.0), constant.factors).each} == {0.0}


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
