"""Sensitivity of one number to the values that vary: first-order and total indices (Sobol' 1993).

Both indices are shares of the number's variance. For samples drawn in any way, a sum of products of
orthonormal polynomials in the probabilities of the values is fitted. Both indices follow from its
coefficients (Sudret 2008, Reliab. Eng. Syst. Saf. 93(7), 964). A fit to four fifths of the samples is
tested on the last fifth, which decides how many products are taken. Products of more than two values
are left out; the variance that no product explains is reported too. For Saltelli's design:
scipy.stats.sobol_indices.
"""

from collections.abc import Sequence
from itertools import combinations, product
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.sweep.result import Sensitivity
from abu_calc.features.sweep.sampling import Factor

Array = NDArray[np.float64]

FOLDS: Final = 5
HIGHEST: Final = 10
"""Degree of a polynomial in one value."""
MOST: Final = 200
"""Products in a fit; each needs some members of its own."""
EACH: Final = 4
"""Members for each product at the least."""
LEVELS: Final = 12
"""Choices beyond which they are taken in their order, as a number is."""
ROUNDING: Final = 1e-9


class Indices(NamedTuple):
    """One for each factor; `unexplained`: the share of the variance that no product explains."""

    each: tuple[Sensitivity, ...]
    unexplained: float


Term = tuple[tuple[int, int], ...]
"""Factor and degree, of one value or of two."""


class RegressionSums:
    """Takes members in parts and keeps sums alone, so that memory does not grow with their number.

    `levels` of each factor: how many choices it has, 0 for a number; `members`: about how many there will be.
    """

    def __init__(self, factors: Sequence[Factor], members: int) -> None:
        self.factors = factors
        choices = (len(factor.variation.values) for factor in factors)
        self.levels = tuple(0 if count > LEVELS else count for count in choices)
        self.terms = _terms(self.levels, members)
        size = len(self.terms) + 1
        self.gram, self.right = np.zeros((FOLDS, size, size)), np.zeros((FOLDS, size))
        self.squares, self.count = np.zeros(FOLDS), np.zeros(FOLDS)

    def products(self, probabilities: Array) -> Array:
        """The value of each product for each member, which serves all numbers of the same members."""
        return _products(self.levels, self.terms, probabilities)

    def add(self, rows: Array, values: Array, members: NDArray[np.int64]) -> None:
        """Some members by their products."""
        # By a hash of their numbers: listed values come round and round.
        folds = (members * 2654435761 % 2**32 >> 16) % FOLDS
        for fold in range(FOLDS):
            here = folds == fold
            A, y = rows[here], values[here]
            self.gram[fold] += A.T @ A
            self.right[fold] += A.T @ y
            self.squares[fold] += y @ y
            self.count[fold] += len(y)

    def indices(self) -> Indices | None:
        """None with too few members; without any variance all are zero."""
        count = self.count.sum()
        if count < EACH * (len(self.levels) + 1) or not (self.count > 0).all():
            return None
        mean = self.right[:, 0].sum() / count
        variance = self.squares.sum() / count - mean**2
        if variance <= ROUNDING * max(mean**2, 1e-300):
            return _none(self.factors)
        unseen = [(self.gram.sum(axis=0) - self.gram[k], self.right.sum(axis=0) - self.right[k]) for k in range(FOLDS)]
        picked = min(_nested(self.terms), key=lambda some: self._error(some, unseen))
        G, b = _part(self.gram.sum(axis=0), self.right.sum(axis=0), picked)
        solution = _solve(G, b)
        left = max(self.squares.sum() - 2 * solution @ b + solution @ G @ solution, 0.0)
        noise = left / max(count - len(picked), 1)
        # The square of a coefficient is too large by its variance.
        parts = np.maximum(solution**2 - noise * np.diag(np.linalg.pinv(G)), 0.0)
        terms = [self.terms[k - 1] for k in picked if k]
        # Not the variance of these members: an orthonormal sum knows that of all there could be.
        shares = parts[1:] / (parts[1:].sum() + left / count)
        each = tuple(self._index(k, terms, shares) for k in range(len(self.factors)))
        return Indices(each, float(1 - min(shares.sum(), 1.0)))

    def _index(self, factor: int, terms: list[Term], shares: Array) -> Sensitivity:
        first = sum(s for term, s in zip(terms, shares, strict=True) if [variable for variable, _ in term] == [factor])
        total = sum(s for term, s in zip(terms, shares, strict=True) if factor in [variable for variable, _ in term])
        key = self.factors[factor].key
        return Sensitivity(key=key, first_order=float(min(first, 1.0)), total=float(min(total, 1.0)))

    def _error(self, picked: tuple[int, ...], unseen: list[tuple[Array, Array]]) -> float:
        """Squared error for samples that the fit has not seen; `unseen`: the sums without each fold."""
        if len(picked) * EACH > self.count.sum():
            return np.inf
        error = 0.0
        for fold, (gram, right) in enumerate(unseen):
            solution = _solve(*_part(gram, right, picked))
            G, b = _part(self.gram[fold], self.right[fold], picked)
            error += float(self.squares[fold] - 2 * solution @ b + solution @ G @ solution)
        return error


