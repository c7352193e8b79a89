"""Values of each sample of a sweep, drawn from the seed and the sample's number alone.

They do not depend on who computes them, and when. Latin hypercubes (McKay, Beckman & Conover 1979, Technometrics 21(2),
239) of 1024 samples, one after another; Sobol sequences, scrambled (Owen 1998); Saltelli's design for sensitivities
(Saltelli et al. 2010, Comput. Phys. Commun. 181, 259). Listed values are dealt in turn. The memory used does not grow
with the number of samples.
"""

import inspect
import math
import warnings
from functools import lru_cache
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

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
