"""Sensitivities of functions whose indices are known in closed form."""

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from abu_calc.features.sweep.sensitivity import BLOCK, Factor, Indices, RegressionSums, Sample, Scheme, block, saltelli
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
