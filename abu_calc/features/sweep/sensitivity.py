"""Sensitivity of one number to the values that vary: first-order and total indices (Sobol' 1993).

Both indices are shares of the number's variance. For samples drawn in any way, a sum of products of
orthonormal polynomials in the probabilities of the values is fitted. Both indices follow from its
coefficients (Sudret 2008, Reliab. Eng. Syst. Saf. 93(7), 964). A fit to four fifths of the samples is
tested on the last fifth, which decides how many products are taken. Products of more than two values
are left out; the variance that no product explains is reported too. For Saltelli's design:
scipy.stats.sobol_indices.

Values of each sample of a sweep, drawn from the seed and the sample's number alone.

They do not depend on who computes them, and when. Latin hypercubes (McKay, Beckman & Conover 1979, Technometrics 21(2),
239) of 1024 samples, one after another; Sobol sequences, scrambled (Owen 1998); Saltelli's design for sensitivities
(Saltelli et al. 2010, Comput. Phys. Commun. 181, 259). Listed values are dealt in turn. The memory used does not grow
with the number of samples.
"""

import inspect
import math
import warnings
from collections.abc import Sequence
from functools import lru_cache
from itertools import combinations, product
from typing import Any, Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.sweep.result import Sensitivity
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.text import Part
from abu_calc.inputs.variation import Variation

Array = NDArray[np.float64]
Scheme = Literal["latin-hypercube", "sobol", "saltelli"]

BLOCK: Final = 1024
"""Members that are drawn together."""
TINY: Final = 1e-12
"""Nearest to 0 and 1 that a probability comes."""


@dataclass(frozen=True)
class Factor:
    """A value that varies: its key, the path in the file (empty: of the start, which no file has), and how."""

    key: str
    path: tuple[Part, ...]
    variation: Variation


@dataclass(frozen=True)
class Sample:
    """Samples of a sweep: `runs` of them, numbered from 0; `base`: rows of Saltelli's two matrices."""

    factors: tuple[Factor, ...]
    runs: int
    seed: int
    scheme: Scheme = "latin-hypercube"
    base: int = 0

    @property
    def points(self) -> int:
        """Combinations of listed values."""
        return math.prod(len(factor.variation.values) for factor in self.factors if factor.variation.listed)

    @property
    def drawn(self) -> int:
        """Number of independently drawn samples: in Saltelli's design those of its first two matrices."""
        return 2 * self.base if self.scheme == "saltelli" else self.runs

    def probabilities(self, member: int) -> tuple[float, ...]:
        """Places of a sample's values in their distributions, 0 … 1."""
        first = member - member % BLOCK
        return tuple(block(self, first // BLOCK)[member - first].tolist())

    def values(self, member: int) -> tuple[object, ...]:
        """The values of a member, in the order of the factors."""
        pairs = zip(self.factors, self.probabilities(member), strict=True)
        return tuple(value_at(factor.variation, probability) for factor, probability in pairs)

    def member_seed(self, member: int) -> int:
        """The seed of what is particular to one member; in Saltelli's design the same for a row of all matrices."""
        row = member % self.base if self.scheme == "saltelli" else member
        # The child that SeedSequence(seed).spawn(2)[1].spawn(…)[row] is, without its brothers.
        return int(np.random.SeedSequence(self.seed, spawn_key=(1, row)).generate_state(1)[0])


@lru_cache(maxsize=8)
def block(sample: Sample, number: int) -> Array:
    """Probabilities of 1024 members at once, the last block shorter: members × factors."""
    first = number * BLOCK
    count = min(BLOCK, sample.runs - first)
    if sample.scheme == "saltelli":
        return _saltelli(sample, np.arange(first, first + count))
    probabilities = np.empty((count, len(sample.factors)))
    drawn = [k for k, drawn_factor in enumerate(sample.factors) if not drawn_factor.variation.listed]
    if drawn:
        probabilities[:, drawn] = _drawn(sample, number, count, len(drawn))
    members, step = np.arange(first, first + count), sample.points
    for k, factor in enumerate(sample.factors):
        if factor.variation.listed:
            many = len(factor.variation.values)
            step //= many
            probabilities[:, k] = (members // step % many + 0.5) / many
    return probabilities


def _drawn(sample: Sample, number: int, count: int, width: int) -> Array:
    from scipy.stats import qmc

    if sample.scheme == "sobol":
        return _sobol(sample.seed, width, number * BLOCK, count)
    child = np.random.SeedSequence(sample.seed, spawn_key=(0, number))
    engine = qmc.LatinHypercube(width, **_random(qmc.LatinHypercube, child))
    return np.clip(np.asarray(engine.random(count)), TINY, 1 - TINY)


def _sobol(seed: int, width: int, first: int, count: int) -> Array:
    from scipy.stats import qmc

    engine = qmc.Sobol(width, scramble=True, **_random(qmc.Sobol, np.random.SeedSequence(seed, spawn_key=(0,))))
    with warnings.catch_warnings():  # a part of the sequence is no power of two, which is no fault
        warnings.simplefilter("ignore")
        if first:
            engine.fast_forward(first)
        return np.clip(np.asarray(engine.random(count)), TINY, 1 - TINY)


def _random(kind: Any, seed: np.random.SeedSequence) -> dict[str, Any]:
    """The generator, as this SciPy calls it."""
    name = "rng" if "rng" in inspect.signature(kind).parameters else "seed"
    return {name: np.random.default_rng(seed)}


def _saltelli(sample: Sample, members: NDArray[np.int64]) -> Array:
    """Rows of A, then of B, then of A with one column after another from B."""
    width, probabilities = len(sample.factors), np.empty((len(members), len(sample.factors)))
    for part in np.unique(members // sample.base).tolist():
        here = members // sample.base == part
        rows = members[here] % sample.base
        both = _sobol(sample.seed, 2 * width, int(rows[0]), len(rows))
        own = both[:, width:] if part == 1 else both[:, :width].copy()
        if part > 1:
            own[:, part - 2] = both[:, width + part - 2]
        probabilities[here] = own
    return probabilities


def value_at(variation: Variation, probability: float) -> object:
    """The value below which a share of all lies; of choices that in which it falls.

    >>> from abu_calc.foundation.errors import Place
    >>> from abu_calc.inputs.variation import variation
    >>> value_at(variation("uniform(2, 4)", Place()), 0.25), value_at(variation("choice(a, b)", Place()), 0.7)
    (2.5, 'b')
    """
    if variation.values:
        return variation.values[min(int(probability * len(variation.values)), len(variation.values) - 1)]
    first, second, *rest = variation.numbers
    if variation.kind == "uniform":
        return first + probability * (second - first)
    if variation.kind == "triangular":
        return _triangular(first, second, rest[0], probability)
    from scipy.special import ndtri

    deviation = float(ndtri(probability))
    return first * math.exp(second * deviation) if variation.kind == "lognormal" else first + second * deviation


def _triangular(low: float, mode: float, high: float, probability: float) -> float:
    if probability * (high - low) < mode - low:
        return low + math.sqrt(probability * (high - low) * (mode - low))
    return high - math.sqrt((1 - probability) * (high - low) * (high - mode))


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