def _part(gram: Array, right: Array, picked: tuple[int, ...]) -> tuple[Array, Array]:
    """The sums of these products alone."""
    chosen = list(picked)
    return gram[np.ix_(chosen, chosen)], right[chosen]


def _solve(gram: Array, right: Array) -> Array:
    """The least squares; what is not determined stays small."""
    scale = ROUNDING * float(np.trace(gram)) / len(gram)
    return np.asarray(np.linalg.solve(gram + scale * np.eye(len(gram)), right), dtype=np.float64)


def _terms(levels: tuple[int, ...], members: int) -> list[Term]:
    """Products by their degree; of one value before those of two."""
    room = min(MOST, members // EACH)
    terms: list[Term] = []
    for degree in range(1, HIGHEST + 1):
        alone = [((k, degree),) for k, count in enumerate(levels) if degree < (count or HIGHEST + 1)]
        pairs = [
            ((i, a), (j, degree - a))
            for i, j in combinations(range(len(levels)), 2)
            for a in range(1, degree)
            if a < (levels[i] or HIGHEST) and degree - a < (levels[j] or HIGHEST)
        ]
        for some in (alone, pairs):
            if len(terms) + len(some) <= room:
                terms += some
    return terms


def _nested(terms: list[Term]) -> list[tuple[int, ...]]:
    """Sets of products to choose from, as numbers of columns: up to a degree alone, and up to one in pairs."""
    highest = max((sum(d for _, d in term) for term in terms), default=0)
    sets = {
        (0, *(k for k, term in enumerate(terms, 1) if sum(d for _, d in term) <= (alone if len(term) == 1 else pairs)))
        for alone, pairs in product(range(highest + 1), repeat=2)
        if pairs <= alone
    }
    return sorted(sets, key=len)


def _products(levels: tuple[int, ...], terms: list[Term], probabilities: Array) -> Array:
    """The value of each product for each member; the constant first."""
    functions = [_functions(count, probabilities[:, k]) for k, count in enumerate(levels)]
    rows = np.ones((len(probabilities), len(terms) + 1))
    for column, term in enumerate(terms, 1):
        for factor, degree in term:
            rows[:, column] *= functions[factor][degree]
    return rows


def _functions(levels: int, probability: Array) -> list[Array]:
    """Orthonormal functions of a probability that is equally likely everywhere: Legendre's polynomials.

    Of choices one fewer than there are, orthonormal over them.
    """
    if not levels:
        x = 2 * probability - 1
        unit = np.eye(HIGHEST + 1)
        return [np.sqrt(2 * k + 1) * np.polynomial.legendre.legval(x, unit[k]) for k in range(HIGHEST + 1)]
    basis, _ = np.linalg.qr(np.vander(np.linspace(-1, 1, levels), levels, increasing=True))
    chosen = np.minimum((probability * levels).astype(int), levels - 1)
    return [np.sqrt(levels) * basis[chosen, k] for k in range(levels)]


def _none(factors: Sequence[Factor]) -> Indices:
    """Of a number that is the same for all."""
    return Indices(tuple(Sensitivity(key=factor.key, first_order=0.0, total=0.0) for factor in factors), 0.0)


def saltelli(values: Array, factors: Sequence[Factor]) -> Indices:
    """Indices from the samples of Saltelli's design in their order, each of its parts a power of two."""
    from scipy.stats import sobol_indices

    parts = values.reshape(len(factors) + 2, -1)
    if np.ptp(parts) <= ROUNDING * np.abs(parts).max():
        return _none(factors)
    indices: Any = sobol_indices(
        func={"f_A": parts[:1].copy(), "f_B": parts[1:2].copy(), "f_AB": parts[2:, None, :].copy()}, n=parts.shape[1]
    )
    rows = zip(factors, np.atleast_1d(indices.first_order), np.atleast_1d(indices.total_order), strict=True)
    each = (Sensitivity(key=row.key, first_order=float(first), total=float(total)) for row, first, total in rows)
    return Indices(tuple(each), 0.0)
